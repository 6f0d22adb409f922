"""What pyproject.toml cannot say: the version, and that CMake builds the module."""

import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).parent.resolve()


def version():
    """It stands in project() of CMakeLists.txt and nowhere else."""
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"project\(trochoid VERSION (\S+)", text)[1]


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        wanted = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        # What ./run python or ./test built for this Python only needs to be renewed.
        build = ROOT / "build/release"
        if not (build / "python/trochoid" / wanted.name).exists():
            build = ROOT / "build/pip"
            options = [
                "-DCMAKE_BUILD_TYPE=Release",
                "-DTROCHOID_BUILD_TESTS=OFF",
                "-DTROCHOID_DEVELOPER=OFF",
                "-DTROCHOID_BUILD_PYTHON=ON",
                f"-DTROCHOID_PYTHON={sys.executable}",
            ]
            generator = ["-G", "Ninja"] if shutil.which("ninja") else []
            self.run_cmake("-S", ROOT, "-B", build, *generator, *options)
        self.run_cmake("--build", build, "--target", "trochoid_python")
        wanted.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(build / "python/trochoid" / wanted.name, wanted)

    def run_cmake(self, *arguments):
        subprocess.run(["cmake", *arguments], check=True)


setup(
    version=version(),
    ext_modules=[Extension("trochoid._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
)
