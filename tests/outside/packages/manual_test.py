"""The man page tells all that --help tells, and man has nothing to complain about."""
import os
import re
import shutil
import subprocess
import unittest

import helps

PAGE = helps.MANUAL / "trochoid.1"


def plain(text):
    return re.sub(r"\\f[BIRP]", "", text).replace("\\-", "-")


class Manual(unittest.TestCase):
    def setUp(self):
        self.page = plain(PAGE.read_text())

    def section(self, name):
        return re.search(rf"^\.SH {name}\n(.*?)(?=^\.SH |\Z)", self.page, re.M | re.S)[1]

    def test_every_command_has_a_part_that_names_its_options(self):
        listed = helps.commands()
        self.assertIn("identify", listed)
        parts = dict(re.findall(r"^\.SS (\w+) [^\n]*\n(.*?)(?=^\.SS |\Z)",
                                self.section("COMMANDS"), re.M | re.S))
        self.assertEqual(list(parts), listed)
        for command in listed:
            named = re.search(r"^Options: (.*)", parts[command], re.M)[1].split(", ")
            wanted = [name for name in helps.options(command) if name.startswith("--")]
            self.assertEqual(named, wanted, command)

    def test_every_option_is_explained(self):
        explained = {name for line in re.findall(r"^\.TP\n(-.*)", self.section("OPTIONS"), re.M)
                     for name in re.findall(r"(?<![\w-])--?[a-z][a-z-]*", line)}
        wanted = set(helps.options())
        for command in helps.commands():
            wanted |= set(helps.options(command))
        self.assertEqual(explained, wanted)

    def test_exit_codes_and_threads_are_told(self):
        self.assertEqual(re.findall(r"^\.TP\n(\d)\n", self.section("EXIT STATUS"), re.M),
                         ["0", "1", "2", "3"])
        self.assertIn("TROCHOID_THREADS", self.section("ENVIRONMENT"))

    def test_help_does_not_tell_how_it_was_made(self):
        self.assertNotIn("--manual", helps.said("--help"))
        self.assertEqual(helps.said("--manual", "man"), PAGE.read_text())

    @unittest.skipUnless(shutil.which("man"), "man is not here")
    def test_man_shows_it_without_a_warning(self):
        shown = subprocess.run(
            ["man", "--warnings", "-l", "-Tutf8", str(PAGE)], capture_output=True, text=True,
            env={**os.environ, "LC_ALL": "C.UTF-8", "MANROFFSEQ": "", "MANWIDTH": "80"})
        self.assertEqual((shown.returncode, shown.stderr), (0, ""))
        self.assertIn("Cutting coefficients and runout", " ".join(shown.stdout.split()))

    @unittest.skipUnless(shutil.which("lexgrog"), "lexgrog is not here")
    def test_apropos_finds_its_name(self):
        found = subprocess.run(["lexgrog", str(PAGE)], capture_output=True, text=True)
        self.assertIn('"trochoid - compute what', found.stdout)


if __name__ == "__main__":
    unittest.main()
