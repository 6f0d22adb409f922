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
NOISE = {"channel1_N": 6.0, "channel2_N": 6.0, "channel3_N": 4.0, "channel4_Nm": 0.04}
NAMES = {"channel1_N": "Fx'_N", "channel2_N": "Fy'_N", "channel3_N": "Fz_N", "channel4_Nm": "Mz_Nm"}


def main():
    random.seed(7)
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        subprocess.run([sys.argv[1], "simulate", str(HERE / "truth.toml"), "-o", str(out),
                        "--no-report", "--quiet"], check=True)
        rows = list(csv.DictReader((out / "forces.csv").open(newline="")))
    start = float(rows[0]["time_s"])
    with (HERE / "record.csv").open("w", newline="") as file:
        write = csv.writer(file, lineterminator="\n").writerow
        write(["time_s", *NAMES.values()])
        for row in rows:
            write([f"{float(row['time_s']) - start:.7f}",
                   *(f"{float(row[c]) + random.gauss(0, sd):.4g}" for c, sd in NOISE.items())])


if __name__ == "__main__":
    main()
