"""The piecewise trigonometric polynomial of a turn against the quadrature along the edge
and against the root of the mark, all in Python; compare_forces.py holds the program
against the same quadrature."""
import unittest
from dataclasses import replace

import numpy as np

import chip
import force
import turn
from case import Case, Tool

PAPER = Case(tool=Tool(D=8.0, pitch=[np.pi, np.pi], helix=np.radians(30)), f_z=0.04,
             a_p=2.0, offsets=[0.0, -0.008])
UNEQUAL = Case(tool=Tool(D=6.0, pitch=[1.9, 2.3, 2 * np.pi - 4.2], helix=np.radians(40)),
               f_z=0.03, a_p=9.0, offsets=[0.0, 0.05, -0.01])  # more than a turn of lag
K = [2620.0, 1560.0, 331.0, 7.0, 3.0, 1.0]


class Turn(unittest.TestCase):
    def test_series_is_the_root(self):  # [C-9] [C-10]
        theta = np.linspace(-np.pi, np.pi, 181)
        for case in (PAPER, UNEQUAL, replace(UNEQUAL, f_z=0.08)):
            R = case.tool.D / 2 + case.rad
            for j in range(case.tool.N):
                for m in range(1, case.tool.N + 1):
                    k = (j - m) % case.tool.N
                    ahead = sum(case.tool.pitch[(j - i) % case.tool.N]
                                for i in range(1, m + 1))
                    want = R[j] - chip.surface_left(R[k], ahead, case.f, theta)
                    got = turn.over_mark(case, j, m, theta, 24)
                    np.testing.assert_allclose(got, want, rtol=0, atol=2e-13)

    def test_steps_are_the_integral_along_the_edge(self):  # [F-10] [F-11] [F-12]
        phi = np.linspace(0, 2 * np.pi, 24, endpoint=False) + 0.0123
        for case in (PAPER, UNEQUAL):
            want = force.forces(case, K, phi)[:, :3]
            np.testing.assert_allclose(turn.forces(case, K, phi), want, rtol=0,
                                       atol=1e-9 * np.abs(want).max())

    def test_between_steps_it_is_one_polynomial(self):  # [F-12]
        phi = np.linspace(1.0, 1.2, 33)  # of the paper's cut: no step within
        k = np.arange(1, 7)
        terms = np.concatenate([np.ones((33, 1)), phi[:, None], np.cos(phi[:, None] * k),
                                np.sin(phi[:, None] * k)], axis=1)
        F = turn.forces(PAPER, K, phi)
        fit = terms @ np.linalg.lstsq(terms, F, rcond=1e-14)[0]
        np.testing.assert_allclose(fit, F, rtol=0, atol=1e-9 * np.abs(F).max())

    def test_short_lags_are_the_limit(self):  # [F-13]
        phi = np.linspace(0, 2 * np.pi, 24, endpoint=False) + 0.0123
        for helix in (0.0, 1e-7):
            case = replace(PAPER, tool=replace(PAPER.tool, helix=helix))
            want = force.forces(case, K, phi)[:, :3]
            np.testing.assert_allclose(turn.forces(case, K, phi), want, rtol=0,
                                       atol=1e-9 * np.abs(want).max())


if __name__ == "__main__":
    unittest.main()
