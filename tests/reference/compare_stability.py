"""`trochoid stability` against the transcription: several modes, helix, pitch, runout, laws.

Angles are chosen so that entry, exit and changes of mark fall on whole steps of the
semi-discretisation, whose error then falls with the square of the step.
"""
import math
import sys
import tempfile
import unittest

import numpy as np
import program
import stability as st


def mode(body, axis, mass, hertz, ratio, degrees=0.0):
    """As the file has it, and as the transcription wants it."""
    omega = 2 * np.pi * hertz
    sign = 1 if body == "tool" else -1
    along = math.radians(degrees + 90 * (axis == "y"))
    return ({"body": body, "axis": axis, "mass_kg": mass, "frequency_Hz": hertz,
             "damping_ratio": ratio} | ({"angle_deg": degrees} if degrees else {}),
            (mass, 2 * ratio * omega * mass, mass * omega**2,
             sign * math.cos(along), sign * math.sin(along)))


X = mode("tool", "x", 0.03993, 922, 0.011)
Y = mode("tool", "y", 0.04, 1010, 0.02)
TABLE = mode("table", "x", 0.194, 1490, 0.0213)
HIGH = mode("tool", "y", 0.01, 2300, 0.015)


def tables(mill, engagement, law):
    out = {
        "tool": {"teeth": mill.teeth, "diameter_mm": 1e3 * mill.diameter,
                 "helix_deg": [math.degrees(h) for h in mill.helices] or
                 math.degrees(mill.helix)},
        "cut": {**engagement, "axial_depth_mm": 1e3 * mill.depth,
                "feed_per_tooth_mm": 1e3 * mill.feed, "spindle_rpm": mill.rpm},
        "chip": {"model": "radial"},
        "stability": {"spindle_rpm": [mill.rpm, 1.1 * mill.rpm, 2],
                      "axial_depth_mm": [1e3 * mill.depth, 1.1e3 * mill.depth, 2],
                      "tolerance": 1e-8}}
    if mill.pitch:
        out["tool"]["pitch_deg"] = [math.degrees(p) for p in mill.pitch]
    if mill.offsets:
        out["runout"] = {"radial_offsets_mm": [1e3 * r for r in mill.offsets]}
    out["force"] = {"K_tc_MPa": mill.K_t / 1e6, "K_rc_MPa": mill.K_r / 1e6, "K_ac_MPa": 0,
                    "K_te_N_per_mm": 0, "K_re_N_per_mm": 0, "K_ae_N_per_mm": 0}
    if mill.power:
        m_t, m_r, floor = mill.power
        out["force"] = {"law": law, "K_t1_MPa": mill.K_t / 1e6, "m_t": m_t,
                        "K_r1_MPa": mill.K_r / 1e6, "m_r": m_r, "K_a1_MPa": 0, "m_a": 0}
        if law == "power_edge":  # a constant force feels no vibration
            out["force"] |= {"K_te_N_per_mm": 9, "K_re_N_per_mm": 7, "K_ae_N_per_mm": 2}
        out["stability"]["chip_floor_um"] = 1e6 * floor
    if mill.flank:
        land, per_volume, friction = mill.flank
        out["force"] |= {"wear_land_um": 1e6 * land, "indentation_N_per_mm3": per_volume / 1e9,
                         "flank_friction": friction}
    return out


SLOT = ({"engagement": "slot"}, 0, np.pi)
UP = ({"engagement": "up", "radial_depth_mm": 2.5}, 0, np.pi / 3)
DOWN = ({"engagement": "down", "radial_depth_mm": 2.5}, 2 * np.pi / 3, np.pi)


