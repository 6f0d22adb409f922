"""Every help ends with commands that lead on with that very command."""
import re
import unittest

import helps


class FirstSteps(unittest.TestCase):
    def test_every_command_names_its_own(self):
        for command in helps.commands():
            with self.subTest(command):
                steps = re.search(r"Start with\n((?:  .*\n)+)", helps.said(command, "--help"))
                self.assertIsNotNone(steps)
                self.assertIn(f"trochoid {command} ", steps[1])


if __name__ == "__main__":
    unittest.main()
