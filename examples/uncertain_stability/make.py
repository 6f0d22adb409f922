"""Make the simulated response of this example: one mode and noise.

Usage: make.py
"""
import pathlib
import tomllib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent


def main():
    truth = tomllib.loads((HERE / "truth.toml").read_text())
    mode, noise = truth["mode"][0], truth["noise"]
    f = np.arange(760.0, 1100.5, 5.0)
    w, wn = 2 * np.pi * f, 2 * np.pi * mode["frequency_Hz"]
    H = 1 / mode["mass_kg"] / (wn**2 - w**2 + 2j * mode["damping_ratio"] * wn * w)
    random = np.random.default_rng(922)
    a, b, c = random.standard_normal((3, f.size))
    H = H * (1 + noise["magnitude_percent"] / 100 * a + 1j * noise["phase_percent"] / 100 * b)
    H = H + noise["floor_m_per_N"] * (c + 1j * random.standard_normal(f.size))
    lines = ["# simulated: one mode and noise (examples/uncertain_stability/make.py)",
             "freq_Hz,re_m/N,im_m/N"]
    lines += [f"{x:g},{h.real:.6g},{h.imag:.6g}" for x, h in zip(f, H)]
    (HERE / "tip_x.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
