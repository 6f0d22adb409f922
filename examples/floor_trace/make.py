#!/usr/bin/env python3
"""Make trace.csv of this example: truth.toml through `trochoid surface`, with noise.

Usage: make.py TROCHOID
"""
import csv
import pathlib
import random
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TURNS = 8
BEGIN = 137      # point of a turn at which the trace begins
NOISE_UM = 0.06  # of each point: grain and instrument
MEMORY = 0.8     # from a point to the next
SLOPE_UM_PER_MM = 0.9


def main():
    random.seed(63)
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        subprocess.run([sys.argv[1], "surface", str(HERE / "truth.toml"), "-o", str(out),
                        "--no-report", "--quiet"], check=True)
        rows = list(csv.DictReader((out / "floor.csv").open(newline="")))
    z = [1e3 * float(row["z_mm"]) for row in rows]
    step = float(rows[1]["x_mm"]) - float(rows[0]["x_mm"])
    noise = 0.0
    with (HERE / "trace.csv").open("w", newline="") as file:
        write = csv.writer(file, lineterminator="\n").writerow
        write(["x_mm", "z_um"])
        for i in range(TURNS * len(z)):
            noise = MEMORY * noise + random.gauss(0, NOISE_UM * (1 - MEMORY**2)**0.5)
            write([f"{i * step:.4f}",
                   f"{z[(i + BEGIN) % len(z)] + SLOPE_UM_PER_MM * i * step + noise:.4f}"])


if __name__ == "__main__":
    main()
