"""The program's surface against the transcription, on made-up cases.

What no state of rest exists for (a cutter that pulls itself in) the program must refuse.
OPEN names where the program is known to be wrong; those are skipped, visibly, until it is not.
"""
import os
import sys
import tempfile
import unittest

import numpy as np

import program
import surface_chip as sc
import surface_error as se
import surface_flexible as sf
import surface_made as made
from compare_calibrate import tables as paper
from surface_error import Compliance

OPEN = {}


def milling(t):
    """With disks so thin that the edge lags little over one of them"""
    plain = made.milling(t)
    least, lag = (120, 0.006) if t["surface"]["feedback"] == "none" else (40, 0.015)
    return made.milling(t, int(np.ceil(max(plain.psi(plain.ap) / lag, least))))


def with_surface(t, model, samples_per_rev, **more):
    return {**t, "surface": {"model": model, **t["surface"], **more},
            "sampling": {"samples_per_rev": samples_per_rev, "revolutions": 1}}


def state(t, phi, heights):
    """Deflection [phi, height], F_n and F_x [phi]; None where there is no state of rest"""
    m, s, K = milling(t), made.structure(t), made.coefficients(t)
    if t["surface"]["feedback"] == "none":
        d = se.compliance(m, s, phi, heights, t["surface"]["load"]).deflection(*K)
        a, b, x_T, x_R = sc.loads(m, phi)
        return d, (K[0] * a + K[1] * b).sum(axis=1), K[0] * x_T + K[1] * x_R
    try:
        _, load, F_x = sf.periodic(m, s, phi, K, t["surface"]["feedback"])
    except ArithmeticError:
        return None
    return load @ s.influence(heights, m.nodes).T, load.sum(axis=1), F_x


def size(t, phi, heights):
    """What the two coefficients would give if they did not work against each other, mm"""
    c = se.compliance(milling(t), made.structure(t), phi, heights, t["surface"]["load"])
    return Compliance(np.abs(c.of_T), np.abs(c.of_R)).deflection(*made.coefficients(t)).max()


