"""The program's identify against the transcription, on records made by the latter."""
import copy
import os
import sys
import tempfile
import unittest
from dataclasses import replace

import numpy as np

import force
import identification as ident
import program
import tables as tb

K = {"K_tc_MPa": 1900.0, "K_rc_MPa": 900.0, "K_ac_MPa": 350.0, "K_te_N_per_mm": 11.0,
     "K_re_N_per_mm": 8.0, "K_ae_N_per_mm": 2.0}
CYLINDER = {"shape": "cylinder", "teeth": 3, "diameter_mm": 10.0, "helix_deg": 30.0}
SLOT = {"engagement": "slot", "axial_depth_mm": 3.0, "feed_per_tooth_mm": 0.05,
        "spindle_rpm": 1200}
OFFSETS = {"radial_offsets_mm": [0.0, 0.009, -0.006]}


def tables(**changes):
    out = {"tool": CYLINDER, "cut": SLOT, "runout": OFFSETS,
           "force": {"law": "linear_edge", "edge_length": "true"}}
    out = copy.deepcopy(out)
    for name, table in changes.items():
        out[name] = {**out.get(name, {}), **table}
    return out


def truth(given, K_values=None):
    """The case of the transcription with the coefficients put in."""
    full = copy.deepcopy(given)
    full["force"] = {**full["force"], **(K_values or K)}
    case = tb.to_case(full)
    return case, tb.coefficients(full["force"])


def record(case, K_true, angle, phase=0.0, noise=0.0, seed=1):
    F = force.forces(case, K_true, angle + phase)[:, :3]
    return F + noise * np.random.default_rng(seed).standard_normal(F.shape)


def turns(per_turn, count=1):
    return np.radians((np.arange(per_turn * count) + 0.5) * 360 / per_turn)


