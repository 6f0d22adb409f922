#!/usr/bin/env python3
"""Check that every source that is cited is in docs/references.md, and every one there cited.

    docs/references.md        **[key]** at the start of a line: listed, once
    src/trochoid/**/*.h,cpp   @src [key] ...; without a key it says "derived", "chosen",
                              "definition", "elementary", or the id of an equation
    docs, tests, examples     [key]: listed too

Nothing may speak of the documents that the project was planned with: they are not here.
Usage: check_references.py [REPOSITORY]. Each gap is printed as file:line: reason.
"""
import collections
import pathlib
import re
import sys

LIST = "docs/references.md"
FOLDERS = ("src", "docs", "tests", "linuxcnc", "examples")
SUFFIXES = {".h", ".cpp", ".c", ".comp", ".py", ".md", ".js", ".mjs", ".toml", ".hal"}

LISTED = re.compile(r"^\*\*\[([a-z]+\d{4}[a-z]?)\]\*\*")
CITED = re.compile(r"\[([a-z]+\d{4}[a-z]?)\](?!\()")
ORIGIN = re.compile(r"\b(derived|chosen|definition|elementary|standard)\b|\b[A-Z]+-\d+")
ABSENT = re.compile(r"\bDESIGN\b|(?<![A-Za-z_])[Ss]pecs?(?![A-Za-z_])|(?<=[a-z])Spec(?=[A-Z(])")


def lines(top):
    """(file, number, line) of everything that may cite."""
    for folder in FOLDERS:
        for file in sorted((top / folder).rglob("*")):
            if file.suffix not in SUFFIXES or "node_modules" in file.parts:
                continue
            for number, line in enumerate(file.read_text(errors="replace").splitlines(), 1):
                yield file, number, line


def origins(top):
    """(file, number, text) of each @src with the lines that continue it."""
    for file in sorted((top / "src/trochoid").rglob("*")):
        if file.suffix not in (".h", ".cpp"):
            continue
        text = file.read_text(errors="replace").splitlines()
        for number, line in enumerate(text, 1):
            if "@src" not in line:
                continue
            said = line.split("@src", 1)[1]
            for more in text[number:]:
                go_on = re.match(r"\s*///\s+(?!@)(\S.*)", more)
                if not go_on:
                    break
                said += " " + go_on[1]
            yield file, number, said


def gaps(top):
    page = top / LIST
    listed = {}
    for number, line in enumerate(page.read_text().splitlines() if page.exists() else [], 1):
        entry = LISTED.match(line)
        if entry and entry[1] in listed:
            yield f"{page}:{number}: [{entry[1]}] is already listed in line {listed[entry[1]]}"
        elif entry:
            listed[entry[1]] = number
    cited = collections.defaultdict(list)
    for file, number, line in lines(top):
        for key in CITED.findall(line) if file != page else []:
            cited[key].append(f"{file}:{number}")
        absent = ABSENT.search(line)
        if absent:
            yield f"{file}:{number}: '{absent[0]}' is a document that is not here"
    for file, number, said in origins(top):
        if not CITED.search(said) and not ORIGIN.search(said):
            yield f"{file}:{number}: @src names no [key] and no origin:{said}"
    for key, where in sorted(cited.items()):
        if key not in listed:
            yield f"{where[0]}: [{key}] is not in {LIST}"
    for key, number in listed.items():
        if key not in cited:
            yield f"{page}:{number}: nothing cites [{key}]"
    if not listed:
        yield f"{page}: no reference found, so nothing was checked"


def main():
    top = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    found = list(gaps(top))
    print("\n".join(found) or "references ok")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
