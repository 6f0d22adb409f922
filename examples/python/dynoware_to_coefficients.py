"""From a DynoWare file to cutting coefficients, and on to the next cut.

    ./run python examples/python/dynoware_to_coefficients.py

Nothing here was measured: the first cell writes two records as DynoWare exports them, with
noise, offsets and a tooth that stands back. Begin with the second cell for files of yours.
"""

# %% Two records that nobody cut: two feeds, one tool
import pathlib
import tempfile

import matplotlib.pyplot as plt
import numpy as np
import trochoid

tool = {"teeth": 2, "diameter_mm": 12, "helix_deg": 30}
cut = {"engagement": "slot", "axial_depth_mm": 2, "feed_per_tooth_mm": 0.05, "spindle_rpm": 1500}
truth = {"K_tc_MPa": 1800, "K_rc_MPa": 700, "K_ac_MPa": 300,
         "K_te_N_per_mm": 12, "K_re_N_per_mm": 15, "K_ae_N_per_mm": 2}
true_case = trochoid.Case({"tool": tool, "cut": cut, "force": truth,
                           "runout": {"radial_offsets_mm": [0, -0.012]}})
rate_Hz = 5000
chance = np.random.default_rng(2)


def write_dynoware(file, case, rpm):
    """A table dynamometer feels the reaction, so the signs turn; air, cut, air."""
    time_s = np.arange(rate_Hz) / rate_Hz
    force = -trochoid.forces(case, 40 + 6 * rpm * time_s)
    force[abs(time_s - 0.5) > 0.3] = 0
    force += chance.normal(0, 8, force.shape) + [3, -2, 5]
    head = ["DynoWare,Version 2.5.1.2", "Path:,D:\\", f"Sampling rate [Hz]:,{rate_Hz}",
            "Delay time [s]:,0", f"Samples per channel:,{rate_Hz}", "Cycle No:,1",
            "Time,Fx,Fy,Fz", "s,N,N,N"]
    rows = [f"{t:.6g},{x:.5g},{y:.5g},{z:.5g}" for t, (x, y, z) in zip(time_s, force)]
    file.write_text("\n".join(head + rows) + "\n")


folder = pathlib.Path(tempfile.mkdtemp())
write_dynoware(folder / "slot_50um.txt", true_case, 1500)
write_dynoware(folder / "slot_80um.txt", true_case.with_({"cut.feed_per_tooth_mm": 0.08}), 1500)

# %% What one record tells
case = trochoid.Case({
    "tool": tool, "cut": cut,
    "dynamometer": {"axes": ["-x", "-y", "-z"]},
    "measurement": [{"file": str(folder / "slot_50um.txt")}],
    "identify": {"chip_models": ["none", "trochoidal"]},
})
found = trochoid.identify(case)
print(found)
fit = found.fits[-1]
names = list(truth)
for name in names:
    one = getattr(fit.coefficients, name)
    print(f"{name:15} {one.value:8.1f}   95 %: {one.low:.1f} to {one.high:.1f}   true {truth[name]}")

# %% The other feed, from those numbers alone
coefficients = {name: getattr(fit.coefficients, name).value for name in names}
next_case = case.with_({
    "force": coefficients,
    "runout": {"radial_offsets_mm": list(fit.runout.radial_offsets_mm)},
    "cut.feed_per_tooth_mm": 0.08,
    "measurement": [{"file": str(folder / "slot_80um.txt")}],
    "identify": None,
})
predicted = trochoid.simulate(next_case)
compared = predicted.comparison[0]
print(f"differs by {compared.rms_N:.1f} N rms from a record of {compared.measured_rms_N:.0f} N")

# %% The picture: left the fit, right the prediction
angle = np.arange(0, 360, 1.0)
recorded = np.loadtxt(folder / "slot_80um.txt", delimiter=",", skiprows=8)
cutting = abs(recorded[:, 0] - 0.5) <= 0.3
turn = ((6 * 1500 * recorded[:, 0] + 40) % 360)[cutting]
measured = -recorded[:, 2]
measured = (measured - measured[~cutting].mean())[cutting]
drawn, (left, right) = plt.subplots(1, 2, figsize=(10, 4), sharey=True, layout="constrained")
fitted = found.tables["fitted"]
left.plot(fitted["angle_deg"] % 360, fitted["Fy_measured_N"], ".", ms=2, color="0.7")
order = np.argsort(fitted["angle_deg"] % 360, kind="stable")
left.plot((fitted["angle_deg"] % 360)[order], fitted["Fy_trochoidal_N"][order], color="C0")
left.set(title="0.05 mm per tooth: fitted", xlabel="spindle angle [deg]", ylabel="Fy on the tool [N]")
right.plot(turn, measured, ".", ms=2, color="0.7", label="record, offset taken out")
right.plot(angle, trochoid.forces(next_case.with_({"measurement": None}), angle)[:, 1], color="C1",
           label="predicted")
right.set(title="0.08 mm per tooth: predicted, nothing fitted", xlabel="spindle angle [deg]")
right.legend(frameon=False)
drawn.savefig("dynoware_to_coefficients.png", dpi=90)
