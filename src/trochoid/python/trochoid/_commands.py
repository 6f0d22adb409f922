"""The commands of the program, as functions."""

from __future__ import annotations

import os
import threading
import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Optional, Union

from . import _core, answers
from ._case import Case, CaseLike, as_case
from ._errors import AnswerWarning
from ._measured import ReadingsLike, Records, Response, Responses, Step, with_measured


def _told(core: _core.Answer, placed: Callable[[Path], str], default: Optional[Path]) -> Any:
    """The answer, of the class that its command has in answers.py; its warnings are told."""
    name = core.command
    if name == "plan":
        of = core.result().get("of")
        name += f" of a {of}" if of else ""
    for code, message in core.warnings:
        warnings.warn(f"[{code}] {message}", AnswerWarning, stacklevel=4)
    return answers.BY_COMMAND[name](core, placed, default)


def _answered(command: str, case: _core.CheckedCase, **options: bool) -> _core.Answer:
    """The answer, of a thread beside the main one: that hears Ctrl-C at once.

    After Ctrl-C the work ends where it next tells how far it is, and Python not before.
    """
    wanted = _core.Wanted()
    if threading.current_thread() is not threading.main_thread():
        return _core.run(command, case, wanted, **options)
    found: list[_core.Answer] = []
    errors: list[BaseException] = []

    def work() -> None:
        try:
            found.append(_core.run(command, case, wanted, **options))
        except BaseException as error:
            errors.append(error)

    thread = threading.Thread(target=work, name=f"trochoid.{command}")
    thread.start()
    try:
        thread.join()
    except BaseException:
        wanted.end()
        raise
    if errors:
        raise errors.pop()
    return found[0]


def _run(command: str, case: CaseLike, measured: Mapping[str, Any], **options: bool) -> Any:
    """measured: data in memory, by the names of with_measured."""
    given = as_case(case)
    if any(data is not None for data in measured.values()):
        document = with_measured(given._document, command, **measured)
        given = Case._of(document, given.file)

    def placed(folder: Path) -> str:
        return _core.read_case(given._document, command, folder).as_understood

    core = _answered(command, given._for(command), **options)
    default = None if given.file is None else given.file.with_suffix("." + command)
    return _told(core, placed, default)


def _bare(command: str, file: Union[str, os.PathLike], options: Mapping[str, Any]) -> Any:
    """Of measured data without a case, as `trochoid modes tip.csv`."""
    name = os.fspath(file)
    bare = _core.BareOptions()
    for option, value in options.items():
        setattr(bare, option, value)

    def placed(folder: Path) -> str:
        return _core.bare_case(name, command, bare, folder).as_understood

    core = _answered(command, _core.bare_case(name, command, bare, ""))
    return _told(core, placed, Path(name).with_suffix("." + command))


def _is_bare(case: Any) -> bool:
    return isinstance(case, (str, os.PathLike)) and Path(case).suffix != ".toml"


def simulate(case: CaseLike, *, records: Records = None) -> answers.SimulateAnswer:
    """Chip thickness, forces, torque and engagement of a case.

    Parameters
    ----------
    case : Case, path of a case file, or dict
        With ``[tool]``, ``[cut]``, ``[force]``; perhaps ``[runout]``, ``[chip]``,
        ``[sampling]``, ``[dynamometer]``.
    records : list of Record, optional
        Measurements to compare with, in place of ``[[measurement]]``.

    Returns
    -------
    Answer
        ``mean_N``, ``min_N``, ``max_N``, ``rms_N`` (x, y, z, on the tool),
        ``peak_xy_N``, ``torque_mean_Nm``, ``torque_peak_Nm``, ``power_W``, ``teeth``.
        Tables ``forces`` (angle_deg, time_s, Fx_N, Fy_N, Fz_N) and ``chip`` (tooth,
        edge_angle_deg, height_mm, h_mm). Equations C-1 to C-8, F-1 to F-8.

    Raises
    ------
    InputError
        With every problem of the case.
    """
    return _run("simulate", case, {"records": records})


