"""Well-known stability diagrams: the program, the transcription, and the page of the guide.

Each row of the tables of docs/guide/stability_diagrams.md is one cut at one speed. The limit
of the program (Floquet multiplier) is compared with semi-discretisation, its two solutions
in the frequency domain with Hill's determinant and with each other, and all numbers with
those printed on the page. `--write` prints the rows for the page.
"""
import math
import pathlib
import re
import sys
import tempfile
import tomllib
import unittest

import diagrams as d
import numpy as np
import program
import stability as st

PAGE = program.ROOT / "docs/guide/stability_diagrams.md"
ONE = [(0.03993, 922, 0.011, 1, 0)]
TWO = [(0.03993, 922, 0.011, 1, 0), (0.03993, 922, 0.011, 0, 1)]
BOOK = [(0.9631, 456.8, 0.1117, 1, 0), (0.1773, 1448.9, 0.0170, 1, 0),
        (0.8901, 516.5, 0.0246, 0, 1), (0.1584, 1408.4, 0.0313, 0, 1)]
# name, modes, K_t, K_r, diameter; kind, immersion, rpm, largest depth
ROWS = [("one", ONE, 600e6, 200e6, 10.0, *row) for row in [
    ("up", 0.05, 9000, 15), ("up", 0.05, 12000, 15), ("up", 0.05, 18000, 15),
    ("down", 0.05, 12000, 5), ("down", 0.05, 18000, 5),
    ("up", 0.1, 12000, 8), ("down", 0.1, 18000, 5),
    ("up", 0.5, 9000, 5), ("down", 0.5, 9000, 5),
    ("up", 1.0, 5000, 2), ("up", 1.0, 12000, 5)]] + \
    [("two", TWO, 600e6, 200e6, 10.0, *row) for row in [
        ("down", 0.05, 18000, 5), ("up", 0.1, 12000, 8), ("down", 0.5, 9000, 5),
        ("up", 1.0, 12000, 5)]] + \
    [("book", BOOK, 1319.4e6, 788.8e6, 31.75, *row) for row in [
        ("down", 0.5, 9500, 8), ("down", 0.5, 14000, 8)]]


def case_of(row, files):
    _, modes, K_t, K_r, diameter, kind, immersion, rpm, most = row
    cut = {"engagement": "slot"} if immersion == 1 else {
        "engagement": kind, "radial_depth_mm": immersion * diameter}
    text = program.case_text("diagram", {
        "tool": {"teeth": 2, "diameter_mm": diameter, "helix_deg": 0},
        "cut": {**cut, "axial_depth_mm": most, "feed_per_tooth_mm": 0.05,
                "spindle_rpm": rpm},
        "chip": {"model": "none"},
        "force": {"K_tc_MPa": K_t / 1e6, "K_rc_MPa": K_r / 1e6, "K_ac_MPa": 0,
                  "K_te_N_per_mm": 0, "K_re_N_per_mm": 0, "K_ae_N_per_mm": 0},
        "stability": {"spindle_rpm": [rpm, 1.01 * rpm, 2],
                      "axial_depth_mm": [most / 10, most, 2], "harmonics": 8}})
    for mass, hertz, ratio, x, _ in modes:
        text += (f'\n[[mode]]\nbody = "tool"\naxis = "{"x" if x else "y"}"\n'
                 f"mass_kg = {mass}\nfrequency_Hz = {hertz}\ndamping_ratio = {ratio}\n")
    for axis, file in files.items():
        text += f'\n[[measured_frf]]\nfile = "{file}"\naxis = "{axis}"\n'
    return text


def write_frf(modes, folder):
    """Noiseless responses of the modes, 1 Hz apart."""
    f = np.arange(100.0, 4000.1, 1.0)
    G = d.receptance(d.Cut(2, 1, 1, 0, 1, modes), 2 * np.pi * f)
    files = {}
    for i, axis in enumerate("xy"):
        if np.abs(G[:, i, i]).max() > 0:
            rows = [f"{a:.17g},{h.real:.17g},{h.imag:.17g}" for a, h in zip(f, G[:, i, i])]
            files[axis] = f"{axis}.csv"
            pathlib.Path(folder, files[axis]).write_text(
                "freq_Hz,re_m/N,im_m/N\n" + "\n".join(rows) + "\n")
    return files


