"""The program's reader of NC programs against the worked cases of ../shared/cases/program.

Cases of other kinds than `parser` and `refusal` are left out.
"""
import csv
import json
import os
import pathlib
import re
import sys
import tempfile
import unittest

import program

TABLES = {"tool": {"teeth": 2, "diameter_mm": 10, "helix_deg": 30},
          "force": {"K_tc_MPa": 2620, "K_rc_MPa": 1560, "K_ac_MPa": 331, "K_te_N_per_mm": 7,
                    "K_re_N_per_mm": 3, "K_ae_N_per_mm": 1}}
STOCK = {"box_mm": [[-1000, -1000, -500], [1000, 1000, 500]]}
ENDINGS = {"iso": "nc", "linuxcnc": "ngc", "sinumerik": "mpf"}
WARNING = re.compile(r"^part\.\w+:(\d+):(\d+): ")


def folder():
    here = pathlib.Path(__file__).resolve().parents[2]
    shared = pathlib.Path(os.environ.get("TROCHOID_SHARED", here.parent / "shared"))
    return shared / "cases/program"


def worked(kind):
    files = sorted(folder().glob("*.json")) if folder().is_dir() else []
    return [c for c in (json.loads(f.read_text()) for f in files) if c["kind"] == kind]


def number(cell):
    return float(cell) if cell else None


def answer(where, text, table, dialect, expected):
    """The answer to a program of that text."""
    part = pathlib.Path(where) / f"part.{ENDINGS[expected]}"
    part.write_text(text)
    given = {**table, "file": part.name, "dialect": dialect}
    content = program.case_text("worked", {**TABLES, "program": given, "stock": STOCK})
    return program.run("program", content, where, f"case_{dialect}")


class Program(unittest.TestCase):
    def setUp(self):
        self.where = tempfile.TemporaryDirectory(prefix="trochoid_")
        self.addCleanup(self.where.cleanup)

    def check_move(self, row, move, tolerance):
        self.assertEqual(row["kind"], move["kind"])
        self.assertEqual(int(row["line"]), move["line"])
        self.assertEqual(row["note"], move.get("note", ""))
        near = [*zip(("x_mm", "y_mm", "z_mm"), move.get("end_mm", ())),
                *zip(("center_x_mm", "center_y_mm"), move.get("centre_mm", ()))]
        if "time_s" in move:
            near.append(("time_s", move["time_s"]))
        for name, want in near:
            got = number(row[name])
            self.assertEqual(got is None, want is None, name)
            if want is not None:
                self.assertAlmostEqual(got, want, delta=tolerance["mm"], msg=name)
        if "turn_deg" in move:
            self.assertAlmostEqual(float(row["turn_deg"]), move["turn_deg"],
                                   delta=tolerance["deg"])
        for name in ("feed_mm_per_min", "spindle_rpm"):
            if name in move:
                self.assertAlmostEqual(float(row[name]) / move[name], 1,
                                       delta=tolerance["feed_relative"])
        if "tool" in move:
            self.assertEqual(row["tool"], "" if move["tool"] is None else str(move["tool"]))

    def test_moves(self):
        for case in worked("parser"):
            given, expected = dict(case["case"]["program"]), case["expected"]
            text = (folder() / given.pop("file")).read_text()
            for dialect in (given.pop("dialect"), "auto"):
                with self.subTest(case["id"], dialect=dialect):
                    said = answer(self.where.name, text, given, dialect,
                                  expected["dialect_found"])
                    self.assertIn(said.code, (0, 1), said.stderr)
                    self.assertEqual(said.result["dialect"], expected["dialect_found"])
                    found = [[w["code"], int(WARNING.match(w["message"])[1])]
                             for w in said.summary["warnings"]
                             if WARNING.match(w["message"])]  # the reader's own
                    self.assertEqual(found, expected["warnings"])
                    with open(said.folder / "moves.csv", newline="") as file:
                        rows = list(csv.DictReader(file))
                    self.assertEqual(len(rows), len(expected["moves"]))
                    for row, move in zip(rows, expected["moves"]):
                        with self.subTest(line=move["line"]):
                            self.check_move(row, move, case["tolerance"])

    def test_refusals(self):
        for case in worked("refusal"):
            for one in case["expected"]["cases"]:
                head = "head_sinumerik" if one["dialect"] == "sinumerik" else "head"
                text = case["case"][head] + one["text"] + "\n"
                with self.subTest(one["text"]):
                    said = answer(self.where.name, text, {}, one["dialect"], one["dialect"])
                    self.assertEqual(said.code, 2, said.stderr)
                    self.assertFalse(said.folder.exists())
                    part = f"part.{ENDINGS[one['dialect']]}:{one['line']}:{one['column']}: "
                    first = said.stderr.split("\n")[0]
                    self.assertIn(part, first)


if __name__ == "__main__":
    if not folder().is_dir():
        print(f"{folder()} is not here: nothing is compared")
        sys.exit(77)
    unittest.main()
