"""`trochoid dynamics` against the transcription: every place and force of the last turn."""
import math
import sys
import tempfile
import unittest

import motion as mo
import numpy as np
import program

GAIN, T_1, T_2 = 0.99536, 1.1303e-3, 1.1376e-3


def mode(body, axis, mass, hertz, ratio):
    omega = 2 * math.pi * hertz
    sign = 1 if body == "tool" else -1
    return ({"body": body, "axis": axis, "mass_kg": mass, "stiffness_N_per_m": mass * omega**2,
             "damping_Ns_per_m": 2 * ratio * omega * mass},
            (mass, 2 * ratio * omega * mass, mass * omega**2,
             sign * (axis == "x"), sign * (axis == "y")))


X = mode("tool", "x", 0.0324, 2500, 0.025)
Y = mode("tool", "y", 0.0324, 2400, 0.03)
LOW = mode("tool", "y", 0.6, 900, 0.03)
TABLE = mode("table", "x", 0.194, 1490, 0.0213)

POWER = ((166.7e6, 0.598, 0.0), (58.35e6, 0.598, 0.0), (60e6, 0.3, 0.0))
SMOOTH = ((420e6, 0.28, 0.0), (95e6, 0.42, 0.0), (0.0, 0.0, 0.0))
POWER_EDGE = ((420e6, 0.28, 4e3), (95e6, 0.42, 3e3), (50e6, 0.1, 1e3))
LINEAR = (800e6, 300e6, 100e6, 0.0, 0.0, 0.0)
EDGES = (800e6, 300e6, 100e6, 4e3, 3e3, 1e3)

SLOT = ({"engagement": "slot"}, 0.0, math.pi)
UP = ({"engagement": "up", "radial_depth_mm": 2.0}, 0.0, math.pi / 3)
DOWN = ({"engagement": "down", "radial_depth_mm": 2.0}, 2 * math.pi / 3, math.pi)
BAND = ({"engagement": "band", "stock_y_mm": [-2.0, 2.0]}, math.pi / 3, 2 * math.pi / 3)


def tables(cut, engagement, turns):
    out = {"tool": {"teeth": len(cut.pitch), "diameter_mm": 1e3 * cut.diameter,
                    "helix_deg": math.degrees(cut.helix),
                    "pitch_deg": [math.degrees(p) for p in cut.pitch]},
           "runout": {"radial_offsets_mm": [1e3 * r for r in cut.offsets]},
           "cut": {**engagement, "axial_depth_mm": 1e3 * cut.depth,
                   "feed_per_tooth_mm": 1e3 * cut.feed, "spindle_rpm": cut.rpm},
           "chip": {"model": "radial"},
           "sampling": {"samples_per_rev": 240, "revolutions": turns}}
    if cut.linear:
        K = cut.linear
        out["force"] = {"K_tc_MPa": K[0] / 1e6, "K_rc_MPa": K[1] / 1e6, "K_ac_MPa": K[2] / 1e6,
                        "K_te_N_per_mm": K[3] / 1e3, "K_re_N_per_mm": K[4] / 1e3,
                        "K_ae_N_per_mm": K[5] / 1e3}
    else:
        edge = any(K_e for _, _, K_e in cut.power)
        out["force"] = {"law": "power_edge" if edge else "power"}
        for (K, m, K_e), q in zip(cut.power, "tra"):
            out["force"] |= {f"K_{q}1_MPa": K / 1e6, f"m_{q}": m}
            if edge:
                out["force"] |= {f"K_{q}e_N_per_mm": K_e / 1e3}
    if cut.flank:
        out["force"] |= {"wear_land_um": 1e6 * cut.flank[0],
                         "indentation_N_per_mm3": cut.flank[1] / 1e9,
                         "flank_friction": cut.flank[2]}
    if cut.actuator:
        out["actuator"] = {"gain": GAIN, "time_constants_s": [T_1, T_2]}
        out["command"] = {"shape": "sine", "peak_to_peak_um": 20, "lead_s": 0.001}
    return out


