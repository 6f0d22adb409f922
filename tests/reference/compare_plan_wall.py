"""The program's plan of a wall against the transcription [E-60] [E-61] [E-62] [E-63]"""
import os
import sys
import tempfile
import unittest

import numpy as np

import compare_calibrate as walls
import program
import surface_made as made
import surface_plan as plan

K = np.array(walls.K)
NOISE = 1.5e-3
A_P = walls.CUT["axial_depth_mm"]
FORCE = {"law": "linear_edge", "K_tc_MPa": K[0], "K_rc_MPa": K[1], "K_ac_MPa": 0.0,
         "K_te_N_per_mm": 0.0, "K_re_N_per_mm": 0.0, "K_ae_N_per_mm": 0.0}
RUNOUT = {"eccentricity_mm": 0.004, "angle_deg": 71.0, "eccentricity_order": "first"}
PLAN = {"of": "wall", "heights": [3, 7], "readings_per_height": [3, 6, 24], "spread": [0.8],
        "noise_um": 1e3 * NOISE, "feed_per_tooth_mm": [0.1, 0.2],
        "radial_depth_mm": [0.5, 1.0]}


def case(wall, **keys):
    return walls.tables("imprint", wall, force=FORCE, runout=RUNOUT, plan={**PLAN, **keys})


class PlanOfAWall(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="trochoid_")
        self.addCleanup(self.folder.cleanup)

    def run_program(self, command, name, tables, codes=(0,)):
        text = program.case_text(name, tables)
        answer = program.run(command, text, self.folder.name, name)
        self.assertIn(answer.code, codes, f"{answer.stderr}\n{text}")
        return answer

    def test_intervals_of_every_design(self):
        for wall in (False, True):
            x0 = walls.WALL["position_mm"] if wall else 0.0
            for form in ("none", "offset", "tilt", "curvature"):
                given = case(wall, form=form)
                m, structure = made.milling(given, 120), made.structure(given)
                answer = self.run_program("plan", f"{form}{wall:d}", given, codes=(0, 1))
                designs = answer.result["designs"]
                self.assertEqual(len(designs), 6)
                told = 0
                for one in designs:
                    n = one["heights"]
                    heights = A_P * (0.5 + 0.8 * (np.arange(n) / (n - 1) - 0.5))
                    want = plan.half_widths(m, structure, heights, one["readings_per_height"],
                                            x0, K, form, NOISE)
                    self.assertEqual(want is None, one["predicted"] is None, f"{form} {one}")
                    if want is None:
                        continue
                    told += 1
                    got = [(one["predicted"][key]["high"] - one["predicted"][key]["low"]) / 2
                           for key in ("K_tc_MPa", "K_rc_MPa", "eccentricity_mm")]
                    # 120 disks over the height: 1e-3 of an influence.
                    np.testing.assert_allclose(got, want, rtol=1e-2, err_msg=f"{form} {one}")
                # A bow of the readings hides what the wall tells, unless that bends as well.
                self.assertEqual(told > 2, answer.code == 0, form)
                self.assertEqual(told == 0, answer.code == 1, form)

    def test_the_map_is_what_surface_computes(self):
        """Each cell by itself, at heights and places that surface takes as well."""
        given = case(True, largest_error_um=30)
        answer = self.run_program("plan", "map", given)
        cells = answer.columns("error_map.csv")
        for i, feed in enumerate(cells["feed_per_tooth_mm"]):
            cut = {**walls.CUT, "feed_per_tooth_mm": feed,
                   "radial_depth_mm": cells["radial_depth_mm"][i]}
            self.assertAlmostEqual(cells["removal_rate_mm3_per_min"][i],
                                   plan.removal_rate(cut, 3), delta=1e-6)
            one = walls.tables("imprint", True, force=FORCE, runout=RUNOUT, cut=cut, surface={
                "heights_mm": list(np.linspace(0, A_P, 9))})
            result = self.run_program("surface", f"cell{i}", one).result
            peak = 1e3 * max(abs(result["peak_error_mm"]), abs(result["min_error_mm"]))
            self.assertAlmostEqual(cells["peak_error_um"][i], peak, delta=1e-4 * peak)
            self.assertAlmostEqual(cells["mean_error_um"][i], 1e3 * result["mean_error_mm"],
                                   delta=1e-4 * peak)
        self.best(answer.result["cutting"], cells, 30)

    def best(self, cutting, cells, limit):
        keeps = [i for i, e in enumerate(cells["peak_error_um"]) if e <= limit]
        rate = cells["removal_rate_mm3_per_min"]
        if keeps:
            self.assertEqual(cutting["best"]["removal_rate_mm3_per_min"],
                             max(rate[i] for i in keeps))
        else:
            self.assertIsNone(cutting["best"])

    def test_the_thinnest_wall_keeps_the_limit_and_a_thinner_one_does_not(self):
        stated = self.run_program("plan", "free", case(True)).result["cutting"]["stated"]
        limit = 0.9 * stated["peak_error_um"]
        given = case(True, largest_error_um=limit)
        cutting = self.run_program("plan", "thin", given).result["cutting"]
        found = cutting["thinnest_wall"]
        self.assertFalse(found["thinner_too"])
        for factor, keeps in ((1.0, True), (0.995, False)):
            one = walls.tables("imprint", True, force=FORCE, runout=RUNOUT,
                               surface={"heights_mm": list(np.linspace(0, A_P, 9))})
            one["wall"] = {**walls.WALL, "thickness_mm": factor * found["thickness_mm"]}
            result = self.run_program("surface", f"wall{factor}", one).result
            peak = 1e3 * max(abs(result["peak_error_mm"]), abs(result["min_error_mm"]))
            self.assertEqual(peak <= limit, keeps, f"{peak} um at {factor}")


if __name__ == "__main__":
    if not os.path.exists(program.PROGRAM):
        sys.exit(f"no program at {program.PROGRAM}; set TROCHOID")
    unittest.main()
