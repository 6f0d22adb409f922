"""Whether docs/formats/results.md knows what the program wrote: every key of summary.json
and every column of the CSV files in a folder of results."""
import csv
import json
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/formats/results.md").read_text()
MARKED = re.compile(r"<!-- ([\w ]+): made of .*? -->\n(.*?)<!-- end -->", re.DOTALL)
ROW = re.compile(r"^\| `([^`]+)` \|(?: `([^`]+)` \|)?", re.MULTILINE)


def pattern(name):
    return re.escape(name).replace(r"\*", r"[^.\[\]]+")


def described():
    """{command: (keys, columns)} of the tables that are made of the program, as patterns; of
    columns with their files."""
    out = {}
    for command, text in MARKED.findall(PAGE):
        rows = ROW.findall(text)
        out[command] = ({pattern(a) for a, b in rows if not b},
                        {(pattern(a), re.escape(b).replace(r"\*", ".+")) for a, b in rows if b})
    return out


# Every word in print of a constant width in what is written by hand.
WORDS = set(re.findall(r"\w+", " ".join(re.findall(r"`([^`\n]+)`", MARKED.sub("", PAGE)))))


def paths(value, path=""):
    """All keys below a value: `fits[].runout.angle_deg`."""
    if isinstance(value, dict):
        for key, below in value.items():
            yield (at := f"{path}.{key}" if path else key)
            yield from paths(below, at)
    elif isinstance(value, list):
        for one in value:
            yield from paths(one, path + "[]")


def known(name, patterns):
    return any(re.fullmatch(p, name) for p in patterns)


def undescribed(folder):
    """What one result folder holds and the page does not, in words."""
    summary = json.loads((folder / "summary.json").read_text())
    command = summary["command"]
    if "of" in summary["result"]:
        command += f" of a {summary['result']['of']}"
    keys, columns = described().get(command, (None, None))
    out = set()
    for path in set(paths(summary["result"])):
        last = path.rsplit(".", 1)[-1]
        if not (known(path, keys) if keys is not None else
                last.replace("[]", "") in WORDS or last.startswith(("K_", "radial_offset"))):
            out.add(f"{command}: {path}")
    for file in folder.glob("*.csv"):
        with file.open(newline="") as lines:
            for column in next(csv.reader(lines)):
                if not (known(column, {c for f, c in columns if re.fullmatch(f, file.name)})
                        if columns is not None else
                        set(re.findall(r"\w+", column)) <= WORDS or
                        column.startswith("half_width_")):
                    out.add(f"{command}: column {column} of {file.name}")
    return out
