"""Arcs of a ball on a wavy raster against the heights that each earlier move leaves.

An independent way to N-16: the height that a ball leaves over a place is closed, as the disc of
its section across the move (a circle of radius g) sinks furthest at s = a - m g/sqrt(1 + m^2). A
point of the circle of the cutter is in stock where it is below the heights of all moves more than
a turn ago. No grid, no map, no wall tables.
"""
import csv
import math
import pathlib
import tempfile
import unittest

import program

R, TOP = 3.0, -0.5  # mm
HEIGHTS = (0.05, 0.2, 0.5)


def raster(wave):
    """Lines along x, 0.4 mm apart, in blocks of 0.5 mm, up and down by `wave`."""
    lines = ["G21 G90 G17", "T1 M6", "S12000 M3", "G0 X-4 Y0 Z5"]
    for row in range(14):
        xs = [0.5 * i for i in range(25)]
        for i, x in enumerate(xs if row % 2 == 0 else xs[::-1]):
            y = 0.4 * row
            z = -2 + wave * math.sin(x / 2) * math.cos(y)
            first = f"G1 X{x:.3f} Y{y:.3f} Z{z:.4f} F1500"
            lines.append(first if i == 0 else f"X{x:.3f} Z{z:.4f}")
    return "\n".join([*lines, "G0 Z20", "M30", ""])


class Move:
    """A straight move that was begun `start` turns after the beginning of the program."""

    def __init__(self, a, b, start, turns, line):
        self.a, self.b, self.start, self.turns, self.line = a, b, start, turns, line

    def height(self, x, y, until):
        """Left over (x, y) by the part of it that was gone by `until` turns; none: no part."""
        gone = min(1.0, (until - self.start) / self.turns)
        if gone < 0:
            return math.inf
        d = [q - p for p, q in zip(self.a, self.b)]
        length = math.hypot(d[0], d[1])
        along = ((x - self.a[0]) * d[0] + (y - self.a[1]) * d[1]) / length
        aside = ((x - self.a[0]) * d[1] - (y - self.a[1]) * d[0]) / length
        if abs(aside) >= R:
            return math.inf
        slope, g = d[2] / length, math.sqrt(R * R - aside * aside)
        s = min(max(along - slope * g / math.hypot(1, slope), 0.0), length * gone)
        if abs(s - along) >= g:
            return math.inf
        return self.a[2] + slope * s + R - math.sqrt(g * g - (s - along) ** 2)


def rows_of(file):
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


def moves_of(rows):
    moves, place, turns = [], None, 0.0
    for row in rows:
        end = [float(row[k]) if row[k] else None for k in ("x_mm", "y_mm", "z_mm")]
        count = float(row["time_s"]) * float(row["spindle_rpm"] or 0) / 60
        if place and None not in place + end and math.dist(place[:2], end[:2]) > 0:
            moves.append(Move(place, end, turns, count, int(row["line"])))
        turns, place = turns + count, end
    return moves


def ends_of(moves, center, chi, height, until):
    """Where the circle at a height above the tip enters and leaves stock, in degrees."""
    r, z = math.sqrt(height * (2 * R - height)), center[2] + height

    def is_stock(theta):
        x = center[0] + r * math.sin(theta) * math.cos(chi) - r * math.cos(theta) * math.sin(chi)
        y = center[1] + r * math.sin(theta) * math.sin(chi) + r * math.cos(theta) * math.cos(chi)
        return z < TOP and all(z < m.height(x, y, until) for m in moves)

    count, ends = 720, []
    thetas = [-math.pi / 2 + 2 * math.pi * i / count for i in range(count + 1)]
    known = [is_stock(theta) for theta in thetas]
    for i in range(count):
        low, high = thetas[i], thetas[i + 1]
        if known[i] == known[i + 1]:
            continue
        for _ in range(50):
            middle = (low + high) / 2
            low, high = (middle, high) if is_stock(middle) == known[i] else (low, middle)
        ends.append(math.degrees(low))
    return ends


class Arcs(unittest.TestCase):
    def check(self, wave):
        tables = {
            "tool": {"shape": "ball", "teeth": 2, "diameter_mm": 2 * R, "helix_deg": 30},
            "force": {"K_tc_MPa": 800, "K_rc_MPa": 250, "K_ac_MPa": 150, "K_te_N_per_mm": 12,
                      "K_re_N_per_mm": 10, "K_ae_N_per_mm": 2},
            "program": {"file": "part.nc", "tool_number": 1, "place_heights_mm": list(HEIGHTS),
                        "places": [[60, 0.5], [185, 0.3], [330, 0.7]]},
            "stock": {"box_mm": [[-5, -5, -10], [20, 15, TOP]]}}
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "part.nc").write_text(raster(wave))
            answer = program.run("program", program.case_text("raster", tables), folder, "arcs")
            self.assertEqual(answer.code, 0, answer.stderr)
            moves = moves_of(rows_of(answer.folder / "moves.csv"))
            places = rows_of(answer.folder / "places.csv")
            arcs = rows_of(answer.folder / "place_arcs.csv")
        compared = 0
        for i, row in enumerate(places):
            move = next(m for m in moves if m.line == int(row["line"]))
            until = move.start + float(row["fraction"]) * move.turns - 1
            center = [float(row[k]) for k in ("x_mm", "y_mm", "z_mm")]
            chi = math.radians(float(row["feed_direction_deg"]))
            for height in HEIGHTS:
                known = sorted(ends_of(moves, center, chi, height, until))
                found = sorted((float(a[k]) + 90) % 360 - 90 for a in arcs
                               for k in ("from_deg", "to_deg")
                               if int(a["place"]) == i and float(a["from_mm"]) == height)
                self.assertEqual(len(found), len(known), (row["line"], height, found, known))
                for a, b in zip(found, known):
                    self.assertAlmostEqual(a, b, delta=1e-6, msg=(row["line"], height))
                    compared += 1
        self.assertGreater(compared, 10)

    def test_level(self):
        self.check(0.0)

    def test_up_and_down(self):
        self.check(0.6)


if __name__ == "__main__":
    unittest.main()
