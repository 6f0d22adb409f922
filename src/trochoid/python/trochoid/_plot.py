"""The main picture of each answer, with matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ._answer import Answer


def figure(answer: Answer) -> Figure:
    """A figure of pyplot: ``plt.show()`` shows it, ``savefig`` writes it."""
    import matplotlib.pyplot as plt

    if not answer.tables:
        raise ValueError(f"there is nothing to show: {answer.message}")
    drawn, axes = plt.subplots(figsize=(9, 4.5), layout="constrained")
    _PICTURES[answer.command_name](answer, axes)
    axes.set_title(answer._core.title or answer.command_name)
    handles, labels = axes.get_legend_handles_labels()
    if handles:
        axes.legend(handles, labels, frameon=False)
    return drawn


def _lines(axes: Axes, table: Any, x: str, names: list[str], **style: Any) -> None:
    for number, name in enumerate(names):
        axes.plot(table[x], table[name], color=f"C{number}", label=name, **style)
    axes.set_xlabel(x)


def _forces(answer: Answer, axes: Axes) -> None:
    table = answer.tables["forces"]
    names = [name for name in table if name in ("Fx_N", "Fy_N", "Fz_N", "F_normal_N")]
    _lines(axes, table, "angle_deg", names)
    axes.set_ylabel("force on the tool [N]")


def _identify(answer: Answer, axes: Axes) -> None:
    if "fitted" not in answer.tables:
        raise ValueError(f"no fit to show: {answer.message}")
    table = answer.tables["fitted"]
    first = table["run"] == table["run"][0]
    angle = table["angle_deg"][first] % 360
    order = np.argsort(angle, kind="stable")
    model = answer.chosen or "trochoidal"
    for number, axis in enumerate("xyz"):
        measured, fitted = f"F{axis}_measured_N", f"F{axis}_{model}_N"
        if measured not in table or fitted not in table:
            continue
        colour = f"C{number}"
        axes.plot(angle, table[measured][first], ".", ms=2, alpha=0.4, color=colour)
        axes.plot(
            angle[order], table[fitted][first][order], color=colour, label=f"F{axis} {model}"
        )
    axes.set(xlabel="angle_deg (of one turn)", ylabel="force [N]: dots measured")


def _surface(answer: Answer, axes: Axes) -> None:
    table = answer.tables["surface"]
    _map(axes, table, "x_mm", "height_mm", "error_mm")


def _map(axes: Axes, table: Any, x: str, y: str, value: str) -> None:
    known = np.isfinite(table[value])
    few = known.sum() < 1000
    shown = axes.scatter(
        table[x][known], table[y][known], c=table[value][known], s=90 if few else 9, marker="s"
    )
    axes.figure.colorbar(shown, ax=axes, label=value)
    axes.set(xlabel=x, ylabel=y)


def _calibrate(answer: Answer, axes: Axes) -> None:
    if "trace" in answer.tables:
        trace = answer.tables["trace"]
        first = trace["measurement"] == trace["measurement"][0]
        for name in ("measured", "fitted"):
            axes.plot(trace["x_mm"][first], 1e3 * trace[f"{name}_mm"][first], lw=1, label=name)
        axes.set(xlabel="x_mm, along the feed", ylabel="height of the surface, um")
        return
    table = answer.tables["residual"]
    fitted, measured = table["fitted_mm"], table["measured_mm"]
    ends = [np.nanmin(fitted), np.nanmax(fitted)]
    axes.plot(fitted, measured, ".", ms=4, label="readings")
    axes.plot(ends, ends, color="grey", lw=1, label="equal")
    axes.set(xlabel="fitted_mm", ylabel="measured_mm, positive: material left")


def _stability(answer: Answer, axes: Axes) -> None:
    tables = answer.tables
    if "lobes" in tables:
        table = tables["lobes"]
        speeds, depths = np.unique(table["spindle_rpm"]), np.unique(table["axial_depth_mm"])
        if len(speeds) > 1 and len(depths) > 1:
            mu = (table["spindle_rpm"], table["axial_depth_mm"], table["multiplier"])
            axes.tricontourf(*mu, levels=[0, 1, np.inf], colors=["#d8ecd8", "#f3d6d2"])
    for name in ("limit", "zeroth_order", "multi_frequency"):
        if name in tables:
            table = tables[name]
            order = np.argsort(table["spindle_rpm"], kind="stable")
            axes.plot(
                table["spindle_rpm"][order], table["limit_depth_mm"][order], ".-", label=name
            )
    axes.set(xlabel="spindle_rpm", ylabel="axial depth [mm]; green: stable")


def _modes(answer: Answer, axes: Axes) -> None:
    table = answer.tables["fitted"]
    names = list(table)
    measured = np.hypot(table[names[1]], table[names[2]])
    fitted = np.hypot(table[names[3]], table[names[4]])
    axes.semilogy(table["frequency_Hz"], measured, ".", ms=3, label="measured")
    axes.semilogy(table["frequency_Hz"], fitted, label="fitted")
    axes.set(xlabel="frequency_Hz", ylabel=names[1].replace("re_", "modulus, "))


def _actuator(answer: Answer, axes: Axes) -> None:
    _lines(
        axes, answer.tables["fitted"], "time_s", ["command_um", "position_um", "fitted_um"]
    )
    axes.set_ylabel("um")


def _dynamics(answer: Answer, axes: Axes) -> None:
    names = ["x_tool_um", "y_tool_um", "x_table_um", "y_table_um"]
    table = answer.tables["motion"]
    _lines(axes, table, "angle_deg", [name for name in names if name in table])
    axes.set_ylabel("um")


def _correct(answer: Answer, axes: Axes) -> None:
    table = answer.tables["forces"]
    for number, axis in enumerate("xy"):
        colour = f"C{number}"
        before, after = f"F{axis}_before_N", f"F{axis}_after_N"
        axes.plot(table["angle_deg"], table[before], ":", color=colour, label=before)
        axes.plot(table["angle_deg"], table[after], color=colour, label=after)
    axes.set(xlabel="angle_deg", ylabel="force on the tool [N]")


def _plan(answer: Answer, axes: Axes) -> None:
    if "error_map" in answer.tables:
        names = ("feed_per_tooth_mm", "radial_depth_mm", "peak_error_um")
        _map(axes, answer.tables["error_map"], *names)
        return
    table = answer.tables["plan"]
    if "Ra_um" in table:
        for name in ("Ra_um", "Ra_within_um", "Ra_alike_um"):
            axes.plot(table["feed_per_tooth_mm"], table[name], label=name)
        axes.set(xlabel="feed_per_tooth_mm", ylabel="Ra [um]")
        return
    axes.plot(table["peak_force_N"], table["narrows"], ".")
    axes.set(xlabel="peak_force_N", ylabel="how many times narrower the intervals become")


def _sweep(answer: Answer, axes: Axes) -> None:
    """Each number that was taken, over the first key whose values are numbers and differ."""
    table = answer.tables["sweep"]
    numbers = {n: table[n] for n in table if table[n].dtype.kind == "f"}
    swept = [*answer.result["keys"], *answer.result["drawn"]]
    keys = [key for key in swept if key in numbers and np.ptp(numbers[key]) > 0]
    taken = [name for name in numbers if name not in (*swept, "draw")]
    if not keys or not taken:
        raise ValueError("there are no numbers to show")
    line = "-" if len(keys) == 1 and not answer.result["drawn"] and answer.method in ("grid", "list") else ""
    order = np.argsort(table[keys[0]], kind="stable")
    for number, name in enumerate(taken):
        axes.plot(
            table[keys[0]][order], table[name][order], "." + line, color=f"C{number}", label=name
        )
    axes.set_xlabel(keys[0])


def _program(answer: Answer, axes: Axes) -> None:
    if "steps" not in answer.tables:
        raise ValueError(f"no forces to show: {answer.message}")
    table = answer.tables["steps"]
    cuts = table["a_p_mm"] > 0
    dots = axes.scatter(
        table["x_mm"][cuts], table["y_mm"][cuts], s=4, c=table["peak_xy_N"][cuts]
    )
    axes.figure.colorbar(dots, label="largest force across the tool [N]")
    axes.set_aspect("equal")
    axes.set_xlabel("x_mm")
    axes.set_ylabel("y_mm")


_PICTURES = {
    "simulate": _forces,
    "identify": _identify,
    "surface": _surface,
    "calibrate": _calibrate,
    "stability": _stability,
    "modes": _modes,
    "actuator": _actuator,
    "dynamics": _dynamics,
    "correct": _correct,
    "plan": _plan,
    "program": _program,
    "sweep": _sweep,
}
