"""A case from the standard input, and keys that are set beside it."""
import subprocess

from in_folder import InFolder, main, program, simulation


class Set(InFolder):
    def setUp(self):
        super().setUp()
        self.write("cut.toml", simulation())

    def test_the_answer_is_that_of_a_case_that_says_so(self):
        self.run_program("simulate", "cut.toml", "--set", "cut.spindle_rpm=4000",
                         "--set", "cut.engagement=up", "--set", "cut.radial_depth_mm=1",
                         "-q", "-o", "set")
        self.write("up.toml", simulation(cut={"spindle_rpm": 4000, "engagement": "up",
                                              "radial_depth_mm": 1.0}))
        self.run_program("simulate", "up.toml", "-q", "-o", "said")
        for name in ("case.toml", "forces.csv"):
            self.assertEqual((self.folder / "set" / name).read_text(),
                             (self.folder / "said" / name).read_text(), name)

    def test_the_case_may_come_before_or_after(self):
        for words in (("--set", "cut.feed_per_tooth_mm=-1", "cut.toml"),
                      ("cut.toml", "--set=cut.feed_per_tooth_mm=-1")):
            done = self.run_program("check", *words, code=2)
            self.assertTrue(done.stderr.startswith(
                "--set: cut.feed_per_tooth_mm = -1 mm: out of range"), done.stderr)

    def test_every_mistake_is_told_at_its_place(self):
        self.write("wrong.toml", simulation(tool={"teeth": -2}))
        done = self.run_program("simulate", "wrong.toml", "--set", "cut.spindel_rpm=1",
                                code=2)
        told = done.stderr.splitlines()
        self.assertEqual(len(told), 2, told)
        self.assertIn("--set: cut.spindel_rpm = 1 rpm: no such key; did you mean", told[0])
        self.assertIn("wrong.toml:", told[1])

    def test_not_beside_a_bare_data_file(self):
        self.write("frf.csv", "1\n")
        done = self.run_program("modes", "frf.csv", "--set", "frf.modes=1", code=2)
        self.assertIn("--set goes with a case", done.stderr)

    def from_input(self, *arguments, text):
        return subprocess.run([program.PROGRAM, *arguments], cwd=self.folder, input=text,
                              capture_output=True, text=True, timeout=program.HANGS)

    def test_a_case_from_the_standard_input(self):
        done = self.from_input("simulate", "-", "--set", "cut.spindle_rpm=900", "-q",
                               text=simulation())
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("spindle_rpm = 900",
                      (self.folder / "stdin.simulate/case.toml").read_text())
        done = self.from_input("check", "-", text="include = 'cut.toml'\n[tool]\nteeth = 0\n")
        self.assertEqual(done.returncode, 2)
        self.assertIn("stdin.toml:3:", done.stderr)
        done = self.from_input("check", "-", text="x = 1\n" * 4_000_000)
        self.assertEqual(done.returncode, 2)
        self.assertIn("larger than 16 MiB", done.stderr)


if __name__ == "__main__":
    main()
