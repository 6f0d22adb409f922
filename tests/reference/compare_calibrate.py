"""The program's calibrate against the transcription, on readings made by the latter."""
import os
import pathlib
import sys
import tempfile
import unittest

import numpy as np

import program
import surface_calibrate as cal
import surface_error as se
import surface_flexible as sf
import surface_made as made
import surface_readings as rd

HEIGHTS = np.linspace(0.25, 2.75, 11)
K = (800.0, 300.0)
UM = 1e-3
TOOL = {"shape": "cylinder", "teeth": 3, "diameter_mm": 12.0, "helix_deg": 45.0}
CUT = {"engagement": "down", "radial_depth_mm": 1.0, "axial_depth_mm": 3.0,
       "feed_per_tooth_mm": 0.2, "spindle_rpm": 1000}
BODY = {"overhang_mm": 83.0, "flute_length_mm": 45.0, "shank_diameter_mm": 12.0,
        "equivalent_diameter_mm": 9.6, "youngs_modulus_GPa": 206.0}
WALL = {"length_mm": 60.0, "height_mm": 30.0, "thickness_mm": 2.0,
        "youngs_modulus_GPa": 69.0, "poisson_ratio": 0.33, "position_mm": 30.0}


def tables(model, wall=True, **changes):
    out = {"tool": TOOL, "cut": CUT, "cutter_body": BODY, "chip": {"model": "radial"},
           "force": {"law": "linear_edge"},
           "surface": {"model": model, "feedback": "none", "errors": "white"}}
    if wall:
        out["wall"] = WALL
    for name, table in changes.items():
        out[name] = {**out.get(name, {}), **table}
    return out


