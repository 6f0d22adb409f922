"""One case over many values of its keys."""

from __future__ import annotations

import atexit
import os
import shutil
import tempfile
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import Any, Optional, Union

from . import _core, answers
from ._answer import Answer
from ._case import CaseLike, as_case
from ._commands import _told
from ._executor import answer_rows
from ._measured import ReadingsLike, Records, Responses, with_measured


def _values(values: Any) -> Any:
    """Arrays and lists are `values` of [sweep]; tables are as they are there."""
    if isinstance(values, range):
        return {"values": list(values)}
    if isinstance(values, (list, tuple)) or hasattr(values, "tolist"):
        return {"values": values}
    return values


#: what is drawn from: an answer, what a command wrote, or {"file": ..., "group": ...}
Found = Union[Answer, str, os.PathLike, Mapping[str, Any]]


def _on_disk(found: Found) -> Any:
    """As a case file names it; an answer is written for as long as Python runs."""
    if isinstance(found, Answer):
        folder = tempfile.mkdtemp(prefix="trochoid_found_")
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
        return os.fspath(found.save(Path(folder) / found.command_name, report=False))
    if isinstance(found, Mapping):
        return {**found, "file": os.path.abspath(found["file"])} if "file" in found else found
    return os.path.abspath(found)


def _covariance(found: Union[Found, Sequence[Found], None]) -> Any:
    if found is None or isinstance(found, (Answer, str, os.PathLike, Mapping)):
        return None if found is None else _on_disk(found)
    return [_on_disk(one) for one in found]


def _with_sweep(
    document: _core.Document, over: Optional[Mapping[str, Any]], table: Mapping[str, Any]
) -> _core.Document:
    """What is given here wins over the case's own [sweep]."""
    given = {key: value for key, value in table.items() if value is not None}
    if over is not None:
        given["over"] = {key: _values(values) for key, values in over.items()}
    for key in ("over", "covariance"):
        if key in given:
            document = document.without(["sweep", key])
    return document.with_tables({"sweep": given}) if given else document


def sweep(
    case: CaseLike,
    over: Optional[Mapping[str, Any]] = None,
    *,
    command: Optional[str] = None,
    take: Union[str, Sequence[str], None] = None,
    method: Optional[str] = None,
    count: Optional[int] = None,
    seed: Optional[int] = None,
    covariance: Union[Found, Sequence[Found], None] = None,
    draws: Optional[int] = None,
    records: Records = None,
    responses: Responses = None,
    readings: ReadingsLike = None,
    executor: Optional[Executor] = None,
    in_flight: Optional[int] = None,
    folder: Union[str, os.PathLike, None] = None,
    part_file: Union[str, os.PathLike, None] = None,
    progress: Optional[Callable[[int, int], object]] = None,
    **options: Any,
) -> answers.SweepAnswer:
    """Parameter sweep: one row per case, as ``trochoid sweep``.

    Parameters
    ----------
    case : Case, path of a case file, or dict
        What is not given here stands in its ``[sweep]`` (docs/guide/sweep.md).
    over : mapping
        ``{"cut.spindle_rpm": np.linspace(3000, 6000, 31)}``: keys of the case, each with
        its values (array, list) or a table as in ``[sweep.over]``: ``{"from": 1, "to": 2,
        "count": 5}``, ``{"mean": 922, "sd": 9}``, ``{"file": "cuts.csv", "column": "rpm"}``.
    command : str
        What answers each row: ``"simulate"``, ``"stability"`` ...
    take : list of str
        What is taken from each answer: ``["result.limit_depth_mm", "result.mean_N[2]"]``.
    method : {"grid", "list", "latin_hypercube", "random"}
        Every combination (default), the first values of all keys, then the second ones,
        or ``count`` rows by chance, the same ones for the same ``seed``.
    count, seed : int
        Of the rows by chance.
    covariance : Answer, path, dict, or a list of them
        What ``identify``, ``modes`` or ``calibrate`` found, drawn with its correlations
        (theory U-1 to U-7): an answer, a folder that a command wrote, or ``{"file":
        folder, "group": name}``. A saved ``case.toml`` names the folder; that of an
        answer which was not saved goes when Python ends.
    draws : int
        How many draws (200); of a grid or list each point has all of them. Intervals are
        in ``quantities``, over a grid in table ``bands``.
    records, responses, readings : list of Record, Response, Readings, optional
        Measurements as arrays, in place of ``[[measurement]]``, ``[[measured_frf]]``,
        ``[[surface_measurement]]``; they travel to workers.
    executor : concurrent.futures.Executor, optional
        Who answers the rows, in parts of about a second and each part on one thread:
        processes, Dask's ``client.get_executor()``, ``MPIPoolExecutor``
        (docs/guide/clusters.md). Default: the threads of this process.
    in_flight : int, optional
        Parts that are asked for at a time; default: two a worker, and two.
    folder : path, optional
        Save the result there, as ``answer.save(folder)``. Until then rows that are done
        are kept beside it, in ``.FOLDER.part``: after a kill the same call goes on there.
    part_file : path, optional
        Keep them in this file instead; it stays.
    progress : callable, optional
        Called with rows that are done, and all of them.
    **options
        Further keys of ``[sweep]``.

    Returns
    -------
    Answer
        ``rows``, ``failed``, ``quantities``; table ``sweep``: the swept keys, what was
        taken, ``status`` (``ok``, ``failed``, ``wrong_input``) and ``message``. The same
        bits as the program's, whoever answered.

    Raises
    ------
    InputError
        Where the case, a key or what is to be taken is wrong, before the work begins.
    SweepUnfinished
        The executor broke down; rows that are done are kept, the same call goes on.

    Examples
    --------
    >>> found = trochoid.sweep("case.toml", {"cut.spindle_rpm": np.linspace(3e3, 6e3, 31)},
    ...                        command="stability", take=["result.limit_depth_mm"])
    >>> found.tables["sweep"]["limit_depth_mm"]
    """
    given = as_case(case)
    document = given._document
    document = with_measured(
        document, command, records=records, responses=responses, readings=readings
    )
    table = {
        "method": method,
        "count": count,
        "seed": seed,
        "covariance": _covariance(covariance),
        "draws": draws,
        **options,
    }
    work = _core.SweepWork(
        _with_sweep(document, over, table),
        command=command or "",
        take=[take] if isinstance(take, str) else list(take or ()),
        part_file=part_file or "",
        folder=folder or "",
    )
    if executor is None:
        work.go_on(progress)
    else:
        answer_rows(work, executor, in_flight, progress)
    default = None if given.file is None else given.file.with_suffix(".sweep")
    answer = _told(work.take_answer(), work.case_toml, default)
    if folder is not None:
        answer.save(folder)
        if part_file is None:
            Path(work.part_file).unlink(missing_ok=True)
    return answer
