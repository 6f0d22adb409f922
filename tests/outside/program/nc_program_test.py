"""program: what it answers, what it warns of and what it leaves out, as a user meets it."""
import csv
import json
import math
import struct

from in_folder import InFolder, ROOT, main, program, tables

PART = """G21 G90 G17
T1 M6
S4000 M3
G0 X-10. Y0. Z5.
G0 Z-2.
G1 X20. F320
Y15.
T2 M6
S4000 M3
G0 X40. Y40. Z5.
G1 X45. Z-2. F300
M30
"""


class NcProgram(InFolder):
    def case(self, text=PART, **changes):
        self.write("part.nc", text)
        table = {"file": "part.nc", "tool_number": 1, "ignore_tools": [2],
                 **changes.pop("program", {})}
        table = {key: value for key, value in table.items() if value is not None}
        given = tables(**{"program": table,
                          "stock": {"box_mm": [[0, -30, -10], [60, 60, 0]]}, **changes})
        given["runout"] = {k: v for k, v in given["runout"].items() if v is not None}
        del given["cut"]
        self.write("case.toml", program.case_text("a program", given))

    def answer(self, code=0):
        self.run_program("program", "case.toml", "-o", "out", "-q", "--no-report", code=code)
        summary = self.summary("out")
        return summary["result"], {w["code"]: w["message"] for w in summary["warnings"]}

    def rows(self, file):
        with open(self.folder / "out" / file, newline="") as stream:
            return list(csv.DictReader(stream))

    def test_the_answer_and_its_files(self):
        self.case()
        result, warnings = self.answer()
        self.assertEqual({p.name for p in (self.folder / "out").iterdir()},
                         {"case.toml", "summary.json", "moves.csv", "lines.csv", "steps.csv",
                          "arcs.csv"})
        self.assertNotIn("not_used", warnings)
        lines = {int(row["line"]): row for row in self.rows("lines.csv")}
        self.assertEqual(lines[6]["text"], "G1 X20. F320")
        steps = [row for row in self.rows("steps.csv") if float(row["a_p_mm"]) > 0]
        most = max(steps, key=lambda row: float(row["peak_xy_N"]))
        peak = result["peaks"]["peak_xy_N"]
        self.assertEqual(float(most["peak_xy_N"]), peak["value"])
        self.assertEqual(int(most["line"]), peak["line"])
        self.assertEqual(max(float(lines[n]["peak_xy_N"]) for n in lines), peak["value"])
        self.assertEqual(float(lines[11]["peak_xy_N"]), 0)  # of the tool that is ignored

    def test_a_limit_is_named_with_its_lines(self):
        self.case()
        most = self.answer()[0]["peaks"]["peak_xy_N"]["value"]
        self.case(limits={"peak_force_N": 0.9 * most})
        result, warnings = self.answer()
        self.assertIn("limit_broken", warnings)
        (broken,) = result["limits_broken"]
        self.assertEqual(broken["limit"], "peak_force_N")
        self.assertAlmostEqual(broken["worst"], most, delta=1e-9 * most)
        beyond = [int(row["line"]) for row in self.rows("lines.csv")
                  if row["broken"] == "peak_force_N"]
        self.assertEqual(broken["lines"], beyond)
        self.case(limits={"peak_force_N": 1.1 * most})
        self.assertEqual(self.answer()[0]["limits_broken"], [])

    def test_lines_that_chatter_are_named(self):
        self.case()
        result, warnings = self.answer()
        self.assertNotIn("chatter", result)
        self.assertEqual({row["chatter_margin"] for row in self.rows("steps.csv")}, {""})
        for mass, chatters in ((0.002, True), (50.0, False)):
            self.case()
            modes = "".join(f'\n[[mode]]\nbody = "tool"\naxis = "{axis}"\nmass_kg = {mass}\n'
                            "frequency_Hz = 900\ndamping_ratio = 0.02\n" for axis in "xy")
            self.write("case.toml", (self.folder / "case.toml").read_text() + modes)
            result, warnings = self.answer()
            self.assertEqual("chatter" in warnings, chatters)
            self.assertEqual(result["chatter"]["looked_at"], 1)
            margins = {}
            for row in self.rows("steps.csv"):
                if row["chatter_margin"]:
                    margins.setdefault(int(row["line"]), []).append(float(row["chatter_margin"]))
            beyond = {line: min(all) for line, all in margins.items() if min(all) < 1}
            named = {one["line"]: one["margin"] for one in result["chatter"]["lines"]}
            self.assertEqual(named, beyond)
            self.assertEqual(bool(beyond), chatters)

    def test_measured_responses_are_as_good_as_their_modes(self):
        """Responses of the modes in the case above, with the same limits as these."""
        mass, frequency, damping = 0.002, 900, 0.02
        modes = responses = ""
        for axis in "xy":
            lines = ["freq_Hz,re_m/N,im_m/N"]
            for i in range(1200):
                w, w0 = 2 * math.pi * (300 + i), 2 * math.pi * frequency
                H = 1 / (mass * (w0 ** 2 - w ** 2 + 2j * damping * w0 * w))
                lines.append(f"{300 + i},{H.real!r},{H.imag!r}")
            self.write(f"{axis}.csv", "\n".join(lines) + "\n")
            responses += f'\n[[measured_frf]]\nfile = "{axis}.csv"\naxis = "{axis}"\n'
            modes += (f'\n[[mode]]\nbody = "tool"\naxis = "{axis}"\nmass_kg = {mass}\n'
                      f"frequency_Hz = {frequency}\ndamping_ratio = {damping}\n")
        answers = []
        for vibrates in (modes, responses):
            self.case()
            self.write("case.toml", (self.folder / "case.toml").read_text() + vibrates)
            answers.append(self.answer()[0]["chatter"])
        first, second = answers
        self.assertTrue(first["lines"])
        self.assertEqual([one["line"] for one in first["lines"]],
                         [one["line"] for one in second["lines"]])
        for a, b in zip(first["lines"], second["lines"]):
            self.assertAlmostEqual(b["limit_depth_mm"], a["limit_depth_mm"],
                                   delta=0.03 * a["limit_depth_mm"])

    def found(self, names, found, matrix, **more):
        """A summary.json as identify writes it."""
        covariance = {"law": "linear_edge", "chip_model": "trochoidal", "teeth": 2, "modes": [],
                      "names": names, "found": found, "matrix": matrix,
                      "interval_factors": [1.96] * len(names), "not_found": [], **more}
        self.write("found/summary.json", json.dumps(
            {"trochoid": "0", "command": "identify", "status": "ok",
             "result": {"covariance": covariance}}))

    def test_intervals_follow_from_the_covariance(self):  # [N-20]
        """By differences of whole runs."""
        names = ["force.K_tc_MPa", "force.K_te_N_per_mm", "runout.radial_offsets_mm[2]"]
        matrix = [[900.0, -3.0, 0.0], [-3.0, 0.04, 1e-4], [0.0, 1e-4, 1e-6]]
        self.found(names, [2620, 7, -0.008], matrix)
        self.case()
        peaks = self.answer()[0]["peaks"]
        self.assertNotIn("low", peaks["peak_xy_N"])
        slopes = []
        for (table, key), value, step in (
                (("force", "K_tc_MPa"), 2620, 10), (("force", "K_te_N_per_mm"), 7, 0.1),
                (("runout", "radial_offsets_mm"), -0.008, 2e-4)):
            ends = []
            for sign in (-1, 1):
                changed = value + sign * step
                self.case(**{table: {key: changed if table == "force" else [0, changed]}})
                ends.append(self.answer()[0]["peaks"])
            slopes.append({q: (ends[1][q]["value"] - ends[0][q]["value"]) / (2 * step)
                           for q in peaks})
        self.case(program={"covariance": "found"})
        result, warnings = self.answer()
        self.assertNotIn("other_value", warnings)
        for q, peak in result["peaks"].items():
            if peak["value"] == 0:  # nothing bends here
                continue
            g = [slope[q] for slope in slopes]
            half = 1.96 * sum(a * matrix[i][j] * b for i, a in enumerate(g)
                              for j, b in enumerate(g)) ** 0.5
            self.assertEqual(peak["value"], peaks[q]["value"])
            self.assertAlmostEqual(peak["high"] - peak["value"], half, delta=0.02 * half + 1e-12)
            self.assertAlmostEqual(peak["value"] - peak["low"], half, delta=0.02 * half + 1e-12)
        self.assertGreater(result["peaks"]["peak_chip_mm"]["high"], peaks["peak_chip_mm"]["value"])

    def test_intervals_of_every_kind_of_runout(self):  # [N-20]
        """Eccentricity and tilt go by their components."""
        def runout(e, t, deep):
            return {"radial_offsets_mm": None, "axial_offsets_mm": [0, deep],
                    "eccentricity_mm": math.hypot(*e),
                    "angle_deg": math.degrees(math.atan2(e[1], e[0])),
                    "tilt_deg": math.degrees(math.atan(math.hypot(*t))),
                    "tilt_angle_deg": math.degrees(math.atan2(t[1], t[0]))}

        def peak(x):
            self.case(runout=runout(x[0:2], x[2:4], x[4]))
            return self.answer()[0]["peaks"]["peak_xy_N"]["value"]

        names = ["runout.e_x_mm", "runout.e_y_mm", "runout.t_x", "runout.t_y",
                 "runout.axial_offsets_mm[2]"]
        found = [0.004, 0.003, 0.0004, -0.0003, -0.02]
        sd = [2e-4, 3e-4, 4e-5, 3e-5, 2e-3]
        for i, (name, step) in enumerate(zip(names, sd)):
            ends = [peak([v + sign * step * (i == k) for k, v in enumerate(found)])
                    for sign in (-1, 1)]
            # The others are nearly certain, so that the interval is of this one.
            self.found(names, found, [[(s if k == i else 1e-4 * s) ** 2 * (j == k)
                                       for k, s in enumerate(sd)] for j in range(5)])
            self.case(runout=runout(found[0:2], found[2:4], found[4]),
                      program={"covariance": "found"})
            told = self.answer()[0]["peaks"]["peak_xy_N"]
            half = 1.96 * abs(ends[1] - ends[0]) / 2
            with self.subTest(name):
                self.assertGreater(half, 1e-4)  # it counts
                self.assertAlmostEqual(told["high"] - told["value"], half, delta=0.05 * half)

    def test_walls_that_stay(self):
        """The line along +x leaves both walls of a slot, the one along +y only stock behind."""
        self.case()
        result, _ = self.answer()
        self.assertNotIn("walls", result)
        self.case(cutter_body={"overhang_mm": 30, "flute_length_mm": 20, "shank_diameter_mm": 8,
                               "equivalent_diameter_mm": 6.4, "youngs_modulus_GPa": 210})
        result, _ = self.answer()
        rows = [row for row in self.rows("steps.csv") if row["wall_left_most_um"]]
        self.assertEqual({row["line"] for row in rows}, {"6", "7"})
        for side in ("left", "right"):
            most = max(float(row[f"wall_{side}_most_um"]) for row in rows if row["line"] == "6")
            (line,) = [w for w in result["walls"]["lines"] if (w["line"], w["side"]) == (6, side)]
            self.assertEqual(line["most_um"], most)
            self.assertLess(line["least_um"], line["mean_um"])
            self.assertLess(line["mean_um"], line["most_um"])
        worst = max(result["walls"]["lines"], key=lambda w: w["most_um"])
        most = result["walls"]["most"]
        self.assertEqual((most["error_um"], most["line"], most["side"]),
                         (worst["most_um"], worst["line"], worst["side"]))

    def test_what_the_covariance_says_of_another_tool(self):
        self.found(["force.K_tc_MPa"], [1800], [[100.0]], not_found=[
            {"name": "runout.radial_offsets_mm[2]", "why": "too short"}])
        limit = {"limits": {"peak_force_N": 1.001 * self.most()}}
        self.case(program={"covariance": "found/summary.json"}, **limit)
        _, warnings = self.answer()
        self.assertIn("found 1800", warnings["other_value"])
        self.assertIn("radial_offsets_mm[2]", warnings["not_in_the_interval"])
        self.assertIn("may go beyond", warnings["limit_within_interval"])
        for change, what in (({"law": "power"}, "of the law power"), ({"teeth": 3}, "of 3 teeth"),
                             ({"law": ""}, "no coefficients")):
            self.found(["force.K_tc_MPa"], [1800], [[100.0]], **change)
            done = self.run_program("program", "case.toml", "-o", "none", code=2)
            self.assertIn(what if change != {"law": ""} else "names nothing", done.stderr)
            self.assertFalse((self.folder / "none").exists())

    def most(self):
        self.case()
        return self.answer()[0]["peaks"]["peak_xy_N"]["value"]

    def test_a_tool_that_is_only_loaded_needs_no_case(self):
        before = self.most()
        self.case(PART.replace("S4000 M3\nG0 X-10.", "T9\nS4000 M3\nG0 X-10.", 1))
        result, warnings = self.answer()
        self.assertNotIn("tool_not_described", warnings)
        self.assertEqual(result["peaks"]["peak_xy_N"]["value"], before)
        self.assertEqual(result["tools"], ["1", "2"])

    def test_what_is_not_used_is_said(self):
        self.case(machine={"max_jerk_m_per_s3": [50, 50, 50], "corner_tolerance_mm": 0.1})
        said = self.answer()[1]
        self.assertIn("max_jerk_m_per_s3", said["not_used"])
        self.assertIn("corner_tolerance_mm", said["not_used"])
        self.assertIn("upper bounds", said["no_machine"])
        self.case(machine={"max_acceleration_m_per_s2": [3, 3, 2], "corner_tolerance_mm": 0.1})
        said = self.answer()[1]
        self.assertNotIn("not_used", said)
        self.assertNotIn("no_machine", said)

    def test_a_machine_that_brakes(self):
        """From rest: v^2 = 2 a s, up to the feed; the time is that of a trapezium."""
        self.case()
        whole, _ = self.answer()
        self.case(machine={"max_acceleration_m_per_s2": [0.05, 0.05, 0.05]})
        result, _ = self.answer()
        self.assertGreater(result["time_s"], whole["time_s"])
        line = [row for row in self.rows("steps.csv") if row["line"] == "7"][0]
        v = (2 * 0.05 * float(line["y_mm"]) * 1e-3) ** 0.5
        self.assertAlmostEqual(float(line["feed_mm_per_min"]), min(320, v * 60e3), delta=1e-6)
        self.assertEqual(float(line["programmed_feed_mm_per_min"]), 320)

    def test_new_feeds(self):
        self.case()
        before, _ = self.answer()
        limit = 0.8 * before["peaks"]["peak_xy_N"]["value"]
        changes = {"limits": {"peak_force_N": limit}}
        self.case(feed={"write": "new.nc"}, **changes)
        for _ in range(2):  # over an old answer as well
            result, _ = self.answer()
        feed = result["feed"]
        self.assertEqual(feed["file"], "new.nc")
        self.assertEqual(feed["before"]["peak_xy_N"], before["peaks"]["peak_xy_N"]["value"])
        self.assertLessEqual(feed["after"]["peak_xy_N"], limit)
        self.assertGreater(feed["after"]["time_s"], feed["before"]["time_s"])
        self.assertIn("peak_force", {row["held_by"] for row in self.rows("feeds.csv")})
        new = (self.folder / "out/new.nc").read_text()
        self.assertGreater(len(new.splitlines()), len(PART.splitlines()))
        for number, line in enumerate(PART.splitlines(), 1):
            if number not in (6, 7):  # those that are fed in stock
                self.assertIn(line, new.splitlines())
        self.case(new, **changes)
        again, _ = self.answer()
        self.assertEqual(again["peaks"]["peak_xy_N"]["value"], feed["after"]["peak_xy_N"])
        self.assertEqual(again["time_s"], feed["after"]["time_s"])

    def test_the_written_pocket_keeps_its_limits(self):
        """Its steps are others than those for which the feeds were found."""
        pocket = ROOT / "examples/pocket"
        case = (pocket / "case.toml").read_text().replace('"../', f'"{(ROOT / "examples").as_posix()}/')
        limits, feed = (pocket / "feed.toml").read_text().split("[feed]")
        self.write("part.nc", (pocket / "part.nc").read_text())
        self.write("pocket.toml", case)
        limits = limits.replace('"case.toml"', '"pocket.toml"')
        self.write("case.toml", limits + "[feed]" + feed)
        self.answer()
        self.write("part.nc", (self.folder / "out/part_feed.nc").read_text())
        self.write("case.toml", limits)
        result, warnings = self.answer()
        self.assertEqual(result["limits_broken"], [])
        self.assertNotIn("limit_broken", warnings)

    def test_thin_cuts_have_the_forces_of_simulate(self):  # [N-30]
        """The tooth finds the cusp that the turn before left past the wall of the cut."""
        deep = 0.05
        for side, block in (("down", [[0, -30, -10], [60, -4 + deep, 0]]), ("up", [[0, 4 - deep, -10], [60, 30, 0]])):
            self.case("G21 G90\nT1 M6\nS4000 M3\nG0 X-10. Y0. Z5.\nG0 Z-2.\nG1 X20. F800\nM30\n",
                      program={"file": "part.nc", "tool_number": 1, "ignore_tools": None},
                      stock={"box_mm": block}, runout={"radial_offsets_mm": [0, 0.006]})
            self.answer()
            step = [row for row in self.rows("steps.csv") if float(row["a_p_mm"]) > 0][-1]
            given = tables(cut={"engagement": side, "radial_depth_mm": deep, "axial_depth_mm": 2.0,
                                "feed_per_tooth_mm": 0.1, "spindle_rpm": 4000},
                           runout={"radial_offsets_mm": [0, 0.006]})
            given["runout"] = {k: v for k, v in given["runout"].items() if v is not None}
            self.write("turn.toml", program.case_text("a turn", given))
            self.run_program("simulate", "turn.toml", "-o", "turn", "-q", "--no-report")
            turn = self.summary("turn")["result"]
            self.assertAlmostEqual(float(step["peak_xy_N"]), turn["peak_xy_N"], delta=2e-3 * turn["peak_xy_N"])
            self.assertAlmostEqual(float(step["torque_mean_Nm"]), turn["exact_mean_torque_Nm"],
                                   delta=1e-3 * turn["exact_mean_torque_Nm"])

    def test_limits_of_what_is_not_known(self):
        """A limit that nothing tells about would be kept by any cut."""
        for key, needs in (("deflection_um", "cutter_body"), ("bending_moment_Nm", "gauge_length_mm")):
            self.case(limits={key: 10})
            said = self.run_program("check", "case.toml", code=2).stderr
            self.assertIn(f"limits.{key}", said)
            self.assertIn(needs, said)

    def test_a_tool_that_is_left_out_is_told(self):
        self.case()
        self.assertIn("what it would cut stays", self.answer()[1]["tool_ignored"])

    def test_one_feed_a_line(self):
        self.case()
        limit = 0.8 * self.answer()[0]["peaks"]["peak_xy_N"]["value"]
        self.case(feed={"write": "new.nc", "split_lines": False}, limits={"peak_force_N": limit})
        self.answer()
        new = (self.folder / "out/new.nc").read_text()
        self.assertEqual(len(new.splitlines()), len(PART.splitlines()))
        self.assertNotEqual(new, PART)

    def test_a_limit_out_of_reach(self):
        self.case(feed={"write": "new.nc"}, limits={"peak_force_N": 1, "chip_mm": [0.05, 0.1]})
        result, warnings = self.answer()
        self.assertEqual(result["feed"]["not_reachable"], [6, 7])
        self.assertIn("6, 7", warnings["limit_not_reachable"])
        self.assertIn("6, 7", warnings["rubbing"])

    def test_the_new_program_has_a_name_of_its_own(self):
        for name in ("steps.csv", "Steps.CSV"):  # some disks do not tell a from A
            self.case(feed={"write": name}, limits={"peak_force_N": 100})
            run = self.run_program("program", "case.toml", "-o", "out", "-q", code=2)
            self.assertIn("feed.write", run.stderr)
            self.assertFalse((self.folder / "out").exists())

    def test_a_power_curve_is_a_limit(self):
        curve = {"power_curve_W": [[0, 0], [4000, 20]]}
        self.case(machine=curve)
        result, warnings = self.answer()
        self.assertNotIn("not_used", warnings)
        self.assertIn("power_curve_W", warnings["limit_broken"])
        broken, = result["limits_broken"]
        self.assertEqual(broken["limit"], "power_curve_W")
        self.assertLessEqual(broken["allowed"], 20)
        self.assertGreater(broken["worst"], broken["allowed"])
        powers = {int(r["line"]): float(r["power_W"]) for r in self.rows("lines.csv")}
        self.assertEqual(set(broken["lines"]), {n for n, p in powers.items() if p > 20})
        self.case(machine=curve, limits={"peak_force_N": 1e6}, feed={"write": "new.nc"})
        warnings = self.answer()[1]
        self.assertNotIn("not_used", warnings)
        self.assertIn("power", {row["held_by"] for row in self.rows("feeds.csv")})

    def test_without_forces_there_are_the_moves(self):
        self.case(program={"ignore_tools": None})
        result, warnings = self.answer(code=1)
        self.assertIn("tool_not_described", warnings)
        self.assertNotIn("tool_not_in_program", warnings)
        self.assertNotIn("peaks", result)
        self.assertEqual({p.name for p in (self.folder / "out").iterdir()},
                         {"case.toml", "summary.json", "moves.csv"})

    def test_a_tool_that_the_program_does_not_have_is_named(self):
        self.case(program={"tool_number": 7})
        self.assertIn("the tool 7, which", self.answer(code=1)[1]["tool_not_in_program"])

    def test_new_feeds_without_a_limit_are_doubted(self):
        self.case(limits={}, feed={"write": "new.nc"})
        self.assertIn("no limit", self.answer()[1]["no_limits"])
        self.case(limits={"peak_tooth_N": 1e6}, feed={"write": "new.nc"})
        self.assertNotIn("no_limits", self.answer()[1])

    def test_any_cutter_is_computed(self):
        alike = {"shape": "cylinder", "teeth": 2, "diameter_mm": 10.0}
        for tool in ({"shape": "ball"}, {"shape": "bull_nose", "corner_radius_mm": 1.0},
                     {"shape": "taper", "taper_deg": 10.0},
                     {**alike, "helix_deg": [30.0, 35.0]},
                     {**alike, "serration": {"shape": "sine", "amplitude_mm": 0.2,
                                             "wavelength_mm": 1.5}}):
            with self.subTest(tool=tool):
                self.case(tool=tool)
                result, _ = self.answer()
                self.assertGreater(result["peaks"]["peak_xy_N"]["value"], 10)
                missing = result["stock_before_mm3"] - result["stock_after_mm3"]
                self.assertLess(abs(result["removed_mm3"] - missing), 0.03 * missing)

    def test_a_body_in_stl_is_a_stock(self):
        self.case()
        box = self.answer()[0]
        for binary in (False, True):
            self.write_body("stock.stl", binary, (0, -30, -10), (60, 60, 0))
            self.case(stock={"file": "stock.stl", "cell_mm": 0.5})
            body, warnings = self.answer()
            self.assertNotIn("stock_undercut", warnings)
            self.assertAlmostEqual(body["stock_before_mm3"], box["stock_before_mm3"], delta=1)
            self.assertAlmostEqual(body["peaks"]["peak_xy_N"]["value"],
                                   box["peaks"]["peak_xy_N"]["value"], delta=0.5)

    def test_a_body_that_is_open_is_refused(self):
        self.write_body("stock.stl", True, (0, -30, -10), (60, 60, 0), faces=11)
        self.case(stock={"file": "stock.stl"})
        told = self.run_program("program", "case.toml", "-o", "out", code=2).stderr
        self.assertIn("stock.stl: the surface is not closed: 3 edges", told)
        for text, why in (("solid x\nvertex 1 2\n", "line 3: a vertex must have three numbers"),
                          ("solid x\n", "it has no face"), ("PK", "this is no STL")):
            self.write("stock.stl", text)
            told = self.run_program("program", "case.toml", "-o", "out", code=2).stderr
            self.assertIn(why, told)

    def write_body(self, name, binary, low, high, faces=12):
        corners = [[(high if i >> k & 1 else low)[k] for k in range(3)] for i in range(8)]
        quads = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2),
                 (1, 3, 7, 5))
        all_faces = [[corners[i] for i in t] for q in quads
                     for t in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))][:faces]
        path = self.folder / name
        if binary:
            data = bytes(80) + struct.pack("<I", len(all_faces))
            for face in all_faces:
                data += struct.pack("<12fH", 0, 0, 0, *(x for p in face for x in p), 0)
            path.write_bytes(data)
            return
        lines = ["solid box"]
        for face in all_faces:
            lines += ["facet normal 0 0 0", "outer loop"]
            lines += [f"vertex {p[0]:e} {p[1]:e} {p[2]:e}" for p in face]
            lines += ["endloop", "endfacet"]
        path.write_text("\n".join([*lines, "endsolid box", ""]))

    def test_a_program_that_cuts_nothing_has_no_good_answer(self):
        self.case(stock={"box_mm": [[0, -30, -10], [60, 60, -5]]})
        self.answer(code=1)
        self.assertEqual(self.summary("out")["message"],
                         "No feed move of the program cuts anything: compare the places of "
                         "the moves with [stock] and origin_mm.")

    def test_places(self):
        self.case(program={"file": "part.nc", "tool_number": 1, "ignore_tools": [2],
                           "places": [[6, 0.5], [7, 0.5]]})
        self.answer()
        places = self.rows("places.csv")
        self.assertEqual([int(row["line"]) for row in places], [6, 7])
        for row, x in zip(places, (5, 20)):
            self.assertAlmostEqual(float(row["x_mm"]), x, delta=1e-9)
        arcs = [row for row in self.rows("place_arcs.csv") if row["place"] == "0"]
        self.assertEqual([(float(a["from_deg"]), float(a["to_deg"])) for a in arcs], [(0, 180)])
        self.case(program={"file": "part.nc", "tool_number": 1, "ignore_tools": [2],
                           "places": [[6, 0.5], [999, 0.5]]})
        said = self.run_program("program", "case.toml", "-o", "none", "-q", code=2).stderr
        self.assertIn("case.toml: program.places entry 2: line 999 of the program has no move with a feed",
                      said)
        self.case(PART.replace("G1 X20. F320", "G1 X20. F320\nG1 X20."),
                  program={"file": "part.nc", "tool_number": 1, "ignore_tools": [2],
                           "places": [[7, 0.5]]})
        said = self.run_program("program", "case.toml", "-o", "none", "-q", code=2).stderr
        self.assertIn("entry 1: line 7", said, "a move without length has no place")


if __name__ == "__main__":
    main()
