"""Make the simulated tap test, hammer record and step of this example.

The response is that of two modes with noise, as a hammer and an accelerometer would give it;
the step that of a second-order actuator with the noise of a capacitive sensor.
Usage: make.py
"""
import pathlib
import tomllib

import numpy as np
from scipy import linalg, signal

HERE = pathlib.Path(__file__).resolve().parent


def response(truth, f):
    w = 2 * np.pi * f
    H = sum(1 / (m["stiffness_N_per_m"] - m["mass_kg"] * w**2
                 + 1j * m["damping_Ns_per_m"] * w) for m in truth["mode"])
    return -w**2 * H


def step(truth, t):
    a = truth["actuator"]
    wn = 2 * np.pi * a["frequency_Hz"]
    zeta = a["damping_ratio"]
    wd = wn * np.sqrt(1 - zeta**2)
    s = np.clip(t - truth["step"]["start_s"], 0, None)
    y = 1 - np.exp(-zeta * wn * s) * (np.cos(wd * s) + zeta * wn / wd * np.sin(wd * s))
    return truth["step"]["step_um"] * a["gain"] * y


def hammer(truth, rate=16000, finer=16):
    """Force and acceleration of four blows, the third of them a double hit."""
    n = int(0.68 * rate) * finer
    dt = 1 / (rate * finer)
    t = np.arange(n) * dt
    force = np.zeros(n)
    for start, peak in ((0.02, 310), (0.18, 260), (0.34, 290), (0.362, 70), (0.50, 330)):
        x = (t - start) / 2.2e-4
        force += np.where((x > 0) & (x < 1), peak * np.sin(np.pi * np.clip(x, 0, 1)), 0)
    a = np.zeros(n)
    for mode in truth["mode"]:
        m, c, k = mode["mass_kg"], mode["damping_Ns_per_m"], mode["stiffness_N_per_m"]
        # the force is a straight line between samples: exact in that
        A, B = np.array([[0, 1], [-k / m, -c / m]]), np.array([0, 1 / m])
        M = np.zeros((4, 4))
        M[:2, :2], M[:2, 2], M[2, 3] = A * dt, B * dt, 1
        E = linalg.expm(M)
        state = np.zeros(2)
        for i in range(n):
            a[i] += (force[i] - c * state[1] - k * state[0]) / m
            if i + 1 < n:
                state = (E[:2, :2] @ state + E[:2, 2] * force[i]
                         + E[:2, 3] * (force[i + 1] - force[i]))
    b = signal.firwin(16 * finer + 1, 0.8 / finer)  # what keeps aliases out
    delay = 8 * finer
    both = [signal.lfilter(b, 1, np.append(y, np.zeros(delay)))[delay:][::finer]
            for y in (force, a)]
    return t[::finer], *both


def main():
    truth = tomllib.loads((HERE / "truth.toml").read_text())
    random = np.random.default_rng(20)
    f = np.arange(100.0, 4000.1, 5.0)
    H = response(truth, f)
    noise = random.standard_normal((2, f.size))
    H = H * (1 + 0.01 * noise[0]) + 0.3 * (noise[1] + 1j * random.standard_normal(f.size))
    rows = [f"{x:g},{h.real:.6g},{h.imag:.6g}" for x, h in zip(f, H)]
    (HERE / "tip_x.csv").write_text("\n".join(
        ["# simulated: two modes and noise (examples/tap_test/make.py)",
         "freq_Hz,re_(m/s^2)/N,im_(m/s^2)/N", *rows]) + "\n")
    t = np.arange(0, 0.03, 5e-5)
    y = step(truth, t) + 0.02 * random.standard_normal(t.size)
    command = np.where(t < truth["step"]["start_s"] - 1e-12, 0, truth["step"]["step_um"])
    rows = [f"{x:.6g},{u:g},{p:.5f}" for x, u, p in zip(t, command, y)]
    (HERE / "step.csv").write_text("\n".join(
        ["# simulated: two poles and noise (examples/tap_test/make.py)",
         "time_s,command_um,position_um", *rows]) + "\n")
    t, force, a = hammer(truth)
    force = force + 0.05 * random.standard_normal(t.size)
    a = a + 1.0 * random.standard_normal(t.size)
    rows = [f"{x:.7g},{f:.2f},{y:.2f}" for x, f, y in zip(t, force, a)]
    (HERE / "hammer.csv").write_text("\n".join(
        ["# simulated: four blows, the third a double hit (examples/tap_test/make.py)",
         "time_s,force_N,acceleration_m/s2", *rows]) + "\n")


if __name__ == "__main__":
    main()
