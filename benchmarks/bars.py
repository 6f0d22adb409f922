#!/usr/bin/env python3
"""What was aimed at, and what this machine takes now: CPU time, beside a bar for each row.

Usage: bars.py BENCHMARKS PROGRAM   BENCHMARKS: trochoid_benchmarks; PROGRAM: trochoid

Bars are of the machine of docs/performance.md, where the textbook's loop takes 20.7 ms. The
last column is scaled by what that loop takes here, in the same run.
"""
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

import numpy as np

import table

EXAMPLES = pathlib.Path(__file__).resolve().parents[1] / "examples"
TEXTBOOK_S = 20.7e-3
US, NS, MS = 1e-6, 1e-9, 1e-3
REPETITIONS = 3

# what, benchmark, counter (None: the whole time), bar [s]
KERNELS = [
    ("a turn of 720 samples, the paper's cut", "whole_turn/trochoidal/720", None, 5 * US),
    ("ball, a sample", "general_turn/ball/2", "per_sample", 0.5 * US),
    ("bull nose, a sample", "general_turn/bull_nose/2", "per_sample", 0.25 * US),
    ("taper, a sample", "general_turn/taper/2", "per_sample", 0.25 * US),
    ("four teeth, eccentric, helix 30 deg, a sample", "general_turn/eccentric/2", "per_sample",
     0.25 * US),
    ("the same, a_p 60 mm", "general_turn/eccentric/60", "per_sample", 2 * US),
    ("fit of two teeth, nothing known", "identify/trochoidal/20", None, 0.4 * MS),
    ("the same, good start", "identify_from_start/20", None, 0.15 * MS),
    ("fit of four teeth, eccentricity, nothing known", "identify_eccentricity/from_nothing/20",
     None, 7 * MS),
    ("the same, good start", "identify_eccentricity/from_start/20", None, 7 * MS),
    ("regenerative step, power law", "motion_power/500", "ns_per_step", 35 * NS),
    ("the same, helix", "motion_power_helix/200", "ns_per_step", 120 * NS),
    ("multiplier of a slot, 5000 rpm", "multiplier_of_the_slot", None, 40 * US),
    ("program, blocks of 0.5 mm, a turn", "program_blocks/50", "turns", 10 * US),
    ("program, three rows of a ball, a turn", "program_ball", "turns", 30 * US),
]
# what, benchmark, benchmark to compare with, bar
RATIOS = [
    ("power law against the linear law, eccentric", "general_power/eccentric",
     "general_turn/eccentric/2", 2),
    ("power law against the linear law, bull nose", "general_power/bull_nose",
     "general_turn/bull_nose/2", 2),
    ("helix 0 against 30 deg, one synchronous record", "identify_straight/20",
     "identify/trochoidal/20", 3),
]
# what, arguments, bar [s], times
COMMANDS = [
    ("calibrate thin_wall_calibrate", "calibrate thin_wall_calibrate/case.toml", 1, 1),
    ("plan plan_wall", "plan plan_wall/case.toml", 2, 1),
    ("stability measured_frf", "stability measured_frf/case.toml", 1, 1),
    ("identify st52_slot", "identify st52_slot/case.toml", 60 * MS, 5),
    ("simulate a slot, no report", "simulate {made}/turn.toml --no-report", 8 * MS, 15),
    ("modes, 16 000 lines with 8 modes", "modes {made}/frf.csv", 2, 1),
    ("identify, a million rows of CSV (times alone)", "identify {made}/long.toml --no-report", 1, 1),
    ("identify, three million samples of npy", "identify {made}/npy.toml --no-report", 0.9, 1),
    ("a row of a sweep of simulate", "sweep {made}/sweep.toml --no-report", 2000 * 0.03 * MS, 1),
]
ROWS_OF_SWEEP = 2000

CUT = """
[tool]
shape = "cylinder"
teeth = 2
diameter_mm = 8.0
helix_deg = 30.0
[cut]
engagement = "slot"
axial_depth_mm = 2.0
feed_per_tooth_mm = 0.04
spindle_rpm = 875
[force]
law = "linear_edge"
"""
COEFFICIENTS = """K_tc_MPa = 2000
K_rc_MPa = 800
K_ac_MPa = 300
K_te_N_per_mm = 20
K_re_N_per_mm = 15
K_ae_N_per_mm = 5
"""


