#!/usr/bin/env python3
"""Writes power.csv: what a drive shows of its power while part.nc runs with a worn cutter.

Made of the power of each turn that `program` computes, with a K_tc a tenth larger and a K_te
1.6 times as large, the 180 W that the spindle takes in air, the lag of the display (0.1 s)
and noise.
Usage: trochoid program case.toml --set force.K_tc_MPa=845 --set force.K_te_N_per_mm=44 -o worn
       make_power.py worn/steps.csv worn/moves.csv > power.csv
"""
import csv
import random
import sys

RPM = 6000
RATE, IDLE, LAG, NOISE, BEFORE, AFTER = 20, 180.0, 0.1, 3.0, 2.4, 1.5


def turns(path):
    """(start, end, power) of each turn in cut."""
    with open(path, newline="") as stream:
        for row in csv.DictReader(stream):
            time, power = float(row["time_s"]), float(row["power_W"] or 0)
            yield time - 30 / RPM, time + 30 / RPM, power


def main(steps, moves):
    with open(moves, newline="") as stream:
        end = sum(float(row["time_s"] or 0) for row in csv.DictReader(stream))
    chance = random.Random(7)
    fine = 200  # moments a second
    power = [0.0] * int((end + BEFORE + AFTER) * fine)
    for start, stop, value in turns(steps):
        for i in range(int((start + BEFORE) * fine), min(int((stop + BEFORE) * fine) + 1, len(power))):
            power[i] = value
    print("time_s,power_W")
    shown = 0.0
    for i, value in enumerate(power):
        shown += (value - shown) / (LAG * fine)
        if i % (fine // RATE) == 0:
            print(f"{i / fine:.2f},{IDLE + shown + chance.gauss(0, NOISE):.0f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