class Identify(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="trochoid_")
        self.addCleanup(self.folder.cleanup)

    def write(self, name, angle, F, head="angle_deg,Fx_N,Fy_N,Fz_N", first=None):
        file = os.path.join(self.folder.name, name)
        first = np.degrees(angle) if first is None else first
        np.savetxt(file, np.column_stack([first, F]), delimiter=",", header=head,
                   comments="", fmt="%.17g")
        return {"file": name, "format": "csv"}

    def identify(self, name, given, identify, measurements):
        # The transcription has no offsets but where a test asks for them.
        identify = {"channel_offsets": "none", **identify}
        text = program.case_text(name, {**given, "identify": identify}, measurements)
        answer = program.run("identify", text, self.folder.name, name)
        self.assertEqual(answer.code, 0, f"{answer.stderr}\n{text}")
        return answer

    def same_coefficients(self, fit, K_want, se_want, rel=1e-5, se_rel=1e-3):
        for key, want, se in zip(fit["coefficients"], K_want, se_want):
            got = fit["coefficients"][key]
            self.assertAlmostEqual(got["value"], want, delta=rel * abs(want) + 0.01 * se,
                                   msg=key)
            self.assertAlmostEqual(got["se"], se, delta=se_rel * se, msg=f"se {key}")

    # [I-1] [I-2] [I-5] [I-6] [I-8]
    def test_two_runs_of_a_bull_nose_at_fixed_runout(self):
        given = tables(tool={"shape": "bull_nose", "corner_radius_mm": 1.5})
        case, K_true = truth(given)
        angle = turns(240)
        fast = replace(case, f_z=0.08)
        F1 = record(case, K_true, angle, noise=6, seed=1)
        F2 = record(fast, K_true, angle, noise=6, seed=2)
        runs = [self.write("a.csv", angle, F1), self.write("b.csv", angle, F2)]
        runs[1]["cut"] = {"feed_per_tooth_mm": 0.08}
        runs[1] = {**runs[1]}
        answer = self.identify("two", given, {"chip_models": ["trochoidal", "radial"],
                                              "runout": "fixed", "phase_deg": 0.0,
                                              "errors": "white"}, runs)
        for fit, model in zip(answer.result["fits"], ("trochoidal", "radial")):
            D = np.vstack([ident.stacked(replace(c, model=model), angle)
                           for c in (case, fast)])
            y = np.concatenate([F1.ravel(), F2.ravel()])
            want, rank, cond = ident.linear(D, y)
            res = y - D @ want
            se = ident.standard_errors(D, res)
            self.same_coefficients(fit, want, se)
            total, axis = ident.rms(res)
            self.assertAlmostEqual(fit["rms_N"], total, delta=1e-5 * total)
            np.testing.assert_allclose(fit["rms_axis_N"], axis, rtol=1e-5)
            self.assertAlmostEqual(fit["condition"], cond, delta=1e-3 * cond)
            self.assertEqual(rank, 6)
            for key, value, s in zip(fit["coefficients"], want, se):
                lo, hi = ident.interval(value, s, len(y) - 6)
                got = fit["coefficients"][key]
                self.assertAlmostEqual(got["low"], lo, delta=2e-3 * s, msg=key)
                self.assertAlmostEqual(got["high"], hi, delta=2e-3 * s, msg=key)

    def vibrating(self, name, turns_each, feeds):
        """Runs with a vibration locked to the spindle: the fit, and our own of it."""
        given = tables()
        case, K_true = truth(given)
        angle = turns(120, turns_each)
        cases = [replace(case, f_z=f_z) for f_z in feeds]
        vibration = 8 * np.sin(np.outer(11 * angle, [1, 1, 1]) + [0.3, 1.2, 2.2])
        F = [record(c, K_true, angle, noise=6, seed=i) + vibration * (1 + i)
             for i, c in enumerate(cases)]
        runs = [{**self.write(f"{name}{i}.csv", angle, f),
                 "cut": {"feed_per_tooth_mm": f_z}} for i, (f, f_z) in enumerate(zip(F, feeds))]
        fit = self.identify(name, given, {"chip_models": ["trochoidal"], "runout": "fixed",
                                          "phase_deg": 0.0, "band_harmonics": 0},
                            runs).result["fits"][0]
        D = np.vstack([ident.stacked(c, angle) for c in cases])
        y = np.concatenate([f.ravel() for f in F])
        want, _, _ = ident.linear(D, y)
        left = (y - D @ want).reshape(len(feeds), -1, 3)
        return fit, D, angle, left, want

    @program.long_form
    def test_what_repeats_counts_by_its_spectrum(self):  # [I-14] [I-15]
        for name, feeds in (("one", [0.04]), ("three", [0.04, 0.07, 0.1])):
            fit, D, angle, left, want = self.vibrating(name, 15, feeds)
            cov = ident.spectral_covariance(D, [(angle, 15)] * len(feeds), left, 3, 48)
            self.same_coefficients(fit, want, np.sqrt(np.diag(cov)), se_rel=2e-3)
            self.assertGreater(fit["interval_factor"], 1.96)

    def test_a_short_record_counts_its_neighbours(self):  # [I-13]
        fit, D, angle, left, want = self.vibrating("short", 3, [0.04])
        wider = ident.widening([angle], left, 6)
        self.assertGreater(wider, 2)
        se = wider * ident.standard_errors(D, left.ravel())
        self.same_coefficients(fit, want, se, se_rel=2e-3)
        self.assertAlmostEqual(fit["interval_widening"], wider, delta=1e-4 * wider)

    def ringing(self, name, H, dynamometer, noise):
        """What a dynamometer with the response H(omega), shape (n, 3, 3), reads of two feeds."""
        given = tables(cut={"engagement": "up", "radial_depth_mm": 2.5},
                       tool={"helix_deg": 10.0}, dynamometer=dynamometer)
        case, K_true = truth(given)
        angle = turns(200, 10)
        Omega = given["cut"]["spindle_rpm"] * 2 * np.pi / 60
        runs = []
        for i, f_z in enumerate((0.04, 0.08)):
            fine = np.radians(np.arange(4000) * 360 / 4000)  # far from any alias
            F = record(replace(case, f_z=f_z), K_true, fine)
            k = np.arange(90)
            lines = np.fft.rfft(F, axis=0)[:90] * np.where(k == 0, 1, 2)[:, None] / 4000
            lines = np.einsum("kij,kj->ki", H(k * Omega), lines)
            read = (np.exp(1j * np.outer(angle, k)) @ lines).real
            read += noise * np.random.default_rng(i).standard_normal(read.shape)
            runs.append({**self.write(f"{name}{i}.csv", angle, read),
                         "cut": {"feed_per_tooth_mm": f_z}})
        result = self.identify(name, given, {"chip_models": ["trochoidal"],
                                             "runout": "fixed", "phase_deg": 0.0},
                               runs).result
        fit = result["fits"][0]
        for (key, c), want in zip(fit["coefficients"].items(), K_true):
            self.assertTrue(c["low"] <= want <= c["high"], f"{key}: {c}, {want}")
        return result, fit, K_true, Omega

    @staticmethod
    def oscillators(omega, rings):
        H = np.zeros((len(omega), 3, 3), complex)
        for q, ring in enumerate(rings):
            x = omega / ring[0] if ring else 0 * omega
            H[:, q, q] = 1 / (1 - x**2 + 2j * (ring[1] if ring else 0) * x)
        return H

    def test_a_dynamometer_that_rings(self):  # [I-16] [I-17]
        """Frequencies and coefficients come back from what such a one reads."""
        turn = 2 * np.pi * 1200 / 60
        rings = [(19.4 * turn, 0.05), (24.7 * turn, 0.03), None]
        result, fit, _, _ = self.ringing("rings", lambda w: self.oscillators(w, rings),
                                         {"axes": ["x", "y", "z"]}, 4)
        for axis, ring in zip("xyz", rings):
            found = fit["resonances"][axis]
            if ring is None:
                self.assertIsNone(found)
                continue
            self.assertAlmostEqual(2 * np.pi * found["frequency_Hz"] / ring[0], 1, delta=0.01)
            self.assertAlmostEqual(found["damping_ratio"], ring[1], delta=0.01)
        self.assertTrue(result["views"][0]["resonance"])

    def test_a_response_that_was_measured(self):  # [I-16]
        """With cross responses, and channels that are turned against the tool."""
        turn = 2 * np.pi * 1200 / 60
        rings = [(9.3 * turn, 0.05), (12.7 * turn, 0.04), (30 * turn, 0.1)]

        def channels(omega):
            H = self.oscillators(omega, rings)
            H[:, 0, 1] = 0.2 * (H[:, 0, 0] - 1)
            return H

        omega = np.linspace(0, 60 * turn, 4000)
        H = channels(omega)
        parts = [(f"H{i + 1}{j + 1}_{n}", getattr(H[:, i, j], part))
                 for i in range(3) for j in range(3)
                 for n, part in (("re", "real"), ("im", "imag"))]
        np.savetxt(os.path.join(self.folder.name, "plate.csv"),
                   np.column_stack([omega / 2 / np.pi] + [v for _, v in parts]),
                   delimiter=",", header=",".join(["freq_Hz"] + [n for n, _ in parts]),
                   comments="", fmt="%.12g")
        Q = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]])  # channels y, -x, z
        _, fit, K_true, _ = self.ringing(
            "measured", lambda w: channels(w) @ Q,
            {"axes": ["y", "-x", "z"], "frf": "plate.csv"}, 1)
        for c, want in zip(fit["coefficients"].values(), K_true):
            self.assertAlmostEqual(c["value"] / want, 1, delta=0.02)
        self.assertLess(fit["unexplained"], 0.02)
        self.assertGreaterEqual(fit["band_harmonics"], 40)

    def joint(self, name, given, kind, names, start, phase, per_turn=60, noise=6.0):
        case, K_true = truth(given)
        angle = turns(per_turn)
        F = record(case, K_true, angle, phase, noise)
        want = ident.joint(case, angle, F, names, start)
        unknown = {k: v for k, v in given.items() if k != "runout"}
        answer = self.identify(
            name, unknown, {"chip_models": [case.model], "runout": kind, "errors": "white",
                            "phase_deg": "free" if "phase" in names else
                            float(np.degrees(phase))}, [self.write(f"{name}.csv", angle, F)])
        fit = answer.result["fits"][0]
        self.same_coefficients(fit, want["K"], want["se_K"], rel=2e-5, se_rel=0.02)
        self.assertAlmostEqual(fit["rms_N"], want["rms"], delta=1e-5 * want["rms"])
        return fit, dict(zip(names, want["p"])), dict(zip(names, want["se_p"]))

    def test_offsets_and_phase_of_three_teeth(self):  # [I-3] [I-4]
        phase = np.radians(20.0)
        fit, p, se = self.joint("offsets", tables(), "offsets",
                                ["shift:1", "shift:2", "phase"], [0.009, -0.006, 20.0],
                                phase)
        r = fit["runout"]
        for k in (1, 2):
            name = f"shift:{k}"
            self.assertAlmostEqual(r["radial_offsets_mm"][k], p[name], delta=0.02 * se[name])
            self.assertAlmostEqual(r["radial_offsets_se_mm"][k], se[name],
                                   delta=0.02 * se[name])
        self.assertAlmostEqual(fit["phase_deg"], p["phase"], delta=0.02 * se["phase"])
        self.assertAlmostEqual(fit["phase_se_deg"], se["phase"], delta=0.02 * se["phase"])

    def test_two_clampings_tell_tool_and_holder_apart(self):  # [I-22]
        given = tables()
        given["runout"] = {"eccentricity_mm": 0.012, "angle_deg": -35.0}
        case, K_true = truth(given)
        angle = turns(60)
        F = record(case, K_true, angle, noise=4)
        before = {"eccentricity_mm": 0.008, "angle_deg": 70.0, "turned_deg": 150.0,
                  "eccentricity_se_mm": 0.0002, "angle_se_deg": 3.0}
        unknown = {k: v for k, v in given.items() if k != "runout"}
        result = self.identify("clocking", unknown, {
            "chip_models": ["trochoidal"], "runout": "eccentricity", "phase_deg": 0.0,
            "previous_clamping": before}, [self.write("c.csv", angle, F)]).result
        e = [0.012 * np.cos(np.radians(-35)), 0.012 * np.sin(np.radians(-35))]
        fit = ident.joint(case, angle, F, ["ex", "ey"], e)
        e2, a = fit["p"], np.radians(before["angle_deg"])
        e1 = before["eccentricity_mm"] * np.array([np.cos(a), np.sin(a)])
        (h, t), inverse = ident.separate(e1, e2, np.radians(before["turned_deg"]))
        along, across = np.array([np.cos(a), np.sin(a)]), np.array([-np.sin(a), np.cos(a)])
        C1 = (0.0002**2 * np.outer(along, along) +
              (0.008 * np.radians(3.0))**2 * np.outer(across, across))
        C2 = np.outer(fit["se_p"], fit["se_p"]) * fit["correlation"][-2:, -2:]
        C = inverse @ np.block([[C1, np.zeros((2, 2))], [np.zeros((2, 2)), C2]]) @ inverse.T
        got = result["clocking"]
        for name, v, cov in (("holder", h, C[:2, :2]), ("tool", t, C[2:, 2:])):
            size = np.hypot(*v)
            amount = got[name]["eccentricity_mm"]
            self.assertAlmostEqual(amount["value"], size, delta=2e-6)
            self.assertAlmostEqual(np.radians(got[name]["angle_deg"]), np.arctan2(v[1], v[0]),
                                   delta=1e-3)
            se = np.sqrt(v @ cov @ v) / size
            self.assertAlmostEqual(amount["se"], se, delta=0.02 * se, msg=name)
        turn = np.arctan2(h[1], h[0]) + np.pi - np.arctan2(t[1], t[0]) - np.radians(150)
        off = np.radians(got["best_turn_deg"]) - turn
        self.assertAlmostEqual(np.cos(off), 1.0, delta=1e-5)
        tir = got["total_indicator_reading_um"]["value"]
        self.assertAlmostEqual(tir, 2000 * np.hypot(*e2), delta=4e-3)

    @program.long_form
    def test_two_groups_share_one_runout(self):  # [I-19] [I-4]
        given = tables()
        worn = {**K, "K_rc_MPa": 1100.0, "K_te_N_per_mm": 19.0, "K_re_N_per_mm": 23.0}
        angle = turns(60)
        runs, files = [], []
        for i, (group, f_z) in enumerate([("new", 0.05), ("worn", 0.04), ("new", 0.08),
                                          ("worn", 0.07)]):
            case, K_true = truth(given, worn if group == "worn" else K)
            case = replace(case, f_z=f_z)
            F = record(case, K_true, angle, noise=6, seed=20 + i)
            runs.append((case, angle, F, group))
            files.append({**self.write(f"g{i}.csv", angle, F), "group": group,
                          "cut": {"feed_per_tooth_mm": f_z}})
        names = ["shift:1", "shift:2"]
        x, se = ident.joint_of_groups(runs, names, [0.009, -0.006])
        unknown = {k: v for k, v in given.items() if k != "runout"}
        result = self.identify("groups", unknown, {
            "chip_models": ["trochoidal"], "runout": "offsets", "phase_deg": 0.0,
            "errors": "white"}, files).result
        self.assertEqual([g["group"] for g in result["groups"]], ["new", "worn"])
        self.assertEqual([os.path.basename(f) for f in result["groups"][1]["files"]],
                         ["g1.csv", "g3.csv"])
        for g, group in enumerate(result["groups"]):
            self.same_coefficients(group, x[6 * g:6 * g + 6], se[6 * g:6 * g + 6],
                                   rel=2e-5, se_rel=0.02)
        runout = result["fits"][0]["runout"]
        for k in (1, 2):
            self.assertAlmostEqual(runout["radial_offsets_mm"][k], x[11 + k],
                                   delta=0.02 * se[11 + k])
            self.assertAlmostEqual(runout["radial_offsets_se_mm"][k], se[11 + k],
                                   delta=0.02 * se[11 + k])

    def test_eccentricity_of_four_teeth(self):  # [I-3] [I-4] [G-9]
        given = tables(tool={"teeth": 4, "pitch_deg": [85.0, 95.0, 88.0, 92.0]},
                       cut={"engagement": "up", "radial_depth_mm": 6.0})
        given["runout"] = {"eccentricity_mm": 0.011, "angle_deg": 65.0}
        a = np.radians(65.0)
        fit, p, _ = self.joint("eccentricity", given, "eccentricity", ["ex", "ey"],
                               [0.011 * np.cos(a), 0.011 * np.sin(a)], 0.0)
        r = fit["runout"]
        angle = np.radians(r["angle_deg"])
        self.assertAlmostEqual(r["eccentricity_mm"] * np.cos(angle), p["ex"], delta=2e-6)
        self.assertAlmostEqual(r["eccentricity_mm"] * np.sin(angle), p["ey"], delta=2e-6)

    def test_constants_and_slopes_of_the_channels(self):  # [I-7]
        given = tables()
        case, K_true = truth(given)
        angle = turns(120, 3)
        t = np.arange(len(angle), dtype=float)
        x = (t - t.mean()) / (t[-1] - t[0])
        F = record(case, K_true, angle, noise=3) + np.array([4.0, -7.0, 2.0])
        F = F + x[:, None] * np.array([5.0, 0.0, -3.0])
        fit = self.identify("drift", given, {"chip_models": ["trochoidal"],
                                             "runout": "fixed", "phase_deg": 0.0,
                                             "channel_offsets": "fit", "errors": "white"},
                            [self.write("drift.csv", angle, F)]).result["fits"][0]
        want = ident.fixed(case, angle, F, extra=ident.channel_columns(t))
        self.same_coefficients(fit, want["K"][:6], want["se"][:6], rel=1e-5)
        for c in range(3):
            got = fit["channel_offsets"][0][c]
            self.assertAlmostEqual(got["constant_N"], want["K"][6 + c], delta=1e-3)
            self.assertAlmostEqual(got["slope_N"], want["K"][9 + c], delta=1e-3)

    def test_band_limit(self):  # [S-5]
        given = tables()
        case, K_true = truth(given)
        angle = turns(200, 2)
        F = record(case, K_true, angle, noise=3)
        F[:, 0] += 20 * np.cos(9 * angle)  # beyond the band: must not matter
        fit = self.identify("band", given, {"chip_models": ["trochoidal"],
                                            "runout": "fixed", "phase_deg": 0.0,
                                            "band_harmonics": 6},
                            [self.write("band.csv", angle, F)]).result["fits"][0]
        m = np.arange(1, 7)
        basis = np.column_stack([np.ones_like(angle), np.cos(np.outer(angle, m)),
                                 np.sin(np.outer(angle, m))])
        Q = np.linalg.qr(basis)[0]
        D = ident.stacked(case, angle).reshape(len(angle), 3, 6)
        D = np.einsum("nb,nck->bck", Q, D).reshape(-1, 6)
        want, _, _ = ident.linear(D, (Q.T @ F).ravel())
        for key, value in zip(fit["coefficients"], want):
            self.assertAlmostEqual(fit["coefficients"][key]["value"], value,
                                   delta=1e-5 * abs(value), msg=key)

    def test_power_law_with_edge_forces(self):  # [F-9]
        given = tables()
        given["force"] = {"law": "power_edge"}
        true = {"K_t1_MPa": 1500.0, "K_r1_MPa": 700.0, "K_a1_MPa": 300.0,
                "K_te_N_per_mm": 7.0, "K_re_N_per_mm": 9.0, "K_ae_N_per_mm": 2.0,
                "m_t": 0.15, "m_r": 0.25, "m_a": 0.2}
        case, K_true = truth(given, true)
        angle = turns(180)
        F = record(case, K_true, angle)
        fit = self.identify("power_edge", given, {"chip_models": ["trochoidal"],
                                                  "runout": "fixed", "phase_deg": 0.0},
                            [self.write("power_edge.csv", angle, F)]).result["fits"][0]
        for key, value in true.items():
            self.assertAlmostEqual(fit["coefficients"][key]["value"], value,
                                   delta=2e-3 * value, msg=key)

    def test_power_law_with_its_exponents(self):  # [F-2]
        given = tables()
        given["force"] = {"law": "power"}
        true = {"K_t1_MPa": 1500.0, "K_r1_MPa": 700.0, "K_a1_MPa": 300.0, "m_t": 0.25,
                "m_r": 0.35, "m_a": 0.2}
        case, K_true = truth(given, true)
        angle = turns(180)
        F = record(case, K_true, angle)
        fit = self.identify("power", given, {"chip_models": ["trochoidal"],
                                             "runout": "fixed", "phase_deg": 0.0},
                            [self.write("power.csv", angle, F)]).result["fits"][0]
        for key, value in true.items():
            self.assertAlmostEqual(fit["coefficients"][key]["value"], value,
                                   delta=1e-3 * value, msg=key)

    def test_speed_and_axes_from_a_record_over_time(self):  # [S-1] [S-3]
        given = tables()
        case, K_true = truth(given)
        rpm, rate = 1203.7, 6000.0
        t = np.arange(9000) / rate
        angle = t * rpm * 2 * np.pi / 60
        one = turns(3600)
        F1 = record(case, K_true, one)
        F = np.column_stack([np.interp(angle % (2 * np.pi), one, F1[:, q],
                                       period=2 * np.pi) for q in range(3)])
        F = F + 3 * np.random.default_rng(4).standard_normal(F.shape)
        Q = np.array([[0, -1, 0], [-1, 0, 0], [0, 0, -1]])  # channels = Q force
        run = self.write("time.csv", None, F @ Q.T, "time_s,Fx_N,Fy_N,Fz_N", t)
        given["dynamometer"] = {"axes": "auto"}
        result = self.identify("time", given, {"chip_models": ["trochoidal"]}, [run]).result
        found = result["signal"]["spindle_rpm"]
        found = found[0] if isinstance(found, list) else found
        self.assertAlmostEqual(found, rpm, delta=2e-4 * rpm)
        self.assertEqual(result["signal"]["axes"], ["-y", "-x", "-z"])
        value = result["fits"][0]["coefficients"]["K_tc_MPa"]["value"]
        self.assertAlmostEqual(value, K["K_tc_MPa"], delta=0.03 * K["K_tc_MPa"])

    def test_pulses_give_the_angle(self):  # [S-7]
        case, K_true = truth(tables())
        rate = 8000.0
        t = np.arange(8000) / rate
        turns_at = 0.37 + 20.3 * t - 0.9 * t**2  # the spindle sags by a tenth
        one = turns(3600)
        F1 = record(case, K_true, one)
        F = np.column_stack([np.interp(2 * np.pi * turns_at, one, F1[:, q],
                                       period=2 * np.pi) for q in range(3)])
        pulse = 5.0 * ((turns_at % 1) < 0.1)
        pulse[(turns_at > 6.9) & (turns_at < 7.2)] = 0.0  # one is missing
        run = self.write("pulse.csv", None, np.column_stack([F, pulse]),
                         "time_s,Fx_N,Fy_N,Fz_N,index_V", t)
        run["pulse_column"] = "index_V"
        answer = self.identify("pulse", tables(), {"chip_models": ["trochoidal"]}, [run])
        # A step from 0 to 5 passes 2.5 halfway between two samples.
        rise = t[1:][(pulse[1:] > 2.5) & (pulse[:-1] < 2.5)] - 0.5 / rate
        lost = int(np.argmax(np.diff(rise)))
        rise = np.insert(rise, lost + 1, 0.5 * (rise[lost] + rise[lost + 1]))
        want = np.interp(t, rise, 360.0 * np.arange(len(rise)))
        col = answer.columns("fitted.csv")
        angle = np.array(col["angle_deg"])
        inside = (angle > 0) & (angle < 360.0 * (len(rise) - 1))
        self.assertGreater(inside.sum(), 1000)
        nearest = want[np.searchsorted(want, angle[inside] - 1e-6)]
        self.assertLess(np.abs(nearest - angle[inside]).max(), 1e-6)

    def idle_record(self, per=120, idle=6, cutting=12):
        """A cut with idle turns before and after, drifting; and the force alone."""
        case, K_true = truth(tables())
        F = np.vstack([np.zeros((per * idle, 3)),
                       np.tile(record(case, K_true, turns(per)), (cutting, 1)),
                       np.zeros((per * idle, 3))])
        n = np.arange(len(F))
        noise = 0.5 * np.random.default_rng(8).standard_normal(F.shape)
        drift = np.array([6.0, -3.0, 2.0]) + np.outer(n / n[-1], [4.0, 5.0, -6.0])
        return np.radians((n + 0.5) * 360 / per), F + noise + drift, F

    def test_idle_parts_give_the_drift(self):  # [S-4]
        angle, F, alone = self.idle_record()
        answer = self.identify("idle", tables(), {
            "chip_models": ["trochoidal"], "runout": "fixed", "phase_deg": 0.0,
            "channel_offsets": "idle"}, [self.write("idle.csv", angle, F)])
        col = answer.columns("fitted.csv")
        at = np.rint((np.radians(col["angle_deg"]) - angle[0]) / (angle[1] - angle[0]))
        left = np.array([col[f"F{q}_measured_N"] for q in "xyz"]).T - alone[at.astype(int)]
        for third in np.array_split(left, 3):  # the drift itself: up to 11 N
            self.assertLess(np.abs(third.mean(axis=0)).max(), 0.2)

    def test_folding(self):  # [S-2]
        given = tables()
        case, K_true = truth(given)
        per, count = 120, 9
        F = np.tile(record(case, K_true, turns(per)), (count, 1))
        F = F + 2 * np.random.default_rng(9).standard_normal(F.shape)
        angle = (np.arange(len(F)) + 0.5) * 2 * np.pi / per
        col = self.identify("fold", given, {"chip_models": ["trochoidal"],
                                            "runout": "fixed", "phase_deg": 0.0},
                            [self.write("fold.csv", angle, F)]).columns("folded.csv")
        at = np.array(col["angle_deg"])
        want = force.forces(case, K_true, np.radians(at))[:, :3]
        got = np.array([col[f"F{q}_mean_N"] for q in "xyz"]).T
        # 9 turns of noise 2 N leave 0.7 N; the bins are not quite those of the samples
        self.assertLess(np.sqrt(np.mean((got - want) ** 2)), 1.5)
        scatter = np.array([col[f"F{q}_sd_N"] for q in "xyz"])
        self.assertAlmostEqual(np.sqrt(np.mean(scatter**2)), 2.0, delta=0.3)


if __name__ == "__main__":
    if not os.path.exists(program.PROGRAM):
        sys.exit(f"no program at {program.PROGRAM}; set TROCHOID")
    unittest.main()
