"""What a command answers."""

from __future__ import annotations

import html
import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union

import numpy as np

from . import _core

if TYPE_CHECKING:
    import matplotlib.figure
    import pandas


class Values(Mapping):
    """Named values of an answer, as attributes and as a mapping; they do not change."""

    __slots__ = ("_members",)
    _members: dict[str, Any]

    def __init__(self, members: Mapping[str, Any]) -> None:
        object.__setattr__(self, "_members", {k: _frozen(v) for k, v in members.items()})

    def __getitem__(self, key: str) -> Any:
        return self._members[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._members)

    def __len__(self) -> int:
        return len(self._members)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        try:
            return self._members[name]
        except KeyError:
            raise AttributeError(
                f"there is no {name!r}; there are {', '.join(self._members)}"
            ) from None

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("an answer does not change")

    __delattr__ = None  # type: ignore[assignment]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._members]

    def __repr__(self) -> str:
        return f"Values({self._members!r})"


def _frozen(value: Any) -> Any:
    if isinstance(value, Mapping):
        return Values(value)
    if isinstance(value, list):
        return tuple(_frozen(one) for one in value)
    return value


class Warned(NamedTuple):
    """A warning of an answer."""

    code: str  #: short and stable, for programs
    message: str  #: a sentence, for people


class Answer:
    """What a command answers: the content of its result folder.

    Every key of ``result`` in summary.json (docs/formats/results.md) is an attribute:
    ``answer.peak_xy_N``, ``answer.fits[0].coefficients.K_tc_MPa.value``; the unit is part
    of the name. Numbers that cannot be known are None.
    """

    __slots__ = ("_core", "_result", "_tables", "_placed")

    def __init__(
        self,
        answer: _core.Answer,
        placed: Callable[[Path], str],
        default_folder: Optional[Path],
    ) -> None:
        tables = {k: MappingProxyType(v) for k, v in answer.tables().items()}
        object.__setattr__(self, "_core", answer)
        object.__setattr__(self, "_result", Values(answer.result()))
        object.__setattr__(self, "_tables", MappingProxyType(tables))
        object.__setattr__(self, "_placed", (placed, default_folder))

    @property
    def command_name(self) -> str:
        """The command: ``simulate``, ``identify`` ..."""
        return self._core.command

    @property
    def ok(self) -> bool:
        """False: there is no good answer; ``message`` says why."""
        return self._core.ok

    @property
    def message(self) -> str:
        """The answer, or why there is none, in a sentence."""
        return self._core.message

    @property
    def warnings(self) -> tuple[Warned, ...]:
        """What to know of an answer that stands all the same."""
        return tuple(Warned(code, message) for code, message in self._core.warnings)

    @property
    def result(self) -> Values:
        """All values, also those with the name of a method: ``answer.result["ok"]``."""
        return self._result

    @property
    def tables(self) -> Mapping[str, Mapping[str, np.ndarray]]:
        """The CSV files: ``answer.tables["forces"]["Fx_N"]``, read-only float64 (n,).

        Columns of texts, as of a sweep, are arrays of str objects.
        """
        return self._tables

    def frame(self, table: Optional[str] = None) -> pandas.DataFrame:
        """A table as a DataFrame of pandas, which must be installed.

        Its name may be left out where there is one table only.
        """
        if table is None and len(self._tables) == 1:
            table = next(iter(self._tables))
        try:
            columns = self._tables[table]  # type: ignore[index]
        except KeyError:
            raise KeyError(
                f"there is no table {table!r}; there are {', '.join(self._tables)}"
            ) from None
        import pandas

        return pandas.DataFrame({name: column.copy() for name, column in columns.items()})

    def to_dict(self) -> dict[str, Any]:
        """``result`` of summary.json as dict, list, str, float, int, bool and None."""
        return self._core.result()

    def save(
        self, folder: Union[str, os.PathLike, None] = None, *, report: bool = True
    ) -> Path:
        """Write the folder that the program writes: case.toml, summary.json, CSV, report.

        Parameters
        ----------
        folder : path, optional
            Default: CASE.COMMAND beside the case file. An older folder of trochoid is
            replaced, anything else is not touched.
        report : bool
            Write report.html.

        Raises
        ------
        OSError
            The place cannot be written, or holds files of others.
        """
        placed, default = self._placed
        place = default if folder is None else Path(folder)
        if place is None:
            raise ValueError("save: name a folder; this case has no file to put it beside")
        self._core.write(place, placed(place), report)
        return place

    def report(self) -> str:
        """report.html as text: one page with the pictures, without requests."""
        return self._core.report_html()

    def plot(self) -> matplotlib.figure.Figure:
        """The main picture of the answer; matplotlib must be installed."""
        from . import _plot

        return _plot.figure(self)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._result, name)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("an answer does not change")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._result]

    def __str__(self) -> str:
        lines = [self._core.short_table.rstrip("\n")]
        lines += [f"warning [{w.code}]: {w.message}" for w in self.warnings]
        if not self.ok:
            lines.append(f"no answer: {self.message}")
        return "\n".join(line for line in lines if line)

    def __repr__(self) -> str:
        status = "" if self.ok else " (no answer)"
        return f"<trochoid.Answer of {self.command_name}{status}: {self.message}>"

    def _repr_html_(self) -> str:
        title = html.escape(self._core.title or self.command_name)
        return f"<b>{title}</b><pre>{html.escape(str(self))}</pre>"
