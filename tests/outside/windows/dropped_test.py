"""What the files do with what is dropped on them: cmd.exe of wine, with a stub of trochoid.exe.

The Explorer starts cmd.exe with a line that has the names, and cmd.exe gives this line as
%CMDCMDLINE%. Wine has no such variable: the tests set it.
"""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import drop_files

COMPILER = "x86_64-w64-mingw32-g++-posix"
STUB = pathlib.Path(__file__).with_name("stub.cpp")
CHECK, COMPUTE = drop_files.NAMES
HANGS = 120  # s
OPENS = """#!/bin/sh
printf 'opened %s\\n' "$1" >>"$STUB_OPENED"
"""


def wine_version():
    """0: it is not here. Before version 10 cmd.exe took a name apart where it compares it."""
    if not shutil.which("wine"):
        return 0
    said = subprocess.run(["wine", "--version"], capture_output=True, text=True).stdout
    found = re.search(r"wine-(\d+)", said)
    return int(found[1]) if found else 0


@unittest.skipUnless(wine_version() >= 10 and shutil.which(COMPILER),
                     f"no wine 10, or no {COMPILER}")
class Dropped(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="trochoid_dropped_")).resolve()
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.program = cls.folder / "shop (1) & floor!"
        cls.program.mkdir()
        drop_files.make(cls.program)
        subprocess.run([COMPILER, "-municode", "-static", "-std=c++20", STUB, "-o",
                        cls.program / "trochoid.exe"], check=True)
        browser = cls.folder / "bin/xdg-open"
        browser.parent.mkdir()
        browser.write_text(OPENS)
        browser.chmod(0o755)

    def setUp(self):
        self.notes, self.opened = self.folder / "notes", self.folder / "opened"
        for file in (self.notes, self.opened):
            file.write_text("")

    def windows(self, path):
        return "Z:" + str(path).replace("/", "\\")

    def run_file(self, name, line=None, report=None, given="", code=0):
        """the file as if the Explorer had started it with names: (calls, output)"""
        environment = {
            **os.environ, "WINEPREFIX": str(self.folder / "wine"), "WINEDEBUG": "-all",
            "LC_ALL": "C.UTF-8", "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}",
            "STUB_NOTES": self.windows(self.notes), "STUB_OPENED": str(self.opened)}
        if line is not None:
            started = self.windows(self.program / name)
            environment["CMDCMDLINE"] = rf'C:\Windows\system32\cmd.exe /c ""{started}" {line}"'
        if report is not None:
            environment["STUB_REPORT"] = self.windows(report)
        done = subprocess.run(["wine", "cmd", "/c", name], cwd=self.program, input=given.encode(),
                              timeout=HANGS, env=environment, capture_output=True)
        out = (done.stdout + done.stderr).decode(errors="replace")
        self.assertEqual(done.returncode, code, out)
        return self.notes.read_text().splitlines(), out

    def test_names_arrive_whole(self):
        names = (r"Z:\a&b\case.toml", r"Z:\Fräse (2)!\100 % neu^.toml", r"\\server\shop\case.toml",
                 r"Z:\x, y;z=1\case.toml")
        line = " ".join(f'"{n}"' if " " in n else n for n in names)
        for end in ("", " "):  # the Explorer's line may end with a blank
            self.notes.write_text("")
            calls, out = self.run_file(CHECK, line + end)
            self.assertEqual(calls, [f"check\t{name}" for name in names])
            self.assertEqual(out.count("no mistakes found"), len(names))
            self.assertIn("Press any key", out)

    def test_the_report_is_opened_and_the_window_closes(self):
        report = self.folder / "slot & wall (1)!/case.identify/report.html"
        report.parent.mkdir(parents=True)
        report.write_text("")
        calls, out = self.run_file(COMPUTE, r"Z:\a&b\case.toml", report)
        self.assertEqual(calls, [r"Z:\a&b\case.toml"])
        self.assertIn("a table", out)
        self.assertNotIn("Press any key", out)
        self.assertRegex(self.opened.read_text(), r"^opened \S+/case\.identify/report\.html\n$")

    def test_what_is_wrong_stays_to_be_read(self):
        calls, out = self.run_file(COMPUTE, r"Z:\wrong.toml Z:\right.toml", code=2)
        self.assertEqual(len(calls), 2)
        self.assertIn("case.toml:1:1: wrong", out)
        self.assertIn("Press any key", out)
        self.assertEqual(self.opened.read_text(), "")

    def test_without_a_file_it_says_what_to_do(self):
        for name in drop_files.NAMES:
            calls, out = self.run_file(name, "", given='"Z:\\x y\\a&b.toml"\n')
            self.assertIn("Drag a case file", out)
            self.assertRegex(calls[-1], r"^(check\t)?Z:\\x y\\a&b\.toml$")

    def test_in_a_prompt_it_takes_its_arguments_and_returns(self):
        script = self.program / "prompt.cmd"
        script.write_bytes(f'@call "{CHECK}" "Z:\\x y.toml" Z:\\b.toml\r\n@echo back\r\n'.encode())
        calls, out = self.run_file(script.name)
        self.assertEqual(calls, ["check\tZ:\\x y.toml", "check\tZ:\\b.toml"])
        self.assertIn("back", out)
        self.assertNotIn("Press any key", out)

    def test_alone_it_says_what_is_missing(self):
        program = self.program / "trochoid.exe"
        program.rename(self.folder / "away")
        self.addCleanup((self.folder / "away").rename, program)
        calls, out = self.run_file(CHECK, r"Z:\case.toml", code=2)
        self.assertEqual(calls, [])
        self.assertIn("There is no trochoid.exe", out)


if __name__ == "__main__":
    unittest.main()