class Surface(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="trochoid_")
        self.addCleanup(self.folder.cleanup)

    def unless_open(self, name):
        if name in OPEN:
            self.skipTest(f"{name}: {OPEN[name]}")

    def run_program(self, name, tables, answered=True):
        text = program.case_text(name, tables)
        answer = program.run("surface", text, self.folder.name, name)
        self.assertEqual(answer.code, 0 if answered else 1,
                         f"{name}: exit {answer.code} {answer.stderr}\n{text}")
        return answer

    def near(self, got, want, t, what, scale):
        """Within a part of the size: disks, and Ritz terms where there is a wall"""
        part = (5e-4 if "wall" in t else 5e-5) + (5e-4 if t["surface"]["feedback"] != "none"
                                                  else 0.0)
        np.testing.assert_allclose(got, want, rtol=0, atol=part * scale + 1e-9, err_msg=what)

    def test_quasi_static(self):  # [E-1] [E-2] [E-4] [E-7] [E-12]
        for name, t in program.some(made.cases(), 3):
            with self.subTest(case=name):
                self.unless_open(name)
                self.quasi_static(name, t)

    def quasi_static(self, name, t):
        m, heights = made.milling(t), t["surface"]["heights_mm"]
        phi = se.rotation(m, np.radians(t["surface"]["phase_deg"]), 7, 7 * m.N)
        known = state(t, phi, heights)
        if known is not None and t["surface"]["feedback"] == "direct":
            # The chip of one tooth may pull it in at angles between those compared.
            fine = se.rotation(m, np.radians(t["surface"]["phase_deg"]), 60, 60 * m.N)
            known = known if state(t, fine, heights) is not None else None
        answer = self.run_program(name, with_surface(t, "quasi_static", 7 * m.N),
                                  known is not None)
        if known is None:
            return
        d, F_n, F_x = known
        scale = size(t, phi, heights)
        col = answer.columns("surface.csv")
        self.assertEqual(len(col["x_mm"]), d.size, name)
        order = np.lexsort((col["height_mm"], np.round(col["x_mm"], 9)))
        x, e, tooth = (np.array(col[k])[order].reshape(d.shape)
                       for k in ("x_mm", "error_mm", "tooth"))
        owner = se.owner(m, phi)
        np.testing.assert_array_equal(tooth, owner[:, None] + 1 + 0 * tooth, name)
        np.testing.assert_allclose(x[:, 0], np.arange(len(phi)) * m.fz / 7, atol=1e-9)
        want = d + se.runout_error(m, owner[:, None], np.array(heights))
        self.near(e, want, t, f"{name} error_mm", scale)
        bent = answer.columns("deflection.csv")
        order = np.lexsort((bent["height_mm"], np.round(bent["angle_deg"], 9)))
        self.near(np.array(bent["deflection_mm"])[order].reshape(d.shape), d, t,
                  f"{name} deflection_mm", scale)
        self.forces(name, phi, answer.columns("forces.csv"), F_n, F_x)
        sign = m.sigma * np.array(answer.columns("forces.csv")["Fy_N"])
        np.testing.assert_allclose(sign, answer.columns("forces.csv")["F_normal_N"], atol=1e-9)

    def forces(self, name, phi, col, F_n, F_x):
        np.testing.assert_allclose(col["angle_deg"], np.degrees(phi), atol=1e-8)
        scale = 1e-3 * max(np.abs(F_n).max(), np.abs(F_x).max())
        np.testing.assert_allclose(col["F_normal_N"], F_n, atol=scale,
                                   err_msg=f"{name} F_normal_N")
        np.testing.assert_allclose(col["Fx_N"], F_x, atol=scale, err_msg=f"{name} Fx_N")

    def test_imprint(self):  # [E-5] [E-6] [E-8]
        for name, t in program.some(made.cases(), 3, 1):
            if t["surface"]["feedback"] != "direct":
                with self.subTest(case=name):
                    self.unless_open(name)
                    self.imprint(name, t)

    def imprint(self, name, t):
        m, heights = made.milling(t), t["surface"]["heights_mm"]
        tooth = np.arange(m.N)
        d = [state(t, se.touching(m, tooth, h), [h]) for h in heights]
        known = all(v is not None for v in d)
        scale = max(size(t, se.touching(m, tooth, h), [h]) for h in heights)
        answer = self.run_program(name, with_surface(t, "imprint", 7 * m.N), known)
        if not known:
            return
        d = np.array([v[0][:, 0] for v in d])
        want = d + se.runout_error(m, tooth, np.array(heights)[:, None])
        col = answer.columns("surface.csv")
        self.assertEqual(len(col["tooth"]), want.size, name)
        order = np.lexsort((col["tooth"], col["height_mm"]))
        got = np.array(col["error_mm"])[order].reshape(want.shape)
        self.near(got, want, t, f"{name} error_mm", scale)
        plain = se.imprint_operator(made.milling({**t, "runout": {}}), made.structure(t),
                                    heights, t["surface"]["load"]).mean(axis=2)
        if t["surface"]["feedback"] == "none":
            for i, key in enumerate(("K_tc_mm_per_MPa", "K_rc_mm_per_MPa")):
                got = [h["operator"][key] for h in answer.result["heights"]]
                self.near(got, plain[i], t, f"{name} {key}", np.abs(plain[i]).max())

    def test_envelope(self):  # [E-9]
        for name, t in made.cases():
            small = name not in ("surface10", "surface13")  # 0.7 and 2.7 mm: no such wall
            if small and t["surface"]["feedback"] == "none":
                with self.subTest(case=name):
                    self.envelope(name, t)

    def test_envelope_with_feedback(self):  # [E-9] [E-10]
        for name, t in made.cases():
            if name in ("surface01", "surface02", "surface14"):
                with self.subTest(case=name):
                    self.envelope(name, t)

    def envelope(self, name, t, points=180):
        m, heights = made.milling(t), t["surface"]["heights_mm"]
        start = m.N * m.fz * np.radians(t["surface"]["phase_deg"]) / (2 * np.pi)
        steps = 240 if t["surface"]["feedback"] == "none" else 160
        turn = se.whole_turn(steps * m.N * (1 if m.N > 2 else 4))
        d, _, _ = state(t, turn, heights)
        answer = self.run_program(name, with_surface(t, "envelope", points))
        col = answer.columns("surface.csv")
        for i, h in enumerate(heights):
            rows = np.abs(np.array(col["height_mm"]) - h) < 1e-9
            x, e, tooth = (np.array(col[k])[rows] for k in ("x_mm", "error_mm", "tooth"))
            self.assertEqual(len(x), points, name)
            paths = se.Envelope(m, h, se.table(turn, d[:, i]))
            x = x + start
            want, _ = paths.at(x)
            scale = np.abs(d).max() + m.rho + m.fz**2 / m.R
            np.testing.assert_allclose(e, want, rtol=0, atol=2e-3 * scale,
                                       err_msg=f"{name} error_mm at {h}")
            fine, who = paths.at(se.feed_grid(m, 1500))
            at = answer.result["heights"][i]
            self.assertAlmostEqual(at["mean_error_mm"], fine.mean(), delta=1e-3 * scale)
            share = np.bincount(who, minlength=m.N) / len(who)
            np.testing.assert_allclose(at["share"], share, atol=0.02, err_msg=name)
            near = np.abs(np.array([q.at(x)[0] for q in self.others(m, h, turn, d[:, i])])
                          - want) < 1e-5  # two teeth at one depth: either may be named
            clear = near.sum(axis=0) == 1
            np.testing.assert_array_equal(tooth[clear] - 1, near.argmax(axis=0)[clear], name)

    def others(self, m, h, turn, d):
        """What each tooth alone would leave"""
        out = []
        for tooth in range(m.N):
            alone = se.Envelope(m, h, se.table(turn, d))
            alone.paths = [(f, e if k == tooth else np.full(e.shape, np.inf))
                           for k, (f, e) in enumerate(alone.paths)]
            out.append(alone)
        return out

    def test_probe(self):  # [E-13] [E-14]
        t = paper("envelope", False, force=made.force(800.0, 300.0),
                  surface={"load": "distributed", "feedback": "none"})
        m, K, points, step = milling(t), made.coefficients(t), 600, 1e-3
        z = [1.0 - step, 1.0, 1.0 + step]
        e, _ = se.envelope(m, made.structure(t), z, K, points=points)
        want = se.touched(se.feed_grid(m, points), e[:, 1], 0.5, m.N * m.fz)
        lean = se.leaning((e[:, 2] - e[:, 0]).mean() / (2 * step), 0.5)
        col = self.run_program("probe", with_surface(
            t, "envelope", points, heights_mm=z, probe_diameter_mm=1.0)).columns("surface.csv")
        got = np.array(col["error_mm"])[np.abs(np.array(col["height_mm"]) - 1.0) < 1e-9]
        self.assertGreater(min(lean, np.mean(want - e[:, 1])), 2e-5)  # else it shows nothing
        np.testing.assert_allclose(got, want + lean, atol=5e-6)

    def test_influence(self):  # [B-1] [B-7]
        for name, t in list(made.cases())[:8]:
            with self.subTest(case=name):
                ap = t["cut"]["axial_depth_mm"]
                z = [0.0, 0.3 * ap, 0.7 * ap, ap]
                far = {"influence_heights_mm": z}
                col = self.run_program(name, with_surface(
                    {**t, "surface": {**t["surface"], "feedback": "none"}}, "imprint", 12,
                    **far)).columns("influence.csv")
                s = made.structure(t)
                at = (np.array(col["height_mm"]), np.array(col["load_height_mm"]))
                self.assertEqual(len(at[0]), len(z) ** 2)
                wall = s.wall_influence(z, z)
                cutter = s.influence(z, z) - wall
                i, j = (np.abs(a[:, None] - z).argmin(axis=1) for a in at)
                np.testing.assert_allclose(col["cutter_mm_per_N"], cutter[i, j], rtol=1e-8)
                if "wall" in t:
                    np.testing.assert_allclose(col["wall_mm_per_N"], wall[i, j], rtol=3e-3)

    def test_free_edge(self):  # the cut ends where the wall ends, whatever the sum rounds to
        _, t = list(made.cases())[1]
        for height, depth in ((30.0, 3.0), (40.0, 4.0), (37.0, 4.0), (41.0, 1.1)):
            with self.subTest(height=height, depth=depth):
                self.unless_open("free edge")
                heights = {"heights_mm": [0.0, depth], "feedback": "none"}
                self.run_program("edge", with_surface(
                    {**t, "wall": {**t["wall"], "height_mm": height},
                     "cut": {**t["cut"], "axial_depth_mm": depth},
                     "surface": {**t["surface"], **heights}}, "imprint", 12))


if __name__ == "__main__":
    if not os.path.exists(program.PROGRAM):
        sys.exit(f"no program at {program.PROGRAM}; set TROCHOID")
    unittest.main()
