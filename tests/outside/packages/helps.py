"""What the program tells with --help, and the files that are made of the same table."""
import os
import pathlib
import re
import subprocess

PROGRAM = os.environ["TROCHOID"]
BUILD = pathlib.Path(os.environ["TROCHOID_BUILD"])
MANUAL = BUILD / "manual"


def said(*arguments):
    return subprocess.run([PROGRAM, *arguments], check=True, capture_output=True,
                          text=True).stdout


def commands():
    listed = said("--help").split("Subcommands:\n")[1].split("\n\n")[0]
    return re.findall(r"^  (\w+)", listed, re.MULTILINE)


def options(*command):
    """-h, --help, ... in the order of the help."""
    listed = said(*command, "--help").split("Options:\n")[1].split("\n\n")[0]
    names = re.findall(r"^  (-\S+)", listed, re.MULTILINE)
    return [name for line in names for name in line.split(",")]
