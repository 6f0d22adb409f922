#!/usr/bin/env python3
"""Run the console blocks of a page and compare what they print.

In a block ```console, lines after `$ ` are commands (a trailing backslash continues them),
all others are their output; `...` stands for anything. The commands of one page share one
scratch folder, which holds ./run and the examples as a clone has them.
Usage: transcripts.py REPOSITORY PAGE...
"""
import doctest
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```console\n(.*?)^```", re.DOTALL | re.MULTILINE)
RULES = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def steps(text):
    """(line, command, expected output) of every command of a page."""
    for block in BLOCK.finditer(text):
        line = text.count("\n", 0, block.start(1)) + 1
        command = None
        for row in block[1].splitlines(keepends=True):
            if row.startswith("$ "):
                if command:
                    yield start, command, expected
                start, command, expected = line, row[2:], ""
            elif command and command.endswith("\\\n"):
                command += row
            else:
                expected += row
            line += 1
        if command:
            yield start, command, expected


def scratch_clone(top, folder):
    (folder / "run").symlink_to(top / "run")
    ours = shutil.ignore_patterns("*.identify", "*.simulate", "*.check")
    shutil.copytree(top / "examples", folder / "examples", ignore=ours)


def differences(top, page):
    environment = {**os.environ, "LC_ALL": "C.UTF-8", "COLUMNS": "100"}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scratch_clone(top, folder)
        count = 0
        for line, command, expected in steps(page.read_text()):
            count += 1
            done = subprocess.run(command, shell=True, cwd=folder, env=environment, text=True,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, timeout=300, check=False)
            printed = done.stdout.replace(f"{folder}/", "")
            if not doctest.OutputChecker().check_output(expected, printed, RULES):
                yield (f"{page}:{line}: $ {command}--- expected\n{expected}"
                       f"--- printed (exit {done.returncode})\n{printed}")
        print(f"{page.name}: {count} commands")
        if count == 0:
            yield f"{page}:1: no console block, so nothing was checked"


def main():
    top = pathlib.Path(sys.argv[1]).resolve()
    found = [text for page in sys.argv[2:] for text in differences(top, pathlib.Path(page))]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
