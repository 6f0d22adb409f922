#!/usr/bin/env python3
"""Run the benchmarks once and print their medians as a table, beside the textbook's.

Usage: table.py PROGRAM [REGEX]   PROGRAM: trochoid_benchmarks
"""
import json
import subprocess
import sys

REPETITIONS = 5
TEXTBOOK = "textbook"  # what forces are compared with


def time_text(ns):
    for limit, unit in ((1e3, "ns"), (1e6, "us"), (1e9, "ms")):
        if ns < limit:
            return f"{ns * 1e3 / limit:.3g} {unit}"
    return f"{ns * 1e-9:.3g} s"


def medians(program, which, repetitions=REPETITIONS, least_s="0.5"):
    """CPU time [ns] and counters of each benchmark that a pattern finds, and of the textbook's."""
    run = subprocess.run(
        [program, f"--benchmark_filter=({which})|^{TEXTBOOK}$", f"--benchmark_repetitions={repetitions}",
         f"--benchmark_min_time={least_s}",
         "--benchmark_enable_random_interleaving=true", "--benchmark_report_aggregates_only=true",
         "--benchmark_format=json"],
        stdout=subprocess.PIPE, text=True, check=True)
    found = {}
    for one in json.loads(run.stdout)["benchmarks"]:
        if one["aggregate_name"] == "median":
            scale = {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}[one["time_unit"]]
            found[one["run_name"]] = (one["cpu_time"] * scale, one)
    return found


def main(program, which):
    found = medians(program, which)
    textbook = found[TEXTBOOK][1]["per_sample"]
    print(f"Medians of {REPETITIONS}, interleaved; CPU time on one thread.\n")
    print("| benchmark | CPU time | a sample | error / peak | textbook / this, a sample |")
    print("|---|---|---|---|---|")
    for name, (ns, one) in sorted(found.items()):
        sample = one.get("per_sample")
        turn = f"{time_text(ns / one['turns'])} a turn" if "turns" in one else ""
        cells = [name, time_text(ns),
                 time_text(1e9 * sample) if sample else turn,
                 f"{one['error']:.1e}" if "error" in one else "",
                 f"{textbook / sample:.0f}" if sample else ""]
        print("| " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else ".")
