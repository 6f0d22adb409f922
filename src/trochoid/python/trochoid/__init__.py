"""What a milling cutter with runout really does: the program trochoid from Python.

>>> import trochoid
>>> case = trochoid.Case.from_file("examples/st52_slot/case.toml")
>>> found = trochoid.identify(case)
>>> found.fits[-1].coefficients.K_tc_MPa.value
>>> found.save("result")                       # the folder that the program writes

Commands (``simulate``, ``identify`` ...) take a :class:`Case`, the name of a case file
or a dict, and answer with an :class:`Answer`: the same numbers, bit for bit, as the
program. ``forces``, ``force_matrix``, ``chip`` and ``multiplier`` take arrays. The unit
is part of every name. Pages: docs/python.md, docs/formats/case.md,
docs/formats/results.md.
"""

from . import _core, answers
from ._answer import Answer, Values, Warned
from ._case import Case
from ._commands import (
    actuator,
    calibrate,
    correct,
    dynamics,
    identify,
    modes,
    plan,
    program,
    simulate,
    stability,
    surface,
)
from ._errors import AnswerWarning, InputError, Problem
from ._executor import SweepUnfinished
from ._kernels import chip, force_matrix, forces, multiplier
from ._measured import Readings, Response, Step
from ._record import Record
from ._sweep import sweep

__version__: str = _core.version


def new_case(command: str) -> str:
    """A commented case file (TOML) to start from, as ``trochoid new COMMAND``."""
    return _core.new_case(command)


__all__ = [
    "Answer",
    "AnswerWarning",
    "Case",
    "InputError",
    "Problem",
    "Readings",
    "Record",
    "Response",
    "Step",
    "SweepUnfinished",
    "Values",
    "Warned",
    "actuator",
    "answers",
    "calibrate",
    "chip",
    "correct",
    "dynamics",
    "force_matrix",
    "forces",
    "identify",
    "modes",
    "multiplier",
    "new_case",
    "plan",
    "program",
    "simulate",
    "stability",
    "surface",
    "sweep",
]
