#!/usr/bin/env python3
"""Check that files, functions and lists of parameters stay short enough to be read, and that
not too many files are so short that an idea is spread over several of them.

Usage: check_sizes.py [REPOSITORY]. Each violation is printed as file:line: reason, and
files above the length that is aimed at as notes, which do not fail. Needs universal-ctags.
"""
import json
import pathlib
import re
import subprocess
import sys

FOLDERS = ("src", "tests", "benchmarks", "linuxcnc", "tools")
TEXT = {".cpp", ".h", ".c", ".comp", ".py", ".js", ".mjs", ".css", ".sh", ".cmake"}
AIM, HEADER, MOST = 400, 250, 600  # lines of a file
# A source or header below LEAST lines belongs to its neighbour of the same idea. So many still
# stand alone, each for a reason (a type that many rooms share, a case of a variant). The number
# falls; only a new law, command or reader may raise it, by its own files.
LEAST, SHORT = 40, 224
# Functions of what is released and measured; a test may be one long table.
CODE = ("src", "benchmarks", "linuxcnc")
LINES, PARAMETERS = 60, 5
# One parameter more where a comment right above the definition says why, in these words.
SIX = re.compile(r"six parameters: \S")

# What may be longer: file, or file:function, and why.
KEYS = "a table of the keys of an answer, one after the other"
MAY = {f"src/trochoid/results/{file}.cpp:{name}_fields": KEYS for file, name in (
    ("calibrate", "calibrate"), ("identify", "identified"), ("dynamics", "motion"),
    ("stability", "stability"))}
MAY |= {f"src/trochoid/python/trochoid/{file}.py": "made: a type for each key of each answer"
        for file in ("answers", "dicts")}


def code_files(top, folders, suffixes):
    for folder in folders:
        yield from sorted(f for f in (top / folder).rglob("*") if f.suffix in suffixes)


def long_files(top):
    """(file, line, reason, whether it is a note only)"""
    for file in code_files(top, FOLDERS, TEXT):
        lines = len(file.read_text().splitlines())
        most = HEADER if file.suffix == ".h" else MOST
        if lines > most:
            yield file, lines, f"{lines} lines, more than {most}", False
        elif lines > AIM and "tests" not in file.relative_to(top).parts:
            yield file, lines, f"{lines} lines, more than the {AIM} aimed at", True


def short_files(top):
    """(how many there are, the shortest of them)"""
    lengths = [(len(f.read_text().splitlines()), f) for f in code_files(top, ("src",), {".cpp", ".h"})]
    short = sorted(pair for pair in lengths if pair[0] < LEAST)
    return len(short), short[0] if short else None


def functions(files):
    """What ctags finds: path, name, line, end and signature of every function and lambda."""
    answer = subprocess.run(
        ["ctags", "--languages=C++", "--langmap=C++:.cpp.h.c", "--kinds-C++=f", "--fields=+neS",
         "--output-format=json", "-f", "-", "-L", "-"],
        input="\n".join(map(str, files)), capture_output=True, text=True, check=True)
    return [json.loads(line) for line in answer.stdout.splitlines()]


def parameters(signature):
    """How many there are in (int a, std::pair<int, int> b)"""
    inner = signature[signature.index("(") + 1:signature.rindex(")")].strip()
    depth, count = 0, 0 if inner in ("", "void") else 1
    for c in inner:
        depth += (c in "(<[{") - (c in ")>]}")
        count += c == "," and depth == 0
    return count


def comment_above(lines, number):
    """The comment that ends right above a line, template heads passed over."""
    found = []
    for line in reversed(lines[:number - 1]):
        text = line.strip()
        if not text.startswith(("//", "template", "requires", "/*", "*")):
            break
        found.append(text)
    return " ".join(reversed(found))


def long_functions(top):
    for tag in functions(code_files(top, CODE, {".cpp", ".h", ".c"})):
        file, line, name = pathlib.Path(tag["path"]), tag["line"], tag["name"]
        lines = tag["end"] - line + 1
        if lines > LINES:
            yield file, line, name, f"{name} has {lines} lines, more than {LINES}"
        count = parameters(tag.get("signature", "()"))
        if count <= PARAMETERS:
            continue
        why = comment_above(file.read_text().splitlines(), line)
        if count > PARAMETERS + 1 or not SIX.search(why):
            yield file, line, name, f"{name} has {count} parameters, more than {PARAMETERS}"


def violations(top, notes=None):
    used = set()

    def allowed(key):
        used.add(key)
        return key in MAY

    for file, line, why, note in long_files(top):
        if note:
            if notes is not None:
                notes.append(f"note: {file}: {why}")
        elif not allowed(str(file.relative_to(top))):
            yield f"{file}:{line}: {why}"
    count, shortest = short_files(top)
    if count > SHORT:
        lines, file = shortest
        yield (f"{file}:{lines}: {count} files of src have less than {LEAST} lines, more than "
               f"the {SHORT} of before: join one with its neighbour")
    elif count < SHORT and notes is not None:
        notes.append(f"note: {count} files have less than {LEAST} lines: SHORT can be that")
    for file, line, name, why in long_functions(top):
        if not allowed(f"{file.relative_to(top)}:{name}"):
            yield f"{file}:{line}: {why}"
    for key in sorted(set(MAY) - used):
        if (top / key.split(":")[0]).exists():
            yield f"{key}: is short enough now, and needs no exception"


def main():
    top = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    notes = []
    found = list(violations(top, notes))
    print("\n".join(notes + (found or ["sizes ok"])))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
