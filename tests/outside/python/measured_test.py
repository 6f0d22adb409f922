"""Responses, steps and walls in memory give what their files give."""

import csv
import os
import pathlib
import pickle
import signal
import threading
import time
import unittest
import warnings

import numpy as np

import trochoid

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
TAP = EXAMPLES / "tap_test"
MEASURED = trochoid.Case.from_file(EXAMPLES / "measured_frf/case.toml")
WALL = trochoid.Case.from_file(EXAMPLES / "thin_wall_table1/case.toml")


def columns_of(file):
    with open(file, newline="") as stream:
        rows = list(csv.reader(line for line in stream if not line.startswith("#")))
    numbers = np.array(rows[1:], dtype=float)
    return {name: numbers[:, i] for i, name in enumerate(rows[0])}


def complex_of(file):
    columns = list(columns_of(file).values())
    return columns[0], columns[1] + 1j * columns[2]


def quietly(call, *arguments, **options):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", trochoid.AnswerWarning)
        return call(*arguments, **options)


class Responses(unittest.TestCase):
    def responses(self):
        case = MEASURED.to_dict()
        return [
            trochoid.Response(
                *complex_of(EXAMPLES / "measured_frf" / one["file"]),
                unit="(m/s^2)/N",
                **{key: value for key, value in one.items() if key != "file"},
            )
            for one in case["measured_frf"]
        ]

    def test_of_one_tap_test(self):
        of_file = trochoid.modes(TAP / "tip_x.csv").modes
        frequency, values = complex_of(TAP / "tip_x.csv")
        response = trochoid.Response(frequency, values, unit="(m/s^2)/N")
        self.assertEqual(trochoid.modes(response).modes, of_file)
        named = trochoid.Response(columns_of(TAP / "tip_x.csv"))
        self.assertEqual(trochoid.modes(named).modes, of_file)

    def test_what_the_case_says_of_it_stays(self):
        case = trochoid.Case.from_file(TAP / "case.toml")
        named = trochoid.Response(columns_of(TAP / "tip_x.csv"), name="tip")
        found = trochoid.modes(case, responses=named)
        self.assertEqual(found.modes, trochoid.modes(case).modes)
        self.assertNotEqual(found.modes, trochoid.modes(named).modes)  # of the whole band

    def test_hammer_blows(self):
        blows = trochoid.Response(columns_of(TAP / "hammer.csv"), modes=2)
        of_file = quietly(trochoid.modes, TAP / "hammer.csv", modes=2)
        self.assertEqual(quietly(trochoid.modes, blows).modes, of_file.modes)

    def test_several_in_place_of_modes(self):
        one = {"spindle_rpm": [9000, 9000, 1], "axial_depth_mm": [0.1, 5, 3]}
        small = MEASURED.with_({"stability": one})
        of_file = quietly(trochoid.stability, small).to_dict()
        found = quietly(trochoid.stability, small, responses=self.responses())
        self.assertGreater(of_file["limit_depth_mm"], 0)
        for name in ("multiplier", "limit_depth_mm"):
            self.assertEqual(found.to_dict()[name], of_file[name])
        rpm = {"cut.spindle_rpm": [9000, 12000]}
        take = ["result.limit_depth_mm"]
        swept = [
            quietly(trochoid.sweep, small, rpm, command="stability", take=take, **options)
            for options in ({}, {"responses": self.responses()})
        ]
        tables = [list(one.tables["sweep"]["limit_depth_mm"]) for one in swept]
        self.assertEqual(tables[0], tables[1])

    def test_a_case_with_data_travels(self):
        document = trochoid._measured.with_measured(
            MEASURED._document, "stability", responses=self.responses()
        )
        case = trochoid.Case._of(document, None)
        there = pickle.loads(pickle.dumps(case))
        self.assertEqual(there.as_understood("stability"), case.as_understood("stability"))
        self.assertIn('file = "response 1"', case.as_understood("stability"))

    def test_what_is_wrong(self):
        f, H = np.arange(1.0, 9), np.ones(8, complex)
        for wrong in (
            lambda: trochoid.Response(f, H),
            lambda: trochoid.Response(f, unit="m/N"),
            lambda: trochoid.Response({"freq_Hz": f}, H),
            lambda: trochoid.Response(f, H.astype(str), unit="m/N"),
            lambda: trochoid.Response(f, H, unit="m/N", file="x.csv"),
            lambda: trochoid.modes(trochoid.Response(f, H, unit="m/N"), modes=2),
            lambda: trochoid.stability(MEASURED, responses=[f]),
        ):
            self.assertRaises(TypeError, wrong)
        for wrong in (
            lambda: trochoid.Response(f, H[1:], unit="m/N"),
            lambda: trochoid.Response(f, H, unit="m,N"),
            lambda: trochoid.Response({}),
            lambda: trochoid.stability(MEASURED, responses=[]),
            lambda: trochoid.stability(
                MEASURED, responses=2 * [trochoid.Response(f, H, unit="m/N", name="a")]
            ),
        ):
            self.assertRaises(ValueError, wrong)
        with self.assertRaisesRegex(trochoid.InputError, "furlong"):
            trochoid.modes(trochoid.Response(f, H, unit="furlong"))
        H[2] = np.nan
        with self.assertRaisesRegex(trochoid.InputError, "tip:4:"):
            trochoid.modes(trochoid.Response(f, H, unit="m/N", name="tip"))


