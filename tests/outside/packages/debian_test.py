"""The Debian package: what it says of itself, what it holds, and that it runs unpacked."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import helps

EXAMPLE = pathlib.Path(__file__).resolve().parents[3] / "examples/ball/case.toml"
CONTENT = """
usr/bin/trochoid
usr/include/trochoid/correction/controller.h
usr/lib/libtrochoid.a
usr/lib/libtrochoid_controller.a
usr/lib/cmake/trochoid/trochoidConfig.cmake
usr/lib/pkgconfig/trochoid.pc
usr/share/man/man1/trochoid.1
usr/share/bash-completion/completions/trochoid
usr/share/zsh/vendor-completions/_trochoid
usr/share/fish/vendor_completions.d/trochoid.fish
usr/share/doc/trochoid/copyright
usr/share/doc/trochoid/README.md
usr/share/doc/trochoid/docs/formats/case.md
usr/share/doc/trochoid/examples/st52_slot/case.toml
""".split()
TOOLS = ("dpkg-deb", "dpkg-shlibdeps", "file", "cpack")


def run(*command, **options):
    return subprocess.run([*map(str, command)], check=True, stdout=subprocess.PIPE,
                          text=True, **options).stdout


@unittest.skipUnless(all(map(shutil.which, TOOLS)), f"one of {', '.join(TOOLS)} is not here")
class Debian(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory(prefix="trochoid_")
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name)
        # Packed fast, and not as small as it goes.
        run("cpack", "-G", "DEB", "--config", helps.BUILD / "CPackConfig.cmake", "-B", cls.folder,
            "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", "-D", "CPACK_THREADS=0")
        cls.package, = cls.folder.glob("*.deb")
        cls.root = cls.folder / "root"
        run("dpkg-deb", "-x", cls.package, cls.root)

    def field(self, name):
        return run("dpkg-deb", "-f", self.package, name).strip()

    def test_it_says_what_it_needs(self):
        self.assertEqual(self.field("Package"), "trochoid")
        self.assertEqual(self.field("Version"), helps.said("--version").strip())
        self.assertEqual(self.field("Architecture"),
                         run("dpkg", "--print-architecture").strip())
        needs = self.field("Depends")
        for library in ("libc6 (>=", "libfmt", "libstdc++6"):
            self.assertIn(library, needs)
        self.assertNotIn("-dev", needs)
        self.assertNotIn("python", needs)
        self.assertIn("milling", self.field("Description"))

    def test_it_holds_program_library_pages_and_examples(self):
        files = {str(f.relative_to(self.root)) for f in self.root.rglob("*") if f.is_file()}
        self.assertEqual([wanted for wanted in CONTENT if wanted not in files], [])
        odd = [f for f in files if not f.startswith("usr/") or "__pycache__" in f
               or ".identify/" in f or "/local/" in f]
        self.assertEqual(odd, [])

    def test_it_names_the_licences_of_what_is_in_it(self):
        notice = (self.root / "usr/share/doc/trochoid/copyright").read_text()
        for author in ("Leon Sorokin", "gitlab.com/catamphetamine", "Arjun Barrett"):
            self.assertIn(author, notice)
        self.assertTrue((self.root / "usr/share/doc/trochoid/docs/licences.md").exists())

    def test_all_of_it_may_be_read_and_belongs_to_root(self):
        for line in run("dpkg-deb", "-c", self.package).splitlines():
            rights, owner = line.split()[:2]
            self.assertEqual(owner, "root/root", line)
            self.assertIn(rights, ("drwxr-xr-x", "-rwxr-xr-x", "-rw-r--r--"), line)

    def test_unpacked_the_program_answers_as_ever(self):
        summaries = []
        for name, program in (("packed", self.root / "usr/bin/trochoid"),
                              ("built", helps.PROGRAM)):
            out = self.folder / name
            run(program, "simulate", "-q", "--no-report", "-o", out, EXAMPLE)
            summaries.append(json.loads((out / "summary.json").read_text()))
        self.assertEqual(*summaries)

    def test_unpacked_the_module_can_be_imported(self):
        place = self.root / "usr/lib/python3/dist-packages"
        if not (helps.BUILD / "python/trochoid").exists():
            self.skipTest("the module is not built")
        said = run(sys.executable, "-c", "import trochoid; print(trochoid.__file__)", cwd="/",
                   env={**os.environ, "PYTHONPATH": str(place)})
        self.assertTrue(said.startswith(str(place)), said)

    def test_a_project_finds_the_library_by_pkg_config(self):
        if not shutil.which("pkg-config"):
            self.skipTest("pkg-config is not here")
        flags = run("pkg-config", "--cflags", "--libs", "trochoid-controller", env={
            **os.environ, "PKG_CONFIG_PATH": str(self.root / "usr/lib/pkgconfig")})
        self.assertIn("-ltrochoid_controller", flags)


if __name__ == "__main__":
    unittest.main()
