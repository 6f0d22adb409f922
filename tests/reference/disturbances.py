"""Records with one thing wrong each, and what `identify` says of them.

Three tools, a number of kinds of disturbance, some seeds of each: is the truth in the 95 %
interval of every coefficient, and if it is not, does the answer say so? A coefficient is
wrong where the truth is farther outside its interval than 1 %. A record is wrong in silence
where a coefficient is wrong and the verdict is "usable" without more.

Usage: disturbances.py [--seeds N] [--only KIND,...] [--list] [--most-silent N]
The table stands in docs/theory/identification.md. The exit code is 1 where a kind is named in
less than half of its answers, and with --most-silent where more answers are wrong in silence.
"""
import argparse
import concurrent.futures
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy

from program import PROGRAM, toml

TRUTH = {"K_tc_MPa": 1900.0, "K_rc_MPa": 800.0, "K_ac_MPa": 300.0,
         "K_te_N_per_mm": 22.0, "K_re_N_per_mm": 18.0, "K_ae_N_per_mm": 4.0}
WITHIN = 300  # s of one run
FINE = 1440  # angles of a turn

TOOLS = {
    "two flutes, slot": {
        "tool": {"shape": "cylinder", "teeth": 2, "diameter_mm": 12.0, "helix_deg": 30.0},
        "runout": {"radial_offsets_mm": [0.0, -0.011]},
        "cut": {"engagement": "slot", "axial_depth_mm": 3.0, "feed_per_tooth_mm": 0.06,
                "spindle_rpm": 2400}},
    "three flutes, half immersion, up": {
        "tool": {"shape": "cylinder", "teeth": 3, "diameter_mm": 12.0, "helix_deg": 30.0},
        "runout": {"radial_offsets_mm": [0.0, -0.006, 0.005]},
        "cut": {"engagement": "up", "radial_depth_mm": 6.0, "axial_depth_mm": 3.0,
                "feed_per_tooth_mm": 0.06, "spindle_rpm": 3000}},
    "four flutes, quarter immersion, down": {
        "tool": {"shape": "cylinder", "teeth": 4, "diameter_mm": 16.0, "helix_deg": 30.0},
        "runout": {"eccentricity_mm": 0.014, "angle_deg": 50.0},
        "cut": {"engagement": "down", "radial_depth_mm": 4.0, "axial_depth_mm": 3.0,
                "feed_per_tooth_mm": 0.06, "spindle_rpm": 2800}},
}


class Cut:
    """The forces of one tool over a turn, as the program computes them."""

    def __init__(self, name, **changes):
        self.name = name
        self.case = {table: dict(keys) for table, keys in TOOLS[name].items()}
        for table, keys in changes.items():
            if table == "runout":
                self.case[table] = keys
            else:
                self.case[table] = {**self.case[table], **keys}
        if self.case["cut"]["engagement"] == "arcs":
            self.case["cut"].pop("radial_depth_mm", None)
        self.rpm = self.case["cut"]["spindle_rpm"]
        self.teeth = self.case["tool"]["teeth"]
        sampled = {**self.case, "force": {"law": "linear_edge", **TRUTH},
                   "sampling": {"samples_per_rev": FINE, "revolutions": 1}}
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "truth.toml").write_text(text_of(sampled))
            subprocess.run([PROGRAM, "simulate", "truth.toml", "-o", "out", "-q", "--no-report"],
                           cwd=folder, check=True, timeout=WITHIN)
            rows = list(csv.DictReader((folder / "out/forces.csv").open()))
        force = numpy.array([[float(r[c]) for c in ("Fx_N", "Fy_N", "Fz_N")] for r in rows])
        self.lines = numpy.fft.rfft(force, axis=0) / FINE
        self.size = numpy.sqrt((force ** 2).sum(axis=1).mean())

    def between(self, sines):
        """The same where the stock lies within these bounds of sin(immersion angle) only: the
        cutter enters it, or leaves it, through a wall that stands across the path."""
        low, high = (numpy.degrees(numpy.arcsin(numpy.clip(s, -1, 1))) for s in sines)
        R = self.case["tool"]["diameter_mm"] / 2
        full = numpy.degrees(numpy.arccos(1 - self.case["cut"].get("radial_depth_mm", 2 * R) / R))
        arc = (180 - full, 180) if self.case["cut"]["engagement"] == "down" else (0, full)
        arcs = [[max(a, arc[0]), min(b, arc[1])] for a, b in ((low, high), (180 - high, 180 - low))]
        if arcs[0][1] == arcs[1][0]:
            arcs = [[arcs[0][0], arcs[1][1]]]
        arcs = [[float(a), float(b)] for a, b in arcs if b - a > 1e-9]
        return Cut(self.name, cut={"engagement": "arcs", "arcs_deg": arcs}) if arcs else None

    def at(self, turns, response=None):
        """Forces where the spindle has made so many turns; response(axis, Hz) of the sensor."""
        out = numpy.empty((len(turns), 3))
        finer = 16 * FINE
        k = numpy.arange(len(self.lines))
        for axis in range(3):
            lines = self.lines[:, axis]
            if response:
                lines = lines * response(axis, k * self.rpm / 60)
            wave = numpy.fft.irfft(lines, finer) * finer
            out[:, axis] = numpy.interp(turns % 1, numpy.arange(finer) / finer, wave, period=1)
        return out


