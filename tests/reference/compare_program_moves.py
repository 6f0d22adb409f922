"""The program's moves against those of LinuxCNC's own interpreter, its Python module `gcode`.

The module is that of Debian's linuxcnc-uspace; without it nothing is compared. It tells
places in inches. `T1 M6` is blanked in its copy: without a machine it stops there.
"""
import csv
import importlib.util
import os
import pathlib
import re
import sys
import tempfile
import unittest

import compare_program as ours
import program

LINES = """G21 G90 G17 G94
T1 M6
S1000 M3
"""
PROGRAMS = {
    "lines": "G0 X1 Y2 Z3\nG1 X-4.5 F300\nG91 X1 Y1 Z-0.125\nX.5\nG90 X0 Y0 Z0\nG20\nG1 X1 Y.5 F20\n",
    "arcs": "G0 X0 Y0 Z0\nG1 X10 F200\nG3 X0 Y10 I-10 J0\nG2 X10 Y0 R10\nG3 X12 Y2 R-2.5\n"
            "G2 I3 J1 Z-2\nG90.1 G3 X20 Y2 I16 J2\nG91.1 G2 X20 Y2 I-3 J0 P3\n",
    "cycles": "G0 X0 Y0 Z20\nG98 G81 X10 Y5 Z-6 R2 F80\nX20\nG99 Y15\nG83 X30 Y30 Z-7 R4 Q3\n"
              "G80\nG0 Z30\nG91 G81 X-3 Y1 Z-4 R-28 L2\nG90 G80 G0 X0 Y0\n",
}


class Heard:
    """What LinuxCNC would tell a machine: kind, line, end, center, turn; mm."""

    INCH = 25.4

    def __init__(self):
        self.moves, self.line, self.place = [], 0, (0.0, 0.0, 0.0)
        self.feed = 0.0
        self.traverses = []

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *arguments: None

    def next_line(self, state):
        self.line = state.sequence_number

    def set_feed_rate(self, feed):
        self.feed = feed * self.INCH

    def add(self, kind, x, y, z, **more):
        end = tuple(self.INCH * v for v in (x, y, z))
        self.moves.append({"kind": kind, "line": self.line, "end_mm": end, **more})
        self.place = end

    def straight_traverse(self, x, y, z, *rest):
        self.add("rapid", x, y, z)

    def straight_feed(self, x, y, z, *rest):
        self.add("line", x, y, z, feed_mm_per_min=self.feed)

    def arc_feed(self, x, y, cx, cy, rotation, z, *rest):
        self.add("arc", x, y, z, feed_mm_per_min=self.feed, rotation=rotation,
                 centre_mm=(cx * self.INCH, cy * self.INCH))

    def check_abort(self):
        return False

    def get_axis_mask(self):
        return 7

    def get_external_length_units(self):
        return 1 / self.INCH

    def get_external_angular_units(self):
        return 1.0

    def get_block_delete(self):
        return False

    def get_tool(self, pocket):
        return (-1,) + (0.0,) * 9 + (0.0, 0.0, 0.0, 0)

    def change_tool(self, pocket):
        pass

    def user_defined_function(self, *arguments):
        pass


def heard(text, where):
    import gcode
    file = pathlib.Path(where) / "heard.ngc"
    file.write_text(re.sub(r"^T1 M6$", "", text, flags=re.M))
    canon = Heard()
    parameters = pathlib.Path(where) / "heard.var"
    parameters.touch()
    canon.parameter_file = str(parameters)
    result, line = gcode.parse(str(file), canon, "G21", "G90")
    if result > gcode.MIN_ERROR:
        raise RuntimeError(f"{line}: {gcode.strerror(result)}")
    return canon.moves


class Moves(unittest.TestCase):
    def test_kinds_lines_ends_and_centers(self):
        for name, text in PROGRAMS.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as where:
                said = ours.answer(where, LINES + text + "M2\n", {}, "linuxcnc", "linuxcnc")
                self.assertEqual(said.code, 0, said.stderr)
                with open(said.folder / "moves.csv", newline="") as file:
                    rows = [r for r in csv.DictReader(file) if r["kind"] != "dwell"]
                wanted = heard(LINES + text + "M2\n", where)
                self.assertEqual([(r["kind"], int(r["line"])) for r in rows],
                                 [(m["kind"], m["line"]) for m in wanted])
                for row, move in zip(rows, wanted):
                    for axis, want in zip(("x_mm", "y_mm", "z_mm"), move["end_mm"]):
                        self.assertAlmostEqual(float(row[axis]), want, delta=1e-9)
                    for axis, want in zip(("center_x_mm", "center_y_mm"),
                                          move.get("centre_mm", ())):
                        self.assertAlmostEqual(float(row[axis]), want, delta=1e-9)
                    if "feed_mm_per_min" in move:
                        self.assertAlmostEqual(float(row["feed_mm_per_min"])
                                               / move["feed_mm_per_min"], 1, delta=1e-12)
                    if "rotation" in move:
                        self.assertEqual(float(row["turn_deg"]) > 0, move["rotation"] > 0)


if __name__ == "__main__":
    if importlib.util.find_spec("gcode") is None:
        print("LinuxCNC's Python module gcode is not here (linuxcnc-uspace): nothing is compared")
        sys.exit(77)
    unittest.main()
