"""The text of trochoid/dicts.py and trochoid/answers.py in the Python package, made of kinds."""
import re
import textwrap

from answer_kinds import DICTS, SCALARS, class_name

ANSWERS = DICTS.with_name("answers.py")
ESTIMATE = ["value", "se", "low", "high"]
ONE_OF = {"teeth": "tooth", "passes": "pass", "axes": "axis", "quantities": "quantity"}
# Where the last word of a path does not say it.
CALLED = {
    ("identify", "fits[].groups[].covariance.modes[]"): "CovarianceMode",
    ("identify", "fits[].prior.K_*"): "IdentifyPrior",
    ("identify", "clocking.tool"): "IdentifyClockingPart",
    ("stability", "measured_frf.zeroth_order"): "StabilityByFrequency",
    ("calibrate", "answers[]"): "CalibrateOneAnswer",
    ("program", "chatter.lines[]"): "ProgramChatterLine",
    ("program", "walls.lines[]"): "ProgramWallLine",
    ("correct", "before"): "CorrectCut",
    ("correct", "runout.static_fit.chip_difference_um[]"): "CorrectChipDifference",
    ("correct", "axes"): "CorrectAxes",
    ("program", "peaks.peak_xy_N"): "ProgramPeak",
    ("program", "feed.before"): "ProgramTotals",
    ("program", "walls.most"): "ProgramWallError",
    ("plan of a wall", "chosen"): "PlanOfWallDesign",
    ("plan of a wall", "cutting.stated"): "PlanOfWallCut",
}
MADE = "Made by tests/golden/answer_types_test.py --renew"

DICTS_HEAD = f'''"""Types of ``to_dict()`` of an answer, for editors and type checkers.

A key that is NotRequired is not in every answer. None: the number cannot be known.
The types hold for answers with ``ok``; one without may lack keys and numbers.
{MADE}: it keeps the types that stand here.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any, Optional, TypedDict, Union

if sys.version_info >= (3, 11):
    from typing import NotRequired
elif TYPE_CHECKING:
    from typing_extensions import NotRequired
'''

ANSWERS_HEAD = f'''"""Types of answers, for editors and type checkers: every key, its type and its meaning.

The types hold for answers with ``ok``; one without may lack keys and numbers. When a program
runs, an answer is of its class here, and every object in it is ``Values``.
{MADE} from docs/formats/results.md and dicts.py.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Generic, Optional, TypeVar, Union

from ._answer import Answer, Values

if TYPE_CHECKING:
    from . import dicts

T = TypeVar("T")


class Named(Values, Generic[T]):
    """Values of one type; the case decides how they are called."""

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> T: ...

        def __getitem__(self, key: str) -> T: ...
'''


def add(into, kind):
    """All that one kind allows, to another one of the same keys."""
    into.null |= kind.null
    into.required &= kind.required
    into.scalars |= kind.scalars
    if float in into.scalars:
        into.scalars.discard(int)
    if kind.item:
        add(into.below(1), kind.item)
    for key, one in kind.keys.items():
        add(into.keys[key], one)
    for key in kind.spelled:
        into.learn_key(key)


def shape(kind):
    """Objects of one shape have one class; () of what is none."""
    if list(kind.keys) == ESTIMATE:
        return "an estimate"
    if kind.item:
        return shape(kind.item)
    return tuple((key, one.meaning, shape(one)) for key, one in kind.keys.items())


def share(kinds):
    """Let objects of one shape be one, which allows what any of them does."""
    first = {}
    for root in kinds:
        for _, kind in list(root.parts()):
            same = first.setdefault(shape(kind), kind) if kind.keys else kind
            if same.keys is not kind.keys:
                add_keys(same, kind)
                kind.keys, kind.spelled = same.keys, same.spelled


def add_keys(into, kind):
    """The same of what stands below alone."""
    null, required = into.null, into.required
    add(into, kind)
    into.null, into.required = null, required


def word(key, listed):
    """`fits` of a list: Fit."""
    one = ONE_OF.get(key, key[:-1] if key.endswith("s") and listed else key)
    return "".join(part[:1].upper() + part[1:] for part in one.replace("*", "").split("_"))


def words(path):
    """`fits[].resonances.*`: Fit, Resonance."""
    parts = path.split(".")
    return [word(part.replace("[]", ""), "[]" in part or following == "*")
            for part, following in zip(parts, [*parts[1:], ""]) if part != "*"]


