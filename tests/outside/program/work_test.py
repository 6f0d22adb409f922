"""Work that would take long or much memory is known before it starts."""
from in_folder import InFolder, identification, main, simulation

# Eight teeth that ask each other at many places who cut before: minutes. But there is no
# feed, so that whoever starts it is soon done.
HEAVY = {"tool": {"shape": "ball", "teeth": 8}, "cut": {"feed_per_tooth_mm": 0.0}}


class Work(InFolder):
    def setUp(self):
        super().setUp()
        self.record()

    def refused(self, command, *options):
        before = self.everything()
        done = self.run_program(command, "cut.toml", *options, code=2)
        self.assertEqual(done.stdout, "")
        self.assertEqual(self.everything(), before)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        return done.stderr

    def test_too_much_is_refused_and_done_where_it_is_asked_for_again(self):
        self.write("cut.toml", identification(**HEAVY))
        for options in ((), ("--quiet",)):
            said = self.refused("identify", *options)
            self.assertRegex(said, r"^cut\.toml: tool\.teeth = 8\. This would take about "
                                   r"\S+ evaluations, 4 min on one core, ")
            self.assertIn("more than 1e+09 evaluations or 1 GB are computed with --anyway only",
                          said)
        done = self.run_program("identify", "cut.toml", "--anyway", code=1)
        self.assertIn("feed", done.stderr)

    def test_the_key_and_the_value_that_would_do(self):
        self.write("cut.toml", simulation(
            tool={"shape": "ball", "teeth": 20}, runout={"radial_offsets_mm": [0.0] * 20},
            sampling={"samples_per_rev": 500000}))
        said = self.refused("simulate")
        self.assertIn("sampling.samples_per_rev = 500000: up to 200000 would do.", said)
        self.assertIn("most of it for 500000 angles of the forces", said)

    def test_memory(self):
        with open(self.folder / "record.csv", "r+b") as record:
            record.truncate(300_000_000)  # a hole of the disk
        self.write("cut.toml", identification())
        said = self.refused("identify")
        self.assertIn("measurement[1].file = 300 MB: up to 180 MB would do.", said)
        self.assertIn("1.6 GB of memory", said)

    def test_it_is_said_together_with_what_is_wrong_with_the_place(self):
        self.write("cut.toml", identification(**HEAVY))
        self.write("file", "somebody's\n")
        said = self.run_program("identify", "cut.toml", "-o", "file", code=2).stderr
        self.assertIn("--anyway", said)
        self.assertIn("cannot write", said)


if __name__ == "__main__":
    main()
