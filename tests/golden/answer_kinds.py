"""What may stand under each key of an answer: read from the types of the Python package
(trochoid/dicts.py), learnt from answers, compared with them.

Keys, their order and meaning are those of docs/formats/results.md. That page has no types.
"""
import importlib.util
import re
import sys
import types
import typing

import described

DICTS = described.ROOT / "src/trochoid/python/trochoid/dicts.py"
KEY = re.compile(r"^\| `([^`]+)` \| (?!`[^`]+` \| )(.*) \|$", re.MULTILINE)
COLUMN = re.compile(r"^\| `([^`]+)\.csv` \| `([^`]+)` \| ", re.MULTILINE)
SCALARS = (bool, int, float, str)
UNITS = tuple(re.findall(r'\{"(_\w+)", \{', (
    described.ROOT / "src/trochoid/base/unit_of_key.cpp").read_text()))


class Kind:
    """What may stand in one place."""

    def __init__(self, meaning=""):
        self.meaning = meaning
        self.required = True  # always there, where it is a key
        self.null = False
        self.scalars = set()  # of SCALARS
        self.item = None  # of a list: each entry
        self.keys = {}  # of an object; `*` is a word that depends on the case
        self.spelled = {}  # keys in place of those with `*`, beside others without

    @property
    def named(self):
        """The kind under all keys, where the case decides how all are called."""
        (key, kind), *others = self.keys.items() if self.keys else [("", None)]
        return kind if "*" in key and not others else None

    def members(self):
        """(key, kind, whether it is always there)"""
        for key, kind in self.keys.items():
            if "*" not in key:
                yield key, kind, kind.required
        for key, kind in sorted(self.spelled.items()):
            yield key, kind, False

    def at(self, key):
        """The kind under a key; None: the types do not have it."""
        if "*" not in key and key in self.keys:
            return self.keys[key]
        return self.spelled.get(key) or (self.named if self.pattern_of(key) else None)

    def learn_key(self, key):
        """The same, and a key that the page has with `*` is one from now on."""
        pattern = self.pattern_of(key)
        if self.at(key) is None and pattern:
            self.spelled[key] = self.keys[pattern]
        return self.at(key)

    def pattern_of(self, key):
        return next((one for one in self.keys
                     if "*" in one and re.fullmatch(described.pattern(one), key)), None)

    def below(self, depth):
        """What stands in a list of lists ... of this."""
        for _ in range(depth):
            self.item = self.item or Kind(self.meaning)
            self = self.item
        return self

    def unknown(self):
        return not (self.scalars or self.item or self.keys)

    def parts(self, path=""):
        """(path, kind) of this and all below."""
        yield path, self
        if self.item:
            yield from self.item.parts(path + "[]")
        for key, kind in self.keys.items():
            yield from kind.parts(f"{path}.{key}" if path else key)


def of_page():
    """{command: (kind of its result, {table: columns})}, without types."""
    out = {}
    for command, text in described.MARKED.findall(described.PAGE):
        root = Kind()
        for path, meaning in KEY.findall(text):
            at = root
            for part in path.split("."):
                name = part.replace("[]", "")
                kind = at.keys.setdefault(name, Kind())
                at = kind.below(part.count("[]"))
            kind.meaning = kind.meaning or meaning
        tables = {}
        for table, column in COLUMN.findall(text):
            tables.setdefault(table, []).append(column)
        out[command] = root, tables
    return out


def class_name(command):
    """Of a command's result in dicts.py."""
    return "".join(word.capitalize() for word in command.split() if word not in ("a",))


def learn_type(kind, hint):
    """Add a type as dicts.py has it."""
    origin, inside = typing.get_origin(hint), typing.get_args(hint)
    if hint is type(None):
        kind.null = True
    elif hint in SCALARS:
        kind.scalars.add(hint)
    elif origin in (typing.Union, types.UnionType):
        for one in inside:
            learn_type(kind, one)
    elif origin is list:
        learn_type(kind.below(1), inside[0])
    elif origin is dict and kind.named:
        learn_type(kind.named, inside[1])
    elif typing.is_typeddict(hint):
        for key, one in typing.get_type_hints(hint, include_extras=True).items():
            if (member := kind.learn_key(key)) is None:
                continue
            if typing.get_origin(one) is typing.NotRequired:
                member.required = False
                one = typing.get_args(one)[0]
            learn_type(member, one)


def with_types(file=DICTS):
    """The same as of_page, with the types of dicts.py."""
    place = importlib.util.spec_from_file_location("dicts_of_answers", file)
    module = importlib.util.module_from_spec(place)
    sys.modules[place.name] = module  # where typing looks for names
    place.loader.exec_module(module)
    all_of = of_page()
    for command, (root, _) in all_of.items():
        if hasattr(module, class_name(command)):
            learn_type(root, getattr(module, class_name(command)))
    return all_of


def learn(kind, value, ok=True, key=""):
    """Add what an answer has. Of one that failed, what is missing tells nothing."""
    if value is None:
        kind.null |= ok
    elif isinstance(value, list):
        for one in value:
            learn(kind.below(1), one, ok, key)
    elif isinstance(value, dict):
        for name, one in value.items():
            if member := kind.learn_key(name):
                learn(member, one, ok, name)
        for name, one in kind.keys.items():
            if ok and name not in value:
                one.required = False
    else:
        # summary.json shows 1.0 as 1. What has a unit is no whole number.
        whole = type(value) is int and (float in kind.scalars or key.endswith(UNITS))
        kind.scalars.add(float if whole else type(value))
        if float in kind.scalars:
            kind.scalars.discard(int)


def fits(kind, value, ok=True, path=""):
    """Where an answer is not as the types have it: "fits[].rank: 3.5"."""
    if value is None:
        if ok and not kind.null:
            yield f"{path}: null"
    elif isinstance(value, list):
        for one in value if kind.item else ():
            yield from fits(kind.item, one, ok, path + "[]")
        if not kind.item:
            yield f"{path}: a list"
    elif isinstance(value, dict):
        if not kind.keys:
            yield f"{path}: an object"
            return
        for key, one in value.items():
            at = f"{path}.{key}" if path else key
            member = kind.at(key)
            yield from fits(member, one, ok, at) if member else [f"{at}: no such key"]
        for key, _, required in kind.members():
            if ok and required and key not in value:
                yield f"{path}: without {key}"
    elif type(value) not in kind.scalars and not (type(value) is int and float in kind.scalars):
        yield f"{path}: {value!r}"


def described_as(command, result):
    """As the page calls it: `plan of a wall` has its own tables."""
    return f"{command} of a {result['of']}" if "of" in result else command


def unlike(all_of, command, result, ok):
    """What of an answer is not as the types have it, in words."""
    command = described_as(command, result)
    return sorted({f"{command}: {what}" for what in fits(all_of[command][0], result, ok)})
