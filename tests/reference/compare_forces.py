"""The program's simulate against the transcription, over every choice of the case file."""
import os
import random
import sys
import tempfile
import unittest

import numpy as np

import chip
import force
import geometry
import made_cases
import program
import tables as tb

TOLERANCE = 1e-6  # of the peak force: what the program promises by default
# Where an edge reaches the axis, marks appear and vanish within parts of a micrometre,
# and either side may miss such a gap.
TOLERANCE_AT_AXIS = 2e-5


def reaches_axis(case):
    _, s0, _ = geometry.segments(case.tool, case.a_p)[0]
    kind = geometry.segments(case.tool, case.a_p)[0][0]
    return geometry.point(case.tool, kind, s0, np.array([s0]))[0][0] < 1e-6


class Simulate(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="trochoid_")
        self.addCleanup(self.folder.cleanup)

    def simulate(self, name, tables):
        answer = program.run("simulate", program.case_text(name, tables), self.folder.name,
                             name)
        self.assertEqual(answer.code, 0, f"{name}: {answer.stderr}\n"
                         + program.case_text(name, tables))
        return answer

    # [F-1] [F-2] [F-3] [F-4] [F-5] [G-1] [G-6] [G-7] [G-8] [G-9] [G-10] [G-11]
    def test_forces(self):
        rng = random.Random(5)
        worst = (0.0, "")
        for name, tables in program.some(made_cases.cases(), 3):
            with self.subTest(name):
                angles = [round(rng.uniform(0, 360), 4) for _ in range(12)]
                tables["sampling"] = {"angles_deg": angles}
                col = self.simulate(name, tables).columns("forces.csv")
                got = np.array([col["Fx_N"], col["Fy_N"], col["Fz_N"]]).T
                case = tb.to_case(tables)
                K = tb.coefficients(tables["force"])
                axis = reaches_axis(case) and case.model == "trochoidal"
                cells = 512 if axis else 64
                want = force.forces(case, K, np.radians(angles), cells)[:, :3]
                peak = np.abs(want).max()
                error = np.abs(got - want).max() / max(peak, 1e-300) if peak else 0.0
                worst = max(worst, (error, name))
                i = int(np.argmax(np.abs(got - want).max(axis=1)))
                self.assertLessEqual(
                    error, TOLERANCE_AT_AXIS if axis else TOLERANCE, f"{name}: {got[i]} for {want[i]} at {angles[i]} deg\n"
                    + program.case_text(name, tables))
        print(f"forces: worst error {worst[0]:.1e} of the peak, in {worst[1]}")

    # [C-1] [C-2] [C-3] [C-4] [C-5] [C-6] [C-7]
    def test_chips_and_engagement(self):
        rng = random.Random(6)
        for name, tables in program.some(made_cases.cases(), 3, 1):
            with self.subTest(name):
                case = tb.to_case(tables)
                a_p = case.a_p
                angles = [round(rng.uniform(-89, 269), 3) for _ in range(40)]
                angles += [0.05, 0.4, 179.7, 179.95, 89.99]
                heights = [0.4 * a_p, a_p, round(0.77 * a_p, 3)]
                tables["sampling"] = {"angles_deg": [0.1], "edge_angles_deg": angles,
                                      "edge_heights_mm": heights}
                answer = self.simulate(name, tables)
                self.compare_chips(name, case, answer.columns("chip.csv"), tables)
                self.compare_intervals(name, case, heights[0], answer.result["teeth"])

    def compare_chips(self, name, case, col, tables):
        sampling = tables["sampling"]
        rows = case.tool.N * len(sampling["edge_angles_deg"]) * len(
            sampling["edge_heights_mm"])
        self.assertEqual(len(col["h_mm"]), rows, name)
        for tooth, angle, z, h in zip(*(col[k] for k in (
                "tooth", "edge_angle_deg", "height_mm", "h_mm"))):
            r, _, lag, _ = geometry.at_height(case.tool, z)
            want, _ = chip.chip(case, int(tooth) - 1, np.radians([angle]), np.array([r]),
                                np.array([lag]))
            self.assertAlmostEqual(h, want[0], delta=1e-12, msg=f"{name} tooth {tooth} "
                                   f"at {angle} deg, {z} mm\n"
                                   + program.case_text(name, tables))

    def compare_intervals(self, name, case, z, teeth):
        r, _, lag, _ = geometry.at_height(case.tool, z)
        for j in range(case.tool.N):
            want = np.degrees(chip.intervals(case, j, r, lag)).reshape(-1, 2)
            got = np.array(teeth[j]["intervals_deg"], float).reshape(-1, 2)
            self.assertEqual(len(got), len(want), f"{name} tooth {j + 1}: {got} {want}")
            np.testing.assert_allclose(got, want, atol=1e-5, err_msg=f"{name} tooth {j+1}")

    def test_summary(self):  # [F-6] [F-7]
        for name, tables in program.some(made_cases.cases(3, seed=77), 2):
            with self.subTest(name):
                tables["sampling"] = {"samples_per_rev": 40, "revolutions": 1,
                                      "start_deg": 0.3}
                answer = self.simulate(name, tables)
                col = answer.columns("forces.csv")
                self.compare_summary(name, tables, col, answer.result)

    def compare_summary(self, name, tables, col, result):
        F = np.array([col["Fx_N"], col["Fy_N"], col["Fz_N"]]).T
        for key, want in (("min_N", F.min(0)), ("max_N", F.max(0)),
                          ("rms_N", np.sqrt((F * F).mean(0)))):
            np.testing.assert_allclose(result[key], want, rtol=1e-12, atol=1e-9)
        # Of a cylinder and a linear law the mean is that of the turn (outside/cases compares
        # it with exact ones); 40 samples are near it.
        np.testing.assert_allclose(result["mean_N"], F.mean(0), atol=0.02 * np.abs(F).max())
        self.assertAlmostEqual(result["peak_xy_N"], np.hypot(F[:, 0], F[:, 1]).max(),
                               delta=1e-9)
        case, K = tb.to_case(tables), tb.coefficients(tables["force"])
        all_six = force.forces(case, K, np.radians(col["angle_deg"]), 64)
        T = all_six[:, 5] / 1000  # N mm to N m
        scale = np.abs(T).max() + 1e-300
        self.assertAlmostEqual(result["torque_mean_Nm"], T.mean(), delta=5e-5 * scale)
        self.assertAlmostEqual(result["torque_peak_Nm"], np.abs(T).max(), delta=5e-5 * scale)
        Omega = tables["cut"]["spindle_rpm"] * 2 * np.pi / 60
        self.assertAlmostEqual(result["power_W"], T.mean() * Omega,
                               delta=5e-5 * scale * Omega)
        bending = np.hypot(all_six[:, 3], all_six[:, 4]).max() / 1000
        keys = [k for k in result if "bending" in k and "peak" in k]
        self.assertTrue(keys, f"no peak bending moment among {sorted(result)}")
        self.assertAlmostEqual(result[keys[0]], bending, delta=5e-5 * bending + 1e-12)


if __name__ == "__main__":
    if not os.path.exists(program.PROGRAM):
        sys.exit(f"no program at {program.PROGRAM}; set TROCHOID")
    unittest.main()
