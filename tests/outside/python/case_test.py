"""Cases from files and dicts: the same keys and checks, everything wrong at once."""

import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import tomllib
import unittest

import numpy as np

import trochoid

ROOT = pathlib.Path(__file__).resolve().parents[3]
BALL = ROOT / "examples/ball/case.toml"
PROGRAM = os.environ["TROCHOID"]


def problems_of(call, *arguments):
    try:
        call(*arguments)
    except trochoid.InputError as error:
        return error
    raise AssertionError("accepted")


class FromFile(unittest.TestCase):
    def test_errors_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "case.toml")
            file.write_text(BALL.read_text().replace("teeth = 2", "teeth = 2.5\nteht = 3"))
            error = problems_of(trochoid.Case.from_file, file)
            run = subprocess.run(
                [PROGRAM, "simulate", file], capture_output=True, text=True
            )
            self.assertEqual(run.returncode, 2)
            self.assertEqual(str(error) + "\n", run.stderr)
            self.assertEqual([p.key for p in error.problems], ["tool.teeth", "tool.teht"])
            line = file.read_text().splitlines().index("teeth = 2.5") + 1
            place = (error.problems[0].file, error.problems[0].line)
            self.assertEqual(place, (str(file), line))
            again = pickle.loads(pickle.dumps(error))
            self.assertEqual((again.problems, str(again)), (error.problems, str(error)))
            self.assertIsInstance(error, ValueError)

    def test_a_missing_file_says_so(self):
        error = problems_of(trochoid.simulate, "nowhere.toml")
        self.assertIn("there is no such file", str(error))


class FromDict(unittest.TestCase):
    def test_a_dict_is_the_file(self):
        tables = tomllib.loads(BALL.read_text())
        case = trochoid.Case(tables)
        self.assertEqual(case.to_dict(), tables)
        file = trochoid.Case.from_file(BALL)
        self.assertEqual(case.as_understood(), file.as_understood())
        self.assertEqual(
            trochoid.simulate(case).to_dict(), trochoid.simulate(file).to_dict()
        )

    def test_all_problems_at_once_without_a_place(self):
        error = problems_of(
            trochoid.Case, {"tool": {"teeth": 0, "diamter_mm": 8}, "cutt": {}, "cut": 3}
        )
        keys = [problem.key for problem in error.problems]
        for key in ("tool.teeth", "tool.diamter_mm", "tool.helix_deg", "cutt", "cut"):
            self.assertIn(key, keys)
        self.assertTrue(all(p.file is None and p.line is None for p in error.problems))
        self.assertIn("did you mean diameter_mm?", str(error))

    def test_what_a_command_needs_is_said_by_it(self):
        tables = tomllib.loads(BALL.read_text())
        del tables["force"]
        error = problems_of(trochoid.simulate, trochoid.Case(tables))
        self.assertEqual([problem.key for problem in error.problems], ["force"])

    def test_numbers_of_numpy_are_numbers(self):
        tables = tomllib.loads(BALL.read_text())
        tables["tool"]["teeth"] = np.int32(2)
        tables["tool"]["diameter_mm"] = np.float32(10)
        tables["sampling"] = {"angles_deg": np.linspace(0, 90, 4)}
        answer = trochoid.simulate(tables)
        np.testing.assert_array_equal(
            answer.tables["forces"]["angle_deg"], [0, 30, 60, 90]
        )

    def test_what_no_file_could_hold_names_its_key(self):
        for value, why in ((object(), "object"), ({1, 2}, "set"), (2**70, "digits")):
            with self.assertRaisesRegex(TypeError, "tool.teeth: .*" + why):
                trochoid.Case({"tool": {"teeth": value}})
        with self.assertRaises(UnicodeEncodeError):
            trochoid.Case({"title": "\ud800"})
        endless = {}
        endless["tool"] = endless
        with self.assertRaisesRegex(TypeError, "nested too deep"):
            trochoid.Case(endless)
        with self.assertRaisesRegex(TypeError, "from_file"):
            trochoid.Case("case.toml")

    def test_files_count_from_the_folder(self):
        folder = ROOT / "examples/st52_slot"
        tables = tomllib.loads((folder / "case.toml").read_text())
        trochoid.Case(tables, folder=folder).check("identify")
        error = problems_of(trochoid.Case(tables, folder="/").check, "identify")
        self.assertEqual(error.problems[0].key, "measurement[1].file")

    def test_a_dict_may_include_a_file(self):
        case = trochoid.Case({"include": str(BALL), "cut": {"spindle_rpm": 123}})
        self.assertEqual(case.to_dict()["cut"]["spindle_rpm"], 123)
        self.assertEqual(case.to_dict()["tool"]["teeth"], 2)