def text_of(case):
    lines = []
    for table, keys in case.items():
        for one in keys if isinstance(keys, list) else [keys]:
            lines.append(f"[[{table}]]" if isinstance(keys, list) else f"[{table}]")
            lines += [f"{key} = {toml(value)}" for key, value in one.items()]
    return "\n".join(lines) + "\n"


class Record:
    """Air, a cut of forty turns, air again; white noise of 2 % of the force."""

    def __init__(self, cut, seed, per_turn=200.0, air=0.12, noise=0.02, response=None, turns=None):
        self.cut = cut
        self.random = numpy.random.default_rng(seed)
        self.rate = per_turn * cut.rpm / 60
        cutting = 40 * 60 / cut.rpm
        self.time = numpy.arange(int((2 * air + cutting) * self.rate)) / self.rate
        self.inside = (self.time >= air) & (self.time < air + cutting)
        self.part = numpy.clip((self.time - air) / cutting, 0, 1)  # of the cut
        self.turns = (self.time - air) * cut.rpm / 60 + self.random.uniform()
        if turns:
            self.turns = turns(self)
        self.force = -cut.at(self.turns, response) * self.inside[:, None]
        self.frf = None  # rows of the file that the case names
        self.starts = None  # of the channels [s], where the file tells them
        self.add(noise * cut.size * self.random.standard_normal(self.force.shape))

    def add(self, what):
        self.force = self.force + what
        return self

    def scaled(self, by):
        self.force = self.force * by
        return self


def oscillator(frequency, damping):
    return lambda f: 1 / (1 - (f / frequency) ** 2 + 2j * damping * f / frequency)


def ringing(per_turn):
    modes = [oscillator(f, 0.03) for f in (880.0, 1040.0, 1310.0)]
    return lambda cut, seed: Record(cut, seed, per_turn, response=lambda axis, f: modes[axis](f))


def two_modes(cut, seed):
    low = [oscillator(f, 0.03) for f in (820.0, 960.0, 1200.0)]
    high = [oscillator(f, 0.03) for f in (1450.0, 1700.0, 2100.0)]
    return Record(cut, seed, response=lambda axis, f: 0.7 * low[axis](f) + 0.3 * high[axis](f))


def given_frf(high):
    """Rings, and the case gives the response with its frequencies so much too high."""
    modes = [(880.0, 0.03), (1040.0, 0.03), (1310.0, 0.03)]

    def record(cut, seed):
        true = [oscillator(*mode) for mode in modes]
        told = [oscillator(f * (1 + high), damping) for f, damping in modes]
        r = Record(cut, seed, response=lambda axis, f: true[axis](f))
        f = numpy.arange(0.0, 3001.0, 2.0)
        r.frf = numpy.column_stack([f] + [part for axis in range(3)
                                          for part in (told[axis](f).real, told[axis](f).imag)])
        return r
    return record


