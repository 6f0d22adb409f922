"""modes and actuator of the program against the fits of the transcription, on the example."""
import json
import os
import pathlib
import subprocess
import tempfile
import tomllib
import unittest

import numpy as np

import modes

EXAMPLE = pathlib.Path(__file__).resolve().parents[2] / "examples/tap_test"
TRUTH = tomllib.loads((EXAMPLE / "truth.toml").read_text())
KEYS = ("mass_kg", "stiffness_N_per_m", "damping_Ns_per_m")


def answer(*arguments, table=None):
    with tempfile.TemporaryDirectory(prefix="trochoid_") as folder:
        out = pathlib.Path(folder) / "out"
        subprocess.run([os.environ["TROCHOID"], *map(str, arguments), "-o", out, "--quiet",
                        "--no-report"], check=True)
        result = json.loads((out / "summary.json").read_text())["result"]
        if table is None:
            return result
        return result, np.loadtxt(out / table, delimiter=",", skiprows=1)


class Compared(unittest.TestCase):
    def near(self, ours, theirs, rel):
        np.testing.assert_allclose(ours, theirs, rtol=rel)

    def test_modes(self):  # [M-6] [M-7] [M-15] [M-16]
        f, re, im = np.loadtxt(EXAMPLE / "tip_x.csv", delimiter=",", skiprows=2).T
        band = f >= 200
        truth = [[mode[key] for key in KEYS] for mode in TRUTH["mode"]]
        expected, se, noise = modes.fit_accelerance(f[band], (re + 1j * im)[band], truth)
        result = answer("modes", EXAMPLE / "case.toml")
        found = result["modes"]
        self.assertEqual(len(found), 2)
        self.near([[m[key] for key in KEYS] for m in found], expected, 1e-6)
        self.near([[m["se"][key] for key in KEYS] for m in found], se, 1e-4)
        ours = result["noise"]
        self.near(ours["floor_m_per_s2_N"], noise[0], 1e-4)
        self.near(ours["magnitude_percent"], 100 * noise[1], 1e-4)
        # 0.3 and 1 % of the magnitude made it: tools/make_tap_test.py
        self.near(noise[0], 0.3, 0.1)
        self.near(noise[1], 0.01, 0.1)
        self.near([m["stiffness_N_per_m"] for m in found], [t[1] for t in truth], 0.03)
        self.assertLess(np.max(np.abs(expected - truth) / se), 4)

    def test_hammer_blows(self):  # [M-20] [M-21] [M-23]
        t, force, a = np.loadtxt(EXAMPLE / "hammer.csv", delimiter=",", skiprows=2).T
        rate = (len(t) - 1) / (t[-1] - t[0])
        result, table = answer("modes", EXAMPLE / "hammer.csv", table="response.csv")
        hits = result["hits"]
        self.assertEqual([hit["left_out"] is None for hit in hits], [True, True, False, True])
        self.assertIn("strikes again 22 ms later", hits[2]["left_out"])
        n = round(result["block_s"] * rate)
        starts = [round((hit["time_s"] - t[0]) * rate) for hit in hits if not hit["left_out"]]
        f, H, coherence = modes.h1(force, a, starts, n, rate, result["window_end"])
        np.testing.assert_allclose(table[:, 0], f[1:len(table) + 1], rtol=1e-9)
        expected = H[1:len(table) + 1]
        ours = table[:, 1] + 1j * table[:, 2]
        self.assertLess(np.max(np.abs(ours - expected)), 1e-6 * np.max(np.abs(expected)))
        self.near(table[:, 3], coherence[1:len(table) + 1], 1e-6)
        # The window is taken out of the modes again, and its spread of noise is counted.
        for mode, truth in zip(result["modes"], TRUTH["mode"]):
            for key in KEYS:
                # a thousandth more: rounded samples, the base line before each blow
                slack = 4 * mode["se"][key] + 1e-3 * truth[key]
                self.assertLess(abs(mode[key] - truth[key]), slack, key)

    def test_actuator(self):  # [M-13]
        t, _, y = np.loadtxt(EXAMPLE / "step.csv", delimiter=",", skiprows=2).T
        a, s = TRUTH["actuator"], TRUTH["step"]
        wn = 2 * np.pi * a["frequency_Hz"]
        truth = np.array([a["gain"], 2 * a["damping_ratio"] / wn, 1 / wn**2])
        expected, se = modes.fit_step(t, y, s["step_um"], s["start_s"], truth)
        found = answer("actuator", EXAMPLE / "step.csv", "--start-s", s["start_s"])
        ours = [found["gain"], found["sum_s"], found["product_s2"]]
        self.near(ours, expected, 1e-6)
        self.near([found["se"][key] for key in ("gain", "sum_s", "product_s2")], se, 1e-4)
        self.assertLess(np.max(np.abs(expected - truth) / se), 4)
        self.assertIsNone(found["time_constants_s"])
        free = answer("actuator", EXAMPLE / "case.toml")
        self.assertLess(abs(free["start_s"] - s["start_s"]), 4 * free["se"]["start_s"])


if __name__ == "__main__":
    unittest.main()
