"""A worked case of ../shared as the tables of a case file."""
import json
import os
import pathlib

MODELS = {"none": ("none", "all"), "simple": ("feed", "all"),
          "simple_m1": ("feed", "previous"), "radial": ("radial", "all"),
          "exact": ("trochoidal", "all"), "exact_m1": ("trochoidal", "previous")}
COEFFICIENTS = {"Ktc": "K_tc_MPa", "Krc": "K_rc_MPa", "Kac": "K_ac_MPa",
                "Kte": "K_te_N_per_mm", "Kre": "K_re_N_per_mm", "Kae": "K_ae_N_per_mm"}
ROOT = pathlib.Path(__file__).resolve().parents[3]
SHARED = pathlib.Path(os.environ.get("TROCHOID_SHARED", ROOT.parent / "shared"))


def worked(kind):
    files = sorted((SHARED / "cases/force").glob("*.json"))
    return [c for c in (json.loads(f.read_text()) for f in files) if c["kind"] == kind]


def shape(t):
    """The named shape where there is one, else the seven parameters."""
    D, R, Rr, Rz = t["D"], t["R"], t["Rr"], t["Rz"]
    straight = t["alpha_deg"] == 0 and t["beta_deg"] == 0
    if R == 0 and straight:
        return {"shape": "cylinder"}
    if straight and Rr == 0 and R == Rz == D / 2:
        return {"shape": "ball"}
    if straight and R == Rz and abs(Rr - (D / 2 - R)) < 1e-12:
        return {"shape": "bull_nose", "corner_radius_mm": R}
    if R == 0 and t["alpha_deg"] == 0:
        return {"shape": "taper", "taper_deg": t["beta_deg"]}
    return {"shape": "apt", "corner_radius_mm": R, "corner_center_radius_mm": Rr,
            "corner_center_height_mm": Rz, "bottom_angle_deg": t["alpha_deg"],
            "taper_deg": t["beta_deg"]}


def tool(t):
    lag = {"const_lead": "constant_lead", "const_helix": "constant_helix"}[t["lag_mode"]]
    return {**shape(t), "teeth": t["N"], "diameter_mm": t["D"],
            "helix_deg": t["helix_deg"], "pitch_deg": t["pitch_deg"],
            "lag": lag, "lag_diameter_mm": t["lag_diameter"]}


def cut(c, D):
    out = {"engagement": c["mode"], "axial_depth_mm": c["ap"],
           "feed_per_tooth_mm": c["fz"], "spindle_rpm": c.get("rpm") or 1000}
    if c["mode"] in ("up", "down"):
        out["radial_depth_mm"] = c["ae"]
    elif c["mode"] != "slot":
        far = 100 * D
        out["engagement"] = "band"
        out["stock_y_mm"] = [-far if c["y_lo"] is None else c["y_lo"],
                             far if c["y_hi"] is None else c["y_hi"]]
    return out


def runout(shift_mm, rho_mm, lambda_deg, order="exact"):
    return {"radial_offsets_mm": shift_mm, "eccentricity_mm": rho_mm,
            "angle_deg": lambda_deg, "eccentricity_order": order}


def tables(c, model):
    """[tool] [runout] [cut] [chip] [force] of a worked case."""
    name, lookback = MODELS[model]
    r = c["runout"]
    K = c.get("coefficients") or c.get("truth", {}).get("K") or dict.fromkeys(COEFFICIENTS, 1.0)
    out = {"tool": tool(c["tool"]), "cut": cut(c["cut"], c["tool"]["D"]),
           "runout": runout(r["shift_mm"], r["rho_mm"], r["lambda_deg"], r["order"]),
           "chip": {"model": name},
           "force": {"law": "linear_edge", **{COEFFICIENTS[k]: v for k, v in K.items()}}}
    if name in ("feed", "trochoidal"):
        out["chip"]["lookback"] = lookback
    if "output_map" in c:
        out["dynamometer"] = {"matrix": c["output_map"]}
    return out
