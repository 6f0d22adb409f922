#!/usr/bin/env python3
"""How long `import trochoid` takes beside numpy alone, and a call of a kernel.

Usage: ./run python benchmarks/python_import.py. Medians; numpy is part of the import.
"""
import pathlib
import statistics
import subprocess
import sys
import time

import trochoid

TIMES = 11
CASE = pathlib.Path(__file__).resolve().parents[1] / "examples/st52_predict/case.toml"


def started(statement):
    """Milliseconds of a fresh interpreter that runs one statement."""
    begin = time.perf_counter()
    subprocess.run([sys.executable, "-c", statement], check=True)
    return 1e3 * (time.perf_counter() - begin)


def called(function):
    """Microseconds of a call."""
    begin = time.perf_counter()
    function()
    return 1e6 * (time.perf_counter() - begin)


def median(measure, *arguments):
    return statistics.median(measure(*arguments) for _ in range(TIMES))


def main():
    nothing = median(started, "pass")
    for name in ("numpy", "trochoid"):
        print(f"import {name:10} {median(started, f'import {name}') - nothing:8.0f} ms")
    case = trochoid.Case.from_file(CASE)
    phi = [float(i) for i in range(720)]
    trochoid.forces(case, phi)
    print(f"forces, 720 angles {median(called, lambda: trochoid.forces(case, phi)):6.0f} us")
    print(f"forces, 1 angle    {median(called, lambda: trochoid.forces(case, 0.0)):6.0f} us")


if __name__ == "__main__":
    main()
