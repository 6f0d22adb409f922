"""Surface cases made up to meet every choice, the same every time; as tables and as the
arguments of the transcription."""
import random

import numpy as np

from surface_chip import Milling
from surface_structure import Cutter, Structure, Wall


def _tool(rng, n):
    return {"shape": "cylinder", "teeth": 1 + n % 6, "diameter_mm": rng.choice([8.0, 12.0, 20.0]),
            "helix_deg": rng.choice([15.0, 30.0, 45.0])}


def _cut(rng, n, D):
    return {"engagement": ("down", "up")[(n // 2 + n // 8) % 2],
            "radial_depth_mm": round(rng.choice([0.04, 0.1, 0.3, 0.8]) * D, 3),
            "axial_depth_mm": rng.choice([1.5, 4.0, 11.0]),
            "feed_per_tooth_mm": rng.choice([0.05, 0.12, 0.2]), "spindle_rpm": 1000}


def _runout(rng, fz):
    """From little to so much that teeth miss"""
    return {"eccentricity_mm": round(rng.choice([0.03, 0.2, 0.8]) * fz, 6),
            "angle_deg": round(rng.uniform(-180, 180), 2), "eccentricity_order": "first"}


def _body(rng, D):
    overhang = rng.choice([5.0, 8.0]) * D
    return {"overhang_mm": overhang, "flute_length_mm": round(0.6 * overhang, 3),
            "shank_diameter_mm": D, "equivalent_diameter_mm": round(0.8 * D, 3),
            "youngs_modulus_GPa": rng.choice([206.0, 420.0])}


def _wall(rng):
    a = rng.choice([60.0, 90.0])
    return {"length_mm": a, "height_mm": 50.0, "thickness_mm": rng.choice([2.0, 3.0]),
            "youngs_modulus_GPa": 69.0, "poisson_ratio": 0.33,
            "position_mm": round(rng.choice([0.25, 0.5, 0.7]) * a, 3)}


def force(K_tc, K_rc):
    return {"law": "linear_edge", "K_tc_MPa": K_tc, "K_rc_MPa": K_rc, "K_ac_MPa": 0.0,
            "K_te_N_per_mm": 0.0, "K_re_N_per_mm": 0.0, "K_ae_N_per_mm": 0.0}


def heights(ap):
    """Within the cut, and its two ends"""
    return [0.0, round(0.17 * ap, 6), round(0.5 * ap, 6), round(0.86 * ap, 6), ap]


def cases(count=24, seed=2015):
    """(name, tables); two in three with runout, every other one with a wall"""
    rng = random.Random(seed)
    for n in range(count):
        tool = _tool(rng, n)
        D, fb = tool["diameter_mm"], ("none", "entry", "regenerative", "direct")[(n + n // 4) % 4]
        cut = _cut(rng, n, D)
        tables = {"tool": tool, "cut": cut, "cutter_body": _body(rng, D),
                  "chip": {"model": "radial"},
                  "force": force(rng.choice([400.0, 1200.0]), rng.choice([150.0, 500.0])),
                  "surface": {"load": "distributed" if n % 5 or fb != "none"
                              else "concentrated", "feedback": fb,
                              "phase_deg": round(rng.uniform(-120, 200), 3),
                              "heights_mm": heights(cut["axial_depth_mm"])}}
        if n % 3:
            tables["runout"] = _runout(rng, cut["feed_per_tooth_mm"])
        if (n + n // 6) % 2:
            tables["wall"] = _wall(rng)
        yield f"surface{n:02d}", tables


def milling(t, disks=200):
    tool, cut, r = t["tool"], t["cut"], t.get("runout", {})
    return Milling(D=tool["diameter_mm"], N=tool["teeth"], helix=np.radians(tool["helix_deg"]),
                   fz=cut["feed_per_tooth_mm"], ae=cut["radial_depth_mm"],
                   ap=cut["axial_depth_mm"], down=cut["engagement"] == "down",
                   rho=r.get("eccentricity_mm", 0.0), lam=np.radians(r.get("angle_deg", 0.0)),
                   disks=disks)


def structure(t, x=None):
    b, w = t["cutter_body"], t.get("wall")
    cutter = Cutter(b["overhang_mm"], b["flute_length_mm"], b["shank_diameter_mm"],
                    b["equivalent_diameter_mm"], 1e3 * b["youngs_modulus_GPa"])
    wall = w and Wall(w["length_mm"], w["height_mm"], w["thickness_mm"],
                      1e3 * w["youngs_modulus_GPa"], w["poisson_ratio"])
    place = x if x is not None else w["position_mm"] if w else 0.0
    return Structure(cutter, wall, place, t["cut"]["axial_depth_mm"])


def coefficients(t):
    return t["force"]["K_tc_MPa"], t["force"]["K_rc_MPa"]
