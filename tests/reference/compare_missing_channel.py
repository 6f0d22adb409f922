"""The program's identify of a record of two channels against the transcription."""
import os
import sys
import unittest

import compare_identification as made
import identification as ident
import program


class MissingChannel(unittest.TestCase):
    setUp, write, identify = made.Identify.setUp, made.Identify.write, made.Identify.identify

    def without_z(self, name, case, angle, F, errors):
        """What the program makes of x and y alone"""
        run = self.write(f"{name}.csv", angle, F[:, :2], "angle_deg,Fx_N,Fy_N")
        unknown = {k: v for k, v in made.tables().items() if k != "runout"}
        return self.identify(name, unknown, {
            "chip_models": ["trochoidal"], "runout": "offsets", "phase_deg": 0.0,
            "errors": errors}, [run])

    def test_a_record_without_z(self):  # [I-1] [I-3] [I-4] [I-5]
        """The same least squares without the rows of z and the columns that only they have"""
        case, K_true = made.truth(made.tables())
        angle = made.turns(90, 6)
        F = made.record(case, K_true, angle, noise=6)
        want = ident.joint_in_plane(case, angle, F, ["shift:1", "shift:2"], [0.009, -0.006])
        for errors in ("white", "auto"):
            answer = self.without_z(f"plane_{errors}", case, angle, F, errors)
            fit = answer.result["fits"][0]
            for key, value, se in zip(("K_tc_MPa", "K_rc_MPa", "K_te_N_per_mm",
                                       "K_re_N_per_mm"), want["K"], want["se_K"]):
                got = fit["coefficients"][key]
                self.assertAlmostEqual(got["value"] / value, 1, delta=1e-6, msg=key)
                if errors == "white":
                    self.assertAlmostEqual(got["se"], se, delta=2e-3 * se, msg=key)
            for k in (1, 2):
                self.assertAlmostEqual(fit["runout"]["radial_offsets_mm"][k],
                                       want["p"][k - 1], delta=1e-6 * abs(want["p"][k - 1]))
            for key in ("K_ac_MPa", "K_ae_N_per_mm"):
                self.assertIsNone(fit["coefficients"][key])
                self.assertEqual(fit["identifiable"][key],
                                 "the axial force was not measured")
            self.assertAlmostEqual(fit["rms_N"], want["rms"], delta=1e-6 * want["rms"])
            self.assertIsNone(fit["rms_axis_N"][2])
            self.assertEqual(fit["rank"], 4)
            self.assertAlmostEqual(fit["condition"], want["cond"], delta=1e-3 * want["cond"])
            self.assertEqual(fit["degrees_of_freedom"], 2 * len(angle) - 6)
            codes = [w["code"] for w in answer.summary["warnings"]]
            self.assertIn("channel_missing", codes)
            columns = answer.columns("fitted.csv")
            self.assertIn("Fy_measured_N", columns)
            self.assertNotIn("Fz_measured_N", columns)


if __name__ == "__main__":
    if not os.path.exists(program.PROGRAM):
        sys.exit(f"no program at {program.PROGRAM}; set TROCHOID")
    unittest.main()