class Calibrate(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="trochoid_")
        self.addCleanup(self.folder.cleanup)

    def calibrate(self, name, given, readings, labelled=False, code=0, **measurement):
        file = readings.write(pathlib.Path(self.folder.name) / f"{name}.csv", labelled)
        text = program.case_text(name, given) + "\n[[surface_measurement]]\n" + "".join(
            f"{k} = {program.toml(v)}\n" for k, v in {"file": file, "form": "none", **measurement}.items())
        answer = program.run("calibrate", text, self.folder.name, name)
        self.assertEqual(answer.code, code, f"{name}: exit {answer.code} {answer.stderr}\n"
                                            f"{text}")
        return answer.result

    def same(self, name, result, fit, part=0.02, prefix=0):
        """Coefficients within a part of their standard error; and what is said about them"""
        for i, key in enumerate(("K_tc_MPa", "K_rc_MPa")):
            got, s = result["coefficients"][key], fit["se"][i]
            self.assertAlmostEqual(got["value"], fit["K"][i], delta=part * s, msg=name + key)
            self.assertAlmostEqual(got["se"], s, delta=0.02 * s, msg=f"{name} se {key}")
            if "low" in fit:
                self.assertAlmostEqual(got["low"], fit["low"][i], delta=0.05 * s, msg=key)
                self.assertAlmostEqual(got["high"], fit["high"][i], delta=0.05 * s, msg=key)
        if "correlation" in fit:
            self.assertAlmostEqual(result["correlation"], fit["correlation"], delta=2e-3)
        self.assertAlmostEqual(result["rms_mm"], fit["rms"], delta=0.01 * fit["rms"])

    def answer_of(self, result, model, feedback="none"):
        found = [a for a in result["answers"]
                 if a["model"] == model and a["feedback"] == feedback]
        self.assertEqual(len(found), 1, result["answers"])
        values = found[0].get("coefficients", found[0])
        return [v["value"] if isinstance(v, dict) else v
                for v in (values["K_tc_MPa"], values["K_rc_MPa"])]

    def test_imprints_with_a_datum(self):  # eqs. (9), (18) [E-15]
        given = tables("imprint")
        m, offset = made.milling(given, 120), 0.004
        r = rd.imprints(m, lambda x: made.structure(given, x), [15.0, 30.0], HEIGHTS, K)
        for shifted in (False, True):
            noisy = r.noisy(UM, 7, offset if shifted else 0.0)
            result = self.calibrate(f"datum{shifted:d}", given, noisy, datum_offset=shifted)
            # The means of all teeth at a place are what is fitted: runout is gone from them.
            fit = cal.imprint(m, lambda x: made.structure(given, x),
                              *cal.grouped(r.x, r.height, noisy.error), "distributed", shifted)
            self.same("imprint", result, fit)
            self.assertAlmostEqual(result["condition"], fit["cond"], delta=0.01 * fit["cond"])
            if shifted:
                found = result["offset_mm"]
                found = found[0] if isinstance(found, list) else found
                found = found["value"] if isinstance(found, dict) else found
                self.assertAlmostEqual(found, fit["K"][2], delta=0.02 * fit["se"][2])

    def test_runout_of_labelled_imprints(self):  # [E-17]
        given = tables("imprint", runout={"eccentricity_mm": 0.005, "angle_deg": 200.0,
                                          "eccentricity_order": "first"})
        bent, plain = made.milling(given, 120), tables("imprint")
        m = made.milling(plain, 120)

        def at(x):
            return made.structure(given, x)

        r = rd.imprints(bent, at, [15.0, 30.0], HEIGHTS, K).noisy(UM, 3)
        result = self.calibrate("labelled", plain, r, labelled=True)
        tooth = r.tooth - 1
        one = cal.imprint(m, at, r.x, r.height, r.error, "distributed")
        two = cal.imprint_runout(m, at, r.x, r.height, r.error, tooth, one["K"],
                                 "distributed")
        found = result["runout"]
        turn = found["angle_deg"] - np.degrees(two["lam"])
        self.assertAlmostEqual(found["eccentricity_mm"], two["rho"], delta=two["se_rho"])
        self.assertAlmostEqual((turn + 180) % 360 - 180, 0.0,
                               delta=np.degrees(two["se_lam"]))
        for key, truth in zip(("K_tc_MPa", "K_rc_MPa"), K):
            got = result["coefficients"][key]
            self.assertLess(abs(got["value"] - truth), 4 * got["se"], key)

    def test_quasi_static_in_two_stages(self):  # eqs. (10)-(18) [E-11] [E-17]
        phi0 = 137.0
        for load in ("concentrated", "distributed"):
            with self.subTest(load=load):
                given = tables("quasi_static", False, surface={"load": load, "phase_deg": phi0},
                               sampling={"samples_per_rev": 36},
                               runout={"eccentricity_mm": 0.006, "angle_deg": -100.0,
                                       "eccentricity_order": "first"})
                bent, s = made.milling(given), made.structure(given)
                r = rd.rotations(bent, s, np.radians(phi0), 12, [0.5, 1.5], K, load)
                r = r.noisy(UM, 5)
                plain = {k: v for k, v in given.items() if k != "runout"}
                result = self.calibrate(load, plain, r)
                fit = cal.quasi_static(made.milling(plain), s, np.radians(phi0), 12,
                                       [0.5, 1.5], r.error.reshape(-1, 2), load)
                one, joint = fit["nominal"], fit["joint"]
                for i, key in enumerate(("K_tc_MPa", "K_rc_MPa")):
                    got = result["coefficients"][key]
                    ends = sorted((one["K"][i], joint["p"][i]))
                    slack = 0.02 * joint["se"][i]
                    self.assertTrue(ends[0] - slack < got["value"] < ends[1] + slack,
                                    f"{key}: {got}, expected within {ends}")
                    self.assertTrue(any(abs(got["se"] - w["se"][i]) < 0.05 * w["se"][i]
                                        for w in (one, joint)), f"{key}: {got} {one} {joint}")
                self.assertAlmostEqual(result["runout"]["eccentricity_mm"], joint["rho"],
                                       delta=joint["se_rho"])
                turn = result["runout"]["angle_deg"] - np.degrees(joint["lam"])
                self.assertAlmostEqual((turn + 180) % 360 - 180, 0.0,
                                       delta=np.degrees(joint["se_lam"]))

    def test_means_of_a_real_surface(self):  # the linear answer is 30 % wrong [E-16]
        given = tables("envelope", False)
        m, s = made.milling(given, 120), made.structure(given)
        e, _ = se.envelope(m, s, HEIGHTS, K)
        n = len(HEIGHTS)
        r = rd.Readings(np.zeros(n), np.zeros(n), HEIGHTS, e.mean(axis=0), np.ones(n))
        r = r.noisy(UM / 10, 11)
        result = self.calibrate("means", given, r)
        linear = cal.imprint(m, lambda _: s, r.x, r.height, r.error, "distributed")
        rigorous = cal.envelope(m, lambda _: s, r.x, r.height, r.error, linear["K"])
        self.same("envelope", result, {**rigorous, "K": rigorous["p"]}, 0.05)
        np.testing.assert_allclose(self.answer_of(result, "imprint"), linear["K"], rtol=2e-3)

    def test_means_at_two_places(self):
        given = tables("envelope")
        m = made.milling(given, 120)
        x, h = np.repeat([15.0, 30.0], len(HEIGHTS)), np.tile(HEIGHTS, 2)
        e = cal.envelope_means(m, lambda p: made.structure(given, p), x, h)(K)
        r = rd.Readings(x, 0 * x, h, e, np.ones(len(x)))
        result = self.calibrate("two_places", given, r.noisy(UM / 1e4, 4))
        for key, truth in zip(("K_tc_MPa", "K_rc_MPa"), K):
            got = result["coefficients"][key]["value"]
            self.assertAlmostEqual(got, truth, delta=2e-3 * truth, msg=key)

    def test_points_of_a_real_surface(self):
        given = tables("envelope", runout={"eccentricity_mm": 0.002, "angle_deg": 40.0,
                                           "eccentricity_order": "first"})
        m = made.milling(given, 120)
        r = rd.profiles(m, lambda x: made.structure(given, x), [30.0], HEIGHTS[::2], K, 30)
        plain = {k: v for k, v in given.items() if k != "runout"}
        result = self.calibrate("points", plain, r.noisy(UM, 2))
        for key, truth in zip(("K_tc_MPa", "K_rc_MPa"), K):
            got = result["coefficients"][key]
            self.assertLess(abs(got["value"] - truth), 4 * got["se"], f"{key}: {got}")

    def test_deflection_that_changes_the_cut(self):  # E-10 [E-16]
        truth, phi0 = (400.0, 200.0), 140.5
        given = tables("quasi_static", surface={"phase_deg": phi0, "feedback": "regenerative"},
                       sampling={"samples_per_rev": 30})
        m, s = made.milling(given, 60), made.structure(given)
        phi = se.rotation(m, np.radians(phi0), 10, 30)
        d = sf.deflection(m, s, phi, [0.5, 1.5], truth, "regenerative")
        r = rd.rotations(m, s, np.radians(phi0), 10, [0.5, 1.5], truth)
        r = rd.Readings(r.x, r.travel, r.height, d.ravel(), r.tooth)
        result = self.calibrate("flexible", given, r)
        rows = cal.nominal_rows(m, s, np.radians(phi0), 10, [0.5, 1.5], d, "distributed")
        np.testing.assert_allclose(self.answer_of(result, "quasi_static"),
                                   cal.linear(*rows)["K"], rtol=5e-3)
        np.testing.assert_allclose(self.answer_of(result, "quasi_static", "regenerative"),
                                   truth, rtol=5e-3)

    def test_intervals_hold_the_truth(self):  # 95 % of them do
        given, held, runs = tables("imprint"), [0, 0], 40
        m = made.milling(given, 120)
        r = rd.imprints(m, lambda x: made.structure(given, x), [30.0], HEIGHTS, K)
        for seed in range(runs):
            result = self.calibrate(f"seed{seed}", given, r.noisy(UM, seed, 0.01),
                                    datum_offset=True)
            for i, key in enumerate(("K_tc_MPa", "K_rc_MPa")):
                got = result["coefficients"][key]
                held[i] += got["low"] < K[i] < got["high"]
        for count in held:  # 38 of 40 expected; outside of 34..40 once in 200
            self.assertGreaterEqual(count, 34, held)

    def test_what_cannot_be_told_apart(self):
        given = tables("imprint", False)
        m, s = made.milling(given), made.structure(given)
        one = rd.imprints(m, lambda _: s, [30.0], [0.5], K)
        straight = tables("imprint", False, tool={"helix_deg": 0.0})
        for name, t in (("one height", given), ("no helix", straight)):
            with self.subTest(what=name):
                r = one if t is given else rd.imprints(m, lambda _: s, [30.0], HEIGHTS, K)
                result = self.calibrate(name.replace(" ", "_"), t, r.noisy(UM, 1), code=1)
                for v in result.get("coefficients", {}).values():
                    self.assertTrue(v is None or v["value"] is None, result)

    def refused(self, name, given, load):
        given = {**given, "surface": {"model": "quasi_static", "load": load, "phase_deg": 3.0},
                 "sampling": {"samples_per_rev": 12 * given["tool"]["teeth"]}}
        m, s = made.milling(given), made.structure(given)
        r = rd.rotations(m, s, np.radians(3.0), 12, [0.5, 1.5], K, load).noisy(UM, 1)
        result = self.calibrate(name, given, r, code=1)
        for v in result.get("coefficients", {}).values():
            self.assertTrue(v is None or v["value"] is None, result)

    def test_pulses_that_do_not_vary(self):
        lead = float(np.pi * 12.0 / 3)
        self.refused("lead", tables("quasi_static", False, cut={"axial_depth_mm": lead}),
                     "concentrated")
        self.refused("slot", tables("quasi_static", False, cut={"radial_depth_mm": 12.0},
                                    tool={"teeth": 4}), "concentrated")

    def test_a_wall_without_error(self):  # all zero: no force, and that is well known
        given = tables("imprint")
        m = made.milling(given)
        r = rd.imprints(m, lambda x: made.structure(given, x), [30.0], HEIGHTS, (0.0, 0.0))
        result = self.calibrate("zero", given, r)
        self.assertEqual(result["rank"], 2)
        for key in ("K_tc_MPa", "K_rc_MPa"):
            self.assertAlmostEqual(result["coefficients"][key]["value"], 0.0, delta=1e-9)


if __name__ == "__main__":
    if not os.path.exists(program.PROGRAM):
        sys.exit(f"no program at {program.PROGRAM}; set TROCHOID")
    unittest.main()
