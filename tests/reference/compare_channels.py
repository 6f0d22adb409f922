"""What the channels of sensors read, and what is found from them, against the transcription.

[F-32] by unit vectors that turn with the tool; [I-26] to [I-28] by dense linear algebra.
"""
import os
import sys
import tempfile
import unittest

import numpy as np

import force
import program
import tables as tb

AXES = ["u", "-v", "torque", "Mx", "Mu", "Mv", "power", "z"]
UNIT = {"u": "N", "v": "N", "z": "N", "x": "N", "y": "N", "power": "W"}
K = {"law": "linear_edge", "K_tc_MPa": 1800.0, "K_rc_MPa": 800.0, "K_ac_MPa": 400.0,
     "K_te_N_per_mm": 12.0, "K_re_N_per_mm": 9.0, "K_ae_N_per_mm": 3.0}
KEYS = [key for key in K if key != "law"]
RPM = 4000.0


def case_tables(**runout):
    return {"tool": {"shape": "bull_nose", "corner_radius_mm": 1.5, "teeth": 3, "diameter_mm": 12.0,
                     "helix_deg": 25.0, "gauge_length_mm": 70.0},
            "runout": runout,
            "cut": {"engagement": "up", "radial_depth_mm": 5.0, "axial_depth_mm": 4.0,
                    "feed_per_tooth_mm": 0.07, "spindle_rpm": RPM}}


def rows(case, axes, angle, sensor):
    """Each channel for a coefficient of 1 in MPa or N/mm: N, N m, W; shape (n, channels, 6)"""
    six = force.matrix(case, angle)  # F, then M about the gauge length, N mm
    turned = angle - sensor
    u = np.stack([np.sin(turned), np.cos(turned), np.zeros_like(angle)], -1)
    v = np.cross(np.array([0.0, 0.0, 1.0]), u)  # z x u [F-32]
    F, M = six[:, :3], six[:, 3:] / 1000
    along = {"x": F[:, 0], "y": F[:, 1], "z": F[:, 2], "Mx": M[:, 0], "My": M[:, 1],
             "torque": M[:, 2], "power": M[:, 2] * RPM * np.pi / 30,
             "u": np.einsum("ni,nic->nc", u, F), "v": np.einsum("ni,nic->nc", v, F),
             "Mu": np.einsum("ni,nic->nc", u, M), "Mv": np.einsum("ni,nic->nc", v, M)}
    sign = {True: -1.0, False: 1.0}
    return np.stack([sign[a.startswith("-")] * along[a.lstrip("-")] for a in axes], 1)


