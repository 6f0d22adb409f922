"""The archive and the installer for Windows: what they hold, and that the installer puts it
there without an administrator and takes away what it put there. With wine."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest
import zipfile

import drop_files

EXE = pathlib.Path(os.environ.get("TROCHOID_EXE", "/nowhere"))
CONTENT = ("trochoid.exe", *drop_files.NAMES, "LICENSE", "README.md", "docs/licences.md",
           "docs/guide/windows.md", "examples/st52_slot/case.toml")
# Of all that is linked into the program or shown in a report, as docs/licences.md lists it.
LICENCES = ("uplot", "libfmt-dev", "libhwy-dev", "libtomlplusplus-dev", "nlohmann-json3-dev",
            "libcli11-dev", "libeigen3-dev", "libboost-dev", "libz-mingw-w64-dev",
            "mingw-w64-x86-64-dev", "gcc-mingw-w64-x86-64-posix")
MENU = ("Check a case", "Command prompt", "Compute a case", "Documentation", "Examples", "Uninstall")
UNINSTALL = r"HKCU\Software\Microsoft\Windows\CurrentVersion\Uninstall\trochoid"
PATH = r"%USERPROFILE%\bin;C:\tools"
PATIENCE = 60  # s, for the uninstaller, which goes on in a copy of itself


@unittest.skipUnless(EXE.exists() and all(map(shutil.which, ("cpack", "makensis", "wine"))),
                     "no trochoid.exe was built, or makensis or wine is not here")
class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="trochoid_packages_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        for kind in ("ZIP", "NSIS"):
            subprocess.run(["cpack", "-G", kind, "--config", EXE.parents[3] / "CPackConfig.cmake", "-B",
                            cls.folder], check=True, stdout=subprocess.DEVNULL)
        archive, = cls.folder.glob("trochoid-*-windows-x86_64.zip")
        cls.setup, = cls.folder.glob("trochoid-*-windows-x86_64-setup.exe")
        zipfile.ZipFile(archive).extractall(cls.folder / "unpacked")
        cls.unpacked = cls.folder / "unpacked" / archive.stem
        # An older wine takes itself for Windows 7.
        cls.wine("reg", "add", r"HKCU\Software\Wine", "/v", "Version", "/d", "win10", "/f")
        cls.user, = (f for f in (cls.prefix() / "drive_c/users").iterdir() if f.name != "Public")
        cls.place = cls.user / "AppData/Local/Programs/Trochoid"
        cls.menu = cls.user / "AppData/Roaming/Microsoft/Windows/Start Menu/Programs/Trochoid"

    @classmethod
    def prefix(cls):
        return cls.folder / "wine"

    @classmethod
    def wine(cls, *command, code=0):
        done = subprocess.run(
            ["wine", *map(str, command)], capture_output=True, timeout=600,
            # Wine has the icons in HOME, and enters the program in the menu of the desktop there.
            env={**os.environ, "HOME": str(cls.folder), "XDG_DATA_HOME": str(cls.folder / "data"),
                 "XDG_CONFIG_HOME": str(cls.folder / "config"),
                 "WINEPREFIX": str(cls.prefix()), "WINEDEBUG": "-all"})
        assert done.returncode == code, (command, done)
        return done.stdout.decode(errors="replace").replace("\r", "") or "done"

    def files(self, folder):
        return {str(f.relative_to(folder)): f.read_bytes() for f in folder.rglob("*") if f.is_file()}

    def uninstall(self):
        self.wine(self.place / "uninstall.exe", "/S")
        end = time.monotonic() + PATIENCE
        while (self.place / "uninstall.exe").exists() or self.menu.exists():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.2)
        self.wine("wineboot", "-e")  # all that it does is done

    def path_is(self):
        line, = (l for l in self.wine("reg", "query", r"HKCU\Environment", "/v", "Path").splitlines()
                 if "REG_EXPAND_SZ" in l)
        return line.split("REG_EXPAND_SZ")[1].strip()

    def set_path(self, value):
        self.wine("reg", "add", r"HKCU\Environment", "/v", "Path", "/t", "REG_EXPAND_SZ",
                  "/d", value, "/f")

    def test_both_hold_program_pages_examples_and_all_notices(self):
        unpacked = self.files(self.unpacked)
        for name in (*CONTENT, *(f"licences/{part}" for part in LICENCES)):
            self.assertTrue(unpacked.get(name), name)
        self.wine(self.setup, "/S")
        self.addCleanup(self.uninstall)
        installed = self.files(self.place)
        self.assertTrue(installed.pop("licences/nsis"))
        self.assertTrue(installed.pop("uninstall.exe"))
        self.assertEqual(installed, unpacked)
        for name in drop_files.NAMES:
            self.assertIn(b"\r\n", unpacked[name])
            self.assertTrue((self.user / "Desktop" / name).with_suffix(".lnk").exists())
        self.assertEqual(sorted(f.stem for f in self.menu.iterdir()), sorted(MENU))
        self.assertIn("0.", self.wine("reg", "query", UNINSTALL, "/v", "DisplayVersion"))

    def test_the_uninstaller_takes_what_was_installed_and_nothing_else(self):
        self.set_path(PATH)
        self.wine(self.setup, "/S")
        mine = self.place / "examples/st52_slot/case.identify/summary.json"
        mine.parent.mkdir()
        mine.write_text("mine")
        self.assertEqual(self.path_is(), PATH)  # unasked it stays as it is
        self.uninstall()
        self.assertEqual(self.files(self.place), {"examples/st52_slot/case.identify/summary.json": b"mine"})
        shutil.rmtree(self.place)
        self.assertEqual(list((self.user / "Desktop").glob("*case.lnk")), [])
        self.wine("reg", "query", UNINSTALL, code=1)
        self.assertEqual(self.path_is(), PATH)

    def test_a_newer_version_takes_the_place_and_keeps_its_entry_in_path(self):
        here = r"C:\users\%s\AppData\Local\Programs\Trochoid" % self.user.name
        self.wine(self.setup, "/S")
        self.set_path(rf"{PATH};{here};C:\more")
        self.wine(self.setup, "/S")
        self.assertEqual(self.path_is(), rf"{PATH};C:\more;{here}")
        self.assertTrue((self.place / "trochoid.exe").exists())
        self.uninstall()
        self.assertEqual(self.path_is(), rf"{PATH};C:\more")

    def test_a_path_that_is_too_long_stays_as_it_is(self):
        here = r"C:\users\%s\AppData\Local\Programs\Trochoid" % self.user.name
        for length in (950, 1022, 3000):
            with self.subTest(length):
                value = rf"{here};C:" + r"\tools" * (length // 6)
                self.set_path(value)
                self.wine(self.setup, "/S")
                self.assertEqual(self.path_is(), value)
                self.uninstall()
                self.assertEqual(self.path_is(), value)


if __name__ == "__main__":
    unittest.main()