def identify(
    case: CaseLike, *, records: Records = None, curves: bool = False, anyway: bool = False
) -> answers.IdentifyAnswer:
    """Cutting coefficients and runout from measured forces, and how well each is known.

    Parameters
    ----------
    case : Case, path of a case file, or dict
        With ``[tool]``, ``[cut]``, ``[force] law`` and ``[[measurement]]``; perhaps
        ``[identify]``, ``[dynamometer]``.
    records : list of Record, optional
        Measurements as arrays, in place of ``[[measurement]]``:
        ``[trochoid.Record(F, sample_rate_Hz=1e4)]`` with F of shape (n, 3) in N.
    curves : bool
        Tables ``fitted`` and ``residual`` with every sample of long records, not the
        mean turn.
    anyway : bool
        Do all, however long it takes; otherwise records of much work are answered
        without what the answer can do without (warning ``work_limit``).

    Returns
    -------
    Answer
        ``fits``, one a chip model: ``coefficients`` (each with ``value``, ``se``,
        ``low``, ``high``: 95 %), ``runout``, ``phase_deg``, ``rms_N``,
        ``identifiable``; ``chosen``, ``signal``. ``ok`` is False where the record does
        not tell them. Equations I-1 to I-21.

    Raises
    ------
    InputError
        With every problem of the case and of the records.

    Examples
    --------
    >>> F = numpy.load("forces.npy")                        # (n, 3), newtons
    >>> record = trochoid.Record(F, sample_rate_Hz=10e3)
    >>> found = trochoid.identify("case.toml", records=[record])
    >>> found.fits[-1].coefficients.K_tc_MPa.value
    """
    return _run("identify", case, {"records": records}, curves=curves, anyway=anyway)


def surface(case: CaseLike) -> answers.SurfaceAnswer:
    """The surface location error that a cut leaves over feed and height.

    case: with ``[tool]``, ``[cut]``, ``[force]`` and ``[cutter_body]`` or ``[wall]``;
    perhaps ``[surface]``. Answers ``mean_error_mm``, ``peak_error_mm`` (positive where
    material is left), ``forces``; table ``surface`` (x_mm, height_mm, error_mm).
    """
    return _run("surface", case, {})


def calibrate(case: CaseLike, *, readings: ReadingsLike = None) -> answers.CalibrateAnswer:
    """Cutting coefficients and runout from a measured wall, without a dynamometer.

    case: as for :func:`surface`, with ``[[surface_measurement]]``, or ``readings`` as
    arrays in its place: ``[trochoid.Readings(x_mm, height_mm, error_mm)]``. Answers
    ``coefficients`` (MPa, each with ``value``, ``se``, ``low``, ``high``), ``runout``,
    ``correlation``, ``rank``, ``condition``, ``rms_mm``.
    """
    return _run("calibrate", case, {"readings": readings})


def stability(case: CaseLike, *, responses: Responses = None) -> answers.StabilityAnswer:
    """Floquet multiplier, limit depth and stability lobe diagram of a cut.

    case: with ``[tool]``, ``[cut]``, ``[force]``, ``[[mode]]`` (or ``[[measured_frf]]``)
    and ``[stability]``; ``responses`` as arrays in place of ``[[measured_frf]]``:
    ``[trochoid.Response(f, H, unit="m/N", axis="x")]``. Answers the multiplier at the case
    and the limit depth; table ``lobes`` (spindle_rpm, axial_depth_mm, multiplier).
    Equations D-8, D-9, D-14.
    """
    return _run("stability", case, {"responses": responses})


def dynamics(case: CaseLike) -> answers.DynamicsAnswer:
    """Time-domain simulation of cutter, table and actuator while they cut, with runout.

    case: with ``[tool]``, ``[cut]``, ``[force]`` and ``[[mode]]``; perhaps ``[actuator]``
    and ``[command]``. Answers peaks and chip areas per flute and whether the motion is
    periodic; tables ``motion`` and ``forces`` of the last revolutions.
    """
    return _run("dynamics", case, {})


def correct(
    case: CaseLike, *, records: Records = None, simulate_controller: bool = False
) -> answers.CorrectAnswer:
    """The motion of the table that makes the flutes cut alike, and the command for it.

    case: with ``[tool]``, ``[cut]``, ``[force]``, ``[runout]`` (or measurements, or
    ``records``), ``[[mode]]`` of the table and ``[actuator]``; perhaps ``[correct]``.
    simulate_controller: run the real-time controller in the loop (``[controller]``).
    """
    options = {"simulate_controller": simulate_controller}
    return _run("correct", case, {"records": records}, **options)


