#!/usr/bin/env python3
"""Count the instructions of the main kernels, and compare them with those on record.

Usage: instructions.py PROGRAM [--renew]   PROGRAM: trochoid_instructions

Times depend on who else uses the machine, instructions hardly: a count more than a tenth
above the record fails. --renew writes the record anew, which is done where a change is worth
its instructions, or saves some.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys

RECORD = pathlib.Path(__file__).with_suffix(".json")
ALLOWED = 1.1
# What comes before the kernel differs by so much from run to run: libhwy waits for a clock.
# A hundred times as much is counted, so that the noise is a hundredth.
NOISE = 1_200_000
ENOUGH = 100 * NOISE


def collected(program, kernel, times):
    """Instructions of a whole run of the program: the least of three, for threads may wait busily."""
    return min(collected_once(program, kernel, times) for _ in range(3))


def collected_once(program, kernel, times):
    run = subprocess.run(
        ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, kernel, str(times)],
        capture_output=True, text=True, check=True)
    return int(re.search(r"Collected\s*:\s*(\d+)", run.stderr)[1])


def about(program, kernel, first):
    """Instructions of a kernel, roughly: of more runs where two of them are lost in the noise."""
    for times in (3, 101):
        all_of_them = collected_once(program, kernel, times) - first
        if all_of_them > 10 * NOISE:
            break
    return max(500, all_of_them // (times - 1))


def count(program, kernel):
    """Instructions of a kernel after its first run, which also fills what is kept."""
    first = collected(program, kernel, 1)
    more = max(2, ENOUGH // about(program, kernel, first))
    return (collected_once(program, kernel, 1 + more) - first) // more


def can_count(program):
    """Is there a valgrind that works, and are vectors as wide as those of the record?

    On a machine without rdtscp valgrind refuses it, and libhwy asks for the time by it as it
    is loaded: there not even the list of the kernels comes out, and nothing can be counted.
    """
    if shutil.which("valgrind") is None or "avx2" not in pathlib.Path("/proc/cpuinfo").read_text():
        return False
    return all(subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", one],
                              capture_output=True, check=False).returncode == 0
               for one in ("true", program))


def main(program, renew):
    if not can_count(program):
        print("skipped: this needs AVX2, and a valgrind that runs the program on this machine")
        return 77
    kernels = subprocess.run([program], capture_output=True, text=True, check=True).stdout.splitlines()
    counts = {kernel: count(program, kernel) for kernel in kernels}
    if renew:
        RECORD.write_text(json.dumps(counts, indent=1) + "\n")
    record = json.loads(RECORD.read_text())
    wrong = 0
    for kernel, now in counts.items():
        ratio = now / record[kernel] if kernel in record else float("inf")
        print(f"{now:>14,}  {ratio:6.3f} of the record  {kernel}")
        wrong += ratio > ALLOWED
    if wrong:
        print(f"{wrong} kernels take a tenth more than on record: find out why, or run with --renew and say why")
    return min(wrong, 1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], "--renew" in sys.argv[2:]))
