#!/usr/bin/env python3
"""Run the console blocks of README.md, docs/guide and examples, compare what they print.

In a block ```console, lines after `$ ` are commands (a trailing backslash continues them),
all others are their output; `...` stands for anything. The commands of one page share one
scratch folder, which holds ./run and the examples as a clone has them.
Usage: transcripts.py [--renew] REPOSITORY
--renew writes what is printed now into the pages, for you to read before you commit it.
"""
import doctest
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "reference"))
import program  # noqa: E402

BLOCK = re.compile(r"^```console\n(.*?)^```", re.DOTALL | re.MULTILINE)
STEP = re.compile(r"^\$ ((?:.*\\\n)*.*\n)((?:(?!\$ ).*\n)*)", re.MULTILINE)
RULES = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def scratch_clone(top, folder):
    (folder / "run").symlink_to(top / "run")
    ours = shutil.ignore_patterns("*.identify", "*.simulate", "*.check",
                                  "*.surface", "*.calibrate", "*.stability", "*.modes",
                                  "*.actuator", "*.dynamics", "*.correct", "*.plan", "*.program",
                                  "*.sweep")
    shutil.copytree(top / "examples", folder / "examples", ignore=ours)


def output(command, folder):
    environment = {**os.environ, "LC_ALL": "C.UTF-8", "COLUMNS": "100"}
    done = subprocess.run(command, shell=True, cwd=folder, env=environment, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=1200, check=False)
    return program.PROGRESS.sub("", done.stdout).replace(f"{folder}/", "")


def differences(top, page, renew):
    text = page.read_text()
    changes = []
    count = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scratch_clone(top, folder)
        for block in BLOCK.finditer(text):
            for step in STEP.finditer(text, block.start(1), block.end(1)):
                count += 1
                printed = output(step[1], folder)
                if doctest.OutputChecker().check_output(step[2], printed, RULES):
                    continue
                line = text.count("\n", 0, step.start()) + 1
                yield (f"{page}:{line}: $ {step[1]}--- the page says\n{step[2]}"
                       f"--- printed\n{printed}")
                changes.append((step.start(2), step.end(2), printed))
    print(f"{page.relative_to(top)}: {count} commands")
    if count == 0:
        yield f"{page}:1: no console block, so nothing was checked"
    for start, end, printed in reversed(changes if renew else []):
        text = text[:start] + printed + text[end:]
        page.write_text(text)


def main():
    top = pathlib.Path(sys.argv[-1]).resolve()
    pages = [top / "README.md"]
    more = [*sorted(top.glob("docs/guide/*.md")), *sorted(top.glob("examples/*/README.md"))]
    pages += [page for page in more if BLOCK.search(page.read_text())]
    found = [text for page in pages for text in differences(top, page, "--renew" in sys.argv)]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
