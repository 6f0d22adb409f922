"""An answer of Python is that of the program, bit for bit."""

import csv
import filecmp
import functools
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import typing
import unittest
import warnings

import numpy as np

import trochoid

ROOT = pathlib.Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "examples"
sys.path.insert(0, str(ROOT / "tests/golden"))
import answer_kinds  # noqa: E402

PROGRAM = os.environ["TROCHOID"]

# Command, file, options of the program, the same of Python: one of each command.
RUNS = [
    ("simulate", "ball/case.toml", [], {}),
    ("simulate", "st52_predict/case.toml", [], {}),
    ("identify", "st52_slot/case.toml", [], {}),
    ("surface", "thin_wall_2mm_4mm/case.toml", [], {}),
    ("calibrate", "thin_wall_table1/case.toml", [], {}),
    ("stability", "stability_922Hz/case.toml", [], {}),
    ("modes", "tap_test/tip_x.csv", ["--modes", "2"], {"modes": 2}),
    ("actuator", "tap_test/step.csv", [], {}),
    ("dynamics", "runout_table_8mm/case.toml", [], {}),
    ("correct", "runout_table_8mm/case.toml", [], {}),
    ("plan", "plan_next_cut/case.toml", [], {}),
    ("program", "pocket/case.toml", [], {}),
    ("calibrate", "floor_trace/case.toml", [], {}),
    ("plan", "face_mill/plan.toml", [], {}),
]


@functools.cache
def answer_of(number):
    """Of one of the runs; computed once, as an answer does not change."""
    command, file, _, options = RUNS[number]
    return quiet(getattr(trochoid, command), EXAMPLES / file, **options)


def quiet(call, *arguments, **options):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", trochoid.AnswerWarning)
        return call(*arguments, **options)


class SameAsProgram(unittest.TestCase):
    def check(self, number):
        command, file, options, _ = RUNS[number]
        with tempfile.TemporaryDirectory() as folder:
            theirs, ours = pathlib.Path(folder, "program"), pathlib.Path(folder, "python")
            case = EXAMPLES / file
            run = subprocess.run(
                [PROGRAM, command, case, "-o", theirs, "-q", *options], capture_output=True
            )
            answer = answer_of(number)
            self.assertEqual(answer.ok, run.returncode == 0, run.stderr)
            self.assertEqual(answer.save(ours), ours)
            names = sorted(entry.name for entry in theirs.iterdir())
            self.assertEqual(sorted(entry.name for entry in ours.iterdir()), names)
            self.assertIn("report.html", names)
            _, different, missing = filecmp.cmpfiles(theirs, ours, names, shallow=False)
            self.assertEqual((different, missing), ([], []))
            summary = json.loads((theirs / "summary.json").read_text())
            self.assertEqual(answer.to_dict(), summary["result"])
            self.assertEqual(answer.message, summary["message"])
            self.assertEqual([w._asdict() for w in answer.warnings], summary["warnings"])
            self.check_attributes(answer, summary["result"])
            for name, table in answer.tables.items():
                self.check_table(table, theirs / f"{name}.csv")

    def check_attributes(self, answer, result):
        """Nothing of the answer is hidden behind a method."""
        for key in result:
            self.assertFalse(hasattr(type(answer), key), key)
            self.assertEqual(getattr(answer, key), answer.result[key])
        self.check_members(answer.result)
        with self.assertRaises(AttributeError):
            answer.message = "better"

    def check_members(self, values):
        """Nor behind what every mapping has."""
        if isinstance(values, tuple):
            for value in values:
                self.check_members(value)
        if isinstance(values, trochoid.Values):
            for key, value in values.items():
                self.assertFalse(hasattr(trochoid.Values, key), key)
                self.check_members(value)

    def check_table(self, table, file):
        with open(file, newline="") as stream:
            rows = list(csv.reader(stream))
        self.assertEqual(list(table), rows[0])
        for i, column in enumerate(table.values()):
            self.assertFalse(column.flags.writeable)
            there = [row[i] for row in rows[1:]]
            if column.dtype.kind == "f":
                there = [float(cell) if cell else math.nan for cell in there]
            np.testing.assert_array_equal(column, there)

    def test_every_command(self):
        for number, run in enumerate(RUNS):
            with self.subTest(run=run[:2]):
                self.check(number)

    def test_there_is_a_run_of_every_command(self):
        self.assertEqual({run[0] for run in RUNS}, set(trochoid._case.COMMANDS))


