"""Make the simulated tap tests of this example.

Two modes that lie askew to the machine's axes, so that a force along x moves the tool along
y as well, with the noise of a hammer and an accelerometer.
Usage: make.py
"""
import pathlib
import tomllib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent


def direction(mode):
    angle = np.radians(mode["angle_deg"]) + (np.pi / 2 if mode["axis"] == "y" else 0)
    return {"x": np.cos(angle), "y": np.sin(angle)}


def response(truth, f, motion, force):
    w = 2 * np.pi * f
    H = 0
    for m in truth["mode"]:
        n = 2 * np.pi * m["frequency_Hz"]
        d = direction(m)
        H = H + d[motion] * d[force] / (
            m["mass_kg"] * (n**2 - w**2 + 2j * m["damping_ratio"] * n * w))
    return -w**2 * H


def main():
    truth = tomllib.loads((HERE / "truth.toml").read_text())
    random = np.random.default_rng(7)
    f = np.arange(200.0, 4000.1, 4.0)
    for motion, force in ("xx", "yy", "xy"):
        H = response(truth, f, motion, force)
        noise = random.standard_normal((2, f.size))
        H = H + 0.2 * (noise[0] + 1j * noise[1])
        rows = [f"{x:g},{h.real:.6g},{h.imag:.6g}" for x, h in zip(f, H)]
        (HERE / f"motion_{motion}_force_{force}.csv").write_text("\n".join(
            ["# simulated: two modes and noise (examples/measured_frf/make.py)",
             "freq_Hz,re_(m/s^2)/N,im_(m/s^2)/N", *rows]) + "\n")


if __name__ == "__main__":
    main()
