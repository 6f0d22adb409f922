"""What goes wrong: the input, all of it at once; and what an answer warns of."""

from __future__ import annotations

import re
from typing import NamedTuple, Optional, Sequence

_PLACED = re.compile(r"(?s)(?P<file>.*?):(?P<line>\d+):(?P<column>\d+): (?P<message>.*)")
_GIVEN = re.compile(r"(?s)case: (?P<message>.*)")
_PATH = r"[A-Za-z_][\w-]*(?:\[\d+\])?(?:\.[\w-]+(?:\[\d+\])?)*"
_KEY = re.compile(
    rf"\[+(?P<table>{_PATH})\]+|(?P<key>{_PATH})(?: = | is missing)|(?P<path>{_PATH}): "
)


def _key_of(message: str) -> Optional[str]:
    match = _KEY.match(message)
    if match is None:
        return None
    return match["table"] or match["key"] or match["path"]


class Problem(NamedTuple):
    """One thing that is wrong."""

    file: Optional[str]  #: where it stands; None for what a program gave
    line: Optional[int]  #: from 1
    column: Optional[int]  #: from 1
    key: Optional[str]  #: path of the key: ``tool.teeth``, ``measurement[1].file``
    message: str  #: ``key = value: why, what would be right``


def problem_of(text: str) -> Problem:
    """A line ``file:line:column: message`` or ``case: message`` in its parts."""
    placed = _PLACED.fullmatch(text)
    given = None if placed else _GIVEN.fullmatch(text)
    match = placed or given
    message = match["message"] if match else text
    return Problem(
        file=placed["file"] if placed else None,
        line=int(placed["line"]) if placed else None,
        column=int(placed["column"]) if placed else None,
        # What has no place at all begins with the name of a record.
        key=_key_of(message) if match else None,
        message=message,
    )


class InputError(ValueError):
    """The case or a measurement is wrong; ``problems`` names everything at once.

    The text is what the program ``trochoid`` prints before it ends with exit code 2.
    """

    #: every :class:`Problem`, in the order in which they stand in the files
    problems: tuple[Problem, ...]

    def __init__(self, problems: Sequence[str], text: str = "") -> None:
        super().__init__(text.rstrip("\n") or "\n".join(problems))
        self.problems = tuple(problem_of(one) for one in problems)

    def __reduce__(self) -> tuple:
        raw = [
            f"{p.file}:{p.line}:{p.column}: {p.message}" if p.file is not None else p.message
            for p in self.problems
        ]
        return (type(self), (raw, str(self)))


class AnswerWarning(UserWarning):
    """Something to know about an answer that stands all the same."""
