"""Run the program on a case and read what it answers."""
import csv
import itertools
import json
import os
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("TROCHOID", str(ROOT / "build/release/src/trochoid/cli/trochoid"))

# `./test --all` runs every comparison; `./test` leaves out long ones whose parts others cover.
WHOLE = "TROCHOID_SEEDS" in os.environ
long_form = unittest.skipUnless(WHOLE, "of ./test --all")


def some(cases, every, first=0):
    """All with `./test --all`; else one in `every`, from the `first` on."""
    return cases if WHOLE else itertools.islice(cases, first, None, every)

HANGS = 1200  # s; for a program that never ends, not for one on a busy machine
# What is said of long work: how much depends on the machine.
PROGRESS = re.compile(r"^[^:\n]+(: \d+ %)?, \d+ (s|min)(, about \d+ (s|min) left)?\n", re.MULTILINE)


def toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(v) for v in value) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {toml(v)}" for k, v in value.items()) + " }"
    return repr(value)


def case_text(title, tables, measurements=()):
    """A case file of {table: {key: value}}."""
    lines = [f"title = {toml(title)}"]
    for name, table in tables.items():
        lines += ["", f"[{name}]"] + [f"{k} = {toml(v)}" for k, v in table.items()]
    for m in measurements:
        lines += ["", "[[measurement]]"] + [f"{k} = {toml(v)}" for k, v in m.items()]
    return "\n".join(lines) + "\n"


class Answer:
    """What the program answered."""

    def __init__(self, folder, code, stderr):
        self.folder, self.code, self.stderr = folder, code, stderr
        summary = folder / "summary.json"
        self.summary = json.loads(summary.read_text()) if summary.exists() else {}
        self.result = self.summary.get("result", {})

    def columns(self, file):
        with open(self.folder / file, newline="") as f:
            head, *rows = list(csv.reader(f))
        return {h: [float(r[i]) for r in rows] for i, h in enumerate(head)}


def run(command, content, folder, name):
    """Write the case, run the program on it, read what it answered."""
    file, out = pathlib.Path(folder) / f"{name}.toml", pathlib.Path(folder) / f"{name}.out"
    file.write_text(content)
    done = subprocess.run([PROGRAM, command, str(file), "-o", str(out), "--no-report",
                           "--quiet"], capture_output=True, text=True, timeout=HANGS)
    return Answer(out, done.returncode, done.stderr.strip() or done.stdout.strip())
