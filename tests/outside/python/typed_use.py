"""What mypy must accept; it is not run."""

import numpy as np

import trochoid

case: trochoid.Case = trochoid.Case.from_file("case.toml").with_({"cut.spindle_rpm": 900})
answer: trochoid.Answer = trochoid.identify(
    case, records=[trochoid.Record(np.zeros((9, 3)), sample_rate_Hz=1e4)]
)
good: bool = answer.ok
codes: list[str] = [warning.code for warning in answer.warnings]
force: np.ndarray = trochoid.forces({"tool": {"teeth": 2}}, [0, 15.5])
