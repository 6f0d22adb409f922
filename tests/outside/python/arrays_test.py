"""Arrays in and out: records in memory, and the kernels."""

import csv
import pathlib
import threading
import time
import unittest
import warnings

import numpy as np

import trochoid

ROOT = pathlib.Path(__file__).resolve().parents[3]
SLOT = ROOT / "examples/st52_slot"
BALL = trochoid.Case.from_file(ROOT / "examples/ball/case.toml")


def columns_of(file):
    with open(file, newline="") as stream:
        rows = list(csv.reader(line for line in stream if not line.startswith("#")))
    numbers = np.array(rows[1:], dtype=float)
    return {name: numbers[:, i] for i, name in enumerate(rows[0])}


def identify(*arguments, **options):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", trochoid.AnswerWarning)
        return trochoid.identify(*arguments, **options)


class Records(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        case = trochoid.Case.from_file(SLOT / "case.toml")
        quick = {"chip_models": ["feed"], "runout": "none", "sweep_um": None}
        cls.case = case.with_({f"identify.{key}": value for key, value in quick.items()})
        cls.columns = columns_of(SLOT / "record.csv")
        cls.from_file = identify(cls.case).to_dict()
        (cls.given,) = cls.case.to_dict()["measurement"]
        cls.keys = {k: v for k, v in cls.given.items() if k != "file"}

    def same(self, record):
        """But for the name of the record, what the file gives."""
        found = identify(self.case, records=[record]).to_dict()
        self.assertEqual(found["fits"], self.from_file["fits"])

    def test_columns_are_the_file(self):
        self.same(trochoid.Record(self.columns, **self.keys))

    def test_a_frame_is_the_file(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not here")
        frame = pandas.DataFrame({**self.columns, "comment": "x"})
        self.same(trochoid.Record(frame, **self.keys))

    def test_an_array_is_the_file(self):
        names = [name for name in self.columns if name.startswith("F")]
        F = np.stack([self.columns[name] for name in names], axis=1)
        F.flags.writeable = False
        rest = {}
        if "time_s" in self.columns:
            rest["time_s"] = self.columns["time_s"]
        if "angle_deg" in self.columns:
            rest["angle_deg"] = self.columns["angle_deg"]
        keys = {k: v for k, v in self.keys.items() if not k.endswith("column")}
        self.same(trochoid.Record(F[::1], **rest, **keys))
        self.same(trochoid.Record(np.asfortranarray(F), **rest, **keys))

    def test_the_case_keeps_its_own_copy(self):
        columns = {name: values.copy() for name, values in self.columns.items()}
        record = trochoid.Record(columns, **self.keys)
        document = trochoid._measured.with_measured(
            self.case._document, "identify", records=[record]
        )
        case = trochoid.Case._of(document, None)
        for values in columns.values():
            values[:] = 0
        self.assertEqual(identify(case).to_dict()["fits"], self.from_file["fits"])

    def test_what_is_wrong_in_a_record_is_an_input_error(self):
        F = np.zeros((100, 3))
        F[7, 1] = np.nan
        with self.assertRaisesRegex(trochoid.InputError, 'plate: column "Fy": sample 8'):
            identify(self.case, records=trochoid.Record(F, sample_rate_Hz=1e4, name="plate"))
        self.assertIsNone(self.problem_of(F).key)
        with self.assertRaisesRegex(trochoid.InputError, "sample_rate_Hz"):
            identify(self.case, records=trochoid.Record(F, sample_rate_Hz=-1))
        with self.assertRaisesRegex(trochoid.InputError, r"measurement\[1\].froms"):
            identify(self.case, records=trochoid.Record(F, sample_rate_Hz=1e4, froms=3))

    def problem_of(self, F):
        with self.assertRaises(trochoid.InputError) as raised:
            identify(self.case, records=trochoid.Record(F, sample_rate_Hz=1e4))
        return raised.exception.problems[0]

    def test_wrong_shapes_and_types_are_said(self):
        for forces, error, why in (
            (np.zeros((3, 100)), ValueError, "transpose"),
            (np.zeros(100), ValueError, r"shape \(n, 3\)"),
            (np.zeros((9, 3), complex), TypeError, "real numbers"),
            ([["a", "b", "c"]], TypeError, "real numbers"),
            ({"Fx_N": np.zeros((9, 2))}, ValueError, "column 'Fx_N'"),
        ):
            with self.assertRaisesRegex(error, why):
                trochoid.Record(forces, sample_rate_Hz=1e4)
        with self.assertRaisesRegex(TypeError, "file"):
            trochoid.Record(np.zeros((9, 3)), file="x.csv")
        record = trochoid.Record(np.zeros((9, 3)), sample_rate_Hz=1e4, name="a")
        with self.assertRaisesRegex(ValueError, "two are called 'a'"):
            identify(self.case, records=[record, record])
        with self.assertRaisesRegex(TypeError, "ndarray"):
            identify(self.case, records=[np.zeros((9, 3))])


class Kernels(unittest.TestCase):
    def test_forces_are_those_of_simulate(self):
        table = trochoid.simulate(BALL).tables["forces"]
        F = trochoid.forces(BALL, table["angle_deg"])
        for i, name in enumerate(("Fx_N", "Fy_N", "Fz_N")):
            np.testing.assert_array_equal(F[:, i], table[name])

    def test_shapes_follow_the_angles(self):
        phi = np.arange(24.0).reshape(2, 3, 4) * 15
        F = trochoid.forces(BALL, phi)
        self.assertEqual(F.shape, (2, 3, 4, 3))
        np.testing.assert_array_equal(F[1, 2, 3], trochoid.forces(BALL, phi[1, 2, 3]))
        np.testing.assert_array_equal(trochoid.forces(BALL, phi.T), F.transpose(2, 1, 0, 3))
        self.assertEqual(trochoid.forces(BALL, []).shape, (0, 3))
        whole = trochoid.forces(BALL, phi.astype(np.int16))
        np.testing.assert_array_equal(whole, F)
        phi.flags.writeable = False
        np.testing.assert_array_equal(trochoid.forces(BALL, phi[:, ::2]), F[:, ::2])

    def test_the_matrix_times_the_coefficients_is_the_force(self):
        phi = np.linspace(0, 360, 25)
        C = trochoid.force_matrix(BALL, phi)
        force = BALL.to_dict()["force"]
        K = [force[f"K_{q}c_MPa"] * 1e6 for q in "tra"]
        K += [force.get(f"K_{q}e_N_per_mm", 0) * 1e3 for q in "tra"]
        F = trochoid.forces(BALL, phi)
        np.testing.assert_allclose(C @ K, F, atol=2e-6 * abs(F).max(), rtol=0)

    def test_chips_are_those_of_simulate(self):
        asked = {"edge_angles_deg": [30, 60, 90], "edge_heights_mm": [0.5, 1.0]}
        case = BALL.with_({"sampling": asked})
        table = trochoid.simulate(case).tables["chip"]
        h = trochoid.chip(
            case, table["tooth"].astype(int), table["edge_angle_deg"], table["height_mm"]
        )
        np.testing.assert_array_equal(h, table["h_mm"])
        teeth = np.array([1, 2])[:, None, None]
        together = trochoid.chip(case, teeth, [[30], [60], [90]], [0.5, 1.0])
        np.testing.assert_array_equal(together.ravel(), h)

    def test_the_multiplier_is_that_of_stability(self):
        case = trochoid.Case.from_file(ROOT / "examples/stability_922Hz/case.toml")
        cut = case.to_dict()["cut"]
        mu = trochoid.multiplier(case, cut["spindle_rpm"], cut["axial_depth_mm"])
        self.assertEqual(mu.shape, ())
        self.assertEqual(mu.dtype, np.complex128)
        stated = trochoid.stability(case).to_dict()["multiplier"]
        self.assertAlmostEqual(abs(mu[()]), stated["absolute"], delta=1e-12)
        grid = trochoid.multiplier(case, [[3000], [4000]], [0.2, 0.5, 1])
        self.assertEqual(grid.shape, (2, 3))

    def test_wrong_arguments_say_what_and_where(self):
        for call, error, why in (
            (lambda: trochoid.forces(BALL, [0, np.nan]), ValueError, r"phi_deg\[1\] is nan"),
            (lambda: trochoid.forces(BALL, np.inf), ValueError, "phi_deg is inf"),
            (lambda: trochoid.forces(BALL, "north"), TypeError, "phi_deg"),
            (lambda: trochoid.forces(BALL, [1j]), TypeError, "complex128"),
            (lambda: trochoid.forces(BALL, [None]), TypeError, "object"),
            (lambda: trochoid.chip(BALL, [1, 3], 30), ValueError, r"tooth\[1\] = 3.*1 to 2"),
            (lambda: trochoid.chip(BALL, 1.0, 30), TypeError, "tooth: whole"),
            (lambda: trochoid.chip(BALL, 1, 30, -1), ValueError, "height_mm = -1"),
            (lambda: trochoid.chip(BALL, [1, 2], [1, 2, 3]), ValueError, r"\(2,\).*\(3,\)"),
            (lambda: trochoid.multiplier(BALL, 0, 1), ValueError, "spindle_rpm = 0"),
            (lambda: trochoid.multiplier(BALL, 900, 1), trochoid.InputError, "mode"),
        ):
            with self.subTest(why=why), self.assertRaisesRegex(error, why):
                call()

    def test_other_threads_go_on_meanwhile(self):
        phi = np.linspace(0, 360, 4001)
        trochoid.forces(BALL, 0)
        ticks, done = [], threading.Event()

        def tick():
            while not done.is_set():
                ticks.append(time.monotonic())
                done.wait(1e-3)

        other = threading.Thread(target=tick)
        other.start()
        begin = time.monotonic()
        trochoid.forces(BALL, phi)
        end = time.monotonic()
        done.set()
        other.join()
        seen = [begin, *(tick for tick in ticks if begin < tick < end), end]
        self.assertLess(np.diff(seen).max(), 0.5 * (end - begin))


if __name__ == "__main__":
    unittest.main()