def a_pass(cut, seed):
    """Through a block: the arc of the cut grows over the first radius of feed, to the last sine
    of the immersion angle, and goes in the same way at the far end."""
    r = Record(cut, seed)
    levels = 40
    R = cut.case["tool"]["diameter_mm"] / 2
    speed = cut.case["cut"]["feed_per_tooth_mm"] * cut.teeth * cut.rpm / 60
    ramp = R / speed  # s
    whole = 40 * 60 / cut.rpm + 2 * ramp
    r.time = numpy.arange(int((0.24 + whole) * r.rate)) / r.rate
    travelled = (r.time - 0.12) / ramp
    entered = numpy.clip(1 - travelled, 0, 1)
    left = numpy.clip(whole / ramp - travelled, 0, 1)
    r.turns = (r.time - 0.12) * cut.rpm / 60 + r.random.uniform()
    r.force = numpy.zeros((len(r.time), 3))
    for part, bounds in ((entered, lambda s: (s, 1)), (left, lambda s: (0, s))):
        ends = part * levels
        waves = [cut.between(bounds(i / levels)) for i in range(levels + 1)]
        for i in range(levels):
            here = numpy.flatnonzero((ends > i) & (ends < i + 1))
            for one, weight in ((waves[i], i + 1 - ends), (waves[i + 1], ends - i)):
                if one is not None:
                    r.force[here] -= one.at(r.turns[here]) * weight[here, None]
    inside = (entered == 0) & (left == 1)
    r.force[inside] -= cut.at(r.turns[inside])
    return r.add(0.02 * cut.size * r.random.standard_normal(r.force.shape))


def from_the_entry_on(cut, seed):
    """The same, triggered a third into the entry and stopped a third before the end of the exit."""
    r = a_pass(cut, seed)
    R = cut.case["tool"]["diameter_mm"] / 2
    ramp = R / (cut.case["cut"]["feed_per_tooth_mm"] * cut.teeth * cut.rpm / 60)
    here = (r.time > 0.12 + ramp / 3) & (r.time < r.time[-1] - 0.12 - ramp / 3)
    r.time, r.force = r.time[here], r.force[here]
    return r


def low_pass(cut, seed):
    return Record(cut, seed, response=lambda axis, f: oscillator(280.0, 0.7)(f))


def coloured(cut, seed):
    r = Record(cut, seed)
    white = r.random.standard_normal(r.force.shape)
    red = numpy.zeros_like(white)
    for i in range(1, len(white)):
        red[i] = 0.95 * red[i - 1] + white[i]
    return r.add(0.02 * cut.size * red)


def speed(change):
    """change(part of the cut): of the speed, relative."""
    def turns(r):
        step = r.cut.rpm / 60 / r.rate * (1 + change(r.part))
        return r.random.uniform() + numpy.cumsum(step)
    return lambda cut, seed: Record(cut, seed, turns=turns)


def offsets_without_air(cut, seed):
    r = Record(cut, seed, air=0.0)
    return r.add(cut.size * r.random.uniform(-0.2, 0.2, 3))


def drift(cut, seed):
    r = Record(cut, seed)
    bend = numpy.exp(-r.time / (0.3 * r.time[-1]))[:, None]
    return r.add(0.15 * cut.size * bend * numpy.array([1.0, -0.7, 0.5]))


def gain(cut, seed):
    return Record(cut, seed).scaled(numpy.array([1.0, 1.03, 1.0]))


def cross_talk(cut, seed):
    r = Record(cut, seed)
    x, y, z = r.force.T
    r.force = numpy.array([x + 0.02 * y, y, z]).T
    return r


def wear(cut, seed):
    r = Record(cut, seed)
    return r.scaled(1 + 0.08 * r.part[:, None])


def line(frequency, size):
    """A line in all channels; frequency(cut) [Hz]."""
    def record(cut, seed):
        r = Record(cut, seed)
        phase = r.random.uniform(0, 2 * numpy.pi, 3)
        wave = numpy.sin(2 * numpy.pi * frequency(cut) * r.time[:, None] + phase)
        return r.add(size * cut.size * wave)
    return record


def in_the_cut(frequency, size):
    def record(cut, seed):
        r = Record(cut, seed)
        wave = numpy.sin(2 * numpy.pi * frequency(cut) * r.time[:, None] + r.random.uniform(0, 6, 3))
        return r.add(size * cut.size * wave * r.inside[:, None])
    return record


def stuck(cut, seed):
    r = Record(cut, seed)
    for start in numpy.flatnonzero(r.random.uniform(size=len(r.time)) < 0.004):
        r.force[start:start + 12] = r.force[start]
    return r


