"""program: what it answers, what it warns of and what it leaves out, as a user meets it."""
import csv

from in_folder import InFolder, main, program, tables

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
        given = tables(**{"program": {"file": "part.nc", "tool_number": 1, "ignore_tools": [2]},
                          "stock": {"box_mm": [[0, -30, -10], [60, 60, 0]]}, **changes})
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

    def test_what_is_not_used_is_said(self):
        self.case(feed={"write": "new.nc"}, limits={"peak_force_N": 1e6},
                  machine={"max_acceleration_m_per_s2": [3, 3, 2]})
        said = self.answer()[1]["not_used"]
        self.assertIn("[feed]", said)
        self.assertIn("max_acceleration_m_per_s2", said)

    def test_without_forces_there_are_the_moves(self):
        for code, changes in (
                ("tool_not_described", {"program": {"file": "part.nc", "tool_number": 1}}),
                ("tool_not_flat", {"tool": {"shape": "ball"}})):
            with self.subTest(code=code):
                self.case(**changes)
                result, warnings = self.answer()
                self.assertIn(code, warnings)
                self.assertNotIn("peaks", result)
                self.assertEqual({p.name for p in (self.folder / "out").iterdir()},
                                 {"case.toml", "summary.json", "moves.csv"})

    def test_a_program_that_cuts_nothing_has_no_good_answer(self):
        self.case(stock={"box_mm": [[0, -30, -10], [60, 60, -5]]})
        self.answer(code=1)
        self.assertEqual(self.summary("out")["message"],
                         "No feed move of the program cuts anything.")

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


if __name__ == "__main__":
    main()
