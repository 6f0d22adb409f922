#!/usr/bin/env python3
"""Writes part.nc, a finishing program as a CAM system writes it, and stock.stl, what roughing left.

A surface of 14 x 10 mm that falls along x and waves along y. A ball of 6 mm goes to and fro along
x, 0.5 mm from line to line, in blocks of 0.5 mm. Roughing left stairs, at least 0.3 mm above it.
Usage: make.py
"""
import math
import pathlib

LENGTH, WIDTH, BOTTOM, RADIUS = 14.0, 10.0, -8.0, 3.0
STEP, BLOCK, STAIRS, LEFT = 0.5, 0.5, 4, 0.3
FEED, SPEED = 1500, 12000
HERE = pathlib.Path(__file__).parent


def surface(x, y):
    return -1.0 - 0.18 * x + 0.4 * math.sin(0.6 * y)


def tip(x, y):
    """The tip of the ball that touches the surface there."""
    slope_x, slope_y = -0.18, 0.24 * math.cos(0.6 * y)
    up = 1 / math.sqrt(1 + slope_x**2 + slope_y**2)
    return (x - RADIUS * slope_x * up, y - RADIUS * slope_y * up,
            surface(x, y) + RADIUS * up - RADIUS)


def program():
    yield "%"
    yield "(BALL D6 FINISHING)"
    yield "G21 G17 G90 G94"
    yield "T1 M6"
    yield f"S{SPEED} M3"
    blocks = round(LENGTH / BLOCK)
    for line in range(round(WIDTH / STEP) + 1):
        places = [tip(i * BLOCK, line * STEP) for i in range(blocks + 1)]
        if line % 2:
            places.reverse()
        x, y, z = places[0]
        if line == 0:
            yield f"G0 X{x:.3f} Y{y:.3f} Z5."
            yield "Z1."
        yield f"G1 X{x:.3f} Y{y:.3f} Z{z:.3f} F{FEED}"
        for x, y, z in places[1:]:
            yield f"X{x:.3f} Y{y:.3f} Z{z:.3f}"
    yield "G0 Z5."
    yield "M5"
    yield "M30"
    yield "%"


def stairs():
    """The outline of the stock seen along y, counter-clockwise from the lower left."""
    width = LENGTH / STAIRS
    points = [(0.0, BOTTOM), (LENGTH, BOTTOM)]
    for i in reversed(range(STAIRS)):
        top = max(surface(i * width, y / 10) for y in range(101)) + LEFT
        points += [((i + 1) * width, top), (i * width, top)]
    return points


def faces():
    outline = stairs()
    count = len(outline)
    for y, order in ((0.0, 1), (WIDTH, -1)):
        for i in range(1, count - 1):
            corners = [outline[0], outline[i], outline[i + 1]][::order]
            yield [(x, y, z) for x, z in corners]
    for (x0, z0), (x1, z1) in zip(outline, outline[1:] + outline[:1]):
        a, b = (x0, 0.0, z0), (x1, 0.0, z1)
        c, d = (x1, WIDTH, z1), (x0, WIDTH, z0)
        yield [a, c, b]
        yield [a, d, c]


def stl():
    yield "solid stock"
    for corners in faces():
        yield "facet normal 0 0 0"
        yield "outer loop"
        for x, y, z in corners:
            yield f"vertex {x:.4f} {y:.4f} {z:.4f}"
        yield "endloop"
        yield "endfacet"
    yield "endsolid stock"


if __name__ == "__main__":
    (HERE / "part.nc").write_text("\n".join(program()) + "\n")
    (HERE / "stock.stl").write_text("\n".join(stl()) + "\n")
