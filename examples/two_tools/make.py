#!/usr/bin/env python3
"""Writes part.nc: a boss on a block, roughed with one tool and finished with another.

A block of 50 x 30 mm, a boss of 40 x 20 mm in its middle with corners of 3 mm, 4 mm high. T1,
8 mm with two flutes, goes around it in two levels and leaves 0.3 mm. T2, 6 mm with four
flutes, takes that in one level of 4 mm. Both go clockwise: down milling, the wall on their right.
Usage: make.py > part.nc
"""
LENGTH, WIDTH, CORNER, LEFT = 40.0, 20.0, 3.0, 0.3


def around(radius, left):
    """Clockwise about the boss, from the middle of its left side."""
    x, y = LENGTH / 2 + left + radius, WIDTH / 2 + left + radius
    r = CORNER + left + radius
    yield f"Y{y - r:.3f}"
    yield f"G2 X{-x + r:.3f} Y{y:.3f} I{r:.3f} J0."
    yield f"G1 X{x - r:.3f}"
    yield f"G2 X{x:.3f} Y{y - r:.3f} I0. J{-r:.3f}"
    yield f"G1 Y{-y + r:.3f}"
    yield f"G2 X{x - r:.3f} Y{-y:.3f} I{-r:.3f} J0."
    yield f"G1 X{-x + r:.3f}"
    yield f"G2 X{-x:.3f} Y{-y + r:.3f} I0. J{r:.3f}"
    yield "G1 Y0."


def tool(number, radius, left, rpm, levels, feed):
    x = LENGTH / 2 + left + radius
    yield f"T{number} M6"
    yield f"S{rpm} M3"
    yield f"G0 X{-x:.3f} Y-40. Z5."
    for z in levels:
        yield f"G0 Z{z:.1f}"
        yield f"G1 Y0. F{feed}"
        yield from around(radius, left)
        yield "G0 X-50."
        yield "Y-40."
        yield f"X{-x:.3f}"
    yield "G0 Z5."


def program():
    yield "%"
    yield "(BOSS 40 X 20, ROUGH D8, FINISH D6)"
    yield "G21 G17 G90 G94"
    yield from tool(1, 4.0, LEFT, 875, (-2.0, -4.0), 90)
    yield from tool(2, 3.0, 0.0, 1600, (-4.0,), 160)
    yield "M5"
    yield "M30"
    yield "%"


if __name__ == "__main__":
    print("\n".join(program()))