def late_channels(cut, seed):
    r = Record(cut, seed)
    by = 3e-4 * r.rate  # samples
    at = numpy.arange(len(r.time))
    r.force[:, 1] = numpy.interp(at - by, at, r.force[:, 1])
    return r


def starts_apart(cut, seed):
    """The channels begin up to 1.4 ms apart, and the file says so."""
    r = Record(cut, seed)
    r.starts = numpy.array([0.0, 9e-4, -5e-4])
    for axis, start in enumerate(r.starts):
        turns = r.turns + start * cut.rpm / 60
        inside = (r.time + start >= 0.12) & (r.time + start < 0.12 + 40 * 60 / cut.rpm)
        r.force[:, axis] = -cut.at(turns)[:, axis] * inside
    return r.add(0.02 * cut.size * r.random.standard_normal(r.force.shape))


KINDS = {
    "white noise of 2 %": Record,
    "white noise of 8 %": lambda cut, seed: Record(cut, seed, noise=0.08),
    "coloured noise": coloured,
    "rings, 131 samples a turn": ringing(131.0),
    "rings, 200 samples a turn": ringing(200.0),
    "rings, 214.3 samples a turn": ringing(10000 / 2800 * 60),
    "rings, 300 samples a turn": ringing(300.0),
    "rings in two modes": two_modes,
    "rings, response given": given_frf(0.0),
    "rings, response 1 % too high": given_frf(0.01),
    "low-pass at 280 Hz": low_pass,
    "entry and exit": a_pass,
    "entry and exit, no air": from_the_entry_on,
    "speed sags by 0.2 %": speed(lambda part: -0.002 * part),
    "speed sags by 1 %": speed(lambda part: -0.01 * part),
    "speed ripples by 1 %": speed(lambda part: 0.01 * numpy.sin(6 * numpy.pi * part)),
    "offsets, no air": offsets_without_air,
    "drift that is no line": drift,
    "gain of y 3 % high": gain,
    "cross talk of 2 %": cross_talk,
    "forces grow by 8 %": wear,
    "hum between the lines": line(lambda cut: 50.0 if cut.rpm != 3000 else 60.0, 0.1),
    "hum on a line": line(lambda cut: cut.rpm / 60, 0.1),
    "hum on the second line": line(lambda cut: cut.rpm / 30, 0.1),
    "chatter": in_the_cut(lambda cut: 7.37 * cut.rpm / 60, 0.25),
    "stuck samples, 5 %": stuck,
    "y is late by 0.3 ms": late_channels,
    "channels start 1.4 ms apart": starts_apart,
}
DEAD = "a tooth that never cuts"
NAMED = {  # the warning that says what it is
    "drift that is no line": "curved_drift", "gain of y 3 % high": "channel_gain",
    "cross talk of 2 %": "cross_talk", "forces grow by 8 %": "changes_within",
    "chatter": "chatter", "stuck samples, 5 %": "dropouts", DEAD: "idle_tooth",
    "channels start 1.4 ms apart": "channels_aligned",
}


def dead_tooth(name):
    """Its neighbours cut what it leaves."""
    teeth = TOOLS[name]["tool"]["teeth"]
    return Cut(name, runout={"radial_offsets_mm": [0.0, -0.08] + [0.0] * (teeth - 2)})


def asked(cut, record, folder):
    case = {table: keys for table, keys in cut.case.items() if table != "runout"}
    case["force"] = {"law": "linear_edge"}
    case["dynamometer"] = {"axes": ["-x", "-y", "-z"]}
    case["measurement"] = [{"file": "record.lvm" if record.starts is not None else "record.csv"}]
    if record.frf is not None:
        case["dynamometer"]["frf"] = "response.csv"
        names = [f"H{axis}{axis}_{part}" for axis in (1, 2, 3) for part in ("re", "im")]
        numpy.savetxt(folder / "response.csv", record.frf, fmt="%.9g", delimiter=",",
                      header="freq_Hz," + ",".join(names), comments="")
    (folder / "case.toml").write_text(text_of(case))


