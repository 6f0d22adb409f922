"""The worked cases of ../shared/cases/surface as arguments of the transcription."""
import json
import os
import pathlib

import numpy as np

from surface_chip import Milling
from surface_structure import Cutter, Structure, Wall

LOADS = {"paper": "concentrated", "distributed": "distributed"}


def folder():
    here = pathlib.Path(__file__).resolve().parents[2]
    shared = pathlib.Path(os.environ.get("TROCHOID_SHARED", here.parent / "shared"))
    return shared / "cases/surface"


def read(kind=None):
    files = sorted(folder().glob("*.json")) if folder().is_dir() else []
    return [c for c in (json.loads(f.read_text()) for f in files)
            if kind in (None, c["kind"])]


def cutter(t):
    return Cutter(t["overhang"], t["flute_length"], t["d_arbor"], t["d_equiv"], t["E"])


def wall(w):
    return w and Wall(w["length"], w["height"], w["thickness"], w["E"], w["nu"])


def milling(given, **changes):
    t, c = given["tool"], given.get("cut") or {"fz": given["fz"], "ae": 1.0, "ap": 3.0,
                                               "mode": "down"}
    r = given.get("runout", {"rho": 0.0, "lambda_deg": 0.0})
    return Milling(**{**dict(D=t["D"], N=t["N"], helix=np.radians(t["helix_deg"]),
                             fz=c["fz"], ae=c["ae"], ap=c["ap"], down=c["mode"] == "down",
                             rho=r["rho"], lam=np.radians(r["lambda_deg"])), **changes})


def structure(given, x=None):
    return Structure(cutter(given["tool"]), wall(given.get("wall")),
                     given.get("x", 0.0) if x is None else x, given["cut"]["ap"])


def load(given):
    return LOADS[given.get("load", "distributed")]


def table(c):
    """The readings of a case: {column: values}"""
    file = folder() / c["inputs"]["csv"]
    head = file.read_text().splitlines()[0].split(",")
    values = np.loadtxt(file, delimiter=",", skiprows=1, ndmin=2)
    return dict(zip(head, values.T))
