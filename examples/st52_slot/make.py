"""Make the simulated records of this example and of examples/st52_predict.

Usage: make.py PROGRAM. The same seed gives the same bytes.
"""

import csv
import pathlib
import subprocess
import sys
import tempfile

import numpy

RPM = 874.3  # the machine does not turn at the stated 875
RATE_HZ = 5000
SAMPLES = 2000
NOISE_N = 18.0
DISTURBANCE_N = 12.0
DISTURBANCE_HZ = 143.0
OFFSET_N = (6.0, -4.0, 3.0)
DRIFT_N = (5.0, 3.0, -2.0)  # from the first sample to the last


def turn_of_forces(program, case):
    """Angles [deg] and forces on the tool [N] of one turn."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        subprocess.run([program, "simulate", case, "-o", out, "--quiet", "--no-report"],
                       check=True)
        rows = list(csv.DictReader((out / "forces.csv").open()))
    angle = numpy.array([float(row["angle_deg"]) for row in rows])
    force = [[float(row[name]) for name in ("Fx_N", "Fy_N", "Fz_N")] for row in rows]
    return angle, numpy.array(force)


def record(angle, force, rpm, phase_deg, seed):
    """What a table dynamometer would have read: (time [s], channels [N])."""
    random = numpy.random.default_rng(seed)
    time = numpy.arange(SAMPLES) / RATE_HZ
    phi = (360 * rpm / 60 * time + phase_deg) % 360
    channels = numpy.empty((SAMPLES, 3))
    for q in range(3):
        channels[:, q] = -numpy.interp(phi, angle, force[:, q], period=360)
        channels[:, q] += OFFSET_N[q] + DRIFT_N[q] * time / time[-1]
        if q < 2:
            channels[:, q] += DISTURBANCE_N * numpy.sin(
                2 * numpy.pi * DISTURBANCE_HZ * time + q)
    channels += NOISE_N * random.standard_normal(channels.shape)
    return time, channels


def write(path, time, channels):
    with path.open("w", newline="\n") as file:
        file.write("# simulated: examples/st52_slot/make.py\n")
        file.write("time_s,Fx_N,Fy_N,Fz_N\n")
        for t, values in zip(time, channels):
            file.write(f"{t:.4f}," + ",".join(f"{v:.2f}" for v in values) + "\n")


def main():
    program = sys.argv[1]
    examples = pathlib.Path(__file__).resolve().parents[1]
    for name, rpm, phase_deg, seed in (("st52_slot", RPM, 37.5, 875),
                                       ("st52_predict", 1049.2, -71.0, 1050)):
        angle, force = turn_of_forces(program, examples / name / "truth.toml")
        write(examples / name / "record.csv", *record(angle, force, rpm, phase_deg, seed))


main()