class Compared(unittest.TestCase):
    def compare(self, modes, where, steps, law="power", share=0.03, **other):
        engagement, entry, leave = where
        mill = st.Mill(**{"teeth": 2, "K_t": 600e6, "K_r": 200e6, "entry": entry,
                          "leave": leave, "depth": 0.5e-3, "rpm": 12000,
                          "modes": [m[1] for m in modes], **other})
        text = program.case_text("compared", tables(mill, engagement, law))
        for given, _ in modes:
            text += "\n[[mode]]\n" + "".join(
                f"{k} = {program.toml(v)}\n" for k, v in given.items())
        with tempfile.TemporaryDirectory() as folder:
            answer = program.run("stability", text, folder, "case")
        self.assertEqual(answer.code, 0, answer.stderr)
        mu = answer.result["multiplier"]
        turn = mu["absolute"] ** (mill.teeth if mu["period"] == "tooth" else 1)
        want, change = st.limit(mill, steps)
        # What the extrapolation leaves is a small part of what it takes away.
        self.assertLess(abs(turn - want), share * change + 2e-6, f"{turn} {want} {change}")
        self.assertLess(change, 0.02 * want)

    def test_one_mode(self):  # [D-3] [D-4] [D-7] [D-11]
        self.compare([X], SLOT, 120)
        self.compare([X], UP, 120)
        self.compare([X], DOWN, 120)

    def test_tool_and_table(self):  # [D-1] [D-2]
        self.compare([X, TABLE], SLOT, 120)
        self.compare([X, Y, HIGH, TABLE], DOWN, 120)

    def test_modes_askew(self):  # [D-1] [D-2]
        """One that moves x and y at once couples them."""
        askew = mode("tool", "x", 0.03993, 922, 0.011, 25.0)
        across = mode("tool", "y", 0.04, 1010, 0.02, 25.0)
        table = mode("table", "x", 0.194, 1490, 0.0213, -40.0)
        self.compare([askew], SLOT, 120)
        self.compare([askew, across], DOWN, 120)
        self.compare([X, Y, table], UP, 120)

    def test_helix(self):  # [D-9]
        self.compare([X, Y], SLOT, 120, helix=math.radians(40), depth=1e-3)
        self.compare([X, Y], DOWN, 120, helix=math.radians(30), teeth=3, depth=2e-3)

    def test_unequal_pitch(self):  # [D-8]
        pitch = tuple(math.radians(p) for p in (168, 192))
        self.compare([X, Y], SLOT, 120, pitch=pitch)
        pitch = tuple(math.radians(p) for p in (114, 126, 120))
        self.compare([X], DOWN, 120, pitch=pitch, teeth=3, depth=1e-3)

    def test_variable_helix(self):  # [D-36] [D-37]
        """Delays that change along the edge. Steps do not fit them: the extrapolation
        leaves more."""
        degrees = lambda *all: tuple(math.radians(a) for a in all)  # noqa: E731
        self.compare([X, Y], SLOT, 120, share=0.15, helices=degrees(30, 38), depth=1e-3)
        self.compare([X, Y], DOWN, 120, share=0.15, helices=degrees(28, 36, 41), teeth=3,
                     depth=3e-3)
        self.compare([X], UP, 120, share=0.15, helices=degrees(30, 40), depth=4e-3,
                     pitch=degrees(174, 186), offsets=(20e-6, 0.0))
        self.compare([X, Y], UP, 120, share=0.15, flank=(25e-6, 3e13, 0.3),
                     helices=degrees(30, 35), depth=2e-3)
        self.compare([X, Y], UP, 120, "power", share=0.15, power=(0.3, 0.4, 25e-6),
                     K_t=200e6, K_r=60e6, helices=degrees(30, 35), depth=1e-3)

    def test_runout(self):  # [D-8]
        """Half the feed: the long tooth meets its own mark for 30 deg at either end."""
        self.compare([X], SLOT, 120, offsets=(25e-6, 0.0))
        self.compare([X, Y], SLOT, 120, offsets=(0.0, 25e-6))
        self.compare([X], UP, 120, offsets=(25e-6, 0.0))
        self.compare([X], SLOT, 120, offsets=(25e-6, 0.0), helix=math.radians(30))

    def test_runout_that_keeps_teeth_out(self):  # [D-8]
        """More than the feed: one tooth of two does all the work."""
        self.compare([X], DOWN, 120, offsets=(60e-6, 0.0))

    def test_power_law(self):  # [D-5] [D-6]
        power = (0.3, 0.4, 25e-6)
        self.compare([X], SLOT, 120, power=power, K_t=200e6, K_r=60e6)
        self.compare([X, Y], UP, 120, power=power, K_t=200e6, K_r=60e6)
        self.compare([X, Y], UP, 120, "power_edge", power=power, K_t=200e6, K_r=60e6)

    def test_process_damping(self):  # [F-16] [D-30] [D-31] [D-32]
        flank = (25e-6, 3e13, 0.3)
        self.compare([X], SLOT, 120, flank=flank, rpm=5000)
        self.compare([X, Y], UP, 120, flank=flank, rpm=9000, depth=1e-3)
        self.compare([X, Y, TABLE], DOWN, 120, flank=(60e-6, 2e13, 0.5), depth=1e-3)
        self.compare([X, Y], SLOT, 120, flank=flank, helix=math.radians(40), depth=1e-3)
        self.compare([X, Y], SLOT, 120, flank=flank, offsets=(25e-6, 0.0))
        self.compare([X, Y], UP, 120, "power", flank=flank, power=(0.3, 0.4, 25e-6),
                     K_t=200e6, K_r=60e6)

    def test_the_transcription_itself(self):
        """Its order is two: the change falls by four when the steps double."""
        mill = st.Mill(2, 600e6, 200e6, 0, np.pi, 0.2e-3, 12000, [X[1]])
        mu = [st.multiplier(mill, n) for n in (60, 120, 240)]
        self.assertAlmostEqual((mu[1] - mu[0]) / (mu[2] - mu[1]), 4, delta=0.2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