def plan(
    case: CaseLike, *, records: Records = None, readings: ReadingsLike = None
) -> Union[answers.PlanAnswer, answers.PlanOfWallAnswer, answers.PlanOfFinishAnswer]:
    """Which cut to measure next, how to measure and cut a wall, or which feed keeps Ra.

    case: with ``[plan]``; what was measured (``[[measurement]]`` or ``records``, of walls
    ``[[surface_measurement]]`` or ``readings``), or coefficients as if nothing had been. Answers ``cuts``, best first, with the interval
    of each quantity that it would leave. Equations I-20, I-21, E-60, W-9.
    """
    return _run("plan", case, {"records": records, "readings": readings})


def program(case: CaseLike, *, moves: bool = False) -> answers.ProgramAnswer:
    """The moves of a whole NC program in G code.

    case: with ``[tool]``, ``[force]``, ``[program]`` and ``[stock]``. Answers ``dialect``, ``moves``,
    ``tools`` and ``time_s``; the moves are ``answer.tables["moves"]``, of more than a million with
    ``moves=True`` only.
    """
    return _run("program", case, {}, moves=moves)


def modes(
    case: Union[CaseLike, Response],
    *,
    responses: Responses = None,
    kind: str = "",
    modes: int = 0,
    band: Sequence[float] = (),
    dataset: int = 0,
) -> answers.ModesAnswer:
    """Modal parameters from a measured frequency response function (FRF).

    Parameters
    ----------
    case : Case, dict, path of a case file (.toml) or of a measured response, Response
        A case needs ``[frf]``.
    responses : Response or list of Response, optional
        Arrays in place of the files of the case: one is that of ``[frf]``, several are
        those of ``[[measured_frf]]``. The others go with a bare data file:
    kind : {"receptance", "mobility", "accelerance"}
        What was measured, if the file does not say it by its unit.
    modes : int
        How many to fit; 0: chosen.
    band : (float, float)
        Lowest and highest frequency used [Hz].
    dataset : int
        Which response of a universal file, from 1; 0: the only one.

    Returns
    -------
    Answer
        ``modes``: each with ``frequency_Hz``, ``damping_ratio``, ``mass_kg``,
        ``stiffness_N_per_m``, ``damping_Ns_per_m``. Table ``fitted``.
    """
    options = {"kind": kind, "modes": modes, "band": list(band), "dataset": dataset}
    if isinstance(case, Response):
        _only_bare(options, "[frf]: an argument of Response")
        return _run("modes", {}, {"responses": case})
    if _is_bare(case):
        if kind not in ("", "receptance", "mobility", "accelerance"):
            raise ValueError(f"kind = {kind!r}: must be receptance, mobility or accelerance")
        return _bare("modes", case, options)  # type: ignore[arg-type]
    _only_bare(options, "[frf]")
    return _run("modes", case, {"responses": responses})


def actuator(
    case: Union[CaseLike, Step],
    *,
    step: Optional[Step] = None,
    step_um: Optional[float] = None,
    start_s: Optional[float] = None,
) -> answers.ActuatorAnswer:
    """Transfer function (gain and two poles) of an actuator from a measured step.

    case: a case with ``[step]``, a :class:`Step`, or the record of the step itself (CSV)
    with the height of the commanded step [um] and its time [s]. step: arrays in place of
    the file of the case. Answers ``gain``, ``frequency_Hz``,
    ``damping_ratio``, ``time_constants_s``.
    """
    options = {"step_um": step_um, "start_s": start_s}
    if isinstance(case, Step):
        _only_bare(options, "[step]: an argument of Step")
        return _run("actuator", {}, {"step": case})
    if _is_bare(case):
        return _bare("actuator", case, options)  # type: ignore[arg-type]
    _only_bare(options, "[step]")
    return _run("actuator", case, {"step": step})


def _only_bare(options: Mapping[str, Any], table: str) -> None:
    given = [name for name, value in options.items() if value not in ("", 0, [], None)]
    if given:
        raise TypeError(
            f"{', '.join(given)}: goes with a bare data file; in a case it is a key of {table}"
        )