def class_names(all_of):
    """{id of its keys: (name, kind, [(command, path)])}, in the order of the page."""
    places = {}
    for command, (root, _) in all_of.items():
        for path, kind in root.parts():
            if kind.keys and not kind.named:
                places.setdefault(id(kind.keys), (kind, []))[1].append((command, path))
    taken = {}
    for key, (kind, at) in places.items():
        taken[key] = name_of(kind, at, {name for name, _, _ in taken.values()}), kind, at
    return taken


def name_of(kind, at, taken):
    command, path = at[0]
    before = class_name(command)
    if at[0] in CALLED or not path:
        return CALLED.get(at[0], before)
    if list(kind.keys) == ESTIMATE:
        return "Estimate"
    if len({c for c, _ in at}) > 1:
        before = ""
    every = words(path)
    return next(name for n in range(len(every)) if
                (name := before + "".join(every[-1 - n:])) not in taken)


def type_text(kind, names, list_of, named):
    """`Optional[list[float]]`"""
    forms = [one.__name__ for one in SCALARS if one in kind.scalars]
    if kind.item:
        forms.append(list_of.format(type_text(kind.item, names, list_of, named)))
    if kind.named:
        forms.append(named.format(type_text(kind.named, names, list_of, named)))
    elif kind.keys:
        forms.append(names[id(kind.keys)][0])
    text = f"Union[{', '.join(forms)}]" if len(forms) > 1 else (forms or ["Any"])[0]
    return f"Optional[{text}]" if kind.null and forms else text


def docstring(text, indent="    "):
    text = text.replace("\\|", "|")
    text = text + " " if text.endswith('"') else text
    return "\n".join(textwrap.wrap(f'"""{text}"""', 96, initial_indent=indent,
                                   subsequent_indent=indent, break_on_hyphens=False,
                                   break_long_words=False))


def dicts_text(all_of):
    names = class_names(all_of)
    out = [DICTS_HEAD]
    for name, kind, _ in ordered(names):
        out.append(f"\n\nclass {name}(TypedDict):\n")
        for key, one, required in kind.members():
            text = type_text(one, names, "list[{}]", "dict[str, {}]")
            out.append(f"    {key}: {text if required else f'NotRequired[{text}]'}\n")
    return "".join(out)


def ordered(names):
    """Those of several commands first."""
    several = [n for n in names.values() if len({c for c, _ in n[2]}) > 1]
    return several + [n for n in names.values() if n not in several]


def of_answer():
    """What an answer has that is no key."""
    text = (ANSWERS.with_name("_answer.py")).read_text().partition("\nclass Answer:")[2]
    return set(re.findall(r"^    def (\w+)", text, re.MULTILINE))


def answers_text(all_of):
    names = class_names(all_of)
    out = [ANSWERS_HEAD]
    for name, kind, at in ordered(names):
        root = not at[0][1]
        out.append(f"\n\nclass {name}{'Answer(Answer)' if root else '(Values)'}:\n")
        out.append(of_tables(at[0][0], all_of[at[0][0]][1]) if root
                   else docstring(what_it_is(kind, at, all_of)) + "\n\n")
        for key, one, required in kind.members():
            if root and key in of_answer():
                continue
            text = type_text(one, names, "tuple[{}, ...]", "Named[{}]")
            rest = "" if required else " (not in every answer)"
            out.append(f"    {key}: {text}\n{docstring(one.meaning + rest)}\n")
        if root:
            out.append("\n    __slots__ = ()\n")
            out.append(f"\n    if TYPE_CHECKING:\n\n        def to_dict(self) -> dicts.{name}: ..."
                       "  # type: ignore[override]\n")
    out.append("\n\n#: by command, as docs/formats/results.md calls it\n"
               "BY_COMMAND: dict[str, type[Answer]] = {\n")
    out += [f'    "{command}": {class_name(command)}Answer,\n' for command in all_of]
    return "".join(out) + "}\n"


def what_it_is(kind, at, all_of):
    if list(kind.keys) == ESTIMATE:
        return "a number that was found, with its 95 % interval"
    command, path = min(at, key=lambda place: len(place[1]))
    return dict(all_of[command][0].parts())[path].meaning or path


def of_tables(command, tables):
    lines = [f"    Of ``{command}``. Tables:", ""]
    for table, columns in tables.items():
        lines += textwrap.wrap(f"``{table}``: {', '.join(dict.fromkeys(columns))}", 96,
                               initial_indent="    ", subsequent_indent="      ",
                               break_on_hyphens=False)
    return '    """' + "\n".join(lines).strip() + '\n    """\n\n'


def texts(all_of):
    """{file: its text}"""
    share(root for root, _ in all_of.values())
    out = {DICTS: dicts_text(all_of), ANSWERS: answers_text(all_of)}
    return {file: text if text.count("Any") > 1 else text.replace(" Any,", "")
            for file, text in out.items()}
