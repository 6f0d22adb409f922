#!/usr/bin/env python3
"""Make record.csv of this example: truth.toml through `trochoid simulate`, with noise.

Usage: make.py TROCHOID
"""
import csv
import pathlib
import random
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
NOISE_N = 15.0


def main():
    random.seed(80)
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        subprocess.run([sys.argv[1], "simulate", str(HERE / "truth.toml"), "-o", str(out),
                        "--no-report", "--quiet"], check=True)
        rows = list(csv.DictReader((out / "forces.csv").open(newline="")))
    start = float(rows[0]["time_s"])
    with (HERE / "record.csv").open("w", newline="") as file:
        write = csv.writer(file, lineterminator="\n").writerow
        write(["time_s", "Fx_N", "Fy_N", "Fz_N"])
        for row in rows:
            write([f"{float(row['time_s']) - start:.6f}",
                   *(f"{float(row[f'channel{c}_N']) + random.gauss(0, NOISE_N):.5g}"
                     for c in (1, 2, 3))])


if __name__ == "__main__":
    main()
