"""Stability lobes of a tool whose modes are known only so well.

    ./run python examples/python/uncertain_lobes.py

Frequency, stiffness and damping come from a measured response with standard errors; each draw of
them has lobes of its own. What is left is the depth that does not chatter in 95 of 100. Nothing
here was measured: the first cell makes a coarse and noisy response of two modes.
"""

# %% A response that nobody measured: receptance, 20 Hz from line to line, 20 % of noise
import pathlib
import tempfile

import matplotlib.pyplot as plt
import numpy as np
import trochoid

chance = np.random.default_rng(4)
frequency_Hz = np.arange(200, 4000, 20.0)
H = 0
for natural_Hz, stiffness, damping_ratio in ((900, 1.9e7, 0.03), (2500, 8e6, 0.025)):
    r = frequency_Hz / natural_Hz
    H = H + 1 / stiffness / (1 - r**2 + 2j * damping_ratio * r)
noise = chance.normal(size=(2, len(H))) * abs(H) * 0.2 / np.sqrt(2)
H = H + noise[0] + 1j * noise[1]
response = pathlib.Path(tempfile.mkdtemp()) / "tip.csv"
np.savetxt(response, np.c_[frequency_Hz, H.real, H.imag], delimiter=",", comments="",
           header="freq_Hz,re_m/N,im_m/N")

# %% Modes, and how well each is known
found = trochoid.modes(response, modes=2)
print(found)

# %% The cut, and its limit depth over the speed
cut = {"tool": {"teeth": 4, "diameter_mm": 12, "helix_deg": 0},
       "cut": {"engagement": "down", "radial_depth_mm": 3, "axial_depth_mm": 0.5,
               "feed_per_tooth_mm": 0.05, "spindle_rpm": 10000},
       "chip": {"model": "none"},
       "force": {"K_tc_MPa": 1800, "K_rc_MPa": 700, "K_ac_MPa": 300,
                 "K_te_N_per_mm": 12, "K_re_N_per_mm": 15, "K_ae_N_per_mm": 2}}
speeds = np.linspace(6000, 14000, 33)
depths = np.linspace(0.25, 6, 24)


def numbers_of(mode, away=(0, 0, 0)):
    """Frequency, stiffness, damping ratio of a mode, so many standard errors away."""
    names = ("frequency_Hz", "stiffness_N_per_m", "damping_ratio")
    return [mode[name] + by * mode.se[name] for name, by in zip(names, away)]


def limit_depth(numbers):
    """The least depth [mm] of the grid, between its lines, where a vibration grows."""
    case = trochoid.Case(cut | {"mode": [
        {"body": "tool", "axis": "x", "frequency_Hz": f, "stiffness_N_per_m": k,
         "damping_ratio": z} for f, k, z in numbers]})
    mu = abs(trochoid.multiplier(case, speeds[:, None], depths))
    grows = mu > 1
    first = np.where(grows.any(axis=1), grows.argmax(axis=1), len(depths) - 1)
    last = np.maximum(first - 1, 0)
    rows = np.arange(len(speeds))
    rise = np.maximum(mu[rows, first] - mu[rows, last], 1e-12)
    share = np.clip((1 - mu[rows, last]) / rise, 0, 1)
    return depths[last] + share * (depths[first] - depths[last])


best = limit_depth([numbers_of(mode) for mode in found.modes])

# %% Draws: every number by its standard error
draws = np.array([
    limit_depth([numbers_of(mode, chance.normal(size=3)) for mode in found.modes])
    for _ in range(40)])
low, high = np.quantile(draws, [0.05, 0.95], axis=0)
for speed, depth, surely in zip(speeds[::8], best[::8], low[::8]):
    print(f"{speed:6.0f} rpm: limit {depth:.2f} mm, in 95 of 100 above {surely:.2f} mm")

# %% The picture
drawn, axes = plt.subplots(figsize=(9, 4), layout="constrained")
axes.fill_between(speeds, low, high, color="C0", alpha=0.3, label="90 of 100 draws")
axes.plot(speeds, best, color="C0", label="modes as found")
axes.set(xlabel="spindle speed [rpm]", ylabel="limit depth [mm]",
         title="How much of a lobe is certain", ylim=(0, None))
axes.legend(frameon=False)
drawn.savefig("uncertain_lobes.png", dpi=90)