class Environment(unittest.TestCase):
    def test_threads_are_limited_as_in_the_program(self):
        for threads, good in (("1", True), ("many", False)):
            run = subprocess.run(
                [sys.executable, "-c", "import trochoid"],
                env={**os.environ, "TROCHOID_THREADS": threads},
                capture_output=True,
                text=True,
            )
            self.assertEqual(run.returncode == 0, good, run.stderr)
        self.assertIn('TROCHOID_THREADS = "many"', run.stderr)


class With(unittest.TestCase):
    def setUp(self):
        self.case = trochoid.Case.from_file(BALL)

    def test_a_changed_case_leaves_the_old_one(self):
        before = self.case.to_dict()
        faster = self.case.with_({"cut.spindle_rpm": 900, "cut": {"axial_depth_mm": 1.5}})
        cut = {**before["cut"], "spindle_rpm": 900, "axial_depth_mm": 1.5}
        self.assertEqual(faster.to_dict()["cut"], cut)
        self.assertEqual(self.case.to_dict(), before)

    def test_none_takes_away(self):
        self.assertNotIn("runout", self.case.with_({"runout": None}).to_dict())
        without = self.case.with_({"tool.helix_deg": 0, "sampling": None})
        self.assertNotIn("sampling", without.to_dict())

    def test_inches_take_the_place_of_millimetres(self):
        wider = self.case.with_({"tool.diameter_in": 0.5}).to_dict()["tool"]
        self.assertNotIn("diameter_in", wider)
        self.assertAlmostEqual(wider["diameter_mm"], 12.7)
        error = problems_of(self.case.with_, {"tool.teeth_in": 2})
        self.assertEqual([problem.key for problem in error.problems], ["tool.teeth_in"])
        offsets = {"runout.radial_offsets_mm": [0, 0.01], "runout.eccentricity_mm": None}
        without = self.case.with_(offsets).with_({"runout.radial_offsets_in": None})
        self.assertNotIn("radial_offsets_mm", without.to_dict()["runout"])

    def test_what_is_changed_wrongly_is_told_at_once(self):
        error = problems_of(self.case.with_, {"cut.spindle_rpm": -1, "tool.teth": 2})
        keys = {problem.key for problem in error.problems}
        self.assertEqual(keys, {"cut.spindle_rpm", "tool.teth"})
        for wrong in ({"cut..x": 1}, {3: 1}, {"cut.a": 1, "cut.a.b": 2}):
            with self.assertRaises(TypeError):
                self.case.with_(wrong)

    def test_an_included_file_is_changed_too(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "other.toml")
            file.write_text("[cut]\nspindle_rpm = 777\naxial_depth_mm = 3\n")
            case = self.case.with_({"include": str(file), "cut.axial_depth_mm": 1})
        cut = case.to_dict()["cut"]
        self.assertEqual((cut["spindle_rpm"], cut["axial_depth_mm"]), (777, 1))

    def test_there_are_commands_only(self):
        with self.assertRaisesRegex(ValueError, "simulate, identify"):
            self.case.check("simulat")


if __name__ == "__main__":
    unittest.main()
