#!/usr/bin/env python3
"""Check that every room includes lower rooms only, as the table of ARCHITECTURE.md says.

Usage: check_layers.py [REPOSITORY]. Each violation is printed as file:line: reason.
"""
import pathlib
import re
import sys

# Beyond the ranks: the report computes nothing, it shows what a result folder holds.
ONLY = {"report": {"base", "results"}}
# The decompositions of Eigen take longest: plain functions of this room give them, and one
# file beside it has the sparse one.
EIGEN = re.compile(r"(unsupported/)?Eigen/")
EIGEN_AT = ("numerics/", "structure/ritz.cpp")
# Headers that are slow to compile stay in .cpp files.
HEAVY = re.compile(r"toml\+\+/|nlohmann/(?!json_fwd)|CLI/|boost/|Eigen/")

ROW = re.compile(r"^\|\s*(\d+)\s*\|([^|]*)\|")
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:<([^>]*)>|"([^"]*)")')


def ranks(page):
    """Rank of each room, from the rows `| rank | room, room | ... |` of a page."""
    found = {}
    for line in page.read_text().splitlines():
        row = ROW.match(line)
        for room in re.findall(r"\w+", row[2]) if row else []:
            found[room] = int(row[1])
    return found


def problem(file, room, target, quoted, rank):
    """Why a file of this room may not include the target, or None."""
    if quoted:  # a private header of the same folder, or a way round the ranks
        return None if "/" not in target else f'"{target}": include it as <trochoid/...>'
    if file.suffix == ".h" and HEAVY.match(target):
        return f"<{target}> is slow to compile: only in .cpp files"
    if EIGEN.match(target) and not f"{room}/{file.name}".startswith(EIGEN_AT):
        return f"<{target}> is slow to compile: call numerics/dense.h or least_squares.h"
    parts = target.split("/")
    if parts[0] != "trochoid" or parts[1] == room:
        return None
    other = parts[1]
    if other not in rank:
        return f"{other} is not a room of ARCHITECTURE.md"
    if rank[other] >= rank[room]:
        return f"{room} (rank {rank[room]}) may not include {other} (rank {rank[other]})"
    if other not in ONLY.get(room, rank):
        return f"{room} may include {' and '.join(sorted(ONLY[room]))} only, not {other}"
    return None


def violations(top):
    rank = ranks(top / "ARCHITECTURE.md")
    source = top / "src/trochoid"
    for folder in sorted(f for f in source.iterdir() if f.is_dir()):
        if folder.name not in rank:
            yield f"{folder}:1: {folder.name} is not a room of ARCHITECTURE.md"
    for file in sorted(source.rglob("*")):
        room = file.relative_to(source).parts[0]
        if file.suffix not in (".h", ".cpp") or room not in rank:
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            include = INCLUDE.match(line)
            if not include:
                continue
            target = include[1] or include[2]
            why = problem(file, room, target, include[1] is None, rank)
            if why:
                yield f"{file}:{number}: {why}"


def main():
    top = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    found = list(violations(top))
    print("\n".join(found) or "layers ok")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
