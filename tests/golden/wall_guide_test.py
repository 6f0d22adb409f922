"""The numbers of docs/guide/thin_wall.md, computed again.

Standard errors are those that `calibrate` gives, for 1 um of noise: they do not depend on the
noise, so a profile with hardly any is enough.
"""
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/reference"))
import program  # noqa: E402

PAGE = (ROOT / "docs/guide/thin_wall.md").read_text()
HEIGHTS = np.linspace(0.25, 2.75, 11).round(3)
WALL = {"length_mm": 60.0, "height_mm": 30.0, "thickness_mm": 2.0,
        "youngs_modulus_GPa": 69, "poisson_ratio": 0.33}
NOISE_MM = 1e-6


def tables(model="envelope", chip="feed", wall=False, a_p=3.0, a_e=1.0):
    pulse = model == "quasi_static"
    out = {
        "tool": {"teeth": 3, "diameter_mm": 12.0, "helix_deg": 45.0},
        "cut": {"engagement": "down", "radial_depth_mm": a_e, "axial_depth_mm": a_p,
                "feed_per_tooth_mm": 0.2, "spindle_rpm": 1000},
        "chip": {"model": chip},
        "force": {"K_tc_MPa": 800, "K_rc_MPa": 300, "K_ac_MPa": 0, "K_te_N_per_mm": 0,
                  "K_re_N_per_mm": 0, "K_ae_N_per_mm": 0},
        "cutter_body": {"overhang_mm": 83.0, "flute_length_mm": 45.0,
                        "youngs_modulus_GPa": 206},
        "surface": {"model": model, "load": "concentrated" if pulse else "distributed",
                    "phase_deg": 140.4,
                    "heights_mm": [0.5] if pulse
                    else [float(h) for h in (HEIGHTS * a_p / 3).round(4)]},
        "sampling": {"samples_per_rev": 30, "revolutions": 1},
    }
    return {**out, "wall": WALL} if wall else out


class Guide(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="trochoid_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def cut(self, truth):
        """The wall that is left: place, height and mean error."""
        answer = program.run("surface", program.case_text("truth", truth), self.folder, "truth")
        self.assertEqual(answer.code, 0, answer.stderr)
        col = {k: np.array(v) for k, v in answer.columns("surface.csv").items()}
        if truth["surface"]["model"] == "quasi_static":
            return "step", [(k, 0.5, e) for k, e in enumerate(col["error_mm"][:10])]
        return "x_mm", [(30.0, h, col["error_mm"][col["height_mm"] == h].mean())
                        for h in np.unique(col["height_mm"])]

    def calibrated(self, truth, read, datum=False):
        """What the profile of `truth` gives, read as `read` says."""
        random = np.random.default_rng(1)
        name, rows = self.cut(truth)
        lines = [f"{x},{h},{e + NOISE_MM * random.standard_normal()!r}" for x, h, e in rows]
        (self.folder / "wall.csv").write_text(
            "\n".join([f"{name},height_mm,error_mm", *lines]) + "\n")
        stated = {**read["surface"], "feedback": "none", "errors": "white"}
        text = program.case_text("read", {**read, "surface": stated}) + (
            f'\n[[surface_measurement]]\nform = "none"\nfile = "wall.csv"\n'
            f"datum_offset = {str(datum).lower()}\n")
        answer = program.run("calibrate", text, self.folder, "read")
        self.assertEqual(answer.code, 0, answer.stderr)
        return answer.result

    def errors(self, datum, **case):
        """Standard errors as the page writes them."""
        result = self.calibrated(tables(**case), tables(**case), datum)
        se = [result["coefficients"][k]["se"] * 1e-3 / result["noise_mm"]
              for k in ("K_tc_MPa", "K_rc_MPa")]
        return ", ".join(f"{x:.0f}" if x < 1000 else f"{float(f'{x:.3g}'):.0f}" for x in se)

    def test_the_table_of_readings_comes_out(self):
        rows = {
            "envelope, rigid wall": {},
            "envelope, wall 60 x 30 x 2 mm": {"wall": True},
            "imprint, rigid wall": {"model": "imprint"},
            "imprint, wall 60 x 30 x 2 mm": {"model": "imprint", "wall": True},
            "imprint, rigid wall, a_p 0.5 mm": {"model": "imprint", "a_p": 0.5},
            "imprint, rigid wall, a_p 1 mm": {"model": "imprint", "a_p": 1.0},
            "imprint, rigid wall, a_p 6 mm": {"model": "imprint", "a_p": 6.0},
            "imprint, rigid wall, a_e 0.3 mm": {"model": "imprint", "a_e": 0.3},
            "quasi_static, 10 spindle angles": {"model": "quasi_static"},
        }
        for name, case in rows.items():
            stated = re.search(rf"^\| {re.escape(name)} \| (.*?) \|(.*)\|$", PAGE, re.MULTILINE)
            self.assertIsNotNone(stated, name)
            self.assertEqual(self.errors(False, **case), stated[1], name)
            if stated[2].strip():
                self.assertEqual(self.errors(True, **case), stated[2].strip(), name)

    def test_the_biased_answers_come_out(self):
        for wall in (False, True):
            exact = self.calibrated(tables(wall=wall), tables(wall=wall))
            chips = self.calibrated(tables(chip="trochoidal", wall=wall), tables(wall=wall))
            self.assertEqual(exact["answers"][0]["model"], "imprint")
            for coefficients in (exact["answers"][0]["coefficients"], chips["coefficients"]):
                K = [coefficients[k]["value"] for k in ("K_tc_MPa", "K_rc_MPa")]
                self.assertIn(f"{K[0]:.0f} / {K[1]:.0f}", PAGE)


if __name__ == "__main__":
    unittest.main()