class Compared(unittest.TestCase):
    def compare(self, modes, where, turns=3, steps=1500, **other):
        engagement, entry, leave = where
        cut = mo.Cut(**{"pitch": [math.pi] * 2, "offsets": [0.0, 0.0], "entry": entry,
                        "leave": leave, "depth": 0.4e-3, "feed": 5e-5, "rpm": 3000,
                        "modes": [m[1] for m in modes], **other})
        text = program.case_text("compared", tables(cut, engagement, turns))
        for given, _ in modes:
            text += "\n[[mode]]\n" + "".join(
                f"{k} = {program.toml(v)}\n" for k, v in given.items())
        with tempfile.TemporaryDirectory() as folder:
            answer = program.run("dynamics", text, folder, "case")
            self.assertEqual(answer.code, 0, answer.stderr)
            places, forces = answer.columns("motion.csv"), answer.columns("forces.csv")
        # The program goes on until the motion repeats.
        turns = answer.result["turns"]
        want = mo.Motion(cut, steps).run(turns)
        # Second order: 1000 steps a tooth, in radians of the fastest mode.
        fastest = max(math.sqrt(m[2] / m[0]) for m in cut.modes)
        step = fastest * 60 / cut.rpm / len(cut.pitch) / answer.result["steps_per_tooth"]
        tolerance = 0.06 * step**2
        r = len(modes)
        columns = {"x_tool_um": [0.0, 0], "y_tool_um": [0.0, 0], "x_table_um": [0.0, 0]}
        off, largest, force_off, force_largest = 0.0, 0.0, 0.0, 0.0
        for i, t in enumerate(places["time_s"]):
            z = want.state(t)
            columns = dict.fromkeys(("x_tool_um", "y_tool_um", "x_table_um"), 0.0)
            for eta, (given, _) in zip(z, modes):
                columns[f"{given['axis']}_{given['body']}_um"] += 1e6 * eta
            if cut.actuator:
                columns["x_actuator_um"] = 1e6 * z[2 * r]
            off = max([off] + [abs(places[c][i] - v) for c, v in columns.items()])
            largest = max([largest] + [abs(v) for v in columns.values()])
            near = want.omega * t - want.behind
            if any(np.abs(np.sin(0.5 * (near - edge))).min() < 1e-6 for edge in (entry, leave)):
                continue  # both sides of a jump are right
            F = want.force(t, z)
            got = [forces[c][i] for c in ("Fx_N", "Fy_N", "Fz_N")]
            # Where the force hardly lets the chip be small, it shows places much enlarged.
            moved = np.zeros_like(z)
            moved[:r] = want.direction @ [1e-6 * off, 1e-6 * off]
            either = np.abs(want.force(t, z + moved) - want.force(t, z - moved)).max()
            force_off = max(force_off, np.abs(got - F).max() - either)
            force_largest = max(force_largest, np.abs(F).max())
        self.assertLess(off / largest, tolerance)
        self.assertLess(force_off / force_largest, tolerance)
        self.assertGreater(largest, 0.3)

    @program.long_form
    def test_slot(self):  # [T-1] [T-4]
        self.compare([X, Y], SLOT, linear=LINEAR)

    def test_runout_and_a_moving_table(self):  # [T-1] [T-2]
        drive = (2, GAIN, T_1, T_2, TABLE[1][2], TABLE[1][1])
        lead = 2 * math.pi * 20
        self.compare([X, Y, TABLE], SLOT, power=POWER, offsets=[13e-6, -13e-6], rpm=1200,
                     actuator=drive, steps=2000,
                     command=lambda t: 10e-6 * math.sin(lead * (t + 0.001)))

    @program.long_form
    def test_up(self):
        self.compare([X, Y], UP, power=SMOOTH, pitch=[2 * math.pi / 3] * 3,
                     offsets=[4e-6, -5e-6, 1e-6], steps=2000)

    @program.long_form
    def test_down(self):
        self.compare([X, Y, LOW, TABLE], DOWN, linear=LINEAR, pitch=[math.pi / 2] * 4,
                     offsets=[0.0] * 4, depth=0.3e-3, steps=2000)

    def test_band_with_edges_and_unequal_pitch(self):  # delays between the steps
        self.compare([X, Y], BAND, linear=EDGES, pitch=[1.9, 2.2, 2 * math.pi - 4.1],
                     offsets=[2e-6, -3e-6, 0.0])

    def test_power_law_with_edge_forces(self):  # [F-9]
        self.compare([X, Y], SLOT, power=POWER_EDGE, offsets=[2e-6, -2e-6], steps=3000)

    @program.long_form
    def test_power_law_with_edge_forces_of_three_teeth(self):  # [F-9]
        self.compare([X, Y], BAND, power=POWER_EDGE, pitch=[2 * math.pi / 3] * 3,
                     offsets=[2e-6, -3e-6, 0.0])

    @program.long_form
    def test_six_unequal_teeth(self):
        pitch = [1.0, 1.1, 1.05, 0.95, 1.15]
        self.compare([X, TABLE], SLOT, power=SMOOTH, pitch=pitch + [2 * math.pi - sum(pitch)],
                     offsets=[2e-6, -3e-6, 0.0, 1e-6, -1e-6, 3e-6], depth=0.3e-3, steps=2000)

    def test_one_tooth(self):
        self.compare([X, Y], SLOT, linear=LINEAR, pitch=[2 * math.pi], offsets=[0.0])

    def test_helix(self):
        self.compare([X, Y], SLOT, linear=LINEAR, offsets=[5e-6, -5e-6], helix=0.5,
                     slices=100)

    def test_process_damping(self):  # [F-16] [T-16] [T-17]
        flank = (60e-6, 3e13, 0.3)
        self.compare([X, Y, LOW, TABLE], UP, linear=EDGES, flank=flank, rpm=1500)

    @program.long_form
    def test_process_damping_of_a_helix(self):  # [F-16] [T-16] [T-17]
        self.compare([X, Y], SLOT, linear=LINEAR, flank=(60e-6, 3e13, 0.3), helix=0.5,
                     slices=100)


