"""Where the results cannot be written is said before the work, and not after it."""
import os
import unittest

from in_folder import InFolder, identification, main, simulation

LOCKED = "/proc/trochoid/out"  # where nobody can make a folder, root neither


class Place(InFolder):
    """The record is rubbish, and nobody comes to read it: the place is looked at first."""

    def setUp(self):
        super().setUp()
        self.write("record.csv", "no record at all\n")
        self.write("id.toml", identification())
        self.write("file", "somebody's\n")
        self.write("foreign/notes.txt", "somebody's\n")
        self.before = self.everything()

    def refused(self, folder, *why):
        done = self.run_program("identify", "id.toml", "-q", "-o", folder, code=2)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("cannot write", done.stderr)
        for part in why:
            self.assertIn(part, done.stderr)
        self.assertEqual(self.everything(), self.before)

    def test_a_file_in_its_place(self):
        self.refused("file", "it exists and is not a folder")

    def test_a_file_above_it(self):
        self.refused("file/out", "file")
        self.refused("file/deep/out", "file")

    def test_a_folder_of_somebody_else(self):
        self.refused("foreign", "it contains 'notes.txt', which trochoid did not write")

    def test_a_folder_that_cannot_be_written(self):
        self.refused(LOCKED, LOCKED)

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_a_folder_without_permission(self):
        (self.folder / "foreign").chmod(0o500)
        self.refused("foreign/out", "foreign/out", "denied")
        self.refused("foreign/deep/out", "foreign/deep/out", "denied")

    def test_a_folder_that_is_there_or_can_be_made_is_no_problem(self):
        for folder in ("out", "deep/down/out"):
            done = self.run_program("identify", "id.toml", "-q", "-o", folder, code=2)
            self.assertIn("record.csv", done.stderr)
            self.assertEqual(self.everything(), self.before)

    def test_all_problems_at_once(self):
        self.write("cut.toml", simulation(tool={"teeth": -2}))
        done = self.run_program("simulate", "cut.toml", "-o", "file", code=2)
        self.assertIn("tool.teeth", done.stderr)
        self.assertIn("cannot write", done.stderr)

    def test_a_bare_data_file(self):
        self.write("frf.csv", "rubbish\n")
        for command in ("modes", "actuator"):
            done = self.run_program(command, "frf.csv", "-o", "file", code=2)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn("it exists and is not a folder", done.stderr)


if __name__ == "__main__":
    main()
