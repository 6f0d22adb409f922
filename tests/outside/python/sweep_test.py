"""A sweep from Python is that of the program: rows, checks, folder, and going on."""

import csv
import filecmp
import os
import pickle
import signal
import subprocess
import sys
import textwrap
import time
import unittest
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from sweeping import CASE, EXAMPLES, OVER, TAKE, Sweeping, sweep

import trochoid

warnings.simplefilter("ignore", trochoid.AnswerWarning)
PROGRAM = os.environ["TROCHOID"]


class Sweep(Sweeping):
    def program(self, text, *options):
        """Of the same case with this [sweep]."""
        case = self.folder / "cut.toml"
        case.write_text(CASE.read_text() + "\n" + textwrap.dedent(text))
        run = subprocess.run(
            [PROGRAM, "sweep", case, "-q", *options], capture_output=True, text=True
        )
        return case, run

    def same_folder(self, case, answer):
        answer.save(self.folder / "ours")
        theirs = case.with_suffix(".sweep")
        files = ["case.toml", "summary.json", "sweep.csv", "report.html"]
        _, different, missing = filecmp.cmpfiles(theirs, self.folder / "ours", files, False)
        self.assertEqual((different, missing), ([], []))

    def test_the_table_of_a_case_file_is_that_of_the_program(self):
        case, run = self.program(
            """
            [sweep]
            command = "simulate"
            take = ["result.peak_xy_N", "result.mean_N[2]"]
            method = "latin_hypercube"
            count = 30
            seed = 5
            [sweep.over]
            "cut.spindle_rpm" = { mean = 900, sd = 20 }
            "tool.helix_deg" = { from = 0, to = 30 }
            "chip.model" = { values = ["radial", "trochoidal"] }
            """
        )
        self.assertEqual(run.returncode, 0, run.stderr)
        self.same_folder(case, trochoid.sweep(case))

    def test_draws_of_an_answer_are_those_of_its_folder(self):
        found = trochoid.identify(EXAMPLES / "st52_slot/case.toml")
        place = found.save(self.folder / "found", report=False)
        case, run = self.program(
            f"""
            [sweep]
            command = "simulate"
            take = ["result.peak_xy_N"]
            covariance = "{place}"
            draws = 12
            seed = 3
            over = {{ "cut.feed_per_tooth_mm" = {{ values = [0.03, 0.05] }} }}
            """
        )
        self.assertEqual(run.returncode, 0, run.stderr)
        told = dict(command="simulate", take="result.peak_xy_N", draws=12, seed=3)
        over = {"cut.feed_per_tooth_mm": [0.03, 0.05]}
        self.same_folder(case, trochoid.sweep(case, covariance=str(place)))
        ours = trochoid.sweep(CASE, over, covariance=found, **told)
        theirs = trochoid.sweep(CASE, over, covariance=place, **told)
        for name, column in theirs.tables["sweep"].items():
            np.testing.assert_array_equal(ours.tables["sweep"][name], column)
        self.assertEqual(len(theirs.tables["bands"]["median_peak_xy_N"]), 2)
        self.assertEqual(ours.quantities, theirs.quantities)

    def test_draws_at_a_single_point_have_a_band_and_a_list_a_limit(self):
        found = trochoid.identify(EXAMPLES / "st52_slot/case.toml", anyway=True)
        told = dict(command="simulate", take=["result.peak_xy_N"], covariance=found)
        one = trochoid.sweep(CASE, {"cut.spindle_rpm": [900]}, draws=5, **told)
        self.assertEqual(len(one.tables["bands"]["median_peak_xy_N"]), 1)
        speeds = {"cut.spindle_rpm": np.linspace(800, 900, 1000)}
        with self.assertRaisesRegex(trochoid.InputError, "more than 100000000 rows"):
            trochoid.sweep(CASE, speeds, method="list", draws=10**6, **told)

    def test_draws_of_an_answer_go_on_where_they_were(self):
        found = trochoid.identify(EXAMPLES / "st52_slot/case.toml")
        seen = []

        def stop(done, rows):
            seen.append(done)
            if done > 0:
                raise KeyboardInterrupt

        for _ in range(2):
            with self.assertRaises(KeyboardInterrupt):
                trochoid.sweep(CASE, command="simulate", take=["result.peak_xy_N"], draws=10**5,
                               covariance=found, part_file=self.folder / "rows", progress=stop)
            seen.append("interrupted")
        second = seen[seen.index("interrupted") + 1]
        self.assertGreater(second, 0)

    def test_arrays_are_the_values_of_a_table(self):
        case, run = self.program(
            """
            [sweep]
            command = "simulate"
            take = ["result.peak_xy_N"]
            method = "list"
            [sweep.over]
            "cut.spindle_rpm" = { values = [500.5, 600.25, 7e2] }
            "tool.helix_deg" = { values = [10, 2000, 12] }
            "cut.feed_per_tooth_mm" = { from = 0.05, to = 0.1, count = 3 }
            """
        )
        self.assertEqual(run.returncode, 0, run.stderr)
        over = {
            "cut.spindle_rpm": np.array([500.5, 600.25, 700.0]),
            "tool.helix_deg": (10, 2000, 12),
            "cut.feed_per_tooth_mm": {"from": 0.05, "to": 0.1, "count": 3},
        }
        options = {"command": "simulate", "take": TAKE[0], "method": "list"}
        found = trochoid.sweep(CASE, over, **options)
        with open(case.with_suffix(".sweep") / "sweep.csv", newline="") as file:
            theirs = list(csv.DictReader(file))
        ours = found.tables["sweep"]
        self.assertEqual([float(row["peak_xy_N"] or "nan") for row in theirs][::2],
                         list(ours["peak_xy_N"][::2]))
        self.assertTrue(np.isnan(ours["peak_xy_N"][1]))
        self.assertEqual([row["status"] for row in theirs], list(ours["status"]))
        self.assertEqual(list(ours["status"]), ["ok", "wrong_input", "ok"])
        self.assertIn("tool.helix_deg = 2000", ours["message"][1])
        # What is given wins over the case's own.
        changed = trochoid.sweep(case, {"cut.spindle_rpm": [600.25]}, method="grid")
        self.assertEqual(list(changed.tables["sweep"]),
                         ["cut.spindle_rpm", "peak_xy_N", "status", "message"])

    def test_an_answer_as_any_other(self):
        found = sweep()
        self.assertTrue(found.ok)
        self.assertEqual((found.rows, found.failed), (150, 50))
        self.assertEqual([w.code for w in found.warnings], ["rows_without_answer"])
        self.assertIn("peak_xy_N", str(found))
        self.assertIn("peak_xy_N", found._repr_html_())
        with self.assertRaises(ValueError):
            found.tables["sweep"]["status"][0] = "no"
        self.assertEqual(found.quantities[0].take, TAKE[0])
        try:
            import pandas  # noqa: F401
        except ImportError:
            return
        self.assertEqual(list(found.frame()["status"][:2]), ["ok", "wrong_input"])

    def test_a_picture(self):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("matplotlib is not here")
        axes = sweep().plot().axes[0]
        self.assertEqual(axes.get_xlabel(), "cut.spindle_rpm")
        self.assertEqual(len(axes.lines), 2)
        found = trochoid.identify(EXAMPLES / "st52_slot/case.toml")
        drawn = trochoid.sweep(CASE, covariance=found, draws=5, command="simulate",
                               take=["result.peak_xy_N"])
        self.assertEqual([line.get_label() for line in drawn.plot().axes[0].lines],
                         ["peak_xy_N"])

    def test_what_is_wrong_is_told_before_the_work(self):
        for over, options, says in (
            ({"cut.spindel_rpm": [1]}, {}, "spindel"),
            ({"cut.spindle_rpm": [-1]}, {}, "cut.spindle_rpm = -1"),
            ({"cut.spindle_rpm": 3}, {}, "from, to, count"),
            ({"cut.spindle_rpm": {"mean": 3, "sd": 1}}, {}, "latin_hypercube"),
            ({"cut.spindle_rpm": [[3, 4]]}, {}, "must be a list of numbers"),
            (OVER, {"command": "simulat"}, "simulate"),
            (OVER, {"take": ["result.peak"]}, "result.peak_xy_N"),
            (OVER, {"take": None}, "what shall be taken"),
            (OVER, {"colour": 3}, "sweep.colour: no such key"),
            (OVER, {"method": "gird"}, "latin_hypercube"),
            (None, {}, "[sweep] is missing"),
        ):
            if over is None:
                options = {"command": "", "take": None}
            with self.subTest(says), self.assertRaises(trochoid.InputError) as error:
                sweep(over, **options)
            self.assertIn(says, str(error.exception))
        with self.assertRaises(TypeError):
            sweep(executor="threads")
        with ThreadPoolExecutor(1) as executor, self.assertRaisesRegex(ValueError, "in_flight"):
            sweep(executor=executor, in_flight=0)

    def test_a_case_travels_with_places_and_records(self):
        case = trochoid.Case.from_file(CASE)
        again = pickle.loads(pickle.dumps(case))
        self.assertEqual((again.file, again.to_dict()), (case.file, case.to_dict()))

        def said(one):
            with self.assertRaises(trochoid.InputError) as error:
                one.check("stability")
            return str(error.exception)

        self.assertEqual(said(case), said(again))

    def test_the_program_and_python_go_on_for_one_another(self):
        over = '[sweep]\nover = { "cut.spindle_rpm" = { from = 100, to = 9000, count = 6000 } }'
        options = ("--command", "simulate", "--take", TAKE[0])
        case, run = self.program(over, *options, "--time-limit", "0.2", "--no-report")
        self.assertEqual(run.returncode, 1, run.stderr)
        folder, part = case.with_suffix(".sweep"), self.folder / ".cut.sweep.part"
        seen = []
        rest = trochoid.sweep(case, command="simulate", take=TAKE[0], folder=folder,
                              progress=lambda done, rows: seen.append((done, rows)))
        self.assertGreater(seen[0][0], 0)
        self.assertEqual(seen[-1], (6000, 6000))
        self.assertFalse(part.exists())
        self.assertTrue((folder / "summary.json").exists())
        self.same(rest, trochoid.sweep(case, command="simulate", take=TAKE[0]))

    def test_an_interrupt_ends_it_within_a_second_and_rows_are_kept(self):
        part = self.folder / "rows"
        script = textwrap.dedent(f"""
            import numpy, trochoid
            print("begun", flush=True)
            trochoid.sweep({str(CASE)!r}, {{"cut.spindle_rpm": numpy.linspace(1, 9, 10**6)}},
                           command="simulate", take=["result.peak_xy_N"],
                           part_file={str(part)!r}, progress=print)""")
        work = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE)
        with work:
            work.stdout.readline()
            while not (part.exists() and part.stat().st_size > 3000):
                time.sleep(0.05)
            begun = time.monotonic()
            work.send_signal(signal.SIGINT)
            _, said = work.communicate(timeout=20)
            took = time.monotonic() - begun
        self.assertIn(b"KeyboardInterrupt", said)
        self.assertLess(took, 3)  # a second, and the end of a process on a busy machine


if __name__ == "__main__":
    unittest.main()
