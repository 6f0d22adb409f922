"""--time-limit ends long work with what was found, and Ctrl-C at once with nothing."""
import os
import shutil
import signal
import subprocess
import time

from in_folder import InFolder, ROOT, identification, main, program, simulation

SOON = 20.0  # s, for a machine that does much else; without an end it is minutes
AT_ONCE = 5.0  # s, likewise: alone it is some hundredths


class TimeLimit(InFolder):
    def setUp(self):
        super().setUp()
        self.write("long.toml", simulation(  # minutes
            tool={"shape": "ball", "teeth": 20}, runout={"radial_offsets_mm": [0.0] * 20},
            sampling={"samples_per_rev": 1000000}))

    def lobes(self):
        text = (ROOT / "examples/stability_922Hz/case.toml").read_text()
        text = text.replace("[5000, 25000, 101]", "[300, 25000, 5000]")
        self.write("lobes.toml", text.replace("[0.08, 4.0, 50]", "[0.08, 4.0, 500]"))

    def test_no_answer_in_time_is_1_and_says_so(self):
        started = time.monotonic()
        done = self.run_program("simulate", "long.toml", "--anyway", "--time-limit", "1", code=1)
        self.assertLess(time.monotonic() - started, SOON)
        said = self.summary("long.simulate")
        self.assertEqual(said["status"], "failed")
        self.assertEqual(said["command"], "simulate")
        self.assertEqual(said["result"], {})
        self.assertTrue(said["message"].startswith(
            "the time limit of 1 s has passed and there is no answer yet"), said["message"])
        self.assertIn(said["message"], done.stderr)
        self.assertEqual({p.name for p in (self.folder / "long.simulate").iterdir()},
                         {"case.toml", "summary.json", "report.html"})
        self.run_program("report", "long.simulate", code=1)

    def test_lobes_of_part_of_the_speeds_are_an_answer(self):
        self.lobes()
        started = time.monotonic()
        done = self.run_program("stability", "lobes.toml", "--anyway", "--time-limit", "2",
                                "--no-report")
        self.assertLess(time.monotonic() - started, SOON)
        said = self.summary("lobes.stability")
        self.assertEqual([w["code"] for w in said["warnings"]], ["time_limit", "one_direction"])
        self.assertEqual(said["result"]["verdict"], "unstable")
        self.assertNotIn("better_speed", said["result"])
        rows = (self.folder / "lobes.stability/lobes.csv").read_text().splitlines()[1:]
        speeds = {row.split(",")[0] for row in rows}
        self.assertEqual(len(rows), 500 * len(speeds))
        self.assertIn(f"lobes.csv has {len(speeds)} of the 5000 speeds", done.stdout)
        self.assertEqual((self.folder / "lobes.stability/limit.csv").read_text().count("\n"), 1)

    def test_the_fit_that_decides_is_an_answer(self):
        self.record()
        self.write("cut.toml", identification(identify={"sweep_um": [-20, 20, 5]}))
        self.run_program("identify", "cut.toml", "--time-limit", "0.001")
        said = self.summary("cut.identify")
        self.assertEqual(said["status"], "ok")
        self.assertEqual(said["result"]["chosen"], "trochoidal")
        self.assertIn("time_limit", [w["code"] for w in said["warnings"]])

    def test_with_time_enough_nothing_is_different(self):
        self.write("cut.toml", simulation())
        self.run_program("simulate", "cut.toml")
        before = self.everything()
        self.run_program("simulate", "cut.toml", "--time-limit", "1000")
        self.assertEqual(self.everything(), before)

    def test_it_must_be_a_time(self):
        for wrong in ("0", "-1", "soon"):
            self.run_program("simulate", "long.toml", "--time-limit", wrong, code=2)


class Interrupted(InFolder):
    def interrupted(self, *arguments, after):
        """Ctrl-C once the program has computed for a while: how long until it is gone."""
        run = subprocess.Popen([program.PROGRAM, *arguments], cwd=self.folder,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while run.poll() is None and not after(run.pid):
            time.sleep(0.002)
        run.send_signal(signal.SIGINT)
        started = time.monotonic()
        self.assertEqual(run.wait(timeout=program.HANGS), -signal.SIGINT)
        return time.monotonic() - started

    def test_while_it_computes_it_leaves_what_was_there(self):
        self.write("cut.toml", simulation())
        self.run_program("simulate", "cut.toml", "-o", "out", "-q")
        self.write("long.toml", simulation(
            tool={"shape": "ball", "teeth": 20}, runout={"radial_offsets_mm": [0.0] * 20},
            sampling={"samples_per_rev": 1000000}))
        before = self.everything()
        ticks = os.sysconf("SC_CLK_TCK")

        def computes(pid):
            with open(f"/proc/{pid}/stat", encoding="utf-8") as stat:
                return int(stat.read().rpartition(")")[2].split()[11]) / ticks > 0.3
        for options in ([], ["--time-limit", "500"]):
            took = self.interrupted("simulate", "long.toml", "--anyway", "-o", "out", *options,
                                    after=computes)
            self.assertLess(took, AT_ONCE)
            self.assertEqual(self.everything(), before)

    def test_while_it_writes_the_next_command_mends_it(self):
        self.write("cut.toml", simulation(sampling={"samples_per_rev": 100000,
                                                    "revolutions": 10}))
        self.write("small.toml", simulation())
        self.run_program("simulate", "small.toml", "-o", "out", "-q")
        before = self.everything()

        def writes(_):
            return any(list(p.glob("*")) for p in self.folder.glob(".out.new-*"))
        took = self.interrupted("simulate", "cut.toml", "-o", "out", after=writes)
        self.assertLess(took, AT_ONCE)
        left = {name for name in self.everything() if name.startswith(".out.new-")}
        self.assertTrue(left)
        for name in before:
            self.assertEqual(self.everything()[name], before[name])
        shutil.copy(self.folder / "small.toml", self.folder / "again.toml")
        self.run_program("simulate", "again.toml", "-o", "out", "-q")
        self.assertEqual(list(self.folder.glob(".out.*")), [])


if __name__ == "__main__":
    main()
