"""A case: a cutter, its cut, and what was measured of it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Optional, Union

from . import _core


def _nested(changes: Mapping[str, Any]) -> tuple[dict[str, Any], list[list[str]]]:
    """Dotted keys as tables in tables, and the paths of what is to be left out."""
    tables: dict[str, Any] = {}
    left_out: list[list[str]] = []
    for key, value in changes.items():
        if not isinstance(key, str) or not all(key.split(".")):
            raise TypeError(f"{key!r} is no key; 'cut.spindle_rpm' is one")
        *path, last = key.split(".")
        if value is None:
            left_out.append([*path, last])
            continue
        table = tables
        for part in path:
            table = table.setdefault(part, {})
            if not isinstance(table, dict):
                raise TypeError(f"{key}: {part} is given a value as well")
        if isinstance(value, Mapping) and isinstance(table.get(last), dict):
            table[last].update(value)
        elif last in table and not isinstance(value, Mapping):
            raise TypeError(f"{key} is given twice")
        else:
            table[last] = dict(value) if isinstance(value, Mapping) else value
    return tables, left_out


class Case:
    """A case, with the tables and keys of a case file (docs/formats/case.md).

    Its keys are checked here, all at once; what a command needs besides is checked by
    that command, or by :meth:`check`. A case never changes: :meth:`with_` makes a new one.

    Parameters
    ----------
    tables : mapping
        ``{"tool": {"teeth": 2, ...}, "cut": {...}}``. The unit is part of each key. numpy
        numbers and arrays may be values; keys whose value is None are left out.
    folder : path, optional
        What relative names of files count from; default: where Python runs.

    Raises
    ------
    InputError
        With every problem.

    Examples
    --------
    >>> case = trochoid.Case.from_file("case.toml")
    >>> faster = case.with_({"cut.spindle_rpm": 900})
    """

    __slots__ = ("_document", "_checked", "file")

    #: the case file; None for a case from a dict
    file: Optional[Path]

    def __init__(
        self, tables: Mapping[str, Any], *, folder: Union[str, os.PathLike, None] = None
    ) -> None:
        if not isinstance(tables, Mapping):
            raise TypeError(
                f"Case: a dict of tables is needed, not {type(tables).__name__}"
                "; Case.from_file reads a case file"
            )
        base = Path.cwd() if folder is None else Path(folder).absolute()
        self._begin(_core.Document.from_dict(dict(tables), base), None)

    def _begin(self, document: _core.Document, file: Optional[Path]) -> None:
        document.check_keys()
        self._document = document
        self._checked: dict[Optional[str], _core.CheckedCase] = {}
        self.file = file

    @classmethod
    def _of(cls, document: _core.Document, file: Optional[Path]) -> Case:
        case = cls.__new__(cls)
        case._begin(document, file)
        return case

    @classmethod
    def from_file(cls, file: Union[str, os.PathLike]) -> Case:
        """Read a case file, with what it includes.

        Raises :class:`InputError` with file, line and column of every problem.
        """
        path = Path(file)
        return cls._of(_core.Document.from_file(path), path)

    def with_(self, changes: Mapping[str, Any]) -> Case:
        """A new case with other values.

        Keys are paths, ``{"cut.spindle_rpm": 900}``, or tables, ``{"cut":
        {"spindle_rpm": 900}}``: those of a table that are not named stay. A list is
        replaced whole. None takes a key or a table away: ``{"runout": None}``.
        """
        tables, left_out = _nested(changes)
        document = self._document.with_tables(tables)
        for path in left_out:
            document = document.without(path)
        return self._of(document, self.file)

    def to_dict(self) -> dict[str, Any]:
        """The tables as they were given, without defaults."""
        return self._document.to_dict()

    def check(self, command: Optional[str] = None) -> None:
        """Check all that a command needs; default: the command that the tables show."""
        self._for(_command(command))

    def as_understood(self, command: Optional[str] = None) -> str:
        """The case as a case file (TOML), with every default filled in."""
        return self._for(_command(command)).as_understood

    def _for(self, command: Optional[str]) -> _core.CheckedCase:
        if command not in self._checked:
            self._checked[command] = _core.read_case(self._document, command, "")
        return self._checked[command]

    def __reduce__(self) -> tuple:
        return Case._of, (self._document, self.file)

    def __repr__(self) -> str:
        tables = self._document.to_dict()
        title = tables.get("title", "")
        names = ", ".join(name for name in tables if name != "title")
        return f"<trochoid.Case {title!r}: {names}>"


COMMANDS: tuple[str, ...] = _core.commands


def _command(name: Optional[str]) -> Optional[str]:
    if name is not None and name not in COMMANDS:
        raise ValueError(f"there is no command {name!r}; there are {', '.join(COMMANDS)}")
    return name


#: what the commands take: a case, the name of a case file, or a dict of tables
CaseLike = Union[Case, str, os.PathLike, Mapping[str, Any]]


def as_case(case: CaseLike) -> Case:
    if isinstance(case, Case):
        return case
    if isinstance(case, (str, os.PathLike)):
        return Case.from_file(case)
    return Case(case)
