"""dynamics: a cut that moves, and one that chatters."""
import csv
import json
import math

from in_folder import InFolder, ROOT, main

BENCHMARK = (ROOT / "examples/stability_922Hz/case.toml").read_text()


def keys_of(value):
    """All keys anywhere in a JSON value."""
    if isinstance(value, dict):
        return set(value) | {k for v in value.values() for k in keys_of(v)}
    if isinstance(value, list):
        return {k for v in value for k in keys_of(v)}
    return set()


class Chatter(InFolder):
    def cut(self, depth, code, more=""):
        text = BENCHMARK.replace("axial_depth_mm = 0.5", f"axial_depth_mm = {depth}")
        self.write("cut.toml", text + more)
        done = self.run_program("dynamics", "cut.toml", code=code)
        return done, self.summary("cut.dynamics")

    def test_a_stable_cut_settles_as_its_multiplier_says(self):
        done, summary = self.cut(0.2, code=0)
        result = summary["result"]
        self.assertEqual(result["verdict"], "periodic")
        self.assertEqual([f["tooth"] for f in result["flutes"]], [1, 2])
        self.assertAlmostEqual(result["linear_growth_per_turn"], 0.8197427843**2, 6)
        self.assertAlmostEqual(result["growth_per_turn"], 0.8197427843**2, delta=1e-3)
        self.assertIn("it repeats", done.stdout)

    def test_an_unstable_cut_chatters_with_its_growth_and_its_amplitudes(self):
        for depth, multiplier in ((0.5, 1.0739755867), (0.7, None), (1.0, 1.4064735254),
                                  (2.0, 1.7606359579)):
            with self.subTest(depth):
                done, summary = self.cut(depth, code=0)
                self.assertEqual(summary["status"], "ok")
                self.assertEqual([w["code"] for w in summary["warnings"]], ["chatter"])
                self.assertIn("chatters", summary["message"])
                result = summary["result"]
                self.assertTrue(result["chatter"])
                linear = result["linear_growth_per_turn"]
                if multiplier:
                    self.assertAlmostEqual(linear, multiplier**2, 5)
                if depth < 1:  # at larger depths the teeth leave the cut at once
                    self.assertAlmostEqual(result["growth_per_turn"], linear, delta=2e-3)
                if result["verdict"] == "bounded":
                    self.assertFalse(result["periodic"])
                    self.assertIsNone(result["period"])
                    vibration = result["vibration"]
                    self.assertGreater(vibration["x_um"], 10)  # of a feed of 50
                    self.assertLess(vibration["x_um"], 500)
                    self.assertEqual(vibration["y_um"], 0)
                    self.assertIn(f"chatter within {vibration['x_um']:.4g} um", done.stdout)
                    self.assertEqual(result["surface_location"], [])

    def test_chatter_sounds_as_its_spectrum_says(self):
        _, summary = self.cut(0.5, code=0)
        vibration = summary["result"]["vibration"]
        sound = vibration["chatter_frequency_Hz"]
        self.assertTrue(922 < sound < 1.1 * 922, sound)  # a little above the mode
        with open(self.folder / "cut.dynamics/spectrum.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        spectrum = {key: [float(row[key]) for row in rows] for key in rows[0]}
        step = spectrum["frequency_Hz"][1]
        own = [line for line in vibration["lines"] if line["spindle_harmonic"] is None]
        self.assertEqual(own[0]["frequency_Hz"], sound)
        for line in vibration["lines"]:
            k = round(line["frequency_Hz"] / step)
            self.assertAlmostEqual(spectrum["x_um"][k], line["x_um"], delta=0.2 * line["x_um"])
            if line["spindle_harmonic"]:
                self.assertAlmostEqual(line["frequency_Hz"],
                                       5000 / 60 * line["spindle_harmonic"], delta=step)

    def test_a_period_of_its_own_is_told(self):
        """Two teeth in turns, beyond a period doubling of interrupted cutting."""
        text = BENCHMARK.replace("axial_depth_mm = 0.5", "axial_depth_mm = 2.5")
        text = text.replace('engagement = "slot"', 'engagement = "up"\nradial_depth_mm = 0.6')
        self.write("cut.toml", text.replace("spindle_rpm = 5000", "spindle_rpm = 19500"))
        done = self.run_program("dynamics", "cut.toml")
        result = self.summary("cut.dynamics")["result"]
        self.assertEqual(result["verdict"], "periodic")
        self.assertEqual(result["period"], {"teeth": 2, "turns": 1, "teeth_of_cut": 1})
        self.assertTrue(result["chatter"])
        self.assertIn("repeats with every turn only", done.stdout)

    def test_a_tool_that_is_thrown_out_is_no_answer(self):
        text = BENCHMARK.replace("mass_kg = 0.03993", "mass_kg = 1e-5")
        self.write("cut.toml", text.replace("frequency_Hz = 922", "frequency_Hz = 200"))
        done = self.run_program("dynamics", "cut.toml", code=1)
        summary = self.summary("cut.dynamics")
        self.assertEqual(summary["status"], "failed")
        self.assertIn("more than 100 mm from where it would rest", done.stderr)
        self.assertEqual(summary["result"]["verdict"], "growing")
        self.assertLessEqual(keys_of(summary["result"]), {
            "verdict", "periodic", "chatter", "settles", "period", "turns",
            "steps_per_tooth", "linear_growth_per_turn", "growth_per_turn", "change_N"})
        self.assertIsNone(summary["result"]["change_N"])
        self.assertNotIn("peak", done.stdout)
        files = {p.name for p in (self.folder / "cut.dynamics").iterdir()}
        self.assertEqual(files, {"case.toml", "summary.json", "report.html",
                                 "once_per_turn.csv"})

    def test_few_turns_are_continued_until_the_motion_tells(self):
        _, summary = self.cut(0.2, code=0, more="[sampling]\nrevolutions = 2\n")
        self.assertEqual(summary["result"]["verdict"], "periodic")
        self.assertGreater(summary["result"]["turns"], 2)
        echo = (self.folder / "cut.dynamics/case.toml").read_text()
        self.assertIn("revolutions = 2\n", echo)

    def test_the_completed_case_answers_the_same(self):
        _, summary = self.cut(0.2, code=0)
        self.run_program("dynamics", "cut.dynamics/case.toml", "-o", "again")
        self.assertEqual(self.summary("again")["result"], summary["result"])

    def test_json(self):
        self.write("cut.toml", BENCHMARK)
        done = self.run_program("dynamics", "cut.toml", "--json")
        self.assertEqual(json.loads(done.stdout)["result"]["verdict"], "bounded")


class Commanded(InFolder):
    TABLE = (ROOT / "examples/runout_table_8mm/case.toml").read_text()

    def peaks(self, name, command):
        self.write(f"{name}.toml", self.TABLE + command)
        self.run_program("dynamics", f"{name}.toml", "-q")
        return [f["peak_Fy_N"] for f in self.summary(f"{name}.dynamics")["result"]["flutes"]]

    def test_a_table_of_a_sine_is_a_sine_wherever_its_middle_is(self):
        rows = "".join(f"{i},{30 + 13 * math.sin(math.radians(i))!r}\n" for i in range(360))
        self.write("command.csv", "angle_deg,command_um\n" + rows)
        lead = "lead_s = 0.0022679\n"
        table = self.peaks("table", '\n[command]\nshape = "table"\nfile = "command.csv"\n' + lead)
        sine = self.peaks("sine", "\n[command]\npeak_to_peak_um = 26\n" + lead)
        for a, b in zip(table, sine):
            self.assertAlmostEqual(a, b, delta=0.01)
        self.assertLess(abs(sine[0] - sine[1]), 2)
        echo = self.folder / "table.dynamics/case.toml"
        self.run_program("dynamics", echo, "-o", "again", "-q")
        self.assertEqual(self.summary("again")["result"],
                         self.summary("table.dynamics")["result"])

    def test_a_bad_table_is_named_with_its_line(self):
        self.write("command.csv", "angle_deg,command_um\n0,1\n90,2\n80,1\n")
        self.write("table.toml", self.TABLE +
                   '\n[command]\nshape = "table"\nfile = "command.csv"\n')
        said = self.run_program("dynamics", "table.toml", code=2).stderr
        self.assertIn("command.csv:4:1: the angle 80 deg does not come after 90 deg", said)

    def test_the_damping_of_the_coupling_is_a_key(self):
        """It acts above a kilohertz: a square wave shows it, a sine hardly."""
        square = '\n[command]\nshape = "square"\npeak_to_peak_um = 26\n'
        usual = self.peaks("usual", square)
        text = self.TABLE.replace("stroke_um = [0, 60]",
                                  "stroke_um = [0, 60]\ncoupling_damping_Ns_per_m = 4000")
        self.write("damped.toml", text + square)
        self.run_program("dynamics", "damped.toml", "-q")
        damped = self.summary("damped.dynamics")["result"]["flutes"]
        self.assertGreater(abs(damped[0]["peak_Fy_N"] - usual[0]), 1e-4)


if __name__ == "__main__":
    main()