class Types(unittest.TestCase):
    def test_an_answer_has_the_types_of_dicts(self):
        all_of = answer_kinds.with_types()
        for number, (command, file, _, _) in enumerate(RUNS):
            with self.subTest(run=(command, file)):
                answer = answer_of(number)
                wrong = answer_kinds.unlike(all_of, command, answer.to_dict(), answer.ok)
                self.assertEqual(wrong, [])
                hint = typing.get_type_hints(getattr(trochoid, command))["return"]
                self.assertIsInstance(answer, typing.get_args(hint) or hint)

    def test_a_wrong_type_is_seen(self):
        all_of, result = answer_kinds.with_types(), answer_of(0).to_dict()
        del result["mean_N"]
        result |= {"peak_xy_N": "large", "teeth": None, "min_N": 1.0, "torque": 1.0}
        self.assertEqual(answer_kinds.unlike(all_of, "simulate", result, ok=True), [
            "simulate: : without mean_N", "simulate: min_N: 1.0", "simulate: peak_xy_N: 'large'",
            "simulate: teeth: null", "simulate: torque: no such key"])

    def test_a_plan_is_of_what_is_planned(self):
        self.assertIs(type(answer_of(len(RUNS) - 1)), trochoid.answers.PlanOfFinishAnswer)
        for answer in trochoid.answers.BY_COMMAND.values():
            self.assertGreater(len(typing.get_type_hints(answer)), 5, answer)


class Plots(unittest.TestCase):
    def test_every_command_has_a_picture(self):
        try:
            import matplotlib.pyplot as plt
        except ImportError:
            self.skipTest("matplotlib is not here")
        for number, run in enumerate(RUNS):
            with self.subTest(command=run[0]):
                axes = answer_of(number).plot().axes[0]
                self.assertTrue(axes.lines or axes.collections)
                plt.close("all")

    def test_a_table_is_a_frame(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not here")
        answer = quiet(trochoid.simulate, EXAMPLES / "ball/case.toml")
        frame = answer.frame("forces")
        self.assertEqual(list(frame.columns), list(answer.tables["forces"]))
        with self.assertRaisesRegex(KeyError, "chip_curve"):
            answer.frame("force")


class NoAnswer(unittest.TestCase):
    def test_no_good_answer_is_no_error(self):
        case = trochoid.Case.from_file(EXAMPLES / "st52_slot/case.toml")
        answer = quiet(trochoid.identify, case.with_({"cut.feed_per_tooth_mm": 0}))
        self.assertFalse(answer.ok)
        self.assertTrue(answer.message)
        self.assertIn("no answer: " + answer.message, str(answer))
        self.assertIn("no answer", answer._repr_html_())

    def test_warnings_are_told(self):
        case = trochoid.Case.from_file(EXAMPLES / "ball/case.toml")
        with self.assertWarnsRegex(trochoid.AnswerWarning, r"\[zero_feed\]") as told:
            answer = trochoid.simulate(case.with_({"cut.feed_per_tooth_mm": 0}))
        self.assertEqual(pathlib.Path(told.filename), pathlib.Path(__file__))
        self.assertIn("zero_feed", [warning.code for warning in answer.warnings])

    def test_foreign_files_are_not_replaced(self):
        answer = quiet(trochoid.simulate, EXAMPLES / "ball/case.toml")
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "thesis.txt").write_text("mine")
            with self.assertRaisesRegex(OSError, "thesis.txt"):
                answer.save(folder)


if __name__ == "__main__":
    unittest.main()