def measured(row, folder):
    """What the program says, and the row of the page without the transcription."""
    answer = program.run("stability", case_of(row, write_frf(row[1], folder)), folder, "case")
    if answer.code != 0:
        raise RuntimeError(answer.stderr)
    return answer.result


def depths_of(row):
    return np.arange(1, 101) * row[8] * 1e-5


def cut_of(row):
    _, modes, K_t, K_r, _, kind, immersion, *_ = row
    return d.Cut(2, K_t, K_r, *d.engaged(kind, immersion), modes)


NAMES = {"hopf": "Hopf", "period_doubling": "flip"}


def cells(row, result, semi):
    frf = result["measured_frf"]

    def depth(solution):
        value = frf[solution]["limit_depth_mm"]
        return "none" if value is None else f"{value:.3f}"
    limit = result["limit_depth_mm"]
    return [row[0], "slot" if row[6] == 1 else row[5], f"{row[6]:g}", str(row[7]),
            f"{limit:.3f}", NAMES[result["limit"]["type"]],
            f'{result["limit"]["chatter_frequencies_Hz"][0]:.0f}', f"{1e3 * semi:.3f}",
            f"{100 * (limit / semi / 1e3 - 1):.2f}", depth("zeroth_order"),
            depth("multi_frequency")]


def printed():
    rows = [[c.strip() for c in line.strip("| \n").split("|")]
            for line in PAGE.read_text().splitlines() if re.match(r"\| (one|two|book) ", line)]
    return {tuple(r[:4]): r for r in rows if len(r) == 11}


