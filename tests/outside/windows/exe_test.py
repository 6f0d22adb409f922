"""trochoid.exe under wine: what it answers is what the program here answers."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
PROGRAM = os.environ["TROCHOID"]
EXE = os.environ.get("TROCHOID_EXE", "")
COMMANDS = "simulate|identify|surface|calibrate|stability|modes|actuator|dynamics|correct|plan"
HANGS = 600  # s
OBJDUMP = "x86_64-w64-mingw32-objdump"
WINDOWS_HAS = {"kernel32.dll", "msvcrt.dll"}

# Another compiler with other vectors: numbers agree so well, those far below the largest
# of their file to this part of it; limits and fits are searched no finer.
SAME = 1e-5
SMALL = 1e-3
# The one curve is known less well; so are multipliers far beyond the limit.
COARSE = {"zeroth_order.csv": 1e-3, "lobes.csv": 5e-3}
# Curves of a fit, far below the largest force of their file.
COARSER = {"st52_slot": {"fitted.csv": 1e-3, "residual.csv": 1e-3}}


def examples():
    """command and case file of all that the pages of the examples run"""
    found = set()
    for page in sorted((ROOT / "examples").glob("*/README.md")):
        runs = re.findall(rf"(?:trochoid|run) ({COMMANDS}) (?:examples/{page.parent.name}/)?(\S+\.toml)",
                          page.read_text())
        found |= {(command, page.parent.name, file) for command, file in runs
                  if (page.parent / file).exists()}
    return sorted(found)


def is_number(word):
    return re.fullmatch(r"-?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?", word, re.IGNORECASE) is not None


def difference(ours, theirs):
    """the largest of two texts that are alike but for numbers, and where it is"""
    split = re.compile(r"""([\s,:;[\]{}()"]+)""").split
    left, right = split(ours), split(theirs)
    if len(left) != len(right):
        return float("inf"), "another form"
    scale = max((abs(float(word)) for word in left if is_number(word)), default=0.0)
    worst = (0.0, "")
    for a, b in zip(left, right):
        if a == b:
            continue
        if not (is_number(a) and is_number(b)):
            return float("inf"), f"{a} and {b}"
        apart = abs(float(a) - float(b)) / max(abs(float(a)), SMALL * scale)
        worst = max(worst, (apart, f"{a} and {b}"))
    return worst


def without_commit(text):
    return re.sub(r'"(commit|version)": "[^"]*"|\(?commit [0-9a-f]+\)?', "", text)


@unittest.skipUnless(EXE and os.path.exists(EXE) and shutil.which("wine"),
                     "no trochoid.exe was built, or wine is not here")
class Exe(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.prefix = tempfile.mkdtemp(prefix="wine_")
        cls.addClassCleanup(shutil.rmtree, cls.prefix, ignore_errors=True)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="trochoid_exe_")).resolve()
        self.addCleanup(shutil.rmtree, self.folder)

    def run_exe(self, *arguments, code=0, folder=None, given=None):
        done = subprocess.run(
            ["wine", EXE, *map(str, arguments)], cwd=folder or self.folder, timeout=HANGS,
            input=given if given is not None else b"", capture_output=True,
            env={**os.environ, "WINEPREFIX": self.prefix, "WINEDEBUG": "-all"})
        out = done.stdout.decode()
        told = done.stderr.decode()
        told = "".join(line for line in told.splitlines(True) if not line.startswith("wine:"))
        self.assertEqual(done.returncode, code, f"{arguments}\n{out}{told}")
        return out, told

    def slot(self, folder):
        shutil.copytree(ROOT / "examples/st52_slot", folder,
                        ignore=shutil.ignore_patterns("*.identify"))
        return folder / "case.toml"

    @unittest.skipUnless(shutil.which(OBJDUMP), f"no {OBJDUMP}")
    def test_it_needs_only_what_each_windows_has(self):
        # Wine has more: with it a program starts that Windows refuses.
        said = subprocess.run([OBJDUMP, "-p", EXE], capture_output=True, text=True, check=True).stdout
        needs = {name.lower() for name in re.findall(r"DLL Name: (\S+)", said)}
        self.assertLessEqual(needs, WINDOWS_HAS)
        self.assertTrue(needs)

    def test_every_example_is_answered_alike(self):
        shutil.copytree(ROOT / "examples", self.folder / "examples",
                        ignore=shutil.ignore_patterns(*(f"*.{c}" for c in COMMANDS.split("|"))))
        known = examples()
        self.assertGreater(len(known), 20)
        otherwise = []
        for command, name, file in known:
            folder = self.folder / "examples" / name
            subprocess.run([PROGRAM, command, file, "-q", "-o", "ours"], cwd=folder, check=True,
                           capture_output=True, timeout=HANGS)
            self.run_exe(command, file, "-q", "-o", "theirs", folder=folder)
            names = sorted(f.name for f in (folder / "ours").iterdir())
            self.assertEqual(names, sorted(f.name for f in (folder / "theirs").iterdir()))
            equal, worst = 0, 0.0
            for one in (n for n in names if n != "report.html"):
                ours, theirs = ((folder / side / one).read_bytes().decode()
                                for side in ("ours", "theirs"))
                ours, theirs = without_commit(ours), without_commit(theirs)
                apart, where = difference(ours, theirs)
                equal += ours == theirs
                worst = max(worst, apart)
                if apart > COARSER.get(name, COARSE).get(one, SAME):
                    otherwise.append(f"{command} {name}/{file} {one}: {apart:.1e}, {where}")
            print(f"{command} {name}/{file}: {equal} of {len(names) - 1} files the same bytes, "
                  f"numbers within {worst:.1e}", flush=True)
            for side in ("ours", "theirs"):
                shutil.rmtree(folder / side)
        self.assertEqual(otherwise, [])

    def test_names_of_files(self):
        folder = self.folder / "Fräse 面 🙂"
        self.slot(folder)
        dos = "Z:" + str(folder).replace("/", "\\")
        for given in ("Fräse 面 🙂/case.toml", "Fräse 面 🙂\\case.toml", f"{dos}\\case.toml"):
            with self.subTest(given=given):
                out, _ = self.run_exe("identify", given, "-q", "-o", "Antwort ü")
                self.assertTrue((self.folder / "Antwort ü/report.html").exists())
                shutil.rmtree(self.folder / "Antwort ü")
        out, _ = self.run_exe("identify", "Fräse 面 🙂\\case.toml")
        self.assertIn("Fräse 面 🙂", out)
        self.assertNotIn("\r", out)
        summary = json.loads((folder / "case.identify/summary.json").read_bytes())
        self.assertEqual(summary["status"], "ok")
        # A second answer takes the place of the first, and nothing hidden stays.
        names = sorted(f.name for f in folder.iterdir())
        self.run_exe("identify", dos + "\\case.toml", "-q")
        self.assertEqual(sorted(f.name for f in folder.iterdir()), names)

    def test_files_as_windows_writes_them(self):
        case = self.slot(self.folder / "slot")
        self.run_exe("identify", "slot/case.toml", "-q", "-o", "plain")
        record = case.with_name("record.csv")
        head, *rows = record.read_text().splitlines()
        comma = [head.replace(",", ";")] + [r.replace(",", ";").replace(".", ",") for r in rows]
        record.write_bytes("\r\n".join(comma).encode() + b"\r\n")
        text = case.read_text()
        case.write_bytes(b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode())
        self.run_exe("identify", "slot/case.toml", "-q", "-o", "windows")
        results = [json.loads((self.folder / f / "summary.json").read_bytes())["result"]
                   for f in ("plain", "windows")]
        self.assertEqual(*results)

    def test_mistakes(self):
        case = self.slot(self.folder / "slot")
        case.write_text(case.read_text().replace("record.csv", "fehlt ü.csv"))
        out, told = self.run_exe("identify", "slot\\case.toml", code=2)
        self.assertRegex(told, r'^slot\\case.toml:\d+:\d+: measurement\[1\]\.file = "fehlt ü.csv": '
                               r'there is no such file')
        self.assertNotIn("\r", told)
        self.assertFalse(list(case.parent.glob("*identify*")))
        _, told = self.run_exe("identfy", "x", code=2)
        self.assertIn("did you mean identify?", told)
        (self.folder / "mine.identify").mkdir()
        (self.folder / "mine.identify/mine.txt").write_text("mine")
        self.slot(self.folder / "again")
        _, told = self.run_exe("identify", "again/case.toml", "-o", "mine.identify", code=2)
        self.assertIn("which trochoid did not write", told)
        self.assertEqual((self.folder / "mine.identify/mine.txt").read_text(), "mine")

    def test_a_case_from_the_standard_input(self):
        text = (ROOT / "examples/stability_922Hz/case.toml").read_bytes()
        self.run_exe("stability", "-", "-q", "--set", "title='ü'", given=text.replace(b"\n", b"\r\n"))
        echo = (self.folder / "stdin.stability/case.toml").read_bytes().decode()
        self.assertIn('title = "ü"', echo)

    def test_a_sweep(self):
        shutil.copytree(ROOT / "examples/uncertain_force", self.folder / "sweep",
                        ignore=shutil.ignore_patterns("*.sweep"))
        case = next(f for f in sorted((self.folder / "sweep").glob("*.toml"))
                    if "[sweep]" in f.read_text())
        self.slot(self.folder / "st52_slot")
        subprocess.run([PROGRAM, "identify", self.folder / "st52_slot/case.toml", "-q"],
                       check=True, timeout=HANGS)
        subprocess.run([PROGRAM, "sweep", case, "-q", "-o", self.folder / "ours"], check=True,
                       timeout=HANGS)
        self.run_exe("sweep", f"sweep/{case.name}", "-q", "-o", "theirs")
        ours, theirs = ((self.folder / side / "sweep.csv").read_text() for side in ("ours", "theirs"))
        self.assertLess(difference(ours, theirs)[0], SAME)

    def test_its_threads_change_nothing_and_let_it_end(self):
        shutil.copytree(ROOT / "examples/stability_922Hz", self.folder / "slot")
        self.run_exe("stability", "slot/case.toml", "-q", "-o", "alone", "--threads", "1")
        alone = (self.folder / "alone/lobes.csv").read_bytes()
        for _ in range(40):  # one in ten did not end while threads ended as the program did
            self.run_exe("stability", "slot/case.toml", "-q", "-o", "all")
            self.assertEqual((self.folder / "all/lobes.csv").read_bytes(), alone)


if __name__ == "__main__":
    unittest.main(verbosity=1, argv=sys.argv)
