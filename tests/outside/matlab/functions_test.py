"""matlab/+trochoid has a function for each command that answers a case, with its sentence."""
import os
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
FOLDER = ROOT / "matlab/+trochoid"
PROGRAM = os.environ["TROCHOID"]
NO_ANSWER = {"check", "new", "report"}


def commands():
    """{command: its sentence} of the help."""
    text = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, check=True).stdout
    listed = text.split("Subcommands:")[1].split("Start with")[0]
    return dict(re.findall(r"^  (\w+) +(.+)$", listed, re.MULTILINE))


class Functions(unittest.TestCase):
    def test_each_command_has_one(self):
        here = {file.stem for file in FOLDER.glob("*.m")} - {"run"}
        self.assertEqual(here, set(commands()) - NO_ANSWER)

    def test_each_says_what_the_program_says(self):
        for name, sentence in commands().items():
            if name in NO_ANSWER:
                continue
            text = (FOLDER / f"{name}.m").read_text()
            self.assertIn(f"trochoid.run('{name}', case_, varargin{{:}})", text)
            head = " ".join(line.lstrip("% ") for line in text.split("%\n")[0].splitlines()[1:])
            said = head.removeprefix(f"{name.upper()}  ").strip().rstrip(".")
            self.assertEqual(said, sentence)

    def test_a_struct_knows_the_tables_that_may_stand_several_times(self):
        known = re.search(r"many = any\(strcmp\(name\{1\}, \{(.*?)\}", (FOLDER / "run.m").read_text(),
                          re.DOTALL)[1]
        page = (ROOT / "docs/formats/case.md").read_text()
        self.assertEqual(re.findall(r"'(\w+)'", known), re.findall(r"^## `\[\[(\w+)\]\]`", page, re.MULTILINE))


if __name__ == "__main__":
    unittest.main()
