"""Make the simulated records of this example.

Usage: make.py PROGRAM. The same seed gives the same bytes.
"""

import csv
import pathlib
import subprocess
import sys
import tempfile

import numpy

RPM = 1998.6  # the machine does not turn at the stated 2000
FINE_HZ = 50000  # of the simulation
RATE_HZ = 5000
AIR_S, CUT_S, AFTER_S = 0.12, 0.42, 0.08
RESONANCE_HZ = (880.0, 1040.0, 1310.0)
DAMPING = (0.03, 0.025, 0.04)
NOISE_N = 8.0
OFFSET_N = (14.0, -9.0, 5.0)
HERE = pathlib.Path(__file__).resolve().parent


def turn_of_forces(program, feed):
    """Angles [deg] and forces on the tool [N] of one turn."""
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder) / "case.toml"
        case.write_text((HERE / "truth.toml").read_text().replace(
            "feed_per_tooth_mm = 0.05", f"feed_per_tooth_mm = {feed}"))
        out = pathlib.Path(folder) / "out"
        subprocess.run([program, "simulate", case, "-o", out, "--quiet", "--no-report"],
                       check=True)
        rows = list(csv.DictReader((out / "forces.csv").open()))
    angle = numpy.array([float(row["angle_deg"]) for row in rows])
    force = [[float(row[name]) for name in ("Fx_N", "Fy_N", "Fz_N")] for row in rows]
    return angle, numpy.array(force)


def read_by(force, frequency, damping):
    """What an oscillator reads of a force: x'' + 2 zeta w x' + w^2 x = w^2 F."""
    w, h = 2 * numpy.pi * frequency, 1 / FINE_HZ
    x = v = 0.0
    out = numpy.empty_like(force)
    for i, f in enumerate(force):
        v += h * (w * w * (f - x) - 2 * damping * w * v)
        x += h * v
        out[i] = x
    return out


def record(program, feed, phase_deg, seed):
    """What the dynamometer would have read: (time [s], channels [N])."""
    random = numpy.random.default_rng(seed)
    angle, force = turn_of_forces(program, feed)
    time = numpy.arange(int((AIR_S + CUT_S + AFTER_S) * FINE_HZ)) / FINE_HZ
    phi = (360 * RPM / 60 * time + phase_deg) % 360
    cutting = (time >= AIR_S) & (time < AIR_S + CUT_S)
    keep = slice(0, None, FINE_HZ // RATE_HZ)
    channels = []
    for q in range(3):
        true = -numpy.interp(phi, angle, force[:, q], period=360) * cutting
        read = read_by(true, RESONANCE_HZ[q], DAMPING[q])[keep]
        channels.append(read + OFFSET_N[q] + NOISE_N * random.standard_normal(len(read)))
    return time[keep], numpy.array(channels).T


def main():
    for name, feed, phase, seed in (("slow", 0.05, 23.0, 1), ("fast", 0.1, 141.0, 2)):
        time, channels = record(sys.argv[1], feed, phase, seed)
        with (HERE / f"{name}.csv").open("w", newline="\n") as file:
            file.write("# simulated: examples/ringing_dynamometer/make.py\n")
            file.write("time_s,Fx_N,Fy_N,Fz_N\n")
            for t, values in zip(time, channels):
                file.write(f"{t:.4f}," + ",".join(f"{v:.1f}" for v in values) + "\n")


if __name__ == "__main__":
    main()
