"""What the calibration of the transcription must obey: E-11 and E-15 to E-17.

The cutter is that of the paper: 12 mm, three teeth, 45 deg, 83 mm out of the holder.
"""
import unittest
from dataclasses import replace

import numpy as np

import surface_calibrate as cal
import surface_error as se
from check_surface_laws import BENT, DOWN, H, K, RIGID, THIN, grid


class Calibration(unittest.TestCase):
    heights = np.linspace(0.25, 2.75, 11)

    def unit_errors(self, M):
        """Standard errors per 1 um of noise"""
        return 1e-3 * np.sqrt(np.diag(np.linalg.inv(M.T @ M)))

    def imprint_matrix(self, m, s, heights):
        return se.imprint_operator(m, s, heights).mean(axis=2).T

    def test_standard_errors_per_um_of_noise(self):
        M = self.imprint_matrix(DOWN, RIGID, self.heights)
        shifted = np.column_stack([M, np.ones(11)])
        np.testing.assert_allclose(self.unit_errors(M), [104, 28], rtol=0.02)
        np.testing.assert_allclose(self.unit_errors(shifted)[:2], [143, 45], rtol=0.02)
        W = self.imprint_matrix(DOWN, THIN, self.heights)
        np.testing.assert_allclose(self.unit_errors(W), [43, 12], rtol=0.02)
        two = self.imprint_matrix(DOWN, RIGID, [0.5, 1.5])
        np.testing.assert_allclose(self.unit_errors(two), [244, 67], rtol=0.02)
        c = se.compliance(DOWN, RIGID, se.rotation(DOWN, np.radians(140.5), 10, 10), [0.5])
        Q = np.column_stack([c.of_T[:, 0], c.of_R[:, 0]])
        np.testing.assert_allclose(self.unit_errors(Q), [49, 21], rtol=0.02)

    def rank(self, m, s, phi, heights, load="distributed"):
        c = se.compliance(m, s, phi, heights, load)
        M = np.column_stack([c.of_T.ravel(), c.of_R.ravel()])
        return cal.rank_and_condition(M, 1e-6)[0]

    def test_what_cannot_be_told_apart(self):
        phi = grid(DOWN)
        self.assertEqual(self.rank(DOWN, RIGID, phi, [0.5]), 2)
        self.assertEqual(self.rank(DOWN, RIGID, phi[2:3], [0.5]), 1)
        self.assertEqual(self.rank(DOWN, RIGID, phi[2:3], H), 2)
        self.assertEqual(self.rank(DOWN, RIGID, phi[2:3], H, "concentrated"), 1)
        lead = np.pi * 12.0 / 3
        even = replace(DOWN, ap=lead, disks=240)
        deep = replace(RIGID, a_p=lead)
        self.assertEqual(self.rank(even, deep, phi, [0.5], "concentrated"), 1)
        straight = replace(DOWN, helix=0.0)
        np.testing.assert_allclose(se.imprint_operator(straight, RIGID, H), 0.0, atol=1e-15)

    def test_calibration_returns_what_was_put_in(self):
        m = replace(DOWN, disks=60)
        for s in (RIGID, THIN):
            e = se.quasi_static(replace(m, **BENT), s, grid(m), H, K)
            got = cal.quasi_static(m, s, grid(m)[0], 10, H, e, "distributed")
            np.testing.assert_allclose(got["nominal"]["K"], K, rtol=1e-9)
            np.testing.assert_allclose(got["runout"]["rho"], BENT["rho"], rtol=1e-6)
            np.testing.assert_allclose(got["runout"]["lam"], BENT["lam"], rtol=1e-6)

    def held(self, M, columns, noise_of, runs):
        """How many of the 95 % intervals hold the truth"""
        K_true = np.array([800.0, 300.0, 0.004])[:columns]
        inside = np.zeros(columns)
        for seed in range(runs):
            fit = cal.linear(M, M @ K_true + noise_of(np.random.default_rng(seed)))
            inside += (fit["low"] < K_true) & (K_true < fit["high"])
        return inside[:2] / runs

    def test_intervals_hold_the_truth(self):
        M = np.repeat(self.imprint_matrix(DOWN, THIN, self.heights), 3, axis=0)
        M = np.column_stack([M, np.ones(len(M))])
        inside = self.held(M, 3, lambda rng: 1e-3 * rng.standard_normal(len(M)), 800)
        np.testing.assert_allclose(inside, 0.95, atol=0.023)  # 3 sigma of 800 runs

    def test_runout_taken_for_noise_makes_intervals_too_long(self):
        # Three teeth at each height are no chance: their mean is exact.
        m = replace(DOWN, **BENT)
        M = np.repeat(self.imprint_matrix(DOWN, THIN, self.heights), 3, axis=0)
        K_true = (800.0, 300.0)
        scatter = se.imprint(m, THIN, self.heights, K_true).ravel() - M @ K_true
        inside = self.held(
            M, 2, lambda rng: scatter + 1e-3 * rng.standard_normal(len(M)), 200)
        self.assertTrue((inside > 0.99).all(), inside)

    def test_linear_answer_of_a_real_profile_is_far_off(self):  # imprint of an envelope
        truth, z = (800.0, 300.0), np.linspace(0.25, 2.75, 11)
        x = np.zeros(11)
        e = se.envelope(DOWN, RIGID, z, truth)[0].mean(axis=0)
        one = cal.imprint(DOWN, lambda _: RIGID, x, z, e, "distributed")
        np.testing.assert_allclose(one["K"], [563, 305], rtol=5e-3)
        two = cal.envelope(DOWN, lambda _: RIGID, x, z, e, one["K"])
        np.testing.assert_allclose(two["p"], truth, rtol=1e-6)

    def test_flexible_fit_of_data_with_feedback(self):  # E-10
        m, truth = replace(DOWN, disks=30), (400.0, 200.0)
        phi0 = np.radians(140.5)
        predict = cal.flexible_quasi_static(m, THIN, phi0, 10, [0.5], "entry")
        e = predict(truth)
        rows = cal.nominal_rows(m, THIN, phi0, 10, [0.5], e, "distributed")
        one = cal.linear(*rows)["K"]
        self.assertLess(one[0], 0.5 * truth[0])
        self.assertGreater(one[1], 1.2 * truth[1])
        got = cal.flexible(predict, e, one)
        np.testing.assert_allclose(got["p"], truth, rtol=1e-4)


if __name__ == "__main__":
    unittest.main()
