"""The transcription of surface error against the worked cases of ../shared, and itself.

Every file of ../shared/cases/surface is run, others of the same kinds just the same.
"""
import sys
import unittest
from dataclasses import replace

import numpy as np

import surface_calibrate as cal
import surface_chip as sc
import surface_error as se
import surface_flexible as sf
import surface_structure as st
import surface_worked as worked

KINDS = {"cutter_compliance", "plate_uniform", "plate_line", "chip", "force",
         "surface_error_qs", "imprint", "envelope", "flexible", "calibrate_qs",
         "calibrate_kin", "calibrate_envelope"}


class Worked(unittest.TestCase):
    def near(self, c, got, want, what="", abs_tol=None, rel=None):
        tol = c["tol"]
        np.testing.assert_allclose(
            np.asarray(got), np.asarray(want), err_msg=f"{c['id']} {what}",
            rtol=tol.get("rel", 0.0) if rel is None else rel,
            atol=tol.get("abs", 0.0) if abs_tol is None else abs_tol)

    def each(self, kind):
        for c in worked.read(kind):
            yield c, c["inputs"], c["expected"]

    def test_every_kind_is_known(self):
        self.assertLessEqual({c["kind"] for c in worked.read()}, KINDS)

    def test_cutter(self):  # [B-1] [B-2]
        for c, g, want in self.each("cutter_compliance"):
            cutter = worked.cutter(g["tool"])
            pairs = list(zip(g["z_obs"], g["z_load"]))
            self.near(c, [st.cutter_influence(cutter, *p) for p in pairs], want["G"])
            for (h, F_z), G in zip(pairs, want["G"]):
                if max(h, F_z) <= cutter.flute_length:
                    self.near(c, st.cutter_by_parts(cutter, h, F_z), G, "by parts")

    def test_plates(self):  # [B-3] [B-4] [B-7]
        for c, g, want in self.each("plate_uniform"):
            a, b, nu = g["length"], g["height"], g["nu"]
            plate = st.Plate(st.Wall(a, b, 1.0, 12 * (1 - nu**2), nu))
            w = plate.uniform([a / 2, a / 2], [b, b / 2]) / a**4
            self.near(c, w, [want["w_free_edge_mid"], want["w_centre"]])
        for c, g, want in self.each("plate_line"):
            wall = worked.wall(g["wall"])
            w = st.plate(wall).line(g["x"], g["y_obs"], wall.height - g["ap"], wall.height)
            self.near(c, w, want["w"])

    def test_chip(self):
        for c, g, want in self.each("chip"):
            m = worked.milling(g)
            h = [sc.chip(m, i, np.radians(t), z) for i in range(m.N) for z in g["z"]
                 for t in g["theta_deg"]]
            self.near(c, h, want["h"])

    def grid(self, m, g, count):
        return se.rotation(m, np.radians(g["phi0_deg"]), g["samples_per_tooth"], count)

    def test_force(self):  # [E-2]
        for c, g, want in self.each("force"):
            m = worked.milling(g)
            phi = self.grid(m, g, g["n_samples"])
            a, b, x_T, x_R = sc.loads(m, phi)
            self.near(c, g["KT"] * a.sum(axis=1) + g["KR"] * b.sum(axis=1),
                      want["F_normal"], "F_normal")
            self.near(c, g["KT"] * x_T + g["KR"] * x_R, want["F_x"], "F_x")
            if m.rho == 0 and m.helix > 0:
                closed = [sc.closed_form(m, p, g["KT"], g["KR"]) for p in phi]
                self.near(c, closed, want["F_normal"], "closed form")

    def test_quasi_static(self):  # [E-6] [E-7] [E-11]
        for c, g, want in self.each("surface_error_qs"):
            m, s, h = worked.milling(g), worked.structure(g), [g["height"]]
            K, load = (g["KT"], g["KR"]), worked.load(g)
            phi = self.grid(m, g, len(want["e"]))
            e = se.quasi_static(m, s, phi, h, K, load)
            d = se.compliance(m, s, phi, h, load).deflection(*K)
            self.near(c, d[:, 0], want["delta"], "delta")
            self.near(c, e[:, 0], want["e"], "e")
            np.testing.assert_array_equal(se.owner(m, phi) + 1, want["owner_tooth"], c["id"])
            if "nominal" in want:
                self.near(c, se.nominal(m, e, g["samples_per_tooth"])[:, 0], want["nominal"])
            if "c_paper" in want:
                self.near(c, s.concentrated(h), [want["c_paper"]], "c")

    def test_imprint(self):  # [E-5] [E-8]
        for c, g, want in self.each("imprint"):
            m, s, K = worked.milling(g), worked.structure(g), (g["KT"], g["KR"])
            plain = se.imprint_operator(replace(m, rho=0.0), s, g["heights"], worked.load(g))
            self.near(c, plain.mean(axis=2).T, want["M"], "M", c["tol"]["M_abs"])
            e = se.imprint(m, s, g["heights"], K, worked.load(g))
            self.near(c, e, want["e_per_tooth"], "e")

    def test_envelope(self):  # [E-9]
        for c, g, want in self.each("envelope"):
            m, s, K = worked.milling(g), worked.structure(g), (g["KT"], g["KR"])
            e, who = se.envelope(m, s, [g["height"]], K, worked.load(g))
            got = [e.mean(), e.min(), e.max()]
            self.near(c, got, [want[k] for k in ("mean", "min", "max")])
            share = [np.mean(who == i) for i in range(m.N)]
            self.near(c, share, want["share"], "share", c["tol"]["share_abs"], 0.0)

    def test_flexible(self):  # [E-10]
        for c, g, want in self.each("flexible"):
            m, s, K = worked.milling(g, disks=60), worked.structure(g), (g["KT"], g["KR"])
            feedback = g["chip"] if g["chip"] in sf.FEEDBACKS else "entry"
            phi = self.grid(m, g, len(want["delta"]))
            _, load, F_x = sf.periodic(m, s, phi, K, feedback)
            self.near(c, load.sum(axis=1), want["F_normal"], "F_normal", c["tol"]["F_abs"])
            self.near(c, F_x, want["F_x"], "F_x", c["tol"]["F_abs"])
            delta = load @ s.influence([g["height"]], m.nodes).T
            self.near(c, delta[:, 0], want["delta"], "delta")

    def coefficients(self, c, K, want, prefix=""):
        for key, value in zip(("KT", "KR"), K):
            self.near(c, value, want[prefix + key], prefix + key, 0.0, c["tol"][f"{key}_rel"])

    def runout(self, c, got, want):
        tol = c["tol"]
        self.near(c, got["rho"], want["rho"], "rho", tol["rho_abs"], tol["rho_rel"])
        turn = np.degrees(got["lam"]) - want["lambda_deg"]
        self.near(c, (turn + 180) % 360 - 180, 0.0, "lambda", tol["lambda_abs_deg"])

    def test_calibration_of_quasi_static(self):  # [E-15] [E-17]
        for c, g, want in self.each("calibrate_qs"):
            m, e = worked.milling(g), worked.table(c)["deviation_mm"][:, None]
            got = cal.quasi_static(m, worked.structure(g), np.radians(g["phi0_deg"]),
                                   g["samples_per_tooth"], [g["height"]], e, worked.load(g))
            one, joint = got["nominal"], got["joint"]
            self.coefficients(c, one["K"], want)
            self.assertEqual(len(one["residual"]), want["n_used"], c["id"])
            self.near(c, one["se"], [want["se_KT"], want["se_KR"]], "se", 0.0, 0.01)
            nominal = se.nominal(m, e, g["samples_per_tooth"])[:, 0]
            self.near(c, nominal, want["nominal"], "nominal", c["tol"]["nominal_abs"])
            self.runout(c, got["runout"], want)
            self.coefficients(c, joint["p"], want["joint"])
            self.near(c, joint["rms"], want["joint"]["rms"], "rms", 0.0, 0.01)
            self.near(c, [*joint["se"][:2], joint["se_rho"], np.degrees(joint["se_lam"])],
                      [want["joint"][f"se_{k}"] for k in ("KT", "KR", "rho", "lam")],
                      "se of the joint fit", 0.0, 0.01)

    def test_calibration_of_imprints(self):  # [E-15] [E-17]
        for c, g, want in self.each("calibrate_kin"):
            t, m, load = worked.table(c), worked.milling(g, disks=120), worked.load(g)
            x, h, e = t["x_mm"], t["height_mm"], t["deviation_mm"]

            def at(place, g=g):
                return worked.structure(g, place)

            one = cal.imprint(m, at, x, h, e, load, g["fit_offset"])
            self.coefficients(c, one["K"], want)
            self.near(c, one["se"][:2], [want["se_KT"], want["se_KR"]], "se", 0.0, 0.01)
            if g["use_tooth"]:
                got = cal.imprint_runout(m, at, x, h, e, t["tooth"].astype(int) - 1,
                                         one["K"][:2], load)
                self.runout(c, got, want)

    def test_calibration_of_envelopes(self):  # [E-16]
        for c, g, want in self.each("calibrate_envelope"):
            t, m, load = worked.table(c), worked.milling(g, disks=120), worked.load(g)
            given = (t["x_mm"], t["height_mm"], t["deviation_mm"])

            def at(place, g=g):
                return worked.structure(g, place)

            one = cal.imprint(m, at, *given, load)
            self.coefficients(c, one["K"], want, "imprint_")
            rigorous = cal.envelope(m, at, *given, one["K"], load)
            self.coefficients(c, rigorous["p"], want, "envelope_")


if __name__ == "__main__":
    if not worked.read():
        print(f"SKIPPED: there are no worked cases at {worked.folder()}")
        sys.exit(77)
    unittest.main()
