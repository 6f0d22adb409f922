"""Worked cases of a folder of ../shared, by kind: what their tests have in common."""
import csv
import json
import pathlib
import shutil
import sys
import tempfile
import unittest


def cells(file):
    """Rows of a CSV file as they stand: empty cells stay empty."""
    with open(file, newline="") as f:
        return list(csv.DictReader(f))


class Problems(list):
    """What does not agree, with how much it may differ."""

    def near(self, got, want, tolerance, what):
        if want is None:
            if got is not None:
                self.append(f"{what}: {got!r}, expected nothing")
        elif got is None or not abs(got - want) <= tolerance:
            self.append(f"{what}: {got!r}, expected {want!r} within {tolerance:g}")

    def all_near(self, got, want, tolerance, what):
        if len(got) != len(want):
            self.append(f"{what}: {len(got)} values, expected {len(want)}")
            return
        for i, (a, b) in enumerate(zip(got, want)):
            self.near(a, b, tolerance, f"{what}[{i}]")


class WorkedFolder(unittest.TestCase):
    """CASES of a subclass: the folder of the cases."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="trochoid_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def of_kind(self, kind, check):
        """check(case, expected, tolerance, problems) of each case of a kind."""
        cases = (json.loads(f.read_text()) for f in sorted(self.CASES.glob("*.json")))
        found = [c for c in cases if c["kind"] == kind]
        if not found:
            self.skipTest(f"no cases in {self.CASES}")
        for c in found:
            with self.subTest(case=c["id"]):
                problems = Problems()
                check(c, c["expected"], c["tolerance"], problems)
                self.assertFalse(problems, f"{c['id']}\n" + "\n".join(problems[:12]))


def main(folder):
    """Run the tests of a script; 77: the cases are not here."""
    if not folder.is_dir():
        print(f"no cases in {folder}")
        sys.exit(77)
    unittest.main()
