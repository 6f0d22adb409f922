#!/usr/bin/env python3
"""The HAL component in halrun, headless, with a simulated spindle and a plant.

Usage: hal_test.py MODULES OFFLINE [unittest options]
MODULES is the folder with trochoid_correct.so and trochoid_bench.so.

Nothing is installed and no rights are needed: rtapi_app loads modules from one fixed folder
only, so a copy of it is given a folder of the same length. Real-time applications refuse to
run as root: root becomes nobody.
"""
import fcntl
import math
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import unittest

MODULES, OFFLINE = (pathlib.Path(arg).resolve() for arg in sys.argv[1:3])
INSTALLED = pathlib.Path("/usr/lib/linuxcnc/modules")
NOBODY = 65534
PERIOD = 250000  # ns
NEVER = 0xFFFFFFFF
DISABLED, FAULT, RUNNING = 0, 5, 3


def table_text(amplitude):
    rows = (f"{i},{amplitude * math.sin(math.radians(i)) + 30!r}" for i in range(360))
    return "angle_deg,command_um\n" + "\n".join(rows) + "\n"


def own_rtapi_app(folder):
    """A copy that finds its modules in ./modules of the folder where it runs."""
    program = pathlib.Path("/usr/bin/rtapi_app").read_bytes()
    old = bytes(INSTALLED)
    assert program.count(old) == 1, "rtapi_app does not name its modules once"
    new = b"./" + b"/" * (len(old) - len("./modules")) + b"modules"
    (folder / "rtapi_app").write_bytes(program.replace(old, new))
    (folder / "rtapi_app").chmod(0o755)
    (folder / "modules").mkdir()
    for module in INSTALLED.glob("*.so"):
        (folder / "modules" / module.name).symlink_to(module)
    for module in MODULES.glob("*.so"):
        (folder / "modules" / module.name).unlink(missing_ok=True)
        shutil.copy(module, folder / "modules")


