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
SEVERAL = EXAMPLE.parent / "several_responses"
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
        # 0.3 and 1 % of the magnitude made it: examples/tap_test/make.py
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

    def read_sets(self):
        """The complex sets 58 of the example, by motion and force."""
        lines = (SEVERAL / "tool.uff").read_text().splitlines()
        out = {}
        for i in (i for i, line in enumerate(lines) if line == "    58"):
            place = lines[i + 6].split()
            name = "xy"[int(place[6]) - 1] + "xy"[int(place[9]) - 1]
            n, first, step = (float(lines[i + 7].split()[k]) for k in (1, 3, 4))
            numbers = []
            for line in lines[i + 12:]:
                if line == "    -1":
                    break
                numbers += [float(line[k:k + 13]) for k in range(0, len(line), 13)]
            H = np.array(numbers).reshape(-1, 2)
            self.assertEqual(len(H), n)
            out[name] = H[:, 0] + 1j * H[:, 1]
        return first + step * np.arange(int(n)), out

    def truth_of_several(self):
        """Poles and shapes by the eigenvectors of the state matrix, scaled by rank one of
        their residues."""
        truth = tomllib.loads((SEVERAL / "truth.toml").read_text())
        M = C = K = 0
        for m in truth["mode"]:
            n = np.array([np.cos(np.radians(m["angle_deg"])), np.sin(np.radians(m["angle_deg"]))])
            w, N = 2 * np.pi * m["frequency_Hz"], m["mass_kg"] * np.outer(n, n)
            M, K, C = M + N, K + w**2 * N, C + 2 * m["damping_ratio"] * w * N
        d = np.radians(truth["damper"]["angle_deg"])
        C = C + truth["damper"]["damping_Ns_per_m"] * np.outer([np.cos(d), np.sin(d)],
                                                              [np.cos(d), np.sin(d)])
        A = np.block([[np.zeros((2, 2)), np.eye(2)],
                      [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
        values, V = np.linalg.eig(A)
        left = np.linalg.solve(V, np.vstack([np.zeros((2, 2)), np.linalg.inv(M)]))
        rows = []
        for r in sorted((r for r in range(4) if values[r].imag > 0),
                        key=lambda r: abs(values[r])):
            p = values[r]
            Z = np.outer(V[:2, r], left[r]) * 2j * p.imag
            phi = modes.rank_one(Z[0, 0], Z[0, 1], Z[1, 1])
            rows.append([abs(p), -p.real / abs(p), *phi.real, *phi.imag])
        return np.array(rows)

    def test_several_responses(self):  # [M-30] [M-31] [M-32] [M-33] [M-34]
        f, responses = self.read_sets()
        truth = self.truth_of_several()
        rows, cov, models, weights = modes.fit_shared(f, responses, truth, True)
        result = answer("modes", SEVERAL / "tool.uff")
        self.assertEqual(result["shapes"], "complex")
        found = result["modes"]
        self.assertEqual(len(found), 2)
        size = len(truth[0])
        for r, mode in enumerate(found):
            row = rows[r]
            se = np.sqrt(np.diag(cov))[size * r:size * r + size]
            phi = row[2:4] + 1j * row[4:6]
            phi *= np.sign(phi[np.argmax(np.abs(phi))].real)
            expected = modes.told(row[0], row[1], phi)
            self.near([2 * np.pi * mode["frequency_Hz"], mode["damping_ratio"]], row[:2], 1e-6)
            self.near([2 * np.pi * mode["se"]["frequency_Hz"], mode["se"]["damping_ratio"]],
                      se[:2], 1e-3)
            self.near([mode[key] for key in (*KEYS, "angle_deg", "imaginary_fraction")],
                      expected, 1e-5)
            shape = mode["shape"]
            ours = [s["re_per_sqrt_kg"] + 1j * s["im_per_sqrt_kg"] for s in shape]
            np.testing.assert_allclose(ours, phi, atol=1e-5)
            self.near([[s["re_se"] for s in shape], [s["im_se"] for s in shape]],
                      se[2:].reshape(2, 2), 1e-3)
            # The noise is drawn once: within four standard errors of the structure.
            self.assertLess(np.max(np.abs(row - truth[r]) / se), 4)
        gains = {name: modes.gain(responses[name], models[name], weights[name])
                 for name in ("xy", "yx")}
        pair = result["reciprocity"][0]
        self.assertEqual((pair["response"], pair["over"]), ("yx", "xy"))
        self.near(pair["gain"], gains["yx"][0] / gains["xy"][0], 1e-6)
        self.near(pair["se"], np.hypot(gains["xy"][1], gains["yx"][1]), 1e-3)

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
