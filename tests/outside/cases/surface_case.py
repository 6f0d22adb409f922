"""A worked case of ../shared/cases/surface as the tables of a case file."""
import json

import case_file as cf

FOLDER = cf.SHARED / "cases/surface"
LOADS = {"paper": "concentrated", "distributed": "distributed"}
CUT = {"fz": 0.2, "ae": 1.0, "ap": 3.0, "mode": "down"}  # where a case is of something else
TOOL = {"D": 12.0, "N": 3, "helix_deg": 45.0, "overhang": 83.0, "flute_length": 45.0,
        "d_arbor": 12.0, "d_equiv": 9.6, "E": 206000.0}


def worked():
    files = sorted(FOLDER.glob("*.json")) if FOLDER.is_dir() else []
    return [json.loads(f.read_text()) for f in files]


def tool(t):
    return {"shape": "cylinder", "teeth": t["N"], "diameter_mm": t["D"],
            "helix_deg": t["helix_deg"]}


def cutter_body(t):
    return {"overhang_mm": t["overhang"], "flute_length_mm": t["flute_length"],
            "shank_diameter_mm": t["d_arbor"], "equivalent_diameter_mm": t["d_equiv"],
            "youngs_modulus_GPa": t["E"] / 1000}


def cut(c):
    return {"engagement": c["mode"], "radial_depth_mm": c["ae"], "axial_depth_mm": c["ap"],
            "feed_per_tooth_mm": c["fz"], "spindle_rpm": 1000}


def runout(r):
    return {"eccentricity_mm": r["rho"], "angle_deg": r["lambda_deg"],
            "eccentricity_order": "first"}


def wall(w, x):
    return {"length_mm": w["length"], "height_mm": w["height"],
            "thickness_mm": w["thickness"], "youngs_modulus_GPa": w["E"] / 1000,
            "poisson_ratio": w["nu"], "position_mm": x}


def force(KT, KR):
    """No edge forces and none along the axis: the law of the case"""
    return {"law": "linear_edge", "K_tc_MPa": KT, "K_rc_MPa": KR, "K_ac_MPa": 0.0,
            "K_te_N_per_mm": 0.0, "K_re_N_per_mm": 0.0, "K_ae_N_per_mm": 0.0}


def feedback(given):
    if "chip" not in given:
        return "none"
    if given["chip"] in ("regenerative", "direct"):
        return given["chip"]
    return "entry" if given.get("entry_feedback") else "none"


def tables(given, model, **surface):
    """All tables but those of measurements; `surface` adds keys to [surface]"""
    t = given.get("tool", TOOL)
    out = {"tool": tool(t), "cutter_body": cutter_body(t), "cut": cut(given.get("cut", CUT)),
           "chip": {"model": "radial"}, "force": force(given.get("KT", 0), given.get("KR", 0)),
           "surface": {"model": model, "load": LOADS[given.get("load", "distributed")],
                       "feedback": feedback(given), **surface}}
    if given.get("runout", {}).get("rho"):
        out["runout"] = runout(given["runout"])
    if given.get("wall"):
        w = given["wall"]
        out["wall"] = wall(w, given.get("x", w["length"] / 2))
    return out


def rotation(given, count):
    """[sampling] and phase of the rotation grid of a case"""
    per_rev = given["samples_per_tooth"] * given["tool"]["N"]
    return {"samples_per_rev": per_rev, "revolutions": count / per_rev}


def angles(given, count):
    step = 360.0 / (given["samples_per_tooth"] * given["tool"]["N"])
    return [given["phi0_deg"] + k * step for k in range(count)]
