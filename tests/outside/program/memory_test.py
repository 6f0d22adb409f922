"""Where there is no memory the program says so and how much was asked for."""
import os
import subprocess

from in_folder import InFolder, ROOT, main, program

SHIM = os.environ["FAILING_MEMORY"]
RUNS = {"simulate": "st52_slot/truth.toml", "identify": "st52_slot/case.toml",
        "modes": "tap_test/case.toml", "actuator": "tap_test/step.csv",
        "stability": "stability_922Hz/case.toml", "surface": "thin_wall_table1/published.toml",
        "calibrate": "thin_wall_table1/case.toml", "dynamics": "runout_table_25mm/case.toml",
        "correct": "runout_correction/case.toml", "plan": "plan_next_cut/case.toml",
        "check": "st52_slot/case.toml"}
STEP = 1.5


class Memory(InFolder):
    def run_with_fault(self, command, file, at):
        environment = dict(os.environ, LD_PRELOAD=SHIM, FAULT_AT=str(at), TROCHOID_THREADS="2")
        done = subprocess.run([program.PROGRAM, command, ROOT / "examples" / file, "-o", "out",
                               "-q"], cwd=self.folder, env=environment, capture_output=True,
                              text=True, timeout=program.HANGS, check=False)
        return done.returncode, done.stderr

    def test_every_command(self):
        for command, file in RUNS.items():
            at = 1.0
            fell = 0
            while True:
                code, said = self.run_with_fault(command, file, int(at))
                if "fault injected" not in said:
                    break
                with self.subTest(command=command, at=int(at)):
                    self.assertIn(code, (0, 1, 2, 3), said)
                    if code == 3:
                        fell += 1
                        self.assertRegex(said, rf"trochoid {command}: there is no memory for it: "
                                               r"\S+ MiB more were asked for; nothing was written")
                    self.assertEqual([p.name for p in self.folder.iterdir()
                                      if p.name.startswith(".")], [])
                at = at * STEP + 1
            with self.subTest(command=command):
                self.assertGreater(fell, 2)


if __name__ == "__main__":
    main()
