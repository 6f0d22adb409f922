"""program with a record: where it lies, where many places look alike.

Records of power are made of the powers that `program` itself finds at the feed that ran, a slot
after the other, with times that know nothing of the search for them.
"""
import csv
import random

from in_folder import InFolder, main, program, tables

RPM, FEED, IDLE, RATE = 4000, 480, 150.0, 100
TRUE = {"law": "linear_edge", "K_tc_MPa": 2620, "K_rc_MPa": 1560, "K_ac_MPa": 331,
        "K_te_N_per_mm": 7, "K_re_N_per_mm": 3, "K_ae_N_per_mm": 1}


def text_of(lengths, feed=FEED):
    """Slots side by side, each through so many millimetres of a block of 40."""
    lines = ["G21 G90 G17", "T1 M6", f"S{RPM} M3"]
    for i, length in enumerate(lengths):
        lines += [f"G0 X-8 Y{12 * i} Z5.", "G0 Z-2.", f"G1 X{length} F{feed}", "G0 Z5."]
    return "\n".join(lines + ["M30"]) + "\n"


class Place(InFolder):
    def answer(self, lengths, feed=FEED, record="record.csv", keys=None):
        self.write("part.nc", text_of(lengths, feed))
        given = tables(program={"file": "part.nc", "tool_number": 1},
                       stock={"box_mm": [[0, -6, -10], [40, 12 * len(lengths) - 6, 0]]}, force=TRUE,
                       dynamometer={"axes": ["power"]})
        del given["cut"]
        self.write("case.toml", program.case_text("a record", given,
                                                  [{"file": record, **(keys or {})}] if record else []))
        self.run_program("program", "case.toml", "-o", "out", "-q", "--no-report")
        summary = self.summary("out")
        return summary["result"], {w["code"]: w["message"] for w in summary["warnings"]}

    def rows(self, file):
        with open(self.folder / "out" / file, newline="") as stream:
            return list(csv.DictReader(stream))

    def powers(self, lengths, feed):
        """Of each line with its number, its begin and end in the program, and (part of it, power)."""
        self.answer(lengths, feed, record=None)
        time, fed = 0.0, []
        for move in self.rows("moves.csv"):
            begin, time = time, time + float(move["time_s"] or 0)
            if move["kind"] == "line":
                fed.append((move["line"], begin, time))
        steps = self.rows("steps.csv")
        return [(line, a, b, [((float(s["time_s"]) - a) / (b - a), float(s["power_W"]))
                              for s in steps if s["line"] == line]) for line, a, b in fed]

    def make_record(self, lengths, factors, margin, only=None, lines=False):
        """The machine ran each line so many times as long; `only`: passes that the logger saw."""
        programmed = self.powers(lengths, FEED)
        ran = [self.powers(lengths, FEED / f)[i] for i, f in enumerate(factors)]
        time, end, seen = 0.0, 0.0, []
        for (line, a, b, _), (*_, power), factor in zip(programmed, ran, factors):
            time += a - end
            seen.append((line, time, time + factor * (b - a), power))
            time, end = seen[-1][2], b
        chance = random.Random(1)
        first, last = (0.0, time) if only is None else (seen[only[0]][1], seen[only[1]][2])
        out = ["time_s,P_W" + (",N_line" if lines else "")]
        count = int((last - first + 2 * margin) * RATE)
        for i in range(count):
            t = first - margin + i / RATE
            power, running = 0.0, "0"
            for line, a, b, curve in seen:
                if a <= t < b:
                    u, running = (t - a) / (b - a), line
                    power = min(curve, key=lambda one: abs(one[0] - u))[1]
            out.append(f"{i / RATE!r},{IDLE + power + chance.gauss(0, 4)!r}" + (f",{running}" if lines else ""))
        self.write("record.csv", "\n".join(out) + "\n")

    def test_equal_passes_with_little_air_at_the_ends(self):  # [N-23]
        """Fewer passes over one another agree as well: the record has all of them."""
        lengths = [48] * 8
        self.make_record(lengths, [1.0] * 8, 0.3)
        result, warnings = self.answer(lengths)
        self.assertAlmostEqual(result["record"]["start_s"], 0.3, delta=0.05)
        self.assertNotIn("record_ambiguous", warnings)
        found = {c["key"]: c["found"] for c in result["record"]["coefficients"] if "found" in c}
        self.assertAlmostEqual(found["K_tc_MPa"], 2620, delta=0.03 * 2620)

    def test_a_part_of_equal_passes_may_be_at_several_places(self):
        lengths = [48] * 8
        self.make_record(lengths, [1.0] * 8, 0.3, only=(2, 5))
        result, warnings = self.answer(lengths)
        self.assertIn("may start at", warnings["record_ambiguous"])
        found = {c["key"]: c["found"] for c in result["record"]["coefficients"] if "found" in c}
        self.assertAlmostEqual(found["K_tc_MPa"], 2620, delta=0.03 * 2620)

    def test_half_of_equal_passes_with_the_feed_turned_down(self):  # [N-28]
        """One factor for all must not fit: right coefficients, or none."""
        lengths = [48] * 8
        self.make_record(lengths, [1.0] * 4 + [1 / 0.6] * 4, 0.3)
        result, warnings = self.answer(lengths)
        if "record_does_not_fit" in warnings:
            self.assertNotIn("record", result)
            return
        self.assertAlmostEqual(result["record"]["start_s"], 0.3, delta=0.1)
        found = {c["key"]: c["found"] for c in result["record"]["coefficients"] if "found" in c}
        self.assertAlmostEqual(found["K_tc_MPa"], 2620, delta=0.05 * 2620)

    def test_a_record_of_another_program(self):
        """Two cuts of other lengths, apart otherwise: a factor for all feeds does not make them fit."""
        other = [12, 48, 30]
        self.make_record(other, [1.0] * 3, 0.5)
        _, warnings = self.answer([48, 48, 10, 48])
        self.assertIn("does not fit", warnings["record_does_not_fit"])
        self.assertIn("line_column", warnings["record_does_not_fit"])

    def test_what_is_said_of_a_record_that_does_not_fit(self):
        self.make_record([12, 48, 30], [1.0] * 3, 0.5, lines=True)
        _, warnings = self.answer([48, 48, 10, 48], keys={"line_column": "N_line"})
        self.assertNotIn("line_column", warnings["record_does_not_fit"], "it has one")
        self.write("short.csv", "time_s,P_W\n" + "".join(f"{i / 100},{150 + i % 3}\n" for i in range(8)))
        _, warnings = self.answer([48, 48], record="short.csv")
        self.assertIn("fewer than ten turns", warnings["record_does_not_fit"])


if __name__ == "__main__":
    main()
