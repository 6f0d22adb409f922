"""Make examples/several_responses/tool.uff: four simulated tap tests of one tool.

Two modes at right angles and a damper that acts along one line only, so that the shapes are
complex. All four responses of x and y stand in one universal file, as sets 58.
Usage: make.py
"""
import pathlib
import tomllib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent


def along(angle_deg):
    """n n^T of a direction n, from +x towards +y."""
    n = np.array([np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))])
    return np.outer(n, n)


def accelerance(truth, f):
    """Of x and y, shape (lines, 2, 2): the dynamic stiffness inverted."""
    s = 2j * np.pi * f[:, None, None]
    K = s * truth["damper"]["damping_Ns_per_m"] * along(truth["damper"]["angle_deg"])
    for m in truth["mode"]:
        n = 2 * np.pi * m["frequency_Hz"]
        K = K + m["mass_kg"] * (n**2 + 2 * m["damping_ratio"] * n * s + s**2) * along(
            m["angle_deg"])
    return s**2 * np.linalg.inv(K)


def data_set(name, response, reference, f, H):
    """One set 58: complex, single precision, even lines."""
    head = ["    -1", "    58", f"simulated tap test, {name}", "NONE", "NONE", "NONE", "NONE",
            f"{4:5d}{0:10d}{0:5d}{0:10d} {'NONE':10s}{1:10d}{response:4d} "
            f"{'NONE':10s}{1:10d}{reference:4d}",
            f"{5:10d}{len(f):10d}{1:10d}{f[0]:13.5e}{f[1] - f[0]:13.5e}{0:13.5e}"]
    for kind, label, unit in ((18, "Frequency", "Hz"), (12, "Acceleration", "m/s^2"),
                              (13, "Force", "N"), (0, "NONE", "NONE")):
        head.append(f"{kind:10d}{0:5d}{0:5d}{0:5d} {label:20s} {unit:20s}")
    numbers = np.column_stack([H.real, H.imag]).ravel()
    rows = ["".join(f"{x:13.5e}" for x in numbers[i:i + 6]) for i in range(0, len(numbers), 6)]
    return "\n".join([*head, *rows, "    -1"]) + "\n"


def main():
    truth = tomllib.loads((HERE / "truth.toml").read_text())
    random = np.random.default_rng(11)
    f = np.arange(400.0, 2000.1, 4.0)
    H = accelerance(truth, f)
    text = ""
    for i, k in ((0, 0), (0, 1), (1, 0), (1, 1)):
        noise = random.standard_normal((2, f.size)) * truth["noise"]["fraction"]
        text += data_set("xy"[i] + " for a blow along " + "xy"[k], i + 1, k + 1, f,
                         H[:, i, k] * (1 + noise[0] + 1j * noise[1]))
    (HERE / "tool.uff").write_text(text)


if __name__ == "__main__":
    main()
