"""The transcription against the worked cases of ../shared, and against itself.

The worked cases come from a third program; that the transcription agrees with them to
rounding makes it fit to judge ours.
"""
import sys
import unittest
from dataclasses import replace

import numpy as np

import chip
import force
import geometry
import identification
import program
import worked
from case import Case, Tool

PAPER = Case(tool=Tool(D=8.0, pitch=[np.pi, np.pi], helix=np.radians(30)), f_z=0.04,
             a_p=2.0, offsets=[0.0, -0.008])
K = [2620.0, 1560.0, 331.0, 7.0, 3.0, 1.0]


class Worked(unittest.TestCase):
    def test_chip_agrees_to_rounding(self):  # [C-2] [C-3] [C-4] [C-5] [C-6] [C-7]
        for c in worked.read("chip"):
            for model in c["samples"][0]["h"]:
                case = worked.to_case(c, model)
                r, _, lag, _ = geometry.at_height(case.tool, c["z"])
                for s in c["samples"]:
                    h, _ = chip.chip(case, s["tooth"] - 1, np.radians([s["theta_deg"]]),
                                     np.array([r]), np.array([lag]))
                    self.assertAlmostEqual(h[0], s["h"][model], delta=1e-13,
                                           msg=f"{c['id']} {model} {s}")

    def test_engagement_and_area(self):  # [C-7] [C-8]
        for c in worked.read("chip"):
            for model, expected in c["engagement_deg"].items():
                case = worked.to_case(c, model)
                r, _, lag, _ = geometry.at_height(case.tool, c["z"])
                for j, want in enumerate(expected):
                    got = np.degrees(chip.intervals(case, j, r, lag))
                    self.assertEqual(len(got), len(want), f"{c['id']} {model} tooth {j+1}")
                    np.testing.assert_allclose(got, want, atol=1e-8)
            self.assertAlmostEqual(chip.area(worked.to_case(c)) / c["area_per_rev_mm2"],
                                   1.0, delta=1e-6)

    def test_forces_agree(self):  # [F-1] [F-3] [F-4]
        for c in worked.read("force"):
            case, phi = worked.to_case(c), np.radians(c["phi_deg"])
            F = force.forces(case, worked.coefficients(c), phi)[:, :3]
            F = F @ np.array(c.get("output_map", np.eye(3))).T
            np.testing.assert_allclose(F, c["F_N"], rtol=0, err_msg=c["id"],
                                       atol=c["tolerance"]["F_converged_N"] / 50)
            if "C_first" in c:
                C = force.matrix(case, [np.radians(c["C_first"]["phi_deg"])])[0, :3]
                np.testing.assert_allclose(C, c["C_first"]["C"], rtol=1e-3, atol=1e-3)

    def test_fits_agree(self):  # [I-1] [I-2] [I-5] [I-6]
        for c in worked.read("ident"):
            data = np.loadtxt(worked.folder() / c["csv"], delimiter=",", skiprows=1)
            angle, F = np.radians(data[:, 0]), data[:, 1:]
            if c.get("expected_error") == "rank_deficient":
                fit = identification.fixed(worked.to_case(c, c["truth"]["model"]), angle, F)
                self.assertIsNone(fit["K"])
                continue
            for f in c["fits"]:
                case = replace(worked.to_case(c, f["model"]), offsets=f["shift_mm"],
                               rho=f["rho_mm"], lam=np.radians(f["lambda_deg"]))
                fit = identification.fixed(case, angle, F, np.radians(f["phase_deg"]))
                tol = f["tolerance"]
                name = f"{c['id']} {f['label']}"
                np.testing.assert_array_less(np.abs(fit["K"] - f["K"]), tol["K"], name)
                self.assertAlmostEqual(fit["rms"], f["rms_vec_N"], delta=tol["rms_N"])
                np.testing.assert_allclose(fit["rms_axis"], f["rms_axis_N"],
                                           atol=tol["rms_N"])
                np.testing.assert_allclose(fit["se"], f["se"], rtol=tol["se_rel"])
                np.testing.assert_allclose(fit["cond"], f["cond_scaled"],
                                           rtol=tol["cond_rel"])

    @program.long_form
    def test_joint_fits_and_sweep_agree(self):  # [I-3] [I-4]
        for c in worked.read("ident"):
            if "joint" not in c and "sweep" not in c:
                continue
            data = np.loadtxt(worked.folder() / c["csv"], delimiter=",", skiprows=1)
            angle, F = np.radians(data[:, 0]), data[:, 1:]
            for f in c.get("joint", [])[-1:]:  # the last is the exact model; 8 s each
                fit = identification.joint(worked.to_case(c, f["model"]), angle, F,
                                           f["parameters"], f["start"])
                np.testing.assert_array_less(np.abs(fit["p"] - f["p"]), f["tolerance"]["p"])
                np.testing.assert_array_less(np.abs(fit["K"] - f["K"]), f["tolerance"]["K"])
                np.testing.assert_allclose(fit["se_p"], f["se_p"], rtol=0.05)
                np.testing.assert_allclose(fit["se_K"], f["se_K"], rtol=0.05)
                np.testing.assert_allclose(fit["correlation"], f["corr"], atol=0.02)
            if "sweep" in c:
                x = np.array(c["sweep"]["shift2_um"])[::5] * 1e-3
                want = np.array(c["sweep"]["rms_vec_N"]["exact"])[::5]
                got = identification.sweep(worked.to_case(c, "exact"), angle, F, x)
                np.testing.assert_allclose(got, want, atol=c["sweep"]["tolerance_N"])


