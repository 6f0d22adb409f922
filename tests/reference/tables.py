"""The tables of a case file as a case of the transcription, units and all."""
import numpy as np

from case import Case, Tool, stock_band


def profile(t):
    """R, Rr, Rz, alpha, beta of a named shape (docs/theory/geometry.md)"""
    D, R = t["diameter_mm"], t.get("corner_radius_mm", 0.0)
    beta = np.radians(t.get("taper_deg", 0.0))
    if t["shape"] == "cylinder":
        return 0.0, D / 2, 0.0, 0.0, 0.0
    if t["shape"] == "ball":
        return D / 2, 0.0, D / 2, 0.0, 0.0
    if t["shape"] == "bull_nose":
        return R, D / 2 - R, R, 0.0, 0.0
    if t["shape"] == "taper":  # the corner touches the bottom and the flank
        return R, D / 2 - R * (1 - np.sin(beta)) / np.cos(beta), R, 0.0, beta
    return (R, t["corner_center_radius_mm"], t["corner_center_height_mm"],
            np.radians(t["bottom_angle_deg"]), beta)


def to_tool(t):
    N = t["teeth"]
    R, Rr, Rz, alpha, beta = profile(t)
    return Tool(D=t["diameter_mm"], pitch=list(np.radians(t.get("pitch_deg", [360 / N] * N))),
                helix=np.radians(t.get("helix_deg", 0.0)), R=R, Rr=Rr, Rz=Rz, alpha=alpha,
                beta=beta, lag_diameter=t.get("lag_diameter_mm", 0.0),
                constant_helix=t.get("lag") == "constant_helix")


def to_case(tables):
    t, c, r = tables["tool"], tables["cut"], tables.get("runout", {})
    chip, f = tables.get("chip", {}), tables["force"]
    y_lo, y_hi = stock_band(c["engagement"], t["diameter_mm"], c.get("radial_depth_mm"),
                            c.get("stock_y_mm"))
    return Case(tool=to_tool(t), f_z=c["feed_per_tooth_mm"], a_p=c["axial_depth_mm"],
                y_lo=y_lo, y_hi=y_hi, offsets=r.get("radial_offsets_mm", []),
                rho=r.get("eccentricity_mm", 0.0), lam=np.radians(r.get("angle_deg", 0.0)),
                first_order=r.get("eccentricity_order") == "first",
                model=chip.get("model", "trochoidal"), lookback=chip.get("lookback", "all"),
                power=(() if f["law"] == "linear_edge" else
                       tuple(f[m] for m in ("m_t", "m_r", "m_a"))),
                edge=f["law"] != "power",
                axial_edge=f.get("edge_length") == "axial",
                gauge_length=t.get("gauge_length_mm", 0.0))


def coefficients(force):
    cutting = (["K_tc_MPa", "K_rc_MPa", "K_ac_MPa"] if force["law"] == "linear_edge" else
               ["K_t1_MPa", "K_r1_MPa", "K_a1_MPa"])
    edge = ([] if force["law"] == "power" else
            ["K_te_N_per_mm", "K_re_N_per_mm", "K_ae_N_per_mm"])
    keys = cutting + edge
    return np.array([force[k] for k in keys])
