"""Measured forces that are arrays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Optional

import numpy as np

_FORCES = ("Fx", "Fy", "Fz")


def samples(values: Any, what: str) -> np.ndarray:
    """One column of real numbers, float64 and contiguous."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{what}: real numbers are needed, not {array.dtype}")
    if array.ndim != 1:
        raise ValueError(f"{what}: one value a sample is needed, not shape {array.shape}")
    return np.ascontiguousarray(array, dtype=np.float64)


def named_columns(data: Any) -> Optional[list[tuple[str, np.ndarray]]]:
    """Columns of numbers of a mapping, DataFrame or structured array; None: it is none."""
    names = getattr(getattr(data, "dtype", None), "names", None)
    if not (hasattr(data, "columns") or isinstance(data, Mapping) or names):
        return None
    keys = names or (data.columns if hasattr(data, "columns") else data)
    found = [(str(key), np.asarray(data[key])) for key in keys]
    # A column of text, a comment for example, is not used; nor is it in a CSV file.
    return [
        (key, samples(values, f"column {key!r}"))
        for key, values in found
        if values.dtype.kind in "fiu"
    ]


def _columns_of(forces: Any, unit: str) -> list[tuple[str, str, np.ndarray]]:
    named = named_columns(forces)
    if named is not None:
        return [(name, "", values) for name, values in named]
    array = np.asarray(forces)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(
            "forces: shape (n, 3) is needed, the channels Fx, Fy, Fz of n samples, "
            f"not {array.shape}"
            + ("; transpose it" if array.ndim == 2 and array.shape[0] == 3 else "")
        )
    return [
        (name, unit, samples(array[:, i], f"forces[:, {i}]"))
        for i, name in enumerate(_FORCES)
    ]


class Record:
    """A measured force record in memory, in place of a file of ``[[measurement]]``.

    Parameters
    ----------
    forces : array_like, shape (n, 3), or mapping of columns, or DataFrame
        The channels of the dynamometer [N]. Columns with names are found as in a CSV
        file: ``Fx_N``, ``time_s``, ``angle_deg`` ... with the unit in the name.
    sample_rate_Hz : float, optional
        Samples a second.
    time_s, angle_deg : array_like, shape (n,), optional
        Time of each sample [s]; spindle angle phi [deg]. One of the three is needed.
    name : str, optional
        For messages and results; default ``record 1``, ``record 2`` ...
    **keys
        Every other key of ``[[measurement]]`` (docs/formats/case.md): ``from_s``,
        ``to_s``, ``group``, ``cut={"feed_per_tooth_mm": 0.05}``, ``scale=[500, 500,
        1000]`` for channels in volts, ``columns``.

    Raises
    ------
    TypeError, ValueError
        Where shape or type is wrong. What is wrong in the samples themselves (NaN, too
        few) is an :class:`InputError` of the command, as for a file.
    """

    def __init__(
        self,
        forces: Any,
        *,
        sample_rate_Hz: Optional[float] = None,
        time_s: Any = None,
        angle_deg: Any = None,
        name: Optional[str] = None,
        **keys: Any,
    ) -> None:
        for forbidden in ("file", "format"):
            if forbidden in keys:
                raise TypeError(f"{forbidden} goes with a record in a file, not in memory")
        columns = _columns_of(forces, "" if "scale" in keys else "N")
        if time_s is not None:
            columns.append(("time", "s", samples(time_s, "time_s")))
        if angle_deg is not None:
            columns.append(("angle", "deg", samples(angle_deg, "angle_deg")))
        self.name = name
        self._columns = columns
        self._keys = dict(keys)
        if sample_rate_Hz is not None:
            self._keys["sample_rate_Hz"] = float(sample_rate_Hz)

    def __repr__(self) -> str:
        count = len(self._columns[0][2]) if self._columns else 0
        names = ", ".join(name for name, _, _ in self._columns)
        return f"<trochoid.Record {self.name or ''}: {count} samples of {names}>"
