"""program with a record made while the program ran: where it lies, and which coefficients it tells.

Forces of the cuts come from `simulate`, a turn each, repeated over the time that `program` gives
each move; so the record knows nothing of steps, arcs and alignment.
"""
import csv
import math
import random

from in_folder import InFolder, main, program, tables

RPM, RATE = 4000, 4103.0
TRUE = {"law": "linear_edge", "K_tc_MPa": 2620, "K_rc_MPa": 1560, "K_ac_MPa": 331,
        "K_te_N_per_mm": 7, "K_re_N_per_mm": 3, "K_ae_N_per_mm": 1}
#: Passes over a block of 14 mm: y, direction, side, feed.
#: (from, to) of the arc of each in degrees, where the block goes on before and behind.
PASSES = [(0.0, 1, (0.0, 180.0), 320),
          (6.0, -1, (60.0, 180.0), 480),
          (8.0, 1, (0.0, 60.0), 800)]
#: Stock that goes on before and behind: its wall is straight, where a short tooth ends earlier.
WHOLE = {((0.0, 180.0),): {"engagement": "slot"},
         ((60.0, 180.0),): {"engagement": "down", "radial_depth_mm": 6.0},
         ((0.0, 60.0),): {"engagement": "up", "radial_depth_mm": 2.0}}
TURNS = {}
TORQUES = {}
FIRST, LAST = -8.0, 22.0
LINES = ["G21 G90 G17", "T1 M6", f"S{RPM} M3"]
for y, way, _, feed in PASSES:
    start, end = (FIRST, LAST) if way > 0 else (LAST, FIRST)
    LINES += [f"G0 X{start} Y{y} Z5.", "G0 Z-2.", f"G1 X{end} F{feed}", "G0 Z5."]
LINES += ["M30"]


def arcs_at(side, way, x):
    """Arcs of a tool of radius 4 with its axis at x, in steps of an eighth of a millimetre."""
    ahead = round((14 - x if way > 0 else x) * 8) / 8  # block in front, up to its end
    since = round((x if way > 0 else 14 - x) * 8) / 8  # since the axis entered
    if since <= -4 or ahead <= 0:
        return []
    arcs = [side]
    if since < 0:
        near = math.degrees(math.asin(-since / 4))
        arcs = [(max(a, near), min(b, 180 - near)) for a, b in arcs]
    if ahead < 4:
        near = math.degrees(math.asin(ahead / 4))
        arcs = [(max(a, lo), min(b, hi)) for a, b in arcs for lo, hi in
                ((0.0, near), (180 - near, 180.0))]
    return [[a, b] for a, b in arcs if b - a > 0.1]