def written(record, folder):
    if record.starts is None:
        with (folder / "record.csv").open("w") as file:
            file.write("time_s,Fx_N,Fy_N,Fz_N\n")
            numpy.savetxt(file, numpy.column_stack([record.time, record.force]), fmt="%.9g",
                          delimiter=",")
        return
    rows = {"Channels": ["3"], "Samples": [str(len(record.time))] * 3, "Y_Unit_Label": ["N"] * 3,
            "X_Dimension": ["Time"] * 3, "X0": [f"{start:.9g}" for start in record.starts],
            "Delta_X": [f"{1 / record.rate:.12g}"] * 3}
    with (folder / "record.lvm").open("w") as file:
        file.write("LabVIEW Measurement\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\n"
                   "Decimal_Separator\t.\nMulti_Headings\tYes\nX_Columns\tNo\n"
                   "***End_of_Header***\n\n")
        for name, values in rows.items():
            file.write("\t".join([name, *values]) + "\n")
        file.write("***End_of_Header***\nX_Value\tFx\tFy\tFz\tComment\n")
        for row in record.force:
            file.write("\t" + "\t".join(f"{value:.9g}" for value in row) + "\n")


def identified(cut, record, keep=None):
    """Exit code and summary."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(keep or name)
        folder.mkdir(exist_ok=True)
        asked(cut, record, folder)
        written(record, folder)
        done = subprocess.run([PROGRAM, "identify", "case.toml", "-o", "out", "-q", "--no-report"],
                              cwd=folder, capture_output=True, text=True, timeout=WITHIN, check=False)
        file = folder / "out/summary.json"
        return done.returncode, json.loads(file.read_text()) if file.exists() else None


def judged(summary):
    """({key: (value, low, high)} of what is wrong, verdict)"""
    result = summary["result"]
    fit = next(f for f in result["fits"] if f["chip_model"] == result["chosen"])
    misses = {}
    for key, truth in TRUTH.items():
        found = fit["coefficients"].get(key)
        if found is None or found.get("value") is None or found.get("low") is None:
            continue
        outside = max(found["low"] - truth, truth - found["high"])
        if outside > 0.01 * truth:
            misses[key] = (found["value"], found["low"], found["high"])
    return misses, result["verdict"]


def one(kind, tool, seed, keep=None):
    cut = dead_tooth(tool) if kind == DEAD else Cut(tool)
    make = Record if kind == DEAD else KINDS[kind]
    code, summary = identified(cut, make(cut, 1000 + seed), keep)
    if code != 0 or summary is None or summary["status"] != "ok":
        return {"refused": True, "message": summary["message"] if summary else "?"}
    misses, verdict = judged(summary)
    codes = [w["code"] for w in summary["warnings"]]
    return {"refused": False, "misses": misses, "verdict": verdict,
            "silent": verdict == "usable" and bool(misses), "codes": codes, "message": summary["message"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--only", default="")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--most-silent", type=int, default=10 ** 6)
    chosen = parser.parse_args()
    kinds = [k for k in [*KINDS, DEAD]
             if not chosen.only or any(part in k for part in chosen.only.split(","))]
    work = [(kind, tool, seed) for kind in kinds for tool in TOOLS
            for seed in range(chosen.seeds)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        answers = dict(zip(work, pool.map(lambda w: one(*w), work)))
    print("| kind | right | doubted | refused | wrong in silence | named |\n|---|---|---|---|---|---|")
    unnamed = 0
    for kind in kinds:
        these = [a for (k, _, _), a in answers.items() if k == kind]
        refused = sum(a["refused"] for a in these)
        silent = sum(a.get("silent", False) for a in these)
        right = sum(not a["refused"] and not a["misses"] for a in these)
        named = sum(NAMED[kind] in a.get("codes", []) for a in these) if kind in NAMED else ""
        unnamed += kind in NAMED and named < len(these) / 2
        print(f"| {kind} | {right} | {len(these) - right - refused - silent} | {refused} | {silent} | {named} |")
    for (kind, tool, seed), a in answers.items():
        if chosen.list and (a["refused"] or a["misses"]):
            print(f"\n{kind}, {tool}, seed {seed}: {a.get('verdict', 'refused')}"
                  f"\n  {a['message'][:200]}\n  {a.get('codes')}")
            for key, (value, low, high) in a.get("misses", {}).items():
                print(f"    {key} {value:.4g} in {low:.4g} to {high:.4g}, true {TRUTH[key]:g}")


    return unnamed > 0 or sum(a.get("silent", False) for a in answers.values()) > chosen.most_silent


if __name__ == "__main__":
    sys.exit(main())
