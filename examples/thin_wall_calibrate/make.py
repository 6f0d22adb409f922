"""Make the simulated profile of this example.

Usage: make.py PROGRAM [SEED]. The same seed gives the same bytes. A measuring
machine reads the wall that the program computes from truth.toml: at some heights, a few
times in each tooth feed, with noise and a datum that is a little off; it does not know
which tooth left what.
"""

import csv
import pathlib
import subprocess
import sys
import tempfile

import numpy

NOISE_MM = 0.0015
DATUM_MM = 0.006
EVERY = 10  # of the samples of truth.toml: four readings in a tooth feed
FIRST = 7   # the machine does not start where a tooth does


def wall(program, case):
    """Rows of the wall: x [mm], height [mm], error [mm]."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        subprocess.run([program, "surface", case, "-o", out, "--quiet", "--no-report"],
                       check=True)
        rows = list(csv.DictReader((out / "surface.csv").open()))
    return numpy.array([[float(row[name]) for name in ("x_mm", "height_mm", "error_mm")]
                        for row in rows])


def measured(rows, seed):
    """What the machine reads of the wall."""
    random = numpy.random.default_rng(seed)
    read = numpy.concatenate([rows[rows[:, 1] == height][FIRST::EVERY]
                              for height in numpy.unique(rows[:, 1])])
    read[:, 2] += DATUM_MM + NOISE_MM * random.standard_normal(len(read))
    return read


def write(path, read):
    with path.open("w", newline="\n") as file:
        file.write("# simulated: examples/thin_wall_calibrate/make.py\n")
        file.write("x_mm,height_mm,error_mm\n")
        for x, height, error in read:
            file.write(f"{x:.3f},{height:.1f},{error:.4f}\n")


def main():
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 2015
    example = pathlib.Path(__file__).resolve().parent
    write(example / "profile.csv", measured(wall(sys.argv[1], example / "truth.toml"), seed))


main()