class Verdicts(unittest.TestCase):
    """What the motion comes to, from what the program wrote of it."""

    def moved(self, **changed):
        cut = {"engagement": "slot", "axial_depth_mm": 0.5, "feed_per_tooth_mm": 0.05,
               "spindle_rpm": 5000, **changed}
        text = program.case_text("verdict", {
            "tool": {"teeth": 2, "diameter_mm": 10, "helix_deg": 0}, "cut": cut,
            "chip": {"model": "none"},
            "force": {"K_tc_MPa": 600, "K_rc_MPa": 200, "K_ac_MPa": 0, "K_te_N_per_mm": 0,
                      "K_re_N_per_mm": 0, "K_ae_N_per_mm": 0}})
        given, _ = mode("tool", "x", 0.03993, 922, 0.011)
        text += "\n[[mode]]\n" + "".join(f"{k} = {program.toml(v)}\n" for k, v in given.items())
        with tempfile.TemporaryDirectory() as folder:
            answer = program.run("dynamics", text, folder, "case")
            self.assertEqual(answer.code, 0, answer.stderr)
            forces = answer.columns("forces.csv")
            spectrum = None if answer.result["period"] else answer.columns("spectrum.csv")
        return answer.result, np.array([forces["Fx_N"], forces["Fy_N"]]).T, spectrum

    def test_periods(self):  # [T-15]
        interrupted = {"engagement": "up", "radial_depth_mm": 0.6, "spindle_rpm": 19500}
        for changed, teeth in (({"axial_depth_mm": 0.2}, 1),
                               ({**interrupted, "axial_depth_mm": 1.7}, 1),
                               ({**interrupted, "axial_depth_mm": 2.5}, 2)):
            result, force, _ = self.moved(**changed)
            self.assertEqual(mo.passes(force, 2, result["peak_xy_N"]), teeth)
            self.assertEqual(result["period"]["teeth"], teeth)

    def test_the_lines_of_a_spectrum(self):  # [T-13] [T-14]
        t = np.arange(4096) / 4096
        q = 3 + 5 * np.sin(2 * np.pi * 200.3 * t) + 2 * np.sin(2 * np.pi * 517 * t)
        k, height = mo.line_near(mo.hann_amplitudes(q), 200)
        np.testing.assert_allclose([k, height], [200.3, 5], rtol=1e-4)
        result, _, spectrum = self.moved()
        a = np.hypot(spectrum["x_um"], spectrum["y_um"])
        step = spectrum["frequency_Hz"][1]
        self.assertGreater(len(result["vibration"]["lines"]), 1)
        for line in result["vibration"]["lines"]:
            k, height = mo.line_near(a, int(round(line["frequency_Hz"] / step)))
            self.assertAlmostEqual(k * step, line["frequency_Hz"], delta=1e-6 * step)
            self.assertAlmostEqual(height, np.hypot(line["x_um"], line["y_um"]), delta=1e-6 * height)


if __name__ == "__main__":
    if not program.pathlib.Path(program.PROGRAM).exists():
        print("the program is not built", file=sys.stderr)
        sys.exit(77)
    unittest.main()
