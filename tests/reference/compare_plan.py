"""The program's plan against the transcription: information, intervals, order [I-20] [I-21]"""
import os
import sys
import tempfile
import unittest
from dataclasses import replace

import numpy as np
from scipy import stats

import compare_identification as made
import identification as ident
import program

NAMES = ["shift:1", "shift:2"]
PLAN = {"engagement": ["slot", "up", "down"], "feed_per_tooth_mm": [0.03, 0.09],
        "radial_depth_mm": [2.5, 6.0], "turns": 4, "samples_per_rev": 72,
        "quantities": ["K_tc", "K_re", "runout"]}
SHOWN = {"K_tc_MPa": 0, "K_re_N_per_mm": 4, "radial_offset_2_mm": 6, "radial_offset_3_mm": 7}
SOME = list(SHOWN.values())


class Plan(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="trochoid_")
        self.addCleanup(self.folder.cleanup)

    def plan(self, name, tables, measurements=()):
        text = program.case_text(name, tables, measurements)
        answer = program.run("plan", text, self.folder.name, name)
        self.assertEqual(answer.code, 0, f"{answer.stderr}\n{text}")
        return answer

    def cuts(self, result, case, K, p, noise, M):
        """Every cut against the transcription, and their order."""
        angle = made.turns(PLAN["samples_per_rev"])
        seen = []
        for cut in result["cuts"]:
            given = made.tables(cut={k: cut[k] for k in (
                "engagement", "feed_per_tooth_mm", "radial_depth_mm")})
            if cut["engagement"] == "slot":
                given["cut"].pop("radial_depth_mm")
            one = replace(made.truth(given)[0], model=case.model)
            A = ident.information(*ident.jacobian(one, angle, K, NAMES, p), noise,
                                  PLAN["turns"])
            then = A if M is None else M + A
            C = np.linalg.inv(then)
            for key, i in SHOWN.items():
                got = cut["predicted"][key]
                self.assertAlmostEqual(got["se"], np.sqrt(C[i, i]),
                                       delta=2e-3 * np.sqrt(C[i, i]), msg=f"{key} {cut}")
            seen.append(ident.log_determinant(then, SOME))
            if M is not None:
                wide = (ident.log_determinant(M, SOME) - seen[-1]) / (2 * len(SOME))
                self.assertAlmostEqual(cut["narrows"], np.exp(wide), delta=2e-3 * np.exp(wide))
        self.assertEqual(len(seen), 10)
        self.assertEqual(seen, sorted(seen))

    @program.long_form
    def test_after_a_record(self):
        given = made.tables()
        case, K_true = made.truth(given)
        angle = made.turns(90, 2)
        F = made.record(case, K_true, angle, np.radians(20.0), 4.0)
        file = os.path.join(self.folder.name, "record.csv")
        np.savetxt(file, np.column_stack([np.degrees(angle), F]), delimiter=",",
                   header="angle_deg,Fx_N,Fy_N,Fz_N", comments="", fmt="%.17g")
        unknown = {k: v for k, v in given.items() if k != "runout"}
        result = self.plan("after", {**unknown, "identify": {"channel_offsets": "none",
                                                        "chip_models": ["trochoidal"]},
                                     "plan": PLAN}, [{"file": "record.csv"}]).result
        start = [0.009, -0.006, 20.0]
        fit = ident.joint(case, angle, F, NAMES + ["phase"], start)
        p, phase = fit["p"][:2], np.radians(fit["p"][2])
        new, _ = ident.with_parameters(case, NAMES, p)
        left = F.ravel() - ident.stacked(new, angle, phase) @ fit["K"]
        freedom = F.size - 9
        wider = ident.widening([angle], [left.reshape(-1, 3)], 9)
        noise = wider * np.sqrt(left @ left / freedom)
        self.assertAlmostEqual(result["noise_N"], noise, delta=1e-3 * noise)
        M = ident.information(*ident.jacobian(case, angle + phase, fit["K"], NAMES, p), noise)
        C = np.linalg.inv(M)
        for key, i in SHOWN.items():
            got = result["before"][key]
            self.assertAlmostEqual(got["se"], np.sqrt(C[i, i]), delta=2e-3 * np.sqrt(C[i, i]))
            width = (got["high"] - got["low"]) / 2
            self.assertAlmostEqual(width, stats.t.ppf(0.975, freedom) * got["se"],
                                   delta=1e-6 * width)
        self.cuts(result, case, fit["K"], p, noise, M)

    def test_before_anything_is_measured(self):
        given = made.tables(force={**made.tables()["force"], **made.K})
        case, K_true = made.truth(made.tables())
        result = self.plan("before", {**given, "plan": {**PLAN, "noise_N": 3.0}}).result
        self.assertEqual(result["before"]["K_tc_MPa"], None)
        self.cuts(result, case, K_true, np.array([0.009, -0.006]), 3.0, None)

    def test_the_limit_of_the_force_leaves_cuts_out(self):
        given = made.tables(force={**made.tables()["force"], **made.K})
        free = self.plan("free", {**given, "plan": {**PLAN, "noise_N": 3.0}}).result
        limit = sorted(cut["peak_force_N"] for cut in free["cuts"])[4] + 1e-6
        bound = self.plan("bound", {**given, "plan": {**PLAN, "noise_N": 3.0,
                                                      "max_force_N": limit}}).result
        kept = [cut for cut in free["cuts"] if cut["peak_force_N"] <= limit]
        self.assertEqual(bound["cuts"], kept)
        self.assertEqual(sum(one["count"] for one in bound["left_out"]), 10 - len(kept))
        self.assertEqual(bound["looked_at"], 10)


if __name__ == "__main__":
    if not os.path.exists(program.PROGRAM):
        sys.exit(f"no program at {program.PROGRAM}; set TROCHOID")
    unittest.main()
