"""Measured responses, steps and walls that are arrays."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Optional, Union

import numpy as np

from . import _core
from ._record import Record, named_columns, samples


def _table(columns: Sequence[tuple[str, np.ndarray]], what: str) -> str:
    """The text of a file with these columns; a value that is no number is left empty."""
    lengths = {len(values) for _, values in columns}
    if len(lengths) != 1:
        told = ", ".join(f"{name}: {len(values)}" for name, values in columns)
        raise ValueError(f"{what}: columns of one length are needed, not {told or 'none'}")
    for name, _ in columns:
        if not name or name[0] == "#" or any(c in name for c in ',;"\t\r\n'):
            raise ValueError(f"{what}: {name!r} is no name of a column")
    rows = zip(*(values.tolist() for _, values in columns))
    lines = [",".join(name for name, _ in columns)]
    lines += [",".join("" if x != x else repr(x) for x in row) for row in rows]
    return "\n".join(lines) + "\n"


class _Measured:
    """Columns as a file would hold them, and the keys of the table that names it."""

    _what = ""

    def __init__(
        self, columns: list[tuple[str, np.ndarray]], name: Optional[str], keys: dict[str, Any]
    ) -> None:
        if "file" in keys:
            raise TypeError("file goes with data in a file, not in memory")
        self.name = name
        self._text = _table(columns, self._what)
        self._keys = keys
        self._shown = f"{len(columns[0][1])} rows of {', '.join(name for name, _ in columns)}"

    def __repr__(self) -> str:
        return f"<trochoid.{type(self).__name__} {self.name or ''}: {self._shown}>"


def _columns(first: Any, others: Sequence[tuple[str, Any]], what: str) -> list:
    """Those of a mapping or DataFrame by their names, or arrays one by one."""
    named = named_columns(first)
    if named is None:
        missing = [name for name, values in others if values is None]
        if missing:
            raise TypeError(f"{what}: {', '.join(missing)} missing")
        return [(name, samples(values, name)) for name, values in others]
    if any(values is not None for _, values in others[1:]):
        raise TypeError(f"{what}: columns with names, or arrays one by one; not both")
    return named


class Response(_Measured):
    """A measured frequency response in memory, in place of a file.

    Parameters
    ----------
    frequency_Hz : array_like, shape (n,); or mapping of columns, or DataFrame
        Frequencies [Hz]. Columns with names are found as in a file: ``freq_Hz``,
        ``re_m/N``, ``im_m/N``, or ``mag_...`` and ``phase_deg``; hammer blows in time as
        ``time_s``, ``force_N``, ``accel_g``.
    response : array_like of complex, shape (n,)
        Motion over force, in ``unit``.
    unit : str
        Of ``response``: ``"m/N"``, ``"um/N"`` (receptance), ``"m/s/N"`` (mobility),
        ``"(m/s^2)/N"``, ``"g/N"`` (accelerance).
    name : str, optional
        For messages and results; default ``response 1``, ``response 2`` ...
    **keys
        Keys of ``[frf]`` or ``[[measured_frf]]`` (docs/formats/case.md): ``axis="x"``,
        ``body="tool"``, ``band_Hz=[100, 2000]``, ``modes=2``.

    Raises
    ------
    TypeError, ValueError
        Where shape or type is wrong. What is wrong in the numbers is an
        :class:`InputError` of the command, which counts lines as in a file: the first
        row of numbers is line 2.
    """

    _what = "Response"

    def __init__(
        self,
        frequency_Hz: Any,
        response: Any = None,
        *,
        unit: Optional[str] = None,
        name: Optional[str] = None,
        **keys: Any,
    ) -> None:
        columns = named_columns(frequency_Hz)
        if columns is None:
            if response is None or unit is None:
                raise TypeError('Response: response and its unit are needed, unit="m/N"')
            values = np.asarray(response)
            if values.dtype.kind not in "fiuc":
                raise TypeError(f"response: numbers are needed, not {values.dtype}")
            columns = [
                ("freq_Hz", samples(frequency_Hz, "frequency_Hz")),
                (f"re_{unit}", samples(values.real, "response")),
                (f"im_{unit}", samples(values.imag, "response")),
            ]
        elif response is not None or unit is not None:
            raise TypeError("Response: columns with names, or two arrays and a unit; not both")
        super().__init__(columns, name, keys)


class Step(_Measured):
    """A measured step of an actuator in memory, in place of the file of ``[step]``.

    Parameters
    ----------
    time_s : array_like, shape (n,); or mapping of columns, or DataFrame
        Time [s]. Columns with names are found as in a file: ``time_s``, ``position_um``
        and perhaps ``command_um``.
    position_um : array_like, shape (n,)
        What was measured [um].
    name : str, optional
        For messages and results; default ``step``.
    **keys
        Keys of ``[step]``: ``step_um`` (height of the commanded step), ``start_s``.
    """

    _what = "Step"

    def __init__(
        self, time_s: Any, position_um: Any = None, *, name: Optional[str] = None, **keys: Any
    ) -> None:
        others = [("time_s", time_s), ("position_um", position_um)]
        super().__init__(_columns(time_s, others, self._what), name, keys)


class Readings(_Measured):
    """A measured wall in memory, in place of the file of a ``[[surface_measurement]]``.

    Parameters
    ----------
    x_mm : array_like, shape (n,); or mapping of columns, or DataFrame
        Along the feed, from the start of the wall [mm]. Columns with names are found as
        in a file (docs/formats/surface.md): ``x_mm``, ``height_mm``, ``error_um`` ...
    height_mm : array_like, shape (n,)
        Above the tip of the cutter [mm].
    error_mm : array_like, shape (n,)
        Positive where material is left [mm]; a reading that is NaN is left out.
    name : str, optional
        For messages and results; default ``readings 1``, ``readings 2`` ...
    **keys
        Keys of ``[[surface_measurement]]``: ``datum_offset``, ``form``, ``frame`` ...
    """

    _what = "Readings"

    def __init__(
        self,
        x_mm: Any,
        height_mm: Any = None,
        error_mm: Any = None,
        *,
        name: Optional[str] = None,
        **keys: Any,
    ) -> None:
        others = [("x_mm", x_mm), ("height_mm", height_mm), ("error_mm", error_mm)]
        super().__init__(_columns(x_mm, others, self._what), name, keys)


Records = Union[Record, Sequence[Record], None]
Responses = Union[Response, Sequence[Response], None]
ReadingsLike = Union[Readings, Sequence[Readings], None]


def _listed(given: Any, kind: type, what: str) -> list:
    """One or several of a kind."""
    data = [given] if isinstance(given, (Record, _Measured)) else list(given)
    for one in data:
        if not isinstance(one, kind):
            raise TypeError(
                f"{what}: trochoid.{kind.__name__} is needed, not {type(one).__name__}"
            )
    if not data:
        raise ValueError(f"{what}: none given")
    return data


def _named(data: Sequence[Any], word: str) -> list[tuple[str, Any]]:
    named = [(one.name or f"{word} {number}", one) for number, one in enumerate(data, 1)]
    names = [name for name, _ in named]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"two are called {name!r}; give each its own name")
    return named


def _several(
    document: _core.Document, data: Sequence[_Measured], table: str, word: str
) -> _core.Document:
    named = _named(data, word)
    for name, one in named:
        document = document.with_text(name, one._text)
    tables = [{"file": name, **one._keys} for name, one in named]
    return document.without([table]).with_tables({table: tables})


def _one(document: _core.Document, data: _Measured, table: str) -> _core.Document:
    """What the table says besides stays."""
    name = data.name or table
    return document.with_text(name, data._text).with_tables(
        {table: {"file": name, **data._keys}}
    )


def with_measured(
    document: _core.Document,
    command: Optional[str],
    *,
    records: Records = None,
    responses: Responses = None,
    step: Optional[Step] = None,
    readings: ReadingsLike = None,
) -> _core.Document:
    """Data in memory in place of all that a case names for their kind."""
    if records is not None:
        for name, record in (named := _named(_listed(records, Record, "records"), "record")):
            document = document.with_record(name, record._columns)
        tables = [{"file": name, **record._keys} for name, record in named]
        document = document.without(["measurement"]).with_tables({"measurement": tables})
    if responses is not None:
        found = _listed(responses, Response, "responses")
        if command == "modes" and len(found) == 1:
            document = _one(document, found[0], "frf")
        else:
            document = _several(document, found, "measured_frf", "response")
    if step is not None:
        (given,) = _listed(step, Step, "step")
        document = _one(document, given, "step")
    if readings is not None:
        found = _listed(readings, Readings, "readings")
        document = _several(document, found, "surface_measurement", "readings")
    return document