class Itself(unittest.TestCase):
    def test_profiles_are_continuous_at_M_and_N(self):  # [G-2] [G-3] [G-4] [G-5]
        tools = [Tool(D=10, pitch=[np.pi] * 2, R=5, Rr=0, Rz=5),
                 Tool(D=12, pitch=[np.pi] * 2, R=1, Rr=5, Rz=1),
                 Tool(D=16, pitch=[np.pi] * 2, R=2, Rr=6.2, Rz=2.4, alpha=0.1, beta=0.05),
                 Tool(D=16, pitch=[np.pi] * 2, alpha=0.2, beta=0.1)]
        for t in tools:
            seg = geometry.segments(t, 15.0)
            for (k1, a1, b1), (k2, a2, _) in zip(seg[:-1], seg[1:]):
                one = geometry.point(t, k1, a1, np.array([b1]))
                two = geometry.point(t, k2, a2, np.array([a2]))
                np.testing.assert_allclose(one[:2], two[:2], atol=1e-12)

    def test_edge_length_of_a_cylinder(self):  # [G-6] [G-7]
        kappa, r = np.array([np.pi / 2]), np.array([4.0])
        _, slope = geometry.lag(PAPER.tool, "flank", r, np.array([1.0]), kappa)
        self.assertAlmostEqual(geometry.edge_length_factor(r, slope)[0],
                               1 / np.cos(np.radians(30)), delta=1e-14)

    def test_constant_helix_is_the_integral_of_its_slope(self):  # [G-8]
        t = Tool(D=8, pitch=[np.pi] * 2, helix=0.6, beta=0.1, constant_helix=True)
        z = np.linspace(0, 6, 20001)
        r = 4 + z * np.tan(0.1)
        slope = np.tan(0.6) / (r * np.cos(0.1))
        want = np.sum(0.5 * (slope[1:] + slope[:-1]) * np.diff(z))
        got, _ = geometry.lag(t, "flank", r[-1:], z[-1:], np.array([np.pi / 2 - 0.1]))
        self.assertAlmostEqual(got[0], want, delta=1e-8)

    def test_first_order_runout_is_the_limit_of_the_exact_one(self):  # [G-9] [G-10]
        k = np.arange(2)
        for rho in (1e-3, 1e-4):
            exact = replace(PAPER, offsets=[], rho=rho, lam=0.7)
            first = replace(exact, first_order=True)
            R1, eps = geometry.runout(exact, np.full(2, 4.0), 0.3, k)
            R2, _ = geometry.runout(first, np.full(2, 4.0), 0.3, k)
            self.assertLess(np.max(np.abs(R1 - R2)), rho**2 / 4)
            np.testing.assert_allclose(eps, rho * np.sin(np.array([0, np.pi]) + 0.3 - 0.7)
                                       / 4, atol=rho**2)

    def test_cumulative_integral_is_the_sum_along_the_edge(self):  # [F-5]
        phi = np.radians([3.0, 50.0, 170.0, 200.0])
        for case in (PAPER, replace(PAPER, model="feed"), replace(PAPER, y_lo=1.0)):
            want = force.forces(case, K, phi)[:, :3]
            got = force.cumulative(case, K, phi)
            np.testing.assert_allclose(got, want, atol=2e-4 * np.abs(want).max())

    def test_means_of_a_slot(self):  # [F-8]
        case = replace(PAPER, offsets=[], model="radial")
        phi = np.radians(np.arange(0, 360, 0.5) + 0.1)
        got = force.forces(case, K, phi)[:, :3].mean(axis=0)
        want = force.slot_means(2, 2.0, 0.04, K, 1 / np.cos(np.radians(30)))
        np.testing.assert_allclose(got, want, atol=0.02)

    def test_torque_is_radius_times_tangential_force(self):  # [F-6]
        case = replace(PAPER, offsets=[])
        only_t = [2620.0, 0, 0, 7.0, 0, 0]
        phi = np.radians([40.0, 100.0])
        one = force.forces(case, only_t, phi)
        both = force.forces(case, K, phi)
        np.testing.assert_allclose(one[:, 5], both[:, 5], rtol=1e-12)
        self.assertTrue((one[:, 5] > 0).all())


if __name__ == "__main__":
    if not worked.folder().is_dir():
        print(f"SKIPPED in part: no {worked.folder()}; only the class Itself is run",
              file=sys.stderr)
        sys.exit(not unittest.main(argv=[sys.argv[0], "Itself"], exit=False)
                 .result.wasSuccessful())
    unittest.main()
