"""What the tests of sweeps have in common: a case, a sweep of it, and equal tables."""

import os
import pathlib
import signal
import tempfile
import unittest

import numpy as np

import trochoid

CASE = pathlib.Path(__file__).resolve().with_name("slot.toml")
EXAMPLES = CASE.parents[3] / "examples"
TAKE = ["result.peak_xy_N", "result.mean_N[2]"]
#: Two of three helix angles go; the speeds are no short numbers.
OVER = {
    "cut.spindle_rpm": np.linspace(500, 9000, 50) / 3,
    "tool.helix_deg": {"values": [10, 2000, 25.5]},
}

#: Long enough that a worker dies amid it.
LONG = {"cut.spindle_rpm": np.linspace(500, 9000, 1500) / 3}


def sweep(over=OVER, **options):
    return trochoid.sweep(CASE, over, **{"command": "simulate", "take": TAKE, **options})


class Sweeping(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def same(self, one, other):
        """Bit for bit, texts too."""
        one, other = one.tables["sweep"], other.tables["sweep"]
        self.assertEqual(list(one), list(other))
        for name in one:
            self.assertEqual(one[name].dtype, other[name].dtype, name)
            if one[name].dtype.kind == "f":
                self.assertEqual(one[name].tobytes(), other[name].tobytes(), name)
            else:
                self.assertEqual(list(one[name]), list(other[name]), name)


class Killer:
    """Progress that kills a process once some rows are done."""

    def __init__(self, *processes):
        self.processes = list(processes)
        self.calls = []

    def __call__(self, done, rows):
        self.calls.append((done, rows))
        if done > 20 and self.processes:
            os.kill(self.processes.pop(), signal.SIGKILL)
