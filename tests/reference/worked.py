"""The worked cases of ../shared as cases of the transcription."""
import json
import os
import pathlib

import numpy as np

from case import Case, Tool, stock_band

MODELS = {"none": ("none", "all"), "simple": ("feed", "all"),
          "simple_m1": ("feed", "previous"), "radial": ("radial", "all"),
          "exact": ("trochoidal", "all"), "exact_m1": ("trochoidal", "previous")}


def folder():
    here = pathlib.Path(__file__).resolve().parents[2]
    return pathlib.Path(os.environ.get("TROCHOID_SHARED", here.parent / "shared")) / "cases/force"


def read(kind):
    files = sorted(folder().glob("*.json")) if folder().is_dir() else []
    return [c for c in (json.loads(f.read_text()) for f in files) if c["kind"] == kind]


def to_case(c, model=None):
    t, cut, ro = c["tool"], c["cut"], c["runout"]
    rad = np.radians
    tool = Tool(D=t["D"], pitch=list(rad(t["pitch_deg"])), helix=rad(t["helix_deg"]),
                R=t["R"], Rr=t["Rr"], Rz=t["Rz"], alpha=rad(t["alpha_deg"]),
                beta=rad(t["beta_deg"]), lag_diameter=t["lag_diameter"],
                constant_helix=t["lag_mode"] == "const_helix")
    y_lo = -np.inf if cut["y_lo"] is None else cut["y_lo"]
    y_hi = np.inf if cut["y_hi"] is None else cut["y_hi"]
    if cut["mode"] in ("up", "down"):
        y_lo, y_hi = stock_band(cut["mode"], t["D"], cut["ae"])
    name, lookback = MODELS[model or c.get("model", "exact")]
    return Case(tool=tool, f_z=cut["fz"], a_p=cut["ap"], y_lo=y_lo, y_hi=y_hi,
                offsets=ro["shift_mm"], rho=ro["rho_mm"], lam=rad(ro["lambda_deg"]),
                first_order=ro["order"] == "first", model=name, lookback=lookback)


def coefficients(c):
    return [c["coefficients"][k] for k in ("Ktc", "Krc", "Kac", "Kte", "Kre", "Kae")]
