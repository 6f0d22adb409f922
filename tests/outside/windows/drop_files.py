"""The files on which a case is dropped, as the build makes them for the packages."""
import pathlib
import subprocess

SOURCE = pathlib.Path(__file__).resolve().parents[3] / "cmake/windows/DropFiles.cmake"
NAMES = ("Check a case.cmd", "Compute a case.cmd")


def make(folder):
    subprocess.run(["cmake", "-D", f"TROCHOID_DROP_FILES={folder}", "-P", str(SOURCE)], check=True)
