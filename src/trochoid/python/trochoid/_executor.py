"""Rows of a sweep answered by an executor, here or on other machines."""

from __future__ import annotations

import functools
import os
import pickle
import time
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError
from concurrent.futures import Executor, Future, wait
from typing import Any, NamedTuple, Optional

from . import _core

_PART_S = 1.0  # a part takes about as long: short to lose, long beside its sending
_MOST_ROWS = 1 << 16
_TRIES = 4
_AHEAD = 8  # so many times `in_flight` may be done before an earlier part is


class SweepUnfinished(RuntimeError):
    """The executor of a sweep broke down; the same call goes on behind what is done."""

    #: rows that are done, from the first on
    done: int
    #: rows in all
    rows: int
    #: where they are kept; empty: nowhere
    part_file: str

    def __init__(self, message: str, done: int = 0, rows: int = 0, part_file: str = "") -> None:
        super().__init__(message)
        self.done, self.rows, self.part_file = done, rows, part_file

    def __reduce__(self) -> tuple:
        return type(self), (str(self), self.done, self.rows, self.part_file)


class _Done(NamedTuple):
    build: str  # of the worker
    text: bytes = b""
    took_s: float = 0.0


@functools.lru_cache(maxsize=4)
def _study(pickled: bytes) -> _core.Study:
    return pickle.loads(pickled)


def part(build: str, *asked: Any) -> tuple:
    """What a worker is asked: some rows of a study.

    ``build``: version of who asks, before anything else is looked at. ``asked``: the
    study, pickled; the number of the first row; the values of all rows; and the number
    of the attempt, so that no scheduler takes a second one for the first.
    """
    if build != _core.build:
        return _Done(_core.build)
    pickled, first, values, _ = asked
    begun = time.perf_counter()
    text = _core.rows(_study(pickled), first, values)
    return _Done(_core.build, text, time.perf_counter() - begun)


class _Asked(NamedTuple):
    first: int
    rows: int
    attempt: int = 1


def _workers(executor: Executor) -> int:
    """How many work at a time, where the executor is one that we know."""
    client = getattr(executor, "_client", None)  # of Dask
    if client is not None:
        return sum(client.nthreads().values())
    pool = getattr(executor, "_pool", None)  # of MPI
    known = getattr(pool, "size", None) or getattr(executor, "_max_workers", None)
    return known if isinstance(known, int) else os.cpu_count() or 1


def _why(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}".rstrip(": ")


def _lacks_us(error: BaseException) -> bool:
    return isinstance(error, ImportError) and "trochoid" in (error.name or str(error))


class _Asking:
    """Parts on their way: asked for, answered but not yet in their turn, to be repeated."""

    def __init__(self, work: _core.SweepWork, executor: Executor, in_flight: int) -> None:
        self.work = work
        self.executor = executor
        self.in_flight = in_flight
        self.study = pickle.dumps(work.study, protocol=pickle.HIGHEST_PROTOCOL)
        self.next = work.done
        self.size = 1
        self.asked: dict[Future, _Asked] = {}
        self.repeat: list[_Asked] = []
        self.early: dict[int, tuple[int, bytes]] = {}

    def unfinished(self, why: str) -> SweepUnfinished:
        done, rows, file = self.work.done, self.work.rows, self.work.part_file
        kept = f"they are kept in {file}, and the same call goes on there"
        lost = "they are lost, as neither folder nor part_file says where to keep them"
        told = f"{why}; {done} of {rows} rows are done: {kept if file else lost}"
        return SweepUnfinished(told, done, rows, file)

    def ask(self) -> None:
        ahead = _AHEAD * self.in_flight
        while len(self.asked) < self.in_flight:
            if self.repeat:
                asked = self.repeat.pop()
            elif self.next < self.work.rows and len(self.early) < ahead:
                asked = _Asked(self.next, min(self.size, self.work.rows - self.next))
                self.next += asked.rows
            else:
                return
            values = self.work.values(asked.first, asked.rows)
            try:
                future = self.executor.submit(
                    part, _core.build, self.study, asked.first, values, asked.attempt
                )
            except RuntimeError as error:  # broken, or shut down
                self.receive(wait(self.asked, timeout=0).done)
                raise self.unfinished(f"the executor takes no work ({_why(error)})") from error
            self.asked[future] = asked

    def receive(self, futures: set[Future]) -> None:
        """Answers first, so that none is lost to a failure beside it."""
        failed: list[tuple[_Asked, BaseException]] = []
        for future in futures:
            asked = self.asked.pop(future)
            try:
                self.answered(asked, _Done(*future.result()))
            except (Exception, CancelledError) as error:
                failed.append((asked, error))
        while self.work.done in self.early:
            count, text = self.early.pop(self.work.done)
            self.work.add(count, text)
        for asked, why in failed:
            self.failed(asked, why)

    def answered(self, asked: _Asked, done: _Done) -> None:
        if done.build != _core.build:
            raise SweepUnfinished(
                f"a worker has trochoid {done.build}, and here it is {_core.build}"
            )
        self.early[asked.first] = (asked.rows, done.text)
        wanted = int(asked.rows * _PART_S / max(done.took_s, 1e-9))
        self.size = max(1, min(wanted, 8 * asked.rows, _MOST_ROWS))

    def failed(self, asked: _Asked, error: BaseException) -> None:
        if isinstance(error, SweepUnfinished):
            raise self.unfinished(str(error)) from None
        if _lacks_us(error):
            raise self.unfinished(
                f"a worker cannot import the module trochoid ({_why(error)})"
            ) from error
        if isinstance(error, BrokenExecutor):
            raise self.unfinished(f"the executor broke down ({_why(error)})") from error
        if asked.attempt == _TRIES:
            raise self.unfinished(
                f"rows {asked.first + 1} to {asked.first + asked.rows} failed {_TRIES} times"
                f", at last with {_why(error)}"
            ) from error
        self.repeat.append(asked._replace(attempt=asked.attempt + 1))


def answer_rows(
    work: _core.SweepWork,
    executor: Executor,
    in_flight: Optional[int],
    progress: Optional[Callable[[int, int], object]],
) -> None:
    """Answer what is left of a sweep; rows come in order whoever is first."""
    if not hasattr(executor, "submit"):
        raise TypeError(
            f"executor: an Executor is needed, not {type(executor).__name__}"
            "; of Dask it is client.get_executor()"
        )
    if in_flight is not None and in_flight < 1:
        raise ValueError(f"in_flight = {in_flight}: must be at least 1")
    asking = _Asking(work, executor, in_flight or 2 * _workers(executor) + 2)
    told = -1
    try:
        while True:
            if progress is not None and work.done > told:
                told = work.done
                progress(told, work.rows)
            if work.done == work.rows:
                return
            asking.ask()
            asking.receive(wait(asking.asked, return_when=FIRST_COMPLETED).done)
    finally:
        for future in asking.asked:
            future.cancel()
