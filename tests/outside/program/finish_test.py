"""Roughness traces made here by a few lines of their own: does `calibrate` find the offsets?

[W-7] A sharp insert leaves straight flanks, so that the trace needs no blade that turns: at
y = 0 the rear clears and the tooth points along the feed."""
import math
import random

from in_folder import InFolder, main

CASE = """
[tool]
shape = "taper"
taper_deg = 45
teeth = {teeth}
diameter_mm = 63.0
helix_deg = 5.0
dish_deg = 0.8
[cut]
engagement = "slot"
axial_depth_mm = 1.0
feed_per_tooth_mm = 0.15
spindle_rpm = 1500
spindle_lead_deg = 0.03
[[surface_measurement]]
file = "trace.csv"
of = "finish"
{keys}
"""


def floor(x, offsets, f_z=0.15):
    """Height [mm] that the lowest of all flanks leaves at x [mm]."""
    up, lead = math.tan(math.radians(0.8)), math.tan(math.radians(0.03))
    feed = f_z * len(offsets)
    heights = []
    for j, offset in enumerate(offsets):
        for n in range(-2, 22):
            d = x - (n * feed + j * f_z)  # before the lowest point, along the feed
            heights.append((d if d > 0 else -d * up) - offset - lead * d)
    return min(heights)


def trace(offsets, turns=7, noise=0.05e-3, sign=1.0, seed=1, wave=0.0):
    rng = random.Random(seed)
    start = rng.random()
    rows = ["x_mm,z_um"]
    points = []
    for i in range(int(turns * 300)):
        x = i * 0.15 * len(offsets) / 300
        z = floor(x + start, offsets) + rng.gauss(0, noise) + 0.4e-3 * x
        z += wave * math.sin(2 * math.pi * x / (4.3 * 0.15 * len(offsets)) + 1.0)
        points.append((sign * x, 1e3 * z))
    for x, z in sorted(points):
        rows.append(f"{x:.5f},{z:.5f}")
    return "\n".join(rows) + "\n"


