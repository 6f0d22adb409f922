"""Cases made up to meet every choice of the case file, the same every time."""
import math
import random

SHAPES = {
    "cylinder": {},
    "ball": {},
    "bull_nose": {"corner_radius_mm": 1.5},
    "taper": {"taper_deg": 4.0},
    "taper_corner": {"taper_deg": 3.0, "corner_radius_mm": 1.0},
    "taper_ball": {"taper_deg": 5.0},  # D such that the corner's centre is on the axis
    "apt_cone": {"corner_radius_mm": 0.0, "bottom_angle_deg": 8.0, "taper_deg": 2.0},
    "apt": {"corner_radius_mm": 1.6, "bottom_angle_deg": 5.0, "taper_deg": 1.0},
}
LAGS = ["constant_lead", "constant_helix"]
RUNOUTS = ["none", "offsets", "exact", "first", "both"]
MODELS = [("none", None), ("feed", "all"), ("feed", "previous"), ("radial", None),
          ("trochoidal", "all"), ("trochoidal", "previous"), ("trochoidal", "all")]
ENGAGEMENTS = ["slot", "up", "down", "band"]
LAWS = ["true", "axial", "power", "power_edge"]


def _corner(t):
    """A corner's centre from where its arc cuts a little into cone and flank."""
    R, D = t["corner_radius_mm"], t["diameter_mm"]
    if R == 0:
        return D / 2, 0.0
    ta, tb = (math.tan(math.radians(t[k])) for k in ("bottom_angle_deg", "taper_deg"))
    down, out = (R - 0.05) * math.hypot(1, ta), (R - 0.05) * math.hypot(1, tb)
    u = D / 2 * (1 - ta * tb)
    Rr = (u + tb * down - out) / (1 - ta * tb)  # Rz = Rr ta + down, Rr = u + Rz tb - out
    return Rr, Rr * ta + down


def _tool(rng, shape, lag):
    D = rng.choice([6.0, 8.0, 10.0, 16.0])
    N = rng.choice([1, 2, 3, 4, 5])
    t = {"shape": shape.split("_")[0] if shape not in ("bull_nose",) else shape,
         "teeth": N, "diameter_mm": D, "helix_deg": rng.choice([0.0, 12.0, 30.0, 45.0]),
         "lag": lag, **SHAPES[shape]}
    if shape == "taper_ball":
        b = math.radians(t["taper_deg"])
        t["corner_radius_mm"] = D / 2 * math.cos(b) / (1 - math.sin(b))
        t["lag_diameter_mm"] = 2 * t["corner_radius_mm"]
    if shape.startswith("apt"):
        t["corner_center_radius_mm"], t["corner_center_height_mm"] = _corner(t)
    if rng.random() < 0.5 and N > 1:
        steps = [rng.uniform(0.8, 1.25) for _ in range(N)]
        pitch = [round(360 * s / sum(steps), 3) for s in steps[:-1]]
        t["pitch_deg"] = pitch + [round(360 - sum(pitch), 3)]
    if rng.random() < 0.3:
        t["lag_diameter_mm"] = 1.1 * D
    t["gauge_length_mm"] = 60.0
    return t


def _runout(rng, kind, N, f_z):
    size = rng.choice([0.2, 0.6, 1.3]) * f_z
    out = {}
    if kind in ("offsets", "both"):
        out["radial_offsets_mm"] = [round(rng.uniform(-0.5, 0.5) * size, 6) for _ in range(N)]
    if kind in ("exact", "first", "both"):
        out.update(eccentricity_mm=round(rng.uniform(0.2, 0.8) * size, 6),
                   angle_deg=round(rng.uniform(-180, 180), 2),
                   eccentricity_order="first" if kind == "first" else "exact")
    return out


def _cut(rng, engagement, D):
    cut = {"engagement": engagement, "axial_depth_mm": rng.choice([1.1, 2.0, 4.3]),
           "feed_per_tooth_mm": rng.choice([0.02, 0.05, 0.12]), "spindle_rpm": 1200}
    if engagement in ("up", "down"):
        cut["radial_depth_mm"] = round(rng.uniform(0.05, 0.95) * D, 3)
    if engagement == "band":
        cut["stock_y_mm"] = [round(rng.uniform(-0.45, -0.1) * D, 3),
                             round(rng.uniform(0.1, 0.45) * D, 3)]
    return cut


def _force(law):
    power = {"K_t1_MPa": 1500.0, "K_r1_MPa": 600.0, "K_a1_MPa": 300.0, "m_t": 0.25,
             "m_r": 0.4, "m_a": 0.1}
    edge = {"K_te_N_per_mm": 12.0, "K_re_N_per_mm": 9.0, "K_ae_N_per_mm": 3.0}
    if law == "power":
        return {"law": law, **power}
    if law == "power_edge":
        return {"law": law, **power, **edge}
    return {"law": "linear_edge", "K_tc_MPa": 1800.0, "K_rc_MPa": 800.0, "K_ac_MPa": 400.0,
            **edge, "edge_length": law}


def cases(rounds=9, seed=2009):
    """(name, tables): every shape `rounds` times, every other choice in turn."""
    rng = random.Random(seed)
    n = 0
    for _ in range(rounds):
        for shape in SHAPES:
            lag = LAGS[n % 2 if n % 3 else 0]
            model, lookback = MODELS[n % len(MODELS)]
            tool = _tool(rng, shape, lag)
            cut = _cut(rng, ENGAGEMENTS[(n + n // 8) % 4], tool["diameter_mm"])
            runout = _runout(rng, RUNOUTS[(n + n // 5) % 5], tool["teeth"],
                             cut["feed_per_tooth_mm"])
            chip = {"model": model, **({"lookback": lookback} if lookback else {})}
            tables = {"tool": tool, "cut": cut, "runout": runout, "chip": chip,
                      "force": _force(LAWS[(n + n // 3) % 4])}
            yield f"made{n:02d}_{shape}", {k: v for k, v in tables.items() if v}
            n += 1
