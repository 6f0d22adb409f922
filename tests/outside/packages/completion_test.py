"""What the shells complete of a command line."""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import helps

IN_BASH = """source "$1"; shift
[ "$(complete -p trochoid)" = "complete -F _trochoid trochoid" ] || exit 1
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_trochoid 2>/dev/null  # compopt speaks up where no key was pressed
printf '%s\\n' "${COMPREPLY[@]}"
"""
FILES = ("cut.toml", "record.csv", "page.html", "cut.identify/summary.json")


class Completion(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(prefix="trochoid_")
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        for name in FILES:
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).write_text("")

    def run_shell(self, *command):
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def in_bash(self, *words):
        """What a tab after the last word offers."""
        out = self.run_shell("bash", "--norc", "-c", IN_BASH, "bash",
                             helps.MANUAL / "trochoid.bash", "trochoid", *words)
        return sorted(out.split())

    def in_fish(self, line):
        out = self.run_shell("fish", "--no-config", "-c", f"source $argv[1]; complete -C '{line}'",
                             helps.MANUAL / "trochoid.fish")
        return sorted(line.split("\t")[0] for line in out.splitlines())

    def test_bash_names_commands_and_options(self):
        self.assertEqual(self.in_bash("st"), ["stability"])
        self.assertEqual(self.in_bash(""), sorted(helps.commands() + helps.options()))
        for command in helps.commands():
            self.assertEqual(self.in_bash(command, "-"), sorted(helps.options(command)))

    def test_bash_names_files_where_files_are_meant(self):
        self.assertEqual(self.in_bash("identify", ""), ["cut.identify", "cut.toml"])
        self.assertEqual(self.in_bash("modes", ""), ["cut.identify", "cut.toml", "record.csv"])
        self.assertEqual(self.in_bash("modes", "-q", "r"), ["record.csv"])
        self.assertEqual(self.in_bash("report", ""), ["cut.identify"])
        self.assertEqual(self.in_bash("identify", "cut.toml", "-o", ""), ["cut.identify"])
        self.assertEqual(self.in_bash("identify", "--output", "=", ""), ["cut.identify"])

    def test_bash_names_what_a_word_may_be(self):
        self.assertEqual(self.in_bash("modes", "--kind", "m"), ["mobility"])
        self.assertEqual(self.in_bash("sweep", "--command", "id"), ["identify"])
        self.assertEqual(self.in_bash("new", "mo"), ["modes"])
        self.assertEqual(self.in_bash("new", "modes", "c"), ["cut.identify", "cut.toml"])
        self.assertEqual(self.in_bash("modes", "--modes", ""), [])

    @unittest.skipUnless(shutil.which("fish"), "fish is not here")
    def test_fish_does_the_same(self):
        self.assertEqual(self.in_fish("trochoid st"), ["stability"])
        self.assertEqual(self.in_fish("trochoid modes --ki"), ["--kind"])
        self.assertEqual(self.in_fish("trochoid modes --kind m"), ["mobility"])
        self.assertIn("cut.toml", self.in_fish("trochoid identify c"))
        self.assertIn("cut.identify/", self.in_fish("trochoid report c"))

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not here")
    def test_zsh_takes_it(self):
        self.run_shell("zsh", "-f", "-n", helps.MANUAL / "_trochoid")
        loaded = self.run_shell(
            "zsh", "-f", "-c", "fpath=($1 $fpath); autoload -Uz compinit; compinit -D -u; "
            "print $_comps[trochoid]", "zsh", helps.MANUAL)
        self.assertEqual(loaded.strip(), "_trochoid")


if __name__ == "__main__":
    unittest.main()