class Record(InFolder):
    def case(self, force=TRUE, **changes):
        self.write("part.nc", "\n".join(LINES) + "\n")
        given = tables(**{"program": {"file": "part.nc", "tool_number": 1},
                          "stock": {"box_mm": [[0, -30, -10], [14, 60, 0]]}, "force": force,
                          **changes})
        del given["cut"]
        return given

    def answer(self, given, measured=True, code=0, **keys):
        records = [{"file": "record.csv", **keys}] if measured else []
        self.write("case.toml", program.case_text("a record", given, records))
        done = self.run_program("program", "case.toml", "-o", "out", "-q", "--no-report", code=code)
        if code == 2:
            return done.stderr
        summary = self.summary("out")
        return summary["result"], {w["code"]: w["message"] for w in summary["warnings"]}

    def rows(self, file):
        with open(self.folder / "out" / file, newline="") as stream:
            return list(csv.DictReader(stream))

    def turn(self, side, way, feed, x, angles=360):
        """Forces over a turn, feed along +x, with the tool at x of the block, at even angles."""
        arcs = arcs_at(side, way, x)
        key = (side, way, feed, tuple(map(tuple, arcs)))
        if key not in TURNS:
            stock = WHOLE.get(tuple(map(tuple, arcs)), {"engagement": "arcs", "arcs_deg": arcs})
            self.write("turn.toml", program.case_text("a turn", tables(
                cut={**stock, "axial_depth_mm": 2.0,
                     "feed_per_tooth_mm": feed / RPM / 2, "spindle_rpm": RPM},
                sampling={"angles_deg": [360 / angles * i for i in range(angles)]})))
            self.run_program("simulate", "turn.toml", "-o", "turn", "-q", "--no-report")
            with open(self.folder / "turn/forces.csv", newline="") as stream:
                rows = list(csv.DictReader(stream))
            TURNS[key] = [[float(row[f"F{axis}_N"]) for axis in "xyz"] for row in rows]
            TORQUES[key] = self.summary("turn")["result"]["exact_mean_torque_Nm"]
        return TURNS[key]

    def make_record(self, before=0.7, stretch=1.0, offset=(3.0, -5.0, 2.0), noise=2.0, overrides=None, drift=0.0):
        """As a table dynamometer reads it: the reaction, offsets that drift, noise.

        overrides: by how much each pass takes longer, and a column with the line that runs."""
        self.answer(self.case(), measured=False)
        ends, time = [], before
        moves = self.rows("moves.csv")
        passes = iter(overrides or [1.0] * len(PASSES))
        for row in moves:
            slower = next(passes) if row["kind"] == "line" else 1.0
            ends.append((time, time + slower * stretch * float(row["time_s"] or 0), row))
            time = ends[-1][1]
        self.ends = ends
        line = lambda t: next((row["line"] for a, b, row in ends if a <= t < b), "0")
        chance = random.Random(1)
        fed = [end for end in ends if end[2]["kind"] == "line"]
        lines = ["time_s,Fx_N,Fy_N,Fz_N" + (",N_line" if overrides else "")]
        for i in range(int((time + 0.5) * RATE)):
            t = i / RATE
            F = [0.0, 0.0, 0.0]
            for (a, b, _), (_, way, side, feed), slower in zip(fed, PASSES, overrides or [1.0] * 3):
                if not a <= t < b:
                    continue
                feed = feed / slower / stretch
                x = FIRST + (LAST - FIRST) * ((t - a) / (b - a) if way > 0 else (b - t) / (b - a))
                if arcs_at(side, way, x):
                    one = self.turn(side, way, feed, x)
                    at = t * RPM / 60 % 1 * len(one)
                    k, u = int(at) % len(one), at - int(at)
                    now = [p + u * (q - p) for p, q in zip(one[k], one[(k + 1) % len(one)])]
                    F = [way * now[0], way * now[1], now[2]]
            lines.append(f"{t!r}," + ",".join(
                repr(o + drift * t / time - f + chance.gauss(0, noise)) for o, f in zip(offset, F)) +
                (f",{line(t)}" if overrides else ""))
        self.write("record.csv", "\n".join(lines) + "\n")

    AXES = {"dynamometer": {"axes": ["-x", "-y", "-z"]}}

    def test_a_record_is_laid_over_its_program(self):  # [N-23]
        self.make_record()
        result, warnings = self.answer(self.case(**self.AXES))
        record = result["record"]
        turn = 60 / RPM
        self.assertAlmostEqual(record["start_s"], 0.7, delta=0.5 * turn)
        self.assertAlmostEqual(record["stretch"], 1, delta=1e-3)
        self.assertGreater(record["correlation"], 0.99)
        self.assertAlmostEqual(record["mean_ratio"], 1, delta=0.01)
        self.assertAlmostEqual(record["peak_ratio"], 1, delta=0.05)
        self.assertNotIn("other_coefficients", warnings)
        steps = [row for row in self.rows("measured_steps.csv") if row["line"] == "6"]
        middle = steps[len(steps) // 2]
        for axis in ("x", "y", "z"):
            self.assertAlmostEqual(float(middle[f"F{axis}_mean_N"]),
                                   float(middle[f"computed_F{axis}_mean_N"]), delta=3)

        done = self.run_program("check", "case.toml")
        self.assertIn("samples", done.stdout)

    def test_coefficients_from_several_cuts(self):  # [N-24]
        """The case states others than made the record; it tells them all, and their errors."""
        self.make_record()
        stated = {**TRUE, "K_tc_MPa": 2200, "K_rc_MPa": 1400, "K_te_N_per_mm": 12}
        result, warnings = self.answer(self.case(stated, **self.AXES))
        self.assertIn("other_coefficients", warnings)
        found = {c["key"]: c for c in result["record"]["coefficients"]}
        for key in ("K_tc_MPa", "K_rc_MPa", "K_ac_MPa", "K_te_N_per_mm", "K_re_N_per_mm"):
            self.assertAlmostEqual(found[key]["found"], TRUE[key], delta=max(
                0.03 * TRUE[key], 2 * (found[key]["high"] - found[key]["found"])), msg=key)
        self.assertAlmostEqual(found["K_tc_MPa"]["found"], 2620, delta=0.03 * 2620)
        self.assertLess(found["K_tc_MPa"]["high"] - found["K_tc_MPa"]["low"], 0.2 * 2620)

    def test_channels_that_drift(self):
        """What they read in air before and after a cut tells what they read in it."""
        self.make_record(drift=25.0)
        result, _ = self.answer(self.case(**self.AXES))
        found = {c["key"]: c for c in result["record"]["coefficients"]}
        for key in ("K_tc_MPa", "K_rc_MPa", "K_re_N_per_mm"):
            self.assertAlmostEqual(found[key]["found"], TRUE[key], delta=max(
                0.03 * TRUE[key], 2 * (found[key]["high"] - found[key]["found"])), msg=key)
        self.assertLess(found["K_rc_MPa"]["high"] - found["K_rc_MPa"]["low"], 0.3 * 1560)

    def test_a_machine_that_is_slower(self):
        self.make_record(stretch=1.04)
        result, warnings = self.answer(self.case(**self.AXES))
        self.assertAlmostEqual(result["record"]["stretch"], 1.04, delta=0.004)
        self.assertIn("times as long", warnings["record_stretch"])

    def test_lines_that_the_record_has(self):  # [N-25]
        """A machine whose feeds were turned up and down lies over the program by its lines."""
        self.make_record(overrides=[1.3, 0.8, 1.6])
        by_lines, warnings = self.answer(self.case(**self.AXES), line_column="N_line")
        record = by_lines["record"]
        self.assertEqual(record["numbers"], "line")
        self.assertGreater(record["correlation"], 0.95)
        self.assertIn("line 6 (1.3 times as long)", warnings["feed_override"])
        self.assertNotIn("other_coefficients", warnings)
        numbered = "\n".join(f"N{10 * i + 5} {line}" for i, line in enumerate(LINES)) + "\n"
        rows = (self.folder / "record.csv").read_text().splitlines()
        self.write("record.csv", "\n".join([rows[0]] + [
            f"{head},{10 * int(line) - 5}" for head, line in (row.rsplit(",", 1) for row in rows[1:])]) + "\n")
        given = self.case(**self.AXES)
        self.write("part.nc", numbered)
        by_blocks, _ = self.answer(given, line_column="N_line")
        self.assertEqual(by_blocks["record"]["numbers"], "block")
        self.assertGreater(by_blocks["record"]["correlation"], 0.95)
        self.assertIn("no column", self.answer(self.case(**self.AXES), code=2, line_column="lines"))

    def test_the_runout_from_steady_cuts(self):  # [N-26]
        """The case says that the tool runs true; the forces over the angle know better."""
        self.make_record()
        given = self.case({**TRUE, "K_tc_MPa": 2300}, **self.AXES,
                          runout={"radial_offsets_mm": [0.0, 0.0]})
        result, warnings = self.answer(given)
        fit = result["record"]["fit"]
        self.assertTrue(fit["ok"])
        self.assertGreaterEqual(len({cut["line"] for cut in result["record"]["cuts"]}), 3)
        self.assertAlmostEqual(abs(fit["runout"]["radial_offsets_mm"][1]), 0.008, delta=0.0002)
        for key, value in TRUE.items():
            if key != "law":
                self.assertAlmostEqual(fit["coefficients"][key]["value"], value, delta=max(
                    0.02 * value, 2 * (value - fit["coefficients"][key]["low"])), msg=key)
        self.assertIn("another runout", warnings["other_runout"])
        material = (self.folder / "out/material.toml").read_text()
        self.assertIn("Found by trochoid program", material)
        del given["force"], given["runout"]
        self.write("material.toml", material)
        text = program.case_text("again", given, [{"file": "record.csv"}])
        self.write("case.toml", 'include = "material.toml"\n' + text)
        self.run_program("program", "case.toml", "-o", "again", "-q", "--no-report")
        again = self.summary("again")
        self.assertAlmostEqual(again["result"]["record"]["peak_ratio"], 1, delta=0.03)
        self.assertNotIn("other_runout", [w["code"] for w in again["warnings"]])

    def test_a_machine_whose_feed_was_turned_up(self):
        """The chip of the fit is that of the feed that ran, not of the feed in the program."""
        self.make_record(overrides=[1.3, 0.8, 1.6])
        result, _ = self.answer(self.case(**self.AXES), line_column="N_line")
        for cut, slower in zip(sorted({c["line"]: c for c in result["record"]["cuts"]}.items()),
                               [1.3, 0.8, 1.6]):
            programmed = PASSES[[6, 10, 14].index(cut[0])][3] / RPM / 2
            self.assertAlmostEqual(cut[1]["feed_per_tooth_mm"] * slower, programmed,
                                   delta=0.01 * programmed)

    def test_a_record_without_lines_whose_feeds_were_all_turned(self):  # [N-28]
        """Rapids take as long as ever; the chips of the fit are those of the feed that ran."""
        for slower in (1.3, 0.8):
            self.make_record(overrides=[slower] * 3)
            result, warnings = self.answer(self.case(**self.AXES))
            record = result["record"]
            self.assertAlmostEqual(record["stretch"], slower, delta=0.01 * slower)
            self.assertAlmostEqual(record["start_s"], 0.7, delta=0.05)
            self.assertGreater(record["correlation"], 0.97)
            self.assertIn("times as long", warnings["record_stretch"])
            self.assertNotIn("do_not_use", warnings)
            found = record["fit"]["coefficients"]
            self.assertAlmostEqual(found["K_tc_MPa"]["value"], 2620, delta=0.01 * 2620)
            self.assertAlmostEqual(found["K_te_N_per_mm"]["value"], 7, delta=0.3)
            for cut in record["cuts"]:
                programmed = PASSES[[6, 10, 14].index(cut["line"])][3] / RPM / 2
                self.assertAlmostEqual(cut["feed_per_tooth_mm"] * slower, programmed,
                                       delta=0.01 * programmed)
            for a, b, row in self.ends:
                for step in self.rows("measured_steps.csv"):
                    if step["line"] == row["line"]:
                        self.assertTrue(a - 0.05 < float(step["record_time_s"]) < b + 0.05)

    def test_a_record_without_lines_whose_feeds_were_turned_one_by_one(self):  # [N-28]
        for overrides in ([1, 1, 1.3], [1, 1.5, 1], [0.7, 1, 1], [1.3, 0.8, 1.6]):
            self.make_record(overrides=overrides)
            result, warnings = self.answer(self.case(**self.AXES))
            record = result["record"]
            self.assertAlmostEqual(record["start_s"], 0.7, delta=0.05)
            self.assertAlmostEqual(record["fit"]["coefficients"]["K_tc_MPa"]["value"], 2620,
                                   delta=0.035 * 2620)
            for line, slower in zip((6, 10, 14), overrides):
                if slower != 1:
                    self.assertIn(f"line {line} (", warnings["feed_override"])

    def test_power_at_several_speeds_of_the_spindle(self):
        """What air takes depends on the speed, more than what the cuts take."""
        given = self.power_by_lines(1, 50, rpm=(4000, 6000, 5000), idle=lambda rpm: 300 * (rpm / 4000) ** 3)
        result, warnings = self.answer(given)
        self.assertNotIn("record_does_not_fit", warnings)
        self.assertAlmostEqual(result["record"]["start_s"], 0.7, delta=0.1)
        found = {c["key"]: c["found"] for c in result["record"]["coefficients"] if "found" in c}
        self.assertAlmostEqual(found["K_tc_MPa"], 2620, delta=60)

    def test_the_power_of_the_spindle(self):
        """Fifty readings a second of a spindle that takes 310 W in air tell K_tc and K_te."""
        self.make_record()
        ends = self.ends
        lines = ["time_s,P_W"]
        chance = random.Random(3)
        for i in range(int((ends[-1][1] + 0.5) * 50)):
            t, power = i / 50, 310 + chance.gauss(0, 1)
            for (a, b, _), (_, way, side, feed) in zip(
                    [end for end in ends if end[2]["kind"] == "line"], PASSES):
                x = FIRST + (LAST - FIRST) * ((t - a) / (b - a) if way > 0 else (b - t) / (b - a))
                if a <= t < b and arcs_at(side, way, x):
                    self.turn(side, way, feed, x)
                    power += TORQUES[(side, way, feed, tuple(map(tuple, arcs_at(side, way, x))))] * \
                        2 * math.pi * RPM / 60
            lines.append(f"{t!r},{power!r}")
        self.write("record.csv", "\n".join(lines) + "\n")
        stated = {**TRUE, "K_tc_MPa": 2200, "K_te_N_per_mm": 12}
        given = self.case(stated, dynamometer={"axes": ["power"]})
        result, warnings = self.answer(given)
        record = result["record"]
        self.assertEqual(record["reads"], "power")
        self.assertNotIn("fit", record)
        self.assertAlmostEqual(record["start_s"], 0.7, delta=0.1)
        found = {c["key"]: c for c in record["coefficients"]}
        for key in ("K_tc_MPa", "K_te_N_per_mm"):
            half = found[key]["high"] - found[key]["found"]
            self.assertAlmostEqual(found[key]["found"], TRUE[key], delta=1.5 * half)
            self.assertLess(half, 0.3 * TRUE[key])
        self.assertNotIn("found", found["K_rc_MPa"])
        self.assertIn("K_tc_MPa", warnings["other_coefficients"])
        rows = [row for row in self.rows("measured_steps.csv") if row["line"] == "6" and row["power_W"]]
        self.assertGreater(len(rows), 20)
        said = self.answer(self.case(dynamometer={"axes": ["power", "torque"]}), code=2)
        self.assertIn("or of power or torque alone", said)

    def power_by_lines(self, blocks, rate, rpm=(RPM, RPM, RPM), idle=lambda rpm: 310, air=True):
        """A record of power with the lines that ran, of passes in so many blocks each.

        The power is that of the turns which `program` computes. rpm: of each pass."""
        given = self.case(dynamometer={"axes": ["power"]})
        lines = ["G21 G90 G17", "T1 M6"]
        for (y, way, _, feed), speed in zip(PASSES, rpm):
            a, b = (FIRST, LAST) if way > 0 else (LAST, FIRST)
            a = a if air or speed == rpm[0] else 7 - 8 * way
            b = b if air or speed == rpm[0] else 7 + 10.5 * way
            lines += [f"S{speed} M3", f"G0 X{a} Y{y} Z5.", "G0 Z-2."]
            lines += [f"G1 X{a + (b - a) * (i + 1) / blocks:.4f} F{feed * speed / RPM:.0f}"
                      for i in range(blocks)] + ["G0 Z5."]
        self.write("part.nc", "\n".join(lines + ["M30"]) + "\n")
        self.answer({k: v for k, v in given.items() if k != "dynamometer"}, measured=False)
        steps = [(float(row["time_s"]), float(row["power_W"] or 0)) for row in self.rows("steps.csv")]
        ends, time, chance = [], 0.7, random.Random(4)
        for row in self.rows("moves.csv"):
            ends.append((time, time + float(row["time_s"] or 0), row["line"], float(row["spindle_rpm"] or 0)))
            time = ends[-1][1]
        out, k = ["time_s,P_W,N_line"], 0
        for i in range(int((time + 0.5) * rate)):
            t = i / rate
            _, _, line, speed = next((one for one in ends if one[0] <= t < one[1]), (0, 0, "0", rpm[0]))
            while k + 1 < len(steps) and steps[k + 1][0] <= t - 0.7:
                k += 1
            cut = steps[k][1] if t > 0.7 else 0
            out.append(f"{t!r},{idle(speed or rpm[0]) + cut + chance.gauss(0, 1)!r},{line}")
        self.write("record.csv", "\n".join(out) + "\n")
        return given

    def test_lines_of_few_samples_say_nothing_of_their_feed(self):
        given = self.power_by_lines(60, 50)
        result, warnings = self.answer(given, line_column="N_line")
        self.assertNotIn("feed_override", warnings)
        self.assertNotIn("other_coefficients", warnings)
        found = {c["key"]: c["found"] for c in result["record"]["coefficients"] if "found" in c}
        self.assertAlmostEqual(found["K_tc_MPa"], 2620, delta=60)

    def test_a_logger_that_stood_still_is_no_feed(self):
        """Two seconds are missing between two lines, and a retract took two seconds longer."""
        self.make_record(overrides=[1.0, 1.0, 1.0])
        head, *rows = (self.folder / "record.csv").read_text().splitlines()
        last = max(i for i, row in enumerate(rows) if row.endswith(",6"))
        later = [f"{float(row.split(',', 1)[0]) + 2},{row.split(',', 1)[1]}" for row in rows[last + 1:]]
        self.write("record.csv", "\n".join([head] + rows[:last + 1] + later) + "\n")
        _, warnings = self.answer(self.case(**self.AXES), line_column="N_line")
        self.assertNotIn("feed_override", warnings)
        self.assertNotIn("other_coefficients", warnings)

    def test_cuts_at_a_speed_without_air_are_left_out(self):
        given = self.power_by_lines(1, 50, rpm=(4000, 4000, 6000), air=False,
                                    idle=lambda rpm: 310 if rpm < 5000 else 420)
        result, warnings = self.answer(given, line_column="N_line")
        self.assertIn("at 6000 rpm", warnings["no_air"])
        for one in result["record"]["coefficients"]:
            if "found" in one:
                self.assertAlmostEqual(one["found"], one["stated"],
                                       delta=2 * (one["high"] - one["found"]))

    def test_steps_of_part_of_a_turn(self):
        self.make_record()
        given = self.case(**self.AXES, program={"file": "part.nc", "tool_number": 1, "step_turns": 0.25})
        result, _ = self.answer(given)
        self.assertGreaterEqual(len(result["record"]["cuts"]), 3)
        self.assertGreater(min(cut["turns"] for cut in result["record"]["cuts"]), 5)

    def test_what_cannot_be_laid_over(self):
        self.make_record()
        chance = random.Random(2)
        lines = (self.folder / "record.csv").read_text().splitlines()
        self.write("record.csv", "\n".join(
            [lines[0]] + [f"{line.split(',')[0]}," + ",".join(
                repr(chance.gauss(0, 50)) for _ in range(3)) for line in lines[1:]]) + "\n")
        result, warnings = self.answer(self.case(**self.AXES))
        self.assertNotIn("record", result)
        self.assertIn("do not fit this program", warnings["record_does_not_fit"])
        said = self.answer(self.case(dynamometer={"axes": "auto"}), code=2)
        self.assertIn("identify finds axes, program does not", said)
        self.write("record.csv", "\n".join(line.split(",", 1)[1] for line in lines) + "\n")
        self.assertTrue(self.answer(self.case(**self.AXES), code=2))


if __name__ == "__main__":
    main()