def record(folder, program, rows):
    """Forces of a turn, again and again, with noise: t and three channels, shape (rows, 4)."""
    (folder / "turn.toml").write_text(CUT + COEFFICIENTS)
    subprocess.run([program, "simulate", folder / "turn.toml", "-q", "--no-report", "-o", folder / "turn"],
                   check=True)
    with open(folder / "turn/forces.csv") as file:
        names = next(line for line in file if not line.startswith("#")).strip().split(",")
        turn = np.loadtxt(file, delimiter=",")
    F = turn[:, [names.index(f"F{q}_N") for q in "xyz"]]
    t = np.arange(rows) / 20000
    angle = t * 875 / 60 * len(F)
    noise = np.random.default_rng(1).standard_normal((rows, 3))
    return np.column_stack([t, F[angle.astype(int) % len(F)] + 20 * noise])


def make_inputs(folder, program):
    measurement = "[dynamometer]\naxes = [\"x\", \"y\", \"z\"]\n[[measurement]]\n"
    data = record(folder, program, 3_000_000)
    np.save(folder / "long.npy", data)
    np.savetxt(folder / "long.csv", data[:1_000_000], fmt="%.5f", delimiter=",",
               header="time_s,Fx_N,Fy_N,Fz_N", comments="")
    (folder / "long.toml").write_text(CUT + measurement + 'file = "long.csv"\n')
    (folder / "npy.toml").write_text(CUT + measurement + 'file = "long.npy"\n')
    (folder / "sweep.toml").write_text(
        CUT + COEFFICIENTS + "[sweep]\ncommand = \"simulate\"\ntake = [\"result.peak_xy_N\"]\n[sweep.over]\n"
        f'"cut.feed_per_tooth_mm" = {{ from = 0.02, to = 0.06, count = {ROWS_OF_SWEEP} }}\n')
    f = np.linspace(100, 4100, 16000)
    random = np.random.default_rng(2)
    H = 1e-9 * (random.standard_normal(f.size) + 1j * random.standard_normal(f.size))
    for k in range(8):
        f_k = 400 + 430 * k
        H += 1 / (5e6 * (1 + k)) / (1 - (f / f_k) ** 2 + 2j * 0.02 * f / f_k)
    np.savetxt(folder / "frf.csv", np.column_stack([f, H.real, H.imag]), delimiter=",",
               header="frequency_Hz,re_m/N,im_m/N", comments="")


def cpu_time(command, folder):
    def used():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    before = used()
    subprocess.run([*command, "-o", folder / "answer", "--threads", "1"], check=True, stdout=subprocess.DEVNULL)
    return used() - before


def verdict(now, bar):
    return "met" if now <= 1.03 * bar else f"missed, {now / bar:.2g} x"


def print_row(what, now, bar, slower):
    print(f"| {what} | {table.time_text(1e9 * now)} | {table.time_text(1e9 * bar)} | {verdict(now / slower, bar)} |",
          flush=True)


def print_kernels(benchmarks):
    names = {row[1] for row in KERNELS} | {name for row in RATIOS for name in row[1:3]}
    found = table.medians(benchmarks, "^(" + "|".join(sorted(names)) + ")$", REPETITIONS, "0.05")
    slower = found[table.TEXTBOOK][0] * 1e-9 / TEXTBOOK_S
    print(f"The textbook's loop takes {slower:.2f} times as long as on the machine of the bars.\n")
    print("| what | here | bar | scaled by the textbook's loop |\n|---|---|---|---|")
    for what, name, counter, bar in KERNELS:
        ns, one = found[name]
        now = {None: ns * 1e-9, "per_sample": one.get("per_sample"), "ns_per_step": one.get("ns_per_step", 0) * 1e-9,
               "turns": ns * 1e-9 / one.get("turns", 1)}[counter]
        print_row(what, now, bar, slower)
    for what, name, other, bar in RATIOS:
        ratio = found[name][0] / found[other][0]
        print(f"| {what} | {ratio:.2g} | {bar} | {verdict(ratio, bar)} |")
    return slower


def print_commands(program, slower):
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        make_inputs(folder, program)
        for what, arguments, bar, times in COMMANDS:
            words = [made_or_example(word, made) for word in arguments.split()]
            now = statistics.median(cpu_time([program, *words, "-q"], folder) for _ in range(times))
            rows = ROWS_OF_SWEEP if words[0] == "sweep" else 1
            print_row(what, now / rows, bar / rows, slower)


def made_or_example(word, made):
    if "/" not in word:
        return word
    return word.format(made=made) if "{made}" in word else str(EXAMPLES / word)


if __name__ == "__main__":
    print_commands(sys.argv[2], print_kernels(sys.argv[1]))
