#!/usr/bin/env python3
"""Check that each equation stands in three places under one id, and in no place alone.

    docs/theory/*.md          \\tag{F-1}   written, once
    src/trochoid/**           @eq F-1      coded: where a header declares it, or in the source
                                           that keeps it to itself
    tests/**                  [F-1]        tested

The id proves presence; the tests prove the value.
Usage: check_equations.py [REPOSITORY]. Each gap is printed as file:line: reason.
"""
import collections
import pathlib
import re
import sys

TEST_FILES = {".cpp", ".h", ".py", ".mjs", ".js", ".toml", ".md", ".json"}


def places(top, folder, suffixes, pattern):
    """id -> the places file:line where the pattern names it."""
    found = collections.defaultdict(list)
    for file in sorted((top / folder).rglob("*")):
        if file.suffix not in suffixes or "node_modules" in file.parts:
            continue
        for number, line in enumerate(file.read_text(errors="replace").splitlines(), 1):
            for name in re.findall(pattern, line):
                found[name].append(f"{file}:{number}")
    return found


def gaps(top):
    identifier = r"([A-Z]+-\d+[a-z]?)"
    written = places(top, "docs/theory", {".md"}, r"\\tag\{" + identifier + r"\}")
    declared = places(top, "src/trochoid", {".h"}, r"@eq\s+" + identifier)
    own = places(top, "src/trochoid", {".cpp"}, r"@eq\s+" + identifier)
    coded = {**own, **declared}
    tested = places(top, "tests", TEST_FILES, r"\[" + identifier + r"\]")
    for name, where in sorted(written.items()):
        for again in where[1:]:
            yield f"{again}: {name} is already written at {where[0]}"
        if name not in coded:
            yield f"{where[0]}: {name} is not coded (no '@eq {name}' in src)"
        if name not in tested:
            yield f"{where[0]}: {name} is not tested (no '[{name}]' in tests)"
    for name, where in sorted(coded.items()):
        if name not in written:
            yield f"{where[0]}: {name} is not written in docs/theory"
    for name, where in sorted(own.items()):
        if name in declared:
            yield f"{where[0]}: '@eq {name}' belongs in the header, where it stands too"
    # An array index such as [N-1] is no equation: only families that the theory has.
    families = {name.split("-")[0] for name in written}
    for name, where in sorted(tested.items()):
        if name not in written and name.split("-")[0] in families:
            yield f"{where[0]}: {name} is tested but not written in docs/theory"


def main():
    top = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    found = list(gaps(top))
    count = len(places(top, "docs/theory", {".md"}, r"\\tag\{()"))
    if not found and not count:
        found = [f"{top}/docs/theory: no equation found, so nothing was checked"]
    print("\n".join(found) or "equations ok")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