class Steps(unittest.TestCase):
    def test_in_place_of_its_file(self):
        columns = columns_of(TAP / "step.csv")
        of_file = trochoid.actuator(TAP / "step.csv").to_dict()
        found = trochoid.actuator(trochoid.Step(columns)).to_dict()
        case = trochoid.Case.from_file(TAP / "case.toml")
        given = trochoid.actuator(case, step=trochoid.Step(columns)).to_dict()
        for answer in (found, given):
            self.assertEqual(answer["frequency_Hz"], of_file["frequency_Hz"])
        height = columns["command_um"][-1] - columns["command_um"][0]
        start = columns["time_s"][np.flatnonzero(np.diff(columns["command_um"]))[0] + 1]
        alone = trochoid.Step(
            columns["time_s"], columns["position_um"], step_um=height, start_s=start
        )
        self.assertAlmostEqual(
            quietly(trochoid.actuator, alone).frequency_Hz / of_file["frequency_Hz"], 1, 2
        )

    def test_what_is_wrong(self):
        with self.assertRaisesRegex(TypeError, "position_um missing"):
            trochoid.Step([0.0, 1.0])
        with self.assertRaisesRegex(TypeError, "not both"):
            trochoid.Step({"time_s": [0.0]}, [0.0])
        with self.assertRaisesRegex(TypeError, "step_um"):
            trochoid.actuator(trochoid.Step([0.0, 1.0], [0.0, 1.0]), step_um=3)


class Walls(unittest.TestCase):
    def test_in_place_of_its_file(self):
        (given,) = WALL.to_dict()["surface_measurement"]
        columns = columns_of(EXAMPLES / "thin_wall_table1" / given["file"])
        keys = {key: value for key, value in given.items() if key != "file"}
        of_file = quietly(trochoid.calibrate, WALL)
        named = quietly(trochoid.calibrate, WALL, readings=trochoid.Readings(columns, **keys))
        self.assertEqual(named.coefficients, of_file.coefficients)
        self.assertEqual(named.rms_mm, of_file.rms_mm)
        holes = {name: np.append(values, values[0]) for name, values in columns.items()}
        holes["error_mm"][-1] = np.nan
        left_out = [trochoid.Readings(holes, **keys)]
        found = quietly(trochoid.calibrate, WALL, readings=left_out)
        self.assertEqual(found.coefficients, of_file.coefficients)
        self.assertIn("skipped", " ".join(warning.code for warning in found.warnings))

    def test_one_by_one(self):
        columns = {"x_mm": [1, 2], "height_mm": [0.5, 1], "error_mm": [0.01, 1e-17]}
        arrays = trochoid.Readings(*columns.values())
        self.assertEqual(arrays._text, trochoid.Readings(columns)._text)
        self.assertEqual(arrays._text.splitlines()[2], "2.0,1.0,1e-17")


class Interrupted(unittest.TestCase):
    def test_ctrl_c_is_heard_while_a_command_works(self):
        case = trochoid.Case.from_file(EXAMPLES / "stability_922Hz/case.toml")
        grid = {"spindle_rpm": [1000, 9000, 900], "axial_depth_mm": [0.05, 6, 300]}
        long = case.with_({"stability": grid})
        begun = time.monotonic()
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            quietly(trochoid.stability, long)
        self.assertLess(time.monotonic() - begun, 10)
        self.assertTrue(quietly(trochoid.stability, case).ok)


if __name__ == "__main__":
    unittest.main()