class Diagrams(unittest.TestCase):
    def test_limits(self):  # [D-13] [D-12]
        page = printed()
        self.assertEqual(len(page), len(ROWS))
        for row in ROWS:
            with self.subTest(row=row[0], cut=row[5:8]), \
                    tempfile.TemporaryDirectory() as folder:
                result = measured(row, folder)
                semi, mu = d.limit_depth(cut_of(row), row[7], depths_of(row))
                limit = result["limit_depth_mm"] * 1e-3
                # Semi-discretisation with 48 and 96 steps a tooth, extrapolated.
                self.assertLess(abs(limit / semi - 1), 1e-3)
                self.assertEqual(result["limit"]["type"], d.kind(mu))
                both = result["measured_frf"]["multi_frequency"]["limit_depth_mm"] * 1e-3
                # Rigid above 4 kHz, and eight harmonics of a short cut.
                self.assertLess(abs(both / limit - 1), 2e-2)
                got = cells(row, result, semi)
                want = page[tuple(got[:4])]
                self.assertEqual(got[5], want[5])
                for a, b in zip(got[4:], want[4:]):
                    if re.match(r"[-0-9.]+$", a):
                        # the difference in percent hangs on the last digits of numpy
                        self.assertAlmostEqual(float(a), float(b), delta=max(
                            0.02, 2e-3 * abs(float(b))), msg=f"{got} {want}")

    def test_zeroth_order(self):  # [D-20] [D-21] [D-22] [D-23]
        for row in (ROWS[4], ROWS[10], ROWS[13]):
            with tempfile.TemporaryDirectory() as folder:
                got = measured(row, folder)["measured_frf"]["zeroth_order"]
            depth, hertz = d.frequency_limit(cut_of(row), row[7], 0)
            self.assertAlmostEqual(got["limit_depth_mm"] / 1e3 / depth, 1, delta=1e-3)
            self.assertAlmostEqual(got["chatter_frequency_Hz"], hertz, delta=0.5)

    def test_tap_tests_of_modes_askew(self):  # [D-24] [D-25]
        """examples/measured_frf: the modes behind the responses are found again, and the
        limit is that of Hill's determinant of these modes."""
        folder = program.ROOT / "examples/measured_frf"
        truth = tomllib.loads((folder / "truth.toml").read_text())["mode"]
        text = f"include = {program.toml(str(folder / 'case.toml'))}\n[stability]\n" \
            "spindle_rpm = [12000, 12100, 2]\naxial_depth_mm = [0.1, 3, 2]\nharmonics = 6\n" \
            '[chip]\nmodel = "none"\n'  # tooth paths are circles in the transcription
        with tempfile.TemporaryDirectory() as out:
            answer = program.run("stability", text, out, "case")
        result = answer.result
        modes = []
        for found, true in zip(result["modes"], truth, strict=True):
            angle = math.radians(true["angle_deg"] + 90 * (true["axis"] == "y"))
            direction = np.array([math.cos(angle), math.sin(angle)])
            modes.append((true["mass_kg"], true["frequency_Hz"], true["damping_ratio"],
                          *direction))
            # Three responses with noise of 0.2 m/s^2/N under peaks of 150 and more.
            self.assertAlmostEqual(found["frequency_Hz"], true["frequency_Hz"], delta=0.2)
            self.assertAlmostEqual(found["mass_kg"] / true["mass_kg"], 1, delta=0.005)
            self.assertAlmostEqual(abs(direction @ found["direction"]), 1, delta=1e-5)
        cut = d.Cut(3, 800e6, 250e6, *d.engaged("down", 0.5), modes)
        per_depth = 2 * math.tan(math.radians(30)) / 0.012
        depth = 1e-3
        for _ in range(4):  # the limit of a force that is turned as far as at the limit
            depth, _ = d.frequency_limit(cut, 12000, 6, (200, 4000), 2.0, per_depth * depth)
        both = result["measured_frf"]["multi_frequency"]["limit_depth_mm"] / 1e3
        self.assertAlmostEqual(both / depth, 1, delta=0.01)
        self.assertAlmostEqual(result["limit_depth_mm"] / 1e3 / both, 1, delta=0.01)

    def test_flip_islands(self):  # [D-11]
        """With a helix a flip is a closed island: stable again above it, in both."""
        file = program.ROOT / "examples/stability_islands/case.toml"
        mass, hertz, ratio, *_ = ONE[0]
        omega = 2 * np.pi * hertz
        modes = [(mass, 2 * ratio * omega * mass, mass * omega**2, 1, 0)]
        for depth, kind in ((0.8, None), (2, "period_doubling"), (4, None), (6, "hopf")):
            text = (f"include = {program.toml(str(file))}\n[cut]\naxial_depth_mm = {depth}\n"
                    "[stability]\nspindle_rpm = [18000, 19000, 2]\n"
                    "axial_depth_mm = [0.1, 0.2, 2]\n")
            with tempfile.TemporaryDirectory() as folder:
                got = program.run("stability", text, folder, "case").result["multiplier"]
            mill = st.Mill(2, 600e6, 200e6, *d.engaged("up", 0.05), depth * 1e-3, 18750, modes,
                           helix=np.pi / 4)
            want = st.multiplier(mill, 144)
            # Entry inside a step: the transcription is good to some hundredths.
            self.assertAlmostEqual(got["absolute"] ** 2, want, delta=0.05 * want)
            self.assertEqual(got["absolute"] > 1, kind is not None)
            self.assertEqual(want > 1, kind is not None)
            if kind:
                self.assertEqual(got["type"], kind)

    def test_runout_moves_a_lobe(self):
        """The limit of examples/stability_runout: a turn of it neither grows nor fades."""
        file = program.ROOT / "examples/stability_runout/case.toml"
        with tempfile.TemporaryDirectory() as folder:
            text = f"include = {program.toml(str(file))}\n" + \
                "[stability]\nspindle_rpm = [12000, 12100, 2]\naxial_depth_mm = [2, 5, 2]\n"
            with_runout = program.run("stability", text, folder, "with").result
            text += "[runout]\nradial_offsets_mm = [0, 0]\n"
            without = program.run("stability", text, folder, "without").result
        mass, hertz, ratio, *_ = ONE[0]
        omega = 2 * np.pi * hertz
        mill = st.Mill(2, 600e6, 200e6, 0, np.pi, with_runout["limit_depth_mm"] * 1e-3, 12000,
                       [(mass, 2 * ratio * omega * mass, mass * omega**2, 1, 0)],
                       offsets=(25e-6, 0.0))
        mu, change = st.limit(mill, 120)
        self.assertAlmostEqual(mu, 1, delta=0.05 * change + 1e-3)
        self.assertEqual(with_runout["limit"]["type"], "period_one")
        self.assertGreater(with_runout["limit_depth_mm"], 1.3 * without["limit_depth_mm"])


if __name__ == "__main__":
    if "--write" in sys.argv:
        for one in ROWS:
            with tempfile.TemporaryDirectory() as where:
                found = measured(one, where)
            print("| " + " | ".join(cells(one, found, d.limit_depth(
                cut_of(one), one[7], depths_of(one))[0])) + " |", flush=True)
    else:
        unittest.main(argv=sys.argv[:1])
