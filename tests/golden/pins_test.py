"""Every answer of the program, to the last bit, as it was when it was last looked at.

Each example with each command, and each worked case of ../shared: exit code, what is
printed, summary.json, the CSV files and the case as it was understood, as hashes in
pins.json. The same width of vectors, compiler and C library give the same bits; where they
differ the test is skipped, as sines and sums differ in the last digit. Vectors wider than
AVX2 are switched off here.

pins_test.py --renew       writes pins.json anew
pins_test.py --keep DIR    also leaves all that was answered in DIR, to be compared
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
for folder in ("tests/reference", "tests/outside/cases"):
    sys.path.insert(0, str(ROOT / folder))
import answer_kinds  # noqa: E402
import case_file  # noqa: E402
import described  # noqa: E402
import program  # noqa: E402
import surface_cases_test  # noqa: E402
import worked_cases_test  # noqa: E402

PINS = pathlib.Path(__file__).with_name("pins.json")
COMMANDS = ("simulate", "identify", "surface", "calibrate", "stability", "modes",
            "actuator", "dynamics", "correct", "plan", "sweep", "check")
BARE = (("modes", "several_responses/tool.uff"), ("modes", "tap_test/hammer.csv"),
        ("modes", "tap_test/tip_x.csv"), ("actuator", "tap_test/step.csv"))
WITHIN = 900  # s
# They take half of the time of all, and go the ways of others: in ./test --all.
LONG = {"plan thin_wall_calibrate/next_wall.toml", "plan thin_wall_calibrate/truth.toml",
        "plan ball/case.toml", "modes measured_frf/case.toml", "stability variable_helix/case.toml"}


def machine():
    """What the last bit of a sum depends on."""
    flags = set(re.search(r"^flags\s*: (.*)$", pathlib.Path("/proc/cpuinfo").read_text(),
                          re.MULTILINE)[1].split())
    widest = next((f for f in ("avx2", "sse4_1") if f in flags), "sse2")
    compiler = re.search(r"[^\n]*", subprocess.run(
        [os.environ.get("CXX", "g++"), "--version"], capture_output=True, text=True).stdout)[0]
    return f"{widest}, {'fma' if 'fma' in flags else 'no fma'}, {compiler}, " \
           f"C library {os.confstr('CS_GNU_LIBC_VERSION')}"


def with_narrow_vectors():
    """The program, for as long as it is run from here."""
    narrow = os.environ.get("AT_MOST_AVX2", "")
    return unittest.mock.patch.dict(os.environ, {"LD_PRELOAD": narrow} if narrow else {})


def short_hash(text):
    return hashlib.sha256(text).hexdigest()[:12]


def without_provenance(name, text):
    """Without version and commit, and without the folders of this machine."""
    text = text.replace(os.fsencode(case_file.SHARED), b"SHARED")
    text = re.sub(rb"/tmp/trochoid_[^/\"]*/", b"", text)
    if name == "summary.json":
        summary = json.loads(text)
        summary.pop("trochoid", None)
        return json.dumps(summary, indent=1).encode()
    if name == "case.toml":
        return re.sub(rb"(?m)^#.*\n", b"", text)
    return text


def pinned(run, folder):
    """The hashes of one run in its folder of results."""
    printed = program.PROGRESS.sub("", run.stdout + run.stderr)
    out = {"exit": run.returncode,
           "printed": short_hash(without_provenance("printed", printed.encode()))}
    for file in sorted(folder.glob("*")) if folder.is_dir() else ():
        if file.suffix in (".json", ".csv", ".toml"):
            out[file.name] = short_hash(without_provenance(file.name, file.read_bytes()))
    (folder.parent / (folder.name + ".printed")).write_text(printed)
    return out


def run_in(folder, command, case, out):
    done = subprocess.run([program.PROGRAM, command, case, *(["-o", out, "--no-report"]
                                                          if command != "check" else [])],
                          cwd=folder, capture_output=True, text=True, timeout=WITHIN)
    return pinned(done, folder / out)


def of_examples(folder, leave_out=frozenset()):
    """{"command example/case.toml": hashes}"""
    shutil.copytree(ROOT / "examples", folder / "examples")
    folder = folder / "examples"
    cases = sorted(str(f.relative_to(folder)) for f in folder.glob("*/*.toml")
                   if "[cut]" in f.read_text() or f.name == "case.toml")
    wanted = [(command, case) for case in cases for command in COMMANDS] + list(BARE)
    wanted = [w for w in wanted if " ".join(w) not in leave_out]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        answers = pool.map(
            lambda w: run_in(folder, w[0], w[1], f"{w[1].replace('/', '_')}.{w[0]}"), wanted)
        return {f"{command} {case}": answer for (command, case), answer in zip(wanted, answers)}


def of_worked_cases(folder):
    """The runs that the tests of the worked cases make, which also hold what is right."""
    if not (case_file.SHARED / "cases/force").is_dir():
        return None
    pins = {}

    def run(command, content, _, name):
        (folder / f"{name}.toml").write_text(content)
        done = subprocess.run([program.PROGRAM, command, f"{name}.toml", "-o", f"{name}.out",
                               "--no-report", "--quiet"], cwd=folder, capture_output=True,
                              text=True, timeout=WITHIN)
        pins[f"{command} {name}"] = pinned(done, folder / f"{name}.out")
        return program.Answer(folder / f"{name}.out", done.returncode, done.stderr.strip())

    before, program.run = program.run, run
    try:
        suite = unittest.TestSuite(unittest.defaultTestLoader.loadTestsFromModule(m)
                                   for m in (worked_cases_test, surface_cases_test))
        suite.run(unittest.TestResult())
    finally:
        program.run = before
    return pins


class Pins(unittest.TestCase):
    maxDiff = None

    def test_every_answer_is_as_it_was(self):
        stored = json.loads(PINS.read_text())
        if stored["machine"] != machine():
            self.skipTest(f"pinned on {stored['machine']}; this is {machine()}")
        folder = pathlib.Path(tempfile.mkdtemp(prefix="trochoid_"))
        self.addCleanup(shutil.rmtree, folder)
        long = frozenset() if program.WHOLE else LONG
        with with_narrow_vectors():
            now = of_examples(folder, long)
            self.compare({k: v for k, v in stored["examples"].items() if k not in long}, now,
                         "examples")
            worked = of_worked_cases(folder)
        if worked is not None:
            self.compare(stored["worked_cases"], worked, "worked cases")
        self.every_key_and_column_is_described(folder)
        self.every_answer_has_its_types(folder)

    def every_key_and_column_is_described(self, folder):
        unknown = set().union(*(described.undescribed(summary.parent)
                                for summary in folder.rglob("summary.json")))
        self.assertFalse(unknown, "not in docs/formats/results.md:\n"
                         + "\n".join(sorted(unknown)))

    def every_answer_has_its_types(self, folder):
        all_of, wrong = answer_kinds.with_types(), set()
        for file in folder.rglob("summary.json"):
            summary = json.loads(file.read_text())
            wrong.update(answer_kinds.unlike(all_of, summary["command"], summary["result"],
                                             summary["status"] == "ok"))
        self.assertFalse(wrong, f"not as in {answer_kinds.DICTS.name}; answer_types_test.py "
                         "--renew\n" + "\n".join(sorted(wrong)))

    def compare(self, then, now, what):
        differ = []
        for run in {**then, **now}:
            before, after = then.get(run, {}), now.get(run, {})
            files = [f for f in {**before, **after} if before.get(f) != after.get(f)]
            if files:
                differ.append(f"{run}: {', '.join(files)}")
        self.assertFalse(differ, f"{what} that differ from tests/golden/pins.json:\n"
                         + "\n".join(differ))


def all_pins(folder):
    with with_narrow_vectors():
        return {"machine": machine(), "examples": of_examples(folder),
                "worked_cases": of_worked_cases(folder)}


def lines(pins):
    """One run a line."""
    parts = [f'"machine": {json.dumps(pins["machine"])}']
    for part in ("examples", "worked_cases"):
        runs = ",\n".join(f"  {json.dumps(k)}: {json.dumps(v)}" for k, v in pins[part].items())
        parts.append(f'"{part}": {{\n{runs}\n}}')
    return "{\n" + ",\n".join(parts) + "\n}\n"


if __name__ == "__main__":
    if sys.argv[1:2] == ["--keep"]:
        kept = pathlib.Path(sys.argv[2])
        kept.mkdir(parents=True)
        (kept / "pins.json").write_text(lines(all_pins(kept)))
    elif sys.argv[1:2] == ["--renew"]:
        with tempfile.TemporaryDirectory(prefix="trochoid_") as made:
            PINS.write_text(lines(all_pins(pathlib.Path(made))))
    else:
        unittest.main()