def running_elsewhere():
    """Processes that hold the HAL of this machine. Dead ones have no command line."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            name = (folder / "comm").read_text().strip()
            alive = (folder / "cmdline").read_bytes() != b""
        except OSError:  # it has just ended
            continue
        if alive and name in ("rtapi_app", "linuxcncsvr"):
            found.append(f"{name} {folder.name}")
    return found


def lock():
    """One HAL a machine, also for tests of another clone."""
    try:
        file = open(pathlib.Path(tempfile.gettempdir()) / "trochoid_hal.lock", "w")
    except PermissionError:  # another user's
        return None
    fcntl.flock(file, fcntl.LOCK_EX)
    return file


class Halrun:
    """A folder in which HAL files are run."""

    def __init__(self):
        self.lock = lock()
        if running_elsewhere():
            print(f"skipped: LinuxCNC is running here: {running_elsewhere()}")
            os._exit(77)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="trochoid_hal_"))
        own_rtapi_app(self.folder)
        if os.getuid() == 0:
            os.chown(self.folder, NOBODY, NOBODY)

    def close(self):
        shutil.rmtree(self.folder)

    def run(self, text, timeout=1200):
        (self.folder / "test.hal").write_text(text)
        command = ["halrun", "-f", "test.hal"]
        if os.getuid() == 0:
            command = ["setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}",
                       "--clear-groups"] + command
        with open(self.folder / "out.txt", "w+") as out:
            process = subprocess.Popen(command, cwd=self.folder, start_new_session=True,
                                       env={**os.environ, "HOME": str(self.folder)},
                                       stdin=subprocess.DEVNULL, stdout=out, stderr=out)
            try:
                process.wait(timeout)
            finally:  # whatever it left, in its session only
                try:
                    os.killpg(process.pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
            out.seek(0)
            said = out.read()
        if process.returncode != 0:
            raise AssertionError(f"halrun: {process.returncode}\n{said}")
        return said


# The first module starts the process that holds them all; it must be our rtapi_app.
SINGLE = """
loadusr -Wn threads ./rtapi_app load threads name1=servo period1={period}
loadrt trochoid_correct table={table} {model}
loadrt trochoid_bench
loadrt sampler depth=16000 cfg=usuuuuff
setp trochoid-correct.0.start-um 30
setp trochoid-correct.0.lead-s 2.268e-3
setp trochoid-bench.0.enable-at {enable_at}
setp trochoid-bench.0.disable-at {disable_at}
setp trochoid-bench.0.lose-index-at {lose_index_at}
net index trochoid-correct.0.index-enable trochoid-bench.0.index-enable
net position trochoid-bench.0.position trochoid-correct.0.position
net speed trochoid-bench.0.speed trochoid-correct.0.speed
net enable trochoid-bench.0.enable trochoid-correct.0.enable
net force trochoid-bench.0.force trochoid-correct.0.force
net command trochoid-correct.0.command-um trochoid-bench.0.command-um
net tick trochoid-bench.0.tick sampler.0.pin.0
net state trochoid-correct.0.state sampler.0.pin.1
net cu trochoid-bench.0.command-upper sampler.0.pin.2
net cl trochoid-bench.0.command-lower sampler.0.pin.3
net fu trochoid-bench.0.force-upper sampler.0.pin.4
net fl trochoid-bench.0.force-lower sampler.0.pin.5
net flute1 trochoid-bench.0.flute1 sampler.0.pin.6
net flute2 trochoid-bench.0.flute2 sampler.0.pin.7
{more}
addf trochoid-bench.0.spindle servo
addf trochoid-correct.0 servo
addf trochoid-bench.0.cut servo
addf sampler.0 servo
start
loadusr -w halsampler -n {ticks} samples.txt
stop
unloadrt all
"""

# One thread for the pulses too: with two, their order is that of the scheduler.
ENCODER = """
loadusr -Wn threads ./rtapi_app load threads name1=servo period1=100000
loadrt trochoid_correct table={table} {model}
loadrt trochoid_bench
loadrt sim_encoder num_chan=1
loadrt encoder num_chan=1
loadrt sampler depth=32000 cfg=usuuuuff
setp trochoid-correct.0.start-um 30
setp trochoid-correct.0.lead-s 2.268e-3
setp trochoid-bench.0.external 1
setp trochoid-bench.0.enable-at {enable_at}
setp sim-encoder.0.speed 20
setp encoder.0.position-scale 400
net a sim-encoder.0.phase-A encoder.0.phase-A
net b sim-encoder.0.phase-B encoder.0.phase-B
net z sim-encoder.0.phase-Z encoder.0.phase-Z
net index trochoid-correct.0.index-enable encoder.0.index-enable
net position encoder.0.position trochoid-correct.0.position trochoid-bench.0.encoder-position
net speed encoder.0.velocity trochoid-correct.0.speed
net enable trochoid-bench.0.enable trochoid-correct.0.enable
net force trochoid-bench.0.force trochoid-correct.0.force
net command trochoid-correct.0.command-um trochoid-bench.0.command-um
net tick trochoid-bench.0.tick sampler.0.pin.0
net state trochoid-correct.0.state sampler.0.pin.1
net cu trochoid-bench.0.command-upper sampler.0.pin.2
net cl trochoid-bench.0.command-lower sampler.0.pin.3
net fu trochoid-bench.0.force-upper sampler.0.pin.4
net fl trochoid-bench.0.force-lower sampler.0.pin.5
net flute1 trochoid-bench.0.flute1 sampler.0.pin.6
net flute2 trochoid-bench.0.flute2 sampler.0.pin.7
addf sim-encoder.make-pulses servo
addf encoder.update-counters servo
addf sim-encoder.update-speed servo
addf encoder.capture-position servo
addf trochoid-bench.0.spindle servo
addf trochoid-correct.0 servo
addf trochoid-bench.0.cut servo
addf sampler.0 servo
start
loadusr -w halsampler -n {ticks} samples.txt
stop
unloadrt all
"""


class Sample:
    def __init__(self, line):
        fields = line.split()
        self.bits = [int(field) for field in fields[:6]]
        self.tick, self.state = self.bits[:2]
        self.command, self.force = (
            struct.unpack(">d", struct.pack(">II", *self.bits[i:i + 2]))[0] for i in (2, 4))
        self.flutes = [float(field) for field in fields[6:8]]

    def difference(self):
        return abs(self.flutes[0] - self.flutes[1]) / max(self.flutes)


class Hal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.halrun = Halrun()

    @classmethod
    def tearDownClass(cls):
        cls.halrun.close()

    def samples(self, text, amplitude=14.0, **settings):
        values = {"period": PERIOD, "table": "table.csv", "model": "", "enable_at": 0,
                  "disable_at": NEVER, "lose_index_at": NEVER, "more": "", **settings}
        folder = self.halrun.folder
        (folder / "table.csv").write_text(table_text(amplitude))
        (folder / "samples.txt").unlink(missing_ok=True)
        self.halrun.run(text.format(**values))
        lines = (folder / "samples.txt").read_text().splitlines()
        self.assertNotIn("overrun", lines)
        found = [Sample(line) for line in lines]
        self.assertEqual([s.tick for s in found], list(range(values["ticks"])))
        return found

    def program_answer(self, name):
        """A file of the program's answer to the example, for the component."""
        example = pathlib.Path(__file__).parents[3] / "examples/runout_correction"
        answer = self.halrun.folder / "answer"
        subprocess.run([os.environ["TROCHOID"], "correct", example / "case.toml",
                        "--output", answer, "--no-report"], check=True, capture_output=True)
        shutil.copy(answer / name, self.halrun.folder)
        return (answer / name).read_text()

    def offline(self, ticks, enable_at=0, disable_at=NEVER, lose_index_at=NEVER, learn=0):
        arguments = [self.halrun.folder / "table.csv", ticks, enable_at, disable_at,
                     lose_index_at, learn]
        done = subprocess.run([OFFLINE, *map(str, arguments)], check=True,
                              capture_output=True, text=True)
        return [[int(field) for field in line.split()] for line in done.stdout.splitlines()]

    def assert_same_bits(self, found, expected):
        self.assertEqual(len(found), len(expected))
        for sample, want in zip(found, expected):
            self.assertEqual(sample.bits, want, f"tick {sample.tick}")

    def test_flutes_differ_before_and_not_after_bit_by_bit_as_the_library_says(self):
        found = self.samples(SINGLE, ticks=4800, enable_at=1000)
        before = found[999]
        after = found[-1]
        self.assertGreater(before.difference(), 0.5)
        self.assertLess(after.difference(), 0.03)
        self.assertEqual(after.state, RUNNING)
        print(f"before {before.flutes}, after {after.flutes}")
        self.assert_same_bits(found, self.offline(4800, enable_at=1000))

    def test_learning_finds_the_gain_by_itself(self):
        found = self.samples(SINGLE, amplitude=10.0, ticks=4800,
                             more="setp trochoid-correct.0.learn 1\n"
                             "setp trochoid-correct.0.gain 0")
        running = next(s.tick for s in found if s.state == RUNNING)
        turn = 200
        self.assertGreater(found[running].difference(), 0.5)
        # The first whole turn begins within one; five turns later the peaks are equal.
        for sample in found[running + 7 * turn:]:
            self.assertLess(sample.difference(), 0.03, sample.tick)
        self.assert_same_bits(found, self.offline(4800, learn=1))

    def test_waves_are_learnt_with_the_model_that_the_program_wrote(self):
        self.program_answer("estimator.csv")
        found = self.samples(SINGLE, model="model=estimator.csv", ticks=9600,
                             more="setp trochoid-correct.0.learn 1\n"
                             "setp trochoid-correct.0.gain 0\n"
                             "setp trochoid-correct.0.lead-s 0")
        running = next(s.tick for s in found if s.state == RUNNING)
        self.assertGreater(found[running].difference(), 0.5)
        print(f"waves: {found[running].difference():.3f} to {found[-1].difference():.4f}")
        for sample in found[-5 * 200:]:
            self.assertLess(sample.difference(), 0.03, sample.tick)

    def test_lost_index_ramps_to_mid_stroke(self):
        lost = 2600
        found = self.samples(SINGLE, ticks=4400, lose_index_at=lost)
        self.assertEqual(found[lost].state, RUNNING)
        fault = next(s.tick for s in found if s.state == FAULT)
        self.assertLessEqual(fault - lost, 1.5 * 200 + 1)
        for i in range(fault, len(found)):
            step = abs(found[i].command - found[i - 1].command)
            self.assertLessEqual(step, 30 / 0.2 * PERIOD * 1e-9 * (1 + 1e-9))
        rest = next(s.tick for s in found[fault:] if s.command == 30.0)
        self.assertLessEqual((rest - fault) * PERIOD * 1e-9, 0.2)
        self.assertEqual({s.command for s in found[rest:]}, {30.0})
        self.assert_same_bits(found, self.offline(4400, lose_index_at=lost))

    def test_disabled_gives_constant_output(self):
        found = self.samples(SINGLE, ticks=800, enable_at=NEVER)
        self.assertEqual({s.command for s in found}, {30.0})
        self.assertEqual({s.state for s in found}, {DISABLED})

    def test_disabling_fades_out(self):
        found = self.samples(SINGLE, ticks=4000, disable_at=2400)
        self.assertEqual(found[2399].state, RUNNING)
        self.assertEqual({s.command for s in found[2400 + 1300:]}, {30.0})
        self.assert_same_bits(found, self.offline(4000, disable_at=2400))

    def test_with_the_simulated_encoder(self):
        found = self.samples(ENCODER, ticks=14000, enable_at=3000)
        before = found[2999]
        after = found[-1]
        print(f"encoder: before {before.flutes}, after {after.flutes}")
        self.assertGreater(before.difference(), 0.5)
        self.assertEqual(after.state, RUNNING)
        self.assertLess(after.difference(), 0.03)

    def test_gives_the_command_that_the_program_wrote(self):
        wanted = [float(line.split(",")[1])
                  for line in self.program_answer("command.csv").splitlines()[1:]]
        middle = (max(wanted) + min(wanted)) / 2
        found = self.samples(SINGLE, table="command.csv", ticks=3200,
                             more="setp trochoid-correct.0.lead-s 0")
        self.assertEqual(found[-1].state, RUNNING)
        for sample in found[-200:]:  # the command is held: half a period ahead
            turns = 0.25 + 20 * PERIOD * 1e-9 * (sample.tick + 1.5)
            there = wanted[round(turns * len(wanted)) % len(wanted)]
            self.assertAlmostEqual(sample.command - 30, there - middle, delta=0.1)

    def test_a_table_that_is_wrong_is_refused(self):
        for table, reason in (("missing.csv", "cannot be opened"),
                              ("bad.csv", "angles are not equally spaced")):
            (self.halrun.folder / "bad.csv").write_text("angle_deg,command_um\n0,1\n90,2\n")
            with self.assertRaises(AssertionError) as said:
                self.halrun.run(
                    "loadusr -Wn threads ./rtapi_app load threads name1=servo\n"
                    f"loadrt trochoid_correct table={table}\n")
            self.assertIn(reason, str(said.exception))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
