"""Rows of a sweep by executors: the same bits, and what breaks is told or repeated."""

import multiprocessing
import os
import shutil
import unittest
import warnings
from concurrent.futures import (
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
)

import numpy as np
from sweeping import CASE, EXAMPLES, LONG, Killer, Sweeping, sweep

import trochoid
from trochoid import _executor

warnings.simplefilter("ignore", trochoid.AnswerWarning)


class Scripted(Executor):
    """Answers at once, last asked first done; the n-th call fails as is said."""

    def __init__(self, failures=()):
        self.failures = dict(failures)
        self.calls = []

    def submit(self, call, *args):
        number = len(self.calls)
        self.calls.append(args)
        failure = self.failures.get(number)
        if failure == "shut":
            raise RuntimeError("cannot schedule new futures after shutdown")
        future = Future()
        if failure is not None:
            future.set_exception(failure)
        else:
            future.set_result(call(*args))
        return future


class Executors(Sweeping):
    @classmethod
    def setUpClass(cls):
        cls.wanted = sweep()

    def unfinished(self, executor, **options):
        with self.assertRaises(trochoid.SweepUnfinished) as raised:
            sweep(executor=executor, **options)
        return raised.exception

    def test_threads(self):
        seen = []
        with ThreadPoolExecutor(3) as threads:
            found = sweep(executor=threads, progress=lambda *of: seen.append(of))
        self.same(found, self.wanted)
        self.assertEqual(seen[-1], (150, 150))
        self.assertEqual(seen, sorted(set(seen)))

    def test_processes(self):
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(2, mp_context=context) as processes:
            self.same(sweep(executor=processes), self.wanted)

    def test_records_in_memory_travel(self):
        slot = EXAMPLES / "st52_slot/case.toml"
        forces = trochoid.forces(
            trochoid.Case.from_file(CASE), np.arange(4000) * 360 * 875 / 60 / 1e3
        )
        record = trochoid.Record(forces, sample_rate_Hz=1e3)
        asked = {"command": "identify", "take": "result.fits[1].rms_N", "records": record}
        over = {"cut.axial_depth_mm": [1.5, 2.5]}
        wanted = trochoid.sweep(slot, over, **asked)
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(1, mp_context=context) as processes:
            self.same(trochoid.sweep(slot, over, **asked, executor=processes), wanted)

    def test_a_file_of_a_case_is_found_from_anywhere(self):
        shutil.copy(EXAMPLES / "tap_test/tip_x.csv", self.folder)
        (self.folder / "tap.toml").write_text('[frf]\nfile = "tip_x.csv"\nmodes = 1\n')
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        asked = {"command": "modes", "take": "result.modes[1].frequency_Hz"}
        over = {"frf.modes": [1]}
        wanted = trochoid.sweep("tap.toml", over, **asked)
        self.assertEqual(list(wanted.tables["sweep"]["status"]), ["ok"])
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(
            1, mp_context=context, initializer=os.chdir, initargs=("/",)
        ) as elsewhere:
            self.same(trochoid.sweep("tap.toml", over, **asked, executor=elsewhere), wanted)

    def test_failures_are_repeated(self):
        failures = {0: ValueError("once"), 3: CancelledError(), 5: OSError("away")}
        executor = Scripted(failures)
        self.same(sweep(executor=executor, in_flight=4), self.wanted)
        self.assertEqual(sum(call[4] > 1 for call in executor.calls), 3)

    def test_what_fails_again_and_again_is_told(self):
        class Failing(Scripted):
            def submit(self, call, *args):
                if args[2] <= 40 < args[2] + len(args[3]):
                    self.failures[len(self.calls)] = ValueError("row 41 is evil")
                return super().submit(call, *args)

        part = self.folder / "rows"
        executor = Failing()
        said = self.unfinished(executor, in_flight=4, part_file=part)
        self.assertIn("failed 4 times, at last with ValueError: row 41 is evil", str(said))
        self.assertIn(f"kept in {part}", str(said))
        self.assertGreater(said.done, 0)
        self.assertLessEqual(said.done, 40)
        goes_on = Scripted()
        self.same(sweep(executor=goes_on, part_file=part), self.wanted)
        self.assertEqual(goes_on.calls[0][2], said.done)

    def test_an_executor_that_is_shut_is_told(self):
        said = self.unfinished(Scripted({6: "shut"}), in_flight=2)
        self.assertIn("takes no work (RuntimeError: cannot schedule", str(said))
        self.assertIn("neither folder nor part_file", str(said))
        self.assertGreater(said.done, 0)

    def test_a_process_killed_breaks_the_pool_and_the_same_call_goes_on(self):
        part = self.folder / "rows"
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(2, mp_context=context) as processes:
            pid = processes.submit(os.getpid).result()
            killer = Killer(pid)
            said = self.unfinished(processes, over=LONG, part_file=part, progress=killer)
        self.assertIn("BrokenProcessPool", str(said))
        self.assertGreater(said.done, 20)
        self.assertLess(said.done, 1500)
        seen = []
        found = sweep(LONG, part_file=part, progress=lambda done, _: seen.append(done))
        self.same(found, sweep(LONG))
        self.assertEqual(seen[0], said.done)

    def test_another_version_is_told(self):
        self.assertEqual(_executor.part("0.0.9 abc", "what it asks is not looked at").text, b"")

        class Older(Scripted):
            def submit(self, call, *args):
                return super().submit(lambda *_: ("0.0.9 abc", b"", 0.0), *args)

        said = self.unfinished(Older())
        self.assertIn("a worker has trochoid 0.0.9 abc, and here it is", str(said))
        missing = ModuleNotFoundError("No module named 'trochoid'", name="trochoid")
        said = self.unfinished(Scripted({0: missing}))
        self.assertIn("a worker cannot import the module trochoid", str(said))

    def test_no_more_parts_than_asked_are_in_flight(self):
        class Slow(ThreadPoolExecutor):
            most = 0

            def submit(self, *args):
                future = super().submit(*args)
                open_ = getattr(self, "open", [])
                self.open = [one for one in open_ if not one.done()] + [future]
                Slow.most = max(Slow.most, len(self.open))
                return future

        with Slow(1) as executor:
            self.same(sweep(executor=executor, in_flight=3), self.wanted)
        self.assertLessEqual(Slow.most, 3)

    def test_a_torn_answer_is_not_believed(self):
        def torn(build, *asked):
            done = _executor.part(build, *asked)
            return done._replace(text=done.text.replace(b"ok", b"OK"))

        class Torn(Scripted):
            def submit(self, call, *args):
                return super().submit(torn, *args)

        with self.assertRaisesRegex(ValueError, "did not come whole"):
            sweep(executor=Torn())


if __name__ == "__main__":
    unittest.main()
