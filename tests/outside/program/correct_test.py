"""correct: the files of a correction, a program in C that uses one, and what is refused."""
import csv
import json
import shutil
import subprocess

from in_folder import InFolder, ROOT, main

EXAMPLE = (ROOT / "examples/runout_correction/case.toml").read_text()

HOST = """
#include <stdio.h>
#include "cut.correct/command.h"
int main(void) {
  int i;
  printf("%.10g %.10g\\n", trochoid_command_rpm, trochoid_command_middle_um);
  for (i = 0; i < TROCHOID_COMMAND_POINTS; ++i) printf("%.10g\\n", trochoid_command_um[i]);
  return 0;
}
"""


class Correct(InFolder):
    def correct(self, *options, code=0, **changes):
        text = EXAMPLE
        for old, new in changes.values():
            self.assertIn(old, text)
            text = text.replace(old, new)
        self.write("cut.toml", text)
        done = self.run_program("correct", "cut.toml", *options, code=code)
        return done, self.summary("cut.correct")

    def columns(self, file):
        with open(self.folder / "cut.correct" / file) as stream:
            rows = list(csv.DictReader(stream))
        return {name: [float(row[name]) for row in rows] for name in rows[0]}

    def test_files(self):
        done, summary = self.correct("--simulate-controller")
        files = {p.name for p in (self.folder / "cut.correct").iterdir()}
        self.assertEqual(files, {"case.toml", "summary.json", "report.html", "command.csv",
                                 "command.h", "estimator.csv", "forces.csv", "speeds.csv", "controller.csv"})
        self.assertIn("difference of the peaks", done.stdout)
        forces = self.columns("forces.csv")
        for when, share in (("before", 0.30), ("after", -0.01)):
            # One tooth cuts at a time: the halves of a turn are the flutes.
            half = len(forces["angle_deg"]) // 2
            Fy = [abs(F) for F in forces[f"Fy_{when}_N"]]
            peaks = max(Fy[:half]), max(Fy[half:])
            self.assertGreater(1 - min(peaks) / max(peaks), share)
            flutes = [f["peak_Fy_N"] for f in summary["result"][when]["flutes"]]
            for peak, flute in zip(peaks, flutes):
                self.assertAlmostEqual(peak, flute, delta=2e-3 * flute)
        states = self.columns("controller.csv")["state"]
        self.assertTrue({0, 2, 3} <= set(states), set(states))

    def test_a_program_in_c_holds_the_command(self):
        compiler = shutil.which("cc") or shutil.which("gcc")
        if compiler is None:
            self.skipTest("no C compiler")
        _, summary = self.correct(title=("title = \"Runout", "title = \"*/ int x; /* Runout"))
        self.write("host.c", HOST)
        subprocess.run([compiler, "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror",
                        "host.c", "-o", "host"], cwd=self.folder, check=True)
        first, *values = subprocess.run([self.folder / "host"], capture_output=True, text=True,
                                        check=True).stdout.splitlines()
        rpm, middle = map(float, first.split())
        self.assertEqual(rpm, 1200)
        self.assertAlmostEqual(middle, summary["result"]["command"]["offset_um"], places=6)
        command = self.columns("command.csv")["command_um"]
        self.assertEqual(len(values), len(command))
        for value, want in zip(values, command):
            self.assertAlmostEqual(float(value), want, delta=1e-4)

    def test_chatter_is_no_answer(self):
        done, summary = self.correct(code=1, tool=("stiffness_N_per_m = 8e6",
                                                   "stiffness_N_per_m = 5e5"))
        self.assertEqual(summary["status"], "failed")
        self.assertIn("chatter", done.stderr)
        self.assertEqual(summary["result"], {})
        files = {p.name for p in (self.folder / "cut.correct").iterdir()}
        self.assertEqual(files, {"case.toml", "summary.json", "report.html"})

    def test_the_completed_case_answers_the_same(self):
        _, summary = self.correct()
        self.run_program("correct", "cut.correct/case.toml", "-o", "again")
        self.assertEqual(self.summary("again")["result"], summary["result"])

    def test_four_flutes_become_equal_in_the_loop(self):
        done, summary = self.correct(
            "--simulate-controller", "--no-report",
            teeth=("teeth = 2", "teeth = 4"), depth=("axial_depth_mm = 1", "axial_depth_mm = 0.3"),
            runout=("radial_offsets_mm = [0.0139, -0.0139]",
                    "radial_offsets_mm = [0.022, 0.003, -0.020, -0.005]"),
            shape=('shape = "sine"', 'shape = "harmonics"\nharmonics = 3\n'
                   "spindle_rpm = [1200, 1300, 2]"),
            strategy=('strategy = "lead"', 'strategy = "inverse"'))
        result = summary["result"]
        controller = result["controller"]
        self.assertGreater(controller["difference_before"], 0.30)
        self.assertLess(controller["difference_running"], 0.03)
        self.assertIsNotNone(controller["turns_to_3_percent"])
        self.assertLess(result["after"]["difference"], 0.01)
        self.assertEqual(result["command"]["optimum"]["kind"], "equal")
        self.assertGreater(controller["turns"][-1]["wave_um"], 1)
        self.assertIn("no motion does better", done.stdout)

    def test_a_spindle_speed_is_compared_within_its_torque(self):
        done, summary = self.correct(
            "--no-report", title=("[correct]", "[spindle]\ninertia_kg_m2 = 5e-4\ntorque_Nm = 2\n\n[correct]"))
        spindle = summary["result"]["spindle_speed"]
        self.assertLess(spindle["part"], 1)
        self.assertLessEqual(spindle["torque_Nm"], 2)
        self.assertIsNone(spindle["torque_wanted_Nm"])  # more than ten times the speed
        self.assertIn("torque", spindle["limit"])
        self.assertIn("spindle_sine", summary["result"]["max_rpm"])
        self.assertLessEqual(max(map(abs, self.columns("spindle.csv")["torque_Nm"])), 2)
        self.assertIn("instead of the table", done.stdout)

    def test_json(self):
        self.write("cut.toml", EXAMPLE)
        done = self.run_program("correct", "cut.toml", "--json")
        self.assertGreater(json.loads(done.stdout)["result"]["reduction"], 0.86)


if __name__ == "__main__":
    main()