class Finish(InFolder):
    def answer(self, text, teeth=5, keys="floor_y_mm = 0", code=0):
        self.write("trace.csv", text)
        self.write("case.toml", CASE.format(teeth=teeth, keys=keys))
        return self.said(code)

    def said(self, code=0):
        done = self.run_program("calibrate", "case.toml", "-o", "out", "--no-report", code=code)
        return done.stdout + done.stderr

    def found(self):
        return self.summary("out")["result"]["finish"][0]

    def test_offsets_of_inserts(self):
        offsets = [0.0, 0.0011, -0.0006, 0.0003, 0.0007]
        self.answer(trace(offsets))
        found = self.found()
        self.assertFalse(found["numbered"])
        for k, tooth in enumerate(found["teeth"]):
            expected = offsets[(1 + k) % 5] - offsets[1]
            self.assertTrue(tooth["writes"])
            offset = tooth["offset_mm"]
            self.assertLessEqual(abs(offset["value"] - expected), 4 * offset["se"] + 2e-6)
        self.assertAlmostEqual(found["feed_mm"]["value"], 0.75, delta=1e-3)
        self.assertAlmostEqual(found["rms_um"], 0.05, delta=0.01)
        runout = (self.folder / "out/runout.toml").read_text()
        self.assertIn("axial_offsets_mm = [0.000000, -0.0017", runout)
        self.assertIn("nothing tells which one it is", runout)

    def test_a_waviness_is_taken_out(self):
        """[W-10] Three micrometres over 4.3 turns, ten times the marks."""
        offsets = [0.0, 0.0011, -0.0006, 0.0003, 0.0007]
        told = self.answer(trace(offsets, turns=17, wave=1.5e-3))
        self.assertIn("waviness", told)
        found = self.found()
        self.assertAlmostEqual(found["waviness_um"], 3.0, delta=0.6)
        for k, tooth in enumerate(found["teeth"]):
            expected = offsets[(1 + k) % 5] - offsets[1]
            offset = tooth["offset_mm"]
            self.assertLessEqual(abs(offset["value"] - expected), 4 * offset["se"] + 2e-6)
            self.assertLess(offset["se"], 3e-5)
        self.answer(trace(offsets))
        self.assertEqual(self.found()["waviness_um"], 0)

    def test_a_tooth_that_writes_nothing(self):
        offsets = [0.0, 0.001, -0.009, 0.0005, 0.0]
        self.answer(trace(offsets))
        teeth = self.found()["teeth"]
        self.assertEqual([tooth["writes"] for tooth in teeth], [True, False, True, True, True])
        self.assertGreater(teeth[1]["at_most_mm"], offsets[2] - offsets[1])
        self.assertLess(teeth[1]["at_most_mm"], 0)
        self.assertFalse((self.folder / "out/runout.toml").exists())

    def test_many_teeth_are_no_long_work(self):
        offsets = [0.0003 * ((7 * j) % 5) for j in range(12)]
        self.answer(trace(offsets), teeth=12)
        self.assertEqual(len(self.found()["teeth"]), 12)

    def test_plan_refuses_a_trace(self):
        self.write("trace.csv", trace([0.0] * 5))
        self.write("case.toml", CASE.format(teeth=5, keys="floor_y_mm = 0"))
        done = self.run_program("plan", "case.toml", code=2)
        self.assertIn("plan reads no roughness trace", done.stderr)

    def planned(self, offsets, plan, code=0):
        text = CASE.format(teeth=5, keys="").split("[[surface_measurement]]")[0]
        self.write("plan.toml", text + f"[runout]\naxial_offsets_mm = {offsets}\n[surface]\nfloor_y_mm = [0]\n"
                   "[plan]\n" + plan)
        done = self.run_program("plan", "plan.toml", "-o", "plan", "--no-report", code=code)
        return self.summary("plan")["result"] if code == 0 else done.stderr

    def test_which_feed_keeps_a_limit(self):
        """[W-9] Ra of the flanks of this file, and the feed at which it is the limit."""
        offsets = [0.0, 0.0011, -0.0006, 0.0003, 0.0007]

        def Ra(f_z, of):
            heights = [floor(i * 5 * f_z / 4000, of, f_z) for i in range(4000)]
            mean = sum(heights) / len(heights)
            return 1e3 * sum(abs(h - mean) for h in heights) / len(heights)

        result = self.planned(offsets, "largest_Ra_um = 0.5\n")
        self.assertEqual(result["of"], "finish")
        for feed in result["feeds"][::5]:
            f_z = feed["feed_per_tooth_mm"]
            self.assertAlmostEqual(feed["Ra_um"], Ra(f_z, offsets), delta=0.01 * feed["Ra_um"])
            self.assertAlmostEqual(feed["Ra_alike_um"], Ra(f_z, [0.0] * 5), delta=0.01 * feed["Ra_alike_um"])
        largest = result["largest_feed"]
        self.assertAlmostEqual(Ra(largest["as_is_mm"], offsets), 0.5, delta=0.01)
        self.assertAlmostEqual(Ra(largest["alike_mm"], [0.0] * 5), 0.5, delta=0.01)

    def test_a_plan_of_a_finish_needs_a_line(self):
        text = CASE.format(teeth=5, keys="").split("[[surface_measurement]]")[0]
        self.write("plan.toml", text + '[plan]\nof = "finish"\n')
        done = self.run_program("plan", "plan.toml", code=2)
        self.assertIn("floor_y_mm is missing", done.stderr)
        told = self.planned([0.0] * 5, 'of = "finish"\nmax_force_N = 100\n', code=2)
        self.assertIn("has no meaning for of = \"finish\"", told)

    def test_a_trace_against_the_feed_is_told(self):
        out = self.answer(trace([0.0, 0.0011, -0.0006, 0.0003, 0.0007], sign=-1.0))
        self.assertIn("against_the_feed", out)

    def test_another_shape_is_told(self):
        text = trace([0.0, 0.0011, -0.0006, 0.0003, 0.0007])
        self.write("trace.csv", text)
        self.write("case.toml", CASE.format(teeth=5, keys="floor_y_mm = 0").replace(
            "dish_deg = 0.8", "dish_deg = 1.3"))
        self.assertIn("other_marks", self.said())

    def test_traces_that_tell_nothing(self):
        flat = "x_mm,z_um\n" + "".join(f"{i * 0.003:.4f},0\n" for i in range(2000))
        self.assertIn("are not on the trace", self.answer(flat, code=1))
        few = "x_mm,z_um\n" + "".join(f"{i * 0.2:.4f},{i % 3}\n" for i in range(40))
        self.assertIn("readings on the mark of a tooth", self.answer(few, code=1))
        self.assertIn("feeds of a turn long", self.answer(trace([0.0] * 5, turns=2), code=1))

    def test_where_the_trace_lies_must_be_said_once(self):
        text = trace([0.0] * 5)
        self.assertIn("neither of floor_y_mm and height_mm", self.answer(text, keys="", code=2))
        self.assertIn("both of floor_y_mm and height_mm", self.answer(
            text, keys="floor_y_mm = 0\nheight_mm = 0.5", code=2))
        self.assertIn("beside the tool", self.answer(text, keys="floor_y_mm = 32", code=2))
        self.assertIn('must be "up" or "down" for a trace on the wall', self.answer(
            text, keys="height_mm = 0.5", code=2))
        self.assertIn("a wall and a finish are two cases", self.answer(
            text, keys='floor_y_mm = 0\n[[surface_measurement]]\nfile = "trace.csv"', code=2))


if __name__ == "__main__":
    main()
