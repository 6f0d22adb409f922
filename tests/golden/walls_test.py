"""The examples about walls: do they recover their truth, and does the page say what comes out?

The simulated profile carries its truth beside it. What the page of thin_wall_table1 states
is computed again, cell by cell. `walls_test.py --renew` writes material.toml anew.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/reference"))
import program  # noqa: E402

EXAMPLES = ROOT / "examples"
MATERIAL = EXAMPLES / "thin_wall_calibrate/material.toml"


def readings(file):
    """Columns by name; a comment comes before the names."""
    return np.genfromtxt(file, delimiter=",", names=True, skip_header=1)


class Example(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="trochoid_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def copy(self, name):
        return shutil.copytree(EXAMPLES / name, self.folder / "examples" / name)

    def answer(self, command, text, folder, name="case", codes=(0,)):
        answer = program.run(command, text, folder, name)
        self.assertIn(answer.code, codes, answer.stderr)
        return answer


class Calibrated(Example):
    def setUp(self):
        super().setUp()
        self.example = self.copy("thin_wall_calibrate")
        self.case = (self.example / "case.toml").read_text()
        self.truth = tomllib.loads((self.example / "truth.toml").read_text())

    def measure(self, seed):
        """The profile anew, by the script that made it."""
        subprocess.run([sys.executable, self.example / "make.py", program.PROGRAM, str(seed)],
                       check=True)
        return readings(self.example / "profile.csv")

    def distances(self):
        """How far each answer is from the truth, in its own standard errors."""
        result = self.answer("calibrate", self.case, self.example).result
        self.assertTrue(result["with_runout"])
        runout, truth = result["runout"], self.truth
        angle = runout["angle_deg"] - truth["runout"]["angle_deg"] + 60.0
        offset = result["datum"][0]["offset_mm"]
        out = {name: (c["value"] - truth["force"][name]) / c["se"]
               for name, c in result["coefficients"].items()}
        out["offset"] = (offset["value"] - 0.006) / offset["se"]
        out["rho"] = ((runout["eccentricity_mm"] - truth["runout"]["eccentricity_mm"])
                      / runout["eccentricity_se_mm"])
        out["lambda"] = (angle % 120.0 - 60.0) / runout["angle_se_deg"]
        return out

    def test_the_truth_lies_within_the_intervals(self):
        for name, distance in self.distances().items():
            self.assertLess(abs(distance), 1.96, name)

    def test_the_profile_is_what_the_script_makes(self):
        stored = readings(EXAMPLES / "thin_wall_calibrate/profile.csv")
        made = self.measure(2015)
        for name in stored.dtype.names:  # the last digit may round the other way
            np.testing.assert_allclose(made[name], stored[name], rtol=0, atol=1.01e-4)

    def test_other_noise_is_answered_as_well(self):
        """Seed 1 once did not settle."""
        squares = []
        for seed in range(1, 1 + int(os.environ.get("TROCHOID_SEEDS", 2))):
            self.measure(seed)
            squares += [d * d for d in self.distances().values()]
        self.assertLess(max(squares), 4.0**2)
        self.assertLess(np.mean(squares), 2.5)  # 5 correlated values a seed, of mean 1

    def test_without_the_fit_of_runout_the_truth_is_missed(self):
        """What the page says of the lines above the answer."""
        result = self.answer("calibrate", self.case, self.example).result
        for answer in result["answers"][:2]:
            self.assertLess(answer["coefficients"]["K_tc_MPa"]["high"], 800)

    def test_stated_feedback_is_fitted_together_with_the_runout(self):
        text = self.case.replace('[surface]\n', '[surface]\nfeedback = "regenerative"\n')
        result = self.answer("calibrate", text, self.example).result
        self.assertTrue(result["with_runout"])
        self.assertEqual({e["feedback"] for e in result["explanations"]}, {"regenerative"})

    def test_material_toml_is_what_was_found_and_is_taken_in(self):
        answer = self.answer("calibrate", self.case, self.example)
        now, then = (tomllib.loads(p.read_text())
                     for p in (answer.folder / "material.toml", MATERIAL))
        for table, keys in (("force", ("K_tc_MPa", "K_rc_MPa")),
                            ("runout", ("eccentricity_mm", "angle_deg"))):
            for key in keys:
                self.assertAlmostEqual(now[table][key], then[table][key],
                                       delta=1e-4 * abs(then[table][key]),
                                       msg=f"{key}; walls_test.py --renew")
        text = (self.example / "next_wall.toml").read_text()
        for command in ("surface", "simulate"):
            next_cut = self.answer(command, text, self.example, "next_wall")
            used = tomllib.loads((next_cut.folder / "case.toml").read_text())
            self.assertEqual(used["force"]["K_tc_MPa"], then["force"]["K_tc_MPa"])
            self.assertEqual(used["runout"]["angle_deg"], then["runout"]["angle_deg"])


class Table1(Example):
    def setUp(self):
        super().setUp()
        self.example = self.copy("thin_wall_table1")
        self.case = (self.example / "case.toml").read_text()
        self.page = (self.example / "README.md").read_text()

    def variant(self, phase="140.4", wall="length_mm = 60", diameter="9.6"):
        """K_tc / K_rc as the page writes them, and the rms in um."""
        text = self.case.replace("phase_deg = 140.4", f"phase_deg = {phase}")
        text = text.replace("equivalent_diameter_mm = 9.6",
                            f"equivalent_diameter_mm = {diameter}")
        if wall == "wall rigid":
            text = re.sub(r"\[wall\].*?\n(?=\[)", "", text, flags=re.DOTALL)
        else:
            text = re.sub(r"length_mm = 60\.0", wall, text, count=1)
        # A coefficient below zero is none, and shown nevertheless: exit 1.
        result = self.answer("calibrate", text, self.example, codes=(0, 1)).result
        K = [result["coefficients"][name]["value"] for name in ("K_tc_MPa", "K_rc_MPa")]
        return f"{K[0]:.0f} / {K[1]:.0f}", f"{1000 * result['rms_mm']:.1f}"

    def test_every_cell_of_the_page_comes_out(self):
        rows = [[cell.strip() for cell in line.strip("|").split("|")]
                for line in re.findall(r"^\|.*\|$", self.page, re.MULTILINE)]
        head, body = rows[0], rows[2:]
        self.assertEqual(len(body), 4)
        for row in body:
            for wall, cell in zip(head[1:5], row[1:5]):
                got, rms = self.variant(row[0], wall)
                self.assertEqual(got, cell, f"phase {row[0]}, {wall}")
                self.assertEqual(rms, row[5], f"phase {row[0]}, {wall}")

    def test_the_three_diameters_of_the_page_come_out(self):
        for diameter in ("8.4", "9.6", "12"):
            got, _ = self.variant(wall="wall rigid", diameter=diameter)
            self.assertIn(got, self.page)

    def test_no_reading_of_it_gives_what_the_paper_states(self):
        for text in re.findall(r"-?\d+ / \d+", self.page.split("| phase_deg", 1)[1]):
            if text != "1535 / 1037":
                self.assertLess(float(text.split("/")[0]), 400)

    def test_the_readings_are_those_of_the_table(self):
        """Its own last row: the mean of the three teeth, to rounding."""
        read = readings(self.example / "table1.csv")
        mean = read["error_mm"].reshape(3, 10).mean(axis=0)
        stated = [0, 0.0191, 0.0356, 0.0263, 0.0192, 0.0117, 0.00097, 0.0002, 0, 0]
        np.testing.assert_allclose(mean, stated, atol=5e-5)


class TwoWalls(Example):
    def peak(self, name, feedback="regenerative"):
        folder = self.copy("thin_wall_2mm_4mm") if not (
            self.folder / "examples").exists() else self.folder / "examples/thin_wall_2mm_4mm"
        if feedback != "regenerative":
            case = folder / "case.toml"
            case.write_text(case.read_text().replace('"regenerative"', f'"{feedback}"'))
        text = (folder / name).read_text()
        return self.answer("surface", text, folder, "run").result["forces"]["F_normal_max_N"]

    def test_the_thinner_wall_takes_less_force_and_soft_coefficients_hide_it(self):
        thin, thick = self.peak("case.toml"), self.peak("wall_4mm.toml")
        # Marched to the periodic state by other means, at ten angles in a tooth, it is
        # 166 and 215 N; between those angles the peak is a little higher.
        self.assertAlmostEqual(thin, 166.0, delta=1.5)
        self.assertAlmostEqual(thick, 216.0, delta=2.0)
        soft = [self.peak("soft_2mm.toml"), self.peak("soft_4mm.toml")]
        self.assertLess(soft[1] / soft[0], 1.06)
        self.assertGreater(self.peak("case.toml", "none"), 1.3 * thick)


def renew():
    folder = tempfile.mkdtemp(prefix="trochoid_")
    try:
        example = shutil.copytree(EXAMPLES / "thin_wall_calibrate", f"{folder}/example")
        case = pathlib.Path(example, "case.toml")
        answer = program.run("calibrate", case.read_text(), case.parent, "case")
        shutil.copyfile(answer.folder / "material.toml", MATERIAL)
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    if "--renew" in sys.argv:
        sys.exit(renew())
    unittest.main()
