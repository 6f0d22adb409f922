"""A runout correction designed, and its controller tried before it sees a machine.

    ./run python examples/python/correction_and_controller.py

The case is examples/runout_correction: 8 mm, two flutes, one of them stands out by 28 um.
"""

# %% The correction, and its controller in the loop: 4 kHz, an encoder of 4096 counts
import pathlib

import matplotlib.pyplot as plt
import trochoid

ROOT = pathlib.Path(__file__).resolve().parents[2]
case = trochoid.Case.from_file(ROOT / "examples/runout_correction/case.toml")
designed = trochoid.correct(case, simulate_controller=True)
print(designed)
tried = designed.controller
print(f"the flutes differ by {100 * tried.difference_before:.2f} % before, "
      f"{100 * tried.difference_running:.2f} % running, "
      f"less than 3 % after {tried.turns_to_3_percent} turns")

# %% Would a piezo of half the stroke do? The controller is not to try
short = trochoid.correct(case.with_({"actuator.stroke_um": [0, 30]}), simulate_controller=True)
print(short.ok, short.message)

# %% The picture
drawn, (forces, run) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
table = designed.tables["forces"]
forces.plot(table["angle_deg"], table["Fy_before_N"], color="0.6", label="before")
forces.plot(table["angle_deg"], table["Fy_after_N"], color="C0", label="after")
forces.set(xlabel="spindle angle [deg]", ylabel="Fy on the tool [N]", title="Both flutes alike")
forces.legend(frameon=False)
steps = designed.tables["controller"]
middle_um = 30  # of the stroke
run.plot(steps["time_s"], steps["command_um"] - middle_um, color="C1", label="command")
run.plot(steps["time_s"], steps["table_um"], color="C2", lw=0.8, label="table")
run.set(xlabel="time [s]", ylabel="from mid-stroke [um]", title="The controller begins")
run.legend(frameon=False)
drawn.savefig("correction_and_controller.png", dpi=90)