class Channels(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="trochoid_")
        self.addCleanup(self.folder.cleanup)

    def run_case(self, command, name, tables, measurements=()):
        text = program.case_text(name, tables, measurements)
        answer = program.run(command, text, self.folder.name, name)
        self.assertEqual(answer.code, 0, f"{answer.stderr}\n{text}")
        return answer

    def test_what_channels_read(self):  # [F-32] [F-6] [F-7]
        tables = case_tables(radial_offsets_mm=[0.0, 0.008, -0.005], eccentricity_mm=0.004,
                             angle_deg=70.0)
        angles = np.linspace(3.1, 350.7, 23)
        tables |= {"force": K, "dynamometer": {"axes": AXES, "sensor_deg": 33.0},
                   "sampling": {"angles_deg": list(angles)}}
        col = self.run_case("simulate", "read", tables).columns("forces.csv")
        want = rows(tb.to_case(tables), AXES, np.radians(angles), np.radians(33.0))
        want = want @ np.array([K[key] for key in KEYS])
        for c, axis in enumerate(AXES):
            got = np.array(col[f"channel{c + 1}_{UNIT.get(axis.lstrip('-'), 'Nm')}"])
            size = np.abs(want[:, c]).max()
            self.assertLess(np.abs(got - want[:, c]).max(), 2e-6 * size, axis)

    def test_posterior(self):  # [I-27] [I-28]
        """Runout and phase known: linear, with a prior, in closed form"""
        tables = case_tables(radial_offsets_mm=[0.0, 0.008, -0.005])
        axes, sensor = ["Mu", "torque", "v"], 33.0
        angle = np.arange(2.0, 360.0, 4.0)
        D = rows(tb.to_case(tables | {"force": K}), axes, np.radians(angle), np.radians(sensor))
        truth = np.array([K[key] for key in KEYS])
        sd = 0.02 * np.abs(D @ truth).max(axis=0)
        random = np.random.default_rng(4)
        y = D @ truth + sd * random.standard_normal((len(angle), 3))
        np.savetxt(os.path.join(self.folder.name, "r.csv"), np.column_stack([angle, y]),
                   fmt="%.12g", delimiter=",", comments="",
                   header="angle_deg,Mu_Nm,torque_Nm,Fv_N")
        prior = {"K_ac_MPa": (500.0, 60.0), "K_ae_N_per_mm": (2.0, 1.5)}
        tables |= {"dynamometer": {"axes": axes, "sensor_deg": sensor, "channel_sd": list(sd)},
                   "prior": {k: {"mean": m, "sd": s} for k, (m, s) in prior.items()},
                   "identify": {"chip_models": ["trochoidal"], "runout": "fixed",
                                "phase_deg": 0.0, "channel_offsets": "none"}}
        fit = self.run_case("identify", "posterior", tables, [{"file": "r.csv"}]).result["fits"][0]
        A, b = (D / sd[:, None]).reshape(-1, 6), (y / sd).ravel()
        P, right = A.T @ A, A.T @ b
        for key, (mean, s) in prior.items():
            P[KEYS.index(key), KEYS.index(key)] += s**-2
            right[KEYS.index(key)] += mean * s**-2
        want, covariance = np.linalg.solve(P, right), np.linalg.inv(P)
        for i, key in enumerate(KEYS):
            got = fit["coefficients"][key]
            self.assertAlmostEqual(got["value"], want[i], delta=1e-4 * covariance[i, i]**0.5, msg=key)
            self.assertAlmostEqual(got["se"], covariance[i, i]**0.5,
                                   delta=1e-5 * covariance[i, i]**0.5, msg=key)
        alone = np.linalg.lstsq(A, b, rcond=None)[0]
        rss = np.sum((b - A @ alone)**2)
        self.assertAlmostEqual(fit["weighted_rss"], rss, delta=1e-6 * rss)
        singular = np.linalg.svd(A / np.linalg.norm(A, axis=0), compute_uv=False)
        self.assertAlmostEqual(fit["condition"], singular[0] / singular[-1],
                               delta=1e-5 * fit["condition"])

    def test_auto_adds_axial_offsets(self):  # [I-29]
        """A bull nose tells them next to the radial ones; it answers without where it does not"""
        tables = case_tables(radial_offsets_mm=[0.0, 0.008, -0.005],
                             axial_offsets_mm=[0.0, -0.009, 0.006])
        tables["cut"] = tables["cut"] | {"engagement": "slot"}
        del tables["cut"]["radial_depth_mm"]
        angle = np.arange(0.5, 1440.0, 3.0)
        made = self.run_case("simulate", "axial", tables | {
            "force": K, "sampling": {"angles_deg": list(angle)}}).columns("forces.csv")
        F = np.array([made[f"F{axis}_N"] for axis in "xyz"]).T
        F = F + 4.0 * np.random.default_rng(5).standard_normal(F.shape)
        np.savetxt(os.path.join(self.folder.name, "axial.csv"), np.column_stack([angle, F]),
                   fmt="%.9g", delimiter=",", comments="", header="angle_deg,Fx_N,Fy_N,Fz_N")
        tables.pop("runout")
        tables |= {"dynamometer": {"axes": ["x", "y", "z"]},
                   "identify": {"chip_models": ["trochoidal"], "channel_offsets": "none"}}
        answer = self.run_case("identify", "axial", tables, [{"file": "axial.csv"}])
        self.assertIn("runout_further", [w["code"] for w in answer.summary["warnings"]])
        runout = answer.result["fits"][0]["runout"]
        for j, want in ((1, -0.009), (2, 0.006)):
            se = runout["axial_offsets_se_mm"][j]
            self.assertLess(se, 0.001)
            self.assertAlmostEqual(runout["axial_offsets_mm"][j], want, delta=4 * se)
        for key in KEYS:
            got = answer.result["fits"][0]["coefficients"][key]
            self.assertLess(abs(got["value"] - K[key]), 4 * got["se"], key)

    def test_known_sums(self):  # [I-26]
        """Of power at one feed K_tc + c K_te is known, c by the means of the edges in cut"""
        tables = case_tables()
        angle = (np.arange(1800) + 0.5) * 2 * np.pi / 1800
        D = rows(tb.to_case(tables | {"force": K}), ["power"], angle, 0.0).mean(axis=0)[0]
        truth = D @ np.array([K[key] for key in KEYS])
        tables |= {"dynamometer": {"axes": ["power"]},
                   "identify": {"chip_models": ["trochoidal"], "runout": "none"}}
        text = program.case_text("sum", tables, [{"mean": [truth], "mean_sd": [0.01 * truth]}])
        answer = program.run("identify", text, self.folder.name, "sum")
        self.assertEqual(answer.code, 1)
        fit = answer.result["fits"][0]
        self.assertTrue(all(v is None for v in fit["coefficients"].values()))
        (known,) = fit["combination"]
        self.assertEqual(list(known["weights"]), ["K_tc_MPa", "K_te_N_per_mm"])
        self.assertAlmostEqual(known["weights"]["K_te_N_per_mm"], D[3] / D[0],
                               delta=1e-4 * D[3] / D[0])
        self.assertAlmostEqual(known["value"], truth / D[0], delta=1e-4 * truth / D[0])
        self.assertAlmostEqual(known["se"], 0.01 * truth / D[0], delta=1e-5 * truth / D[0])
        self.assertIn("K_tc + ", answer.summary["message"])


if __name__ == "__main__":
    if not os.path.exists(program.PROGRAM):
        sys.exit(f"no program at {program.PROGRAM}; set TROCHOID")
    unittest.main()
