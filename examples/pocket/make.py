#!/usr/bin/env python3
"""Writes part.nc, the program of a pocket as a simple post writes it.

A pocket of 60 x 40 mm with corners of 5 mm, 4 mm deep, from the inside out: the tool of 8 mm
goes down on a helix, then along rings 3 mm apart with sharp corners, and at last along the
wall with 0.3 mm left, where it turns in the corners on an arc.
Usage: make.py > part.nc
"""
LENGTH, WIDTH, CORNER, DEPTH = 60.0, 40.0, 5.0, 4.0
RADIUS, STEP, LEFT = 4.0, 3.0, 0.3
FEED, PLUNGE, FINISH = 900, 300, 700


def ring(x, y):
    """Anticlockwise about a rectangle, from its lower left corner."""
    return [f"X{x:.3f} Y{-y:.3f}", f"X{x:.3f} Y{y:.3f}", f"X{-x:.3f} Y{y:.3f}",
            f"X{-x:.3f} Y{-y:.3f}"]


def program():
    yield "%"
    yield "(POCKET 60 X 40, D8 3 FLUTES)"
    yield "G21 G17 G90 G94"
    yield "T1 M6"
    yield "S6000 M3"
    yield "G0 X-10. Y-2. Z5."
    yield "Z1."
    for z in (0.0, -1.0, -2.0, -3.0, -4.0):
        yield f"G3 X-10. Y-2. Z{z:.1f} I0. J2. F{PLUNGE}"
    yield f"G3 X-10. Y-2. I0. J2. F{PLUNGE}"
    x, y = LENGTH / 2 - RADIUS - LEFT, WIDTH / 2 - RADIUS - LEFT
    rings = []
    while y > 0.5:
        rings.append((x, y))
        x, y = x - STEP, y - STEP
    for x, y in reversed(rings):
        yield f"G1 X{-x:.3f} Y{-y:.3f} F{FEED}"
        yield from ring(x, y)
    x, y, r = LENGTH / 2 - RADIUS, WIDTH / 2 - RADIUS, CORNER - RADIUS
    yield f"G1 X{-x + r:.3f} Y{-y:.3f} F{FINISH}"
    yield f"X{x - r:.3f}"
    yield f"G3 X{x:.3f} Y{-y + r:.3f} I0. J{r:.3f}"
    yield f"G1 Y{y - r:.3f}"
    yield f"G3 X{x - r:.3f} Y{y:.3f} I{-r:.3f} J0."
    yield f"G1 X{-x + r:.3f}"
    yield f"G3 X{-x:.3f} Y{y - r:.3f} I0. J{-r:.3f}"
    yield f"G1 Y{-y + r:.3f}"
    yield f"G3 X{-x + r:.3f} Y{-y:.3f} I{r:.3f} J0."
    yield "G0 Z5."
    yield "M5"
    yield "M30"
    yield "%"


if __name__ == "__main__":
    print("\n".join(program()))
