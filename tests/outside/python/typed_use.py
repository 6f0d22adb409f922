"""What mypy must accept; it is not run."""

from concurrent.futures import ThreadPoolExecutor
from typing import Optional, Tuple, assert_type

import numpy as np

import trochoid
from trochoid import answers, dicts

case: trochoid.Case = trochoid.Case.from_file("case.toml").with_({"cut.spindle_rpm": 900})
answer: trochoid.Answer = trochoid.identify(
    case, records=[trochoid.Record(np.zeros((9, 3)), sample_rate_Hz=1e4)]
)
good: bool = answer.ok
response = trochoid.Response(np.arange(9.0), np.zeros(9, complex), unit="m/N", axis="x")
lobes: trochoid.Answer = trochoid.stability(case, responses=[response])
tip: trochoid.Answer = trochoid.modes(response)
drive: trochoid.Answer = trochoid.actuator(trochoid.Step([0, 1], [0, 1], step_um=1.0))
wall: trochoid.Answer = trochoid.calibrate(case, readings=trochoid.Readings([1], [1], [0.1]))
codes: list[str] = [warning.code for warning in answer.warnings]
force: np.ndarray = trochoid.forces({"tool": {"teeth": 2}}, [0, 15.5])
over = {"cut.spindle_rpm": np.linspace(800, 900, 3), "tool.teeth": [2, 3]}
with ThreadPoolExecutor(2) as threads:
    try:
        swept = trochoid.sweep(
            case, over, command="simulate", take=["result.peak_xy_N"], executor=threads
        )
    except trochoid.SweepUnfinished as broken:
        left: int = broken.rows - broken.done
status: np.ndarray = swept.tables["sweep"]["status"]

# What an answer holds has a type of its own, and not Any.
assert_type(trochoid.simulate(case).peak_xy_N, float)
fit = trochoid.identify(case).fits[0]
assert_type(fit, answers.Fit)
assert_type(fit.coefficients.K_tc_MPa, Optional[answers.Estimate])
assert_type(fit.coefficients["K_tc_MPa"], Optional[answers.Estimate])
content: dicts.Identify = trochoid.identify(case).to_dict()
assert_type(content["fits"][0]["chip_model"], str)
assert_type(swept.keys, Tuple[str, ...])
planned = trochoid.plan(case)
if isinstance(planned, answers.PlanAnswer):
    assert_type(planned.cuts[0].turns, int)
