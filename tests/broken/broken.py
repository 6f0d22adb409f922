#!/usr/bin/python3
"""The broken files of the tables beside this file, and the message that each must give.

    broken.py KIND FOLDER           write the broken files of a kind, each with NAME.expected
    broken.py --renew BUILD         write into the tables what the test of this build says

A table, KIND/NAME.txt, has sound files to start from and what is broken in them:

    == base slot                    up to the next "==": a sound file
    [tool]
    teeth = 2

    == teeth_below_one.toml: slot   a broken file and its base; without one it is empty at first
    # Why, where it is not plain.
     [tool]                         go on to behind the next line that reads so
    -teeth = 2                      go on to the next line that reads so, and leave it out
    +teeth = -1                     put in this line
    ! 2:9: tool.teeth = -1: out of range ...    the message; "2:9: " is of this file

A line "\\" leaves out the end of the last line. A file whose bytes no table can hold stands in
KIND/ itself, and its section has the message alone. KIND/parts/ lies beside all.
"""
import argparse
import json
import pathlib
import re
import shutil
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
KINDS = ("case", "program", "record", "surface")
OF_THIS_FILE = re.compile(r"\d+:\d+: ")


def tables(kind):
    return [file for file in sorted((HERE / kind).glob("*.txt")) if file.name != "CMakeLists.txt"]


def sections(table):
    """[head, lines] in their order; what stands before the first has no head"""
    out = [[None, []]]
    for line in table.read_text(encoding="utf-8").split("\n")[:-1]:
        if line.startswith("== "):
            out.append([line[3:], []])
        else:
            out[-1][1].append(line)
    return out


def changed(base, lines):
    """the text of a base after the changes of a section"""
    text, at, end = list(base), 0, "\n"
    for line in lines:
        mark, rest = line[:1], line[1:]
        if mark == "+":
            text.insert(at, rest)
            at += 1
        elif mark == "\\":
            end = ""
        elif mark == "-":
            at = text.index(rest, at)
            del text[at]
        elif mark == " ":
            at = text.index(rest, at) + 1
        elif mark not in ("", "#", "!"):
            raise ValueError(f"starts with none of the marks: {line}")
    return "\n".join(text) + end if text else ""


def message(name, lines):
    said = [line[2:] for line in lines if line.startswith("! ")]
    return "".join((f"{name}:" if OF_THIS_FILE.match(line) else "") + line + "\n" for line in said)


def broken_files(kind):
    """name -> (bytes, message) of every broken file of a kind"""
    out, bases = {}, {}
    for table in tables(kind):
        for head, lines in sections(table)[1:]:
            if head.startswith("base "):
                bases[head[5:]] = "\n".join(lines).rstrip("\n").split("\n")
    for table in tables(kind):
        for head, lines in sections(table)[1:]:
            name, _, base = head.partition(": ")
            if head.startswith("base "):
                continue
            if name in out:
                raise ValueError(f"{table}: {name} is there already")
            try:
                file = HERE / kind / name
                content = (file.read_bytes() if file.exists()
                           else changed(bases[base] if base else [], lines).encode())
            except (KeyError, ValueError) as error:
                raise ValueError(f"{table}: {name}: {error}") from None
            out[name] = content, message(name, lines)
    return out


def write(kind, folder):
    """the files, nothing else; what has not changed keeps its time"""
    folder.mkdir(parents=True, exist_ok=True)
    files = {}
    for name, (content, said) in broken_files(kind).items():
        files[name] = content
        files[str(pathlib.Path(name).with_suffix(".expected"))] = said.encode()
    for part in (HERE / kind).glob("parts/*"):
        files[f"parts/{part.name}"] = part.read_bytes()
    for old in folder.rglob("*"):
        if old.is_file() and str(old.relative_to(folder)) not in files:
            old.unlink()
    for name, content in files.items():
        file = folder / name
        file.parent.mkdir(exist_ok=True)
        if not file.exists() or file.read_bytes() != content:
            file.write_bytes(content)


def said_by(build):
    """name without its ending -> what the test of this build was told, by kind"""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        subprocess.run([build / "tests/broken/broken_test", f"--gtest_output=json:{report}"],
                       stdout=subprocess.DEVNULL, check=False)
        suites = json.loads(report.read_text())["testsuites"]
    out = {kind: {} for kind in KINDS}
    for suite in suites:
        for test in suite["testsuite"]:
            if "said" in test:
                out[test["kind"]][test["name"].split("/")[-1]] = test["said"]
    return out


def renew(build):
    for kind, said in said_by(build).items():
        for table in tables(kind):
            text = ""
            for head, lines in sections(table):
                name = (head or "").partition(": ")[0]
                if pathlib.Path(name).stem in said and not name.startswith("base "):
                    lines = [line for line in lines if not line.startswith("! ")]
                    while lines and not lines[-1]:
                        lines.pop()
                    for line in said[pathlib.Path(name).stem].splitlines():
                        short = line.removeprefix(f"{name}:")
                        lines.append("! " + (short if OF_THIS_FILE.match(short) else line))
                    lines.append("")
                text += (f"== {head}\n" if head else "") + "".join(f"{x}\n" for x in lines)
            text = text.rstrip("\n") + "\n"
            if text != table.read_text(encoding="utf-8"):
                table.write_text(text, encoding="utf-8")
                print(f"{table.relative_to(HERE)} is renewed")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("kind", nargs="?", choices=KINDS)
    parser.add_argument("folder", nargs="?", type=pathlib.Path)
    parser.add_argument("--renew", type=pathlib.Path, metavar="BUILD")
    given = parser.parse_args()
    if given.renew:
        renew(given.renew)
    elif given.folder:
        shutil.rmtree(given.folder / "parts", ignore_errors=True)
        write(given.kind, given.folder)
    else:
        parser.error("a kind and a folder, or --renew BUILD")


if __name__ == "__main__":
    main()
