"""Where an edge is: docs/theory/geometry.md, written down once more from the formulas."""
import numpy as np


def tangent_points(t):
    """M and N of the profile as (r, z) [G-5]"""
    ta, tb = np.tan(t.alpha), np.tan(t.beta)
    u = t.D / 2 * (1 - ta * tb)
    if t.R == 0:  # cone and flank meet in one point
        return (t.D / 2, t.D / 2 * ta), (t.D / 2, t.D / 2 * ta)
    root_m = (t.R**2 - t.Rr**2) * ta**2 + 2 * t.Rr * t.Rz * ta + t.R**2 - t.Rz**2
    Mr = (t.Rz * ta + t.Rr + np.sqrt(max(root_m, 0.0))) / (1 + ta**2)
    d = t.Rr - u
    root_n = (t.R**2 - t.Rz**2) * tb**2 + 2 * t.Rz * d * tb - d**2 + t.R**2
    Nz = (d * tb + t.Rz - np.sqrt(max(root_n, 0.0))) / (1 + tb**2)
    return (Mr, Mr * ta), (u + Nz * tb, Nz)


def segments(t, a_p):
    """The meridian below z = a_p as (kind, s_from, s_to), s = 0 where the edge begins."""
    (Mr, Mz), (Nr, Nz) = tangent_points(t)
    out, s = [], 0.0
    if t.alpha > 0:
        z_to = min(Mz, a_p)
        length = z_to / np.sin(t.alpha)
        out.append(("cone", s, s + length))
        s += length
    if t.R > 0 and a_p > Mz and Nz > Mz:
        kappa_m = np.arctan2(Mr - t.Rr, t.Rz - Mz)
        z_to = min(Nz, a_p)
        kappa_to = np.arccos(np.clip((t.Rz - z_to) / t.R, -1, 1))
        out.append(("arc", s, s + t.R * (kappa_to - kappa_m)))
        s += t.R * (kappa_to - kappa_m)
    if a_p > Nz:
        out.append(("flank", s, s + (a_p - Nz) / np.cos(t.beta)))
    return out


def point(t, kind, s_from, s):
    """r, z, kappa at meridian length s of a segment [G-2] [G-3] [G-4]"""
    (Mr, Mz), (Nr, Nz) = tangent_points(t)
    q = s - s_from
    if kind == "cone":
        return q * np.cos(t.alpha), q * np.sin(t.alpha), np.full_like(s, t.alpha)
    if kind == "arc":
        kappa = np.arctan2(Mr - t.Rr, t.Rz - Mz) + q / t.R
        return t.Rr + t.R * np.sin(kappa), t.Rz - t.R * np.cos(kappa), kappa
    z = Nz + q * np.cos(t.beta)
    return Nr + (z - Nz) * np.tan(t.beta), z, np.full_like(s, np.pi / 2 - t.beta)


def lag(t, kind, r, z, kappa):
    """Lag and its slope along the meridian [G-7] [G-8]"""
    D_lag = t.lag_diameter or t.D
    tan_i = np.tan(t.helix)
    if not (t.constant_helix and kind == "flank"):
        return 2 * z * tan_i / D_lag, 2 * tan_i / D_lag * np.sin(kappa)
    (_, _), (Nr, Nz) = tangent_points(t)
    if t.beta == 0:
        along = (z - Nz) * tan_i / Nr
    else:
        along = tan_i / np.sin(t.beta) * np.log(r / Nr)
    return 2 * Nz * tan_i / D_lag + along, tan_i / r * np.ones_like(z)


def edge_length_factor(r, dlag_ds):
    """dS/ds [G-6]"""
    return np.sqrt(1 + (r * dlag_ds) ** 2)


def runout(case, r, lag_z, k):
    """R and epsilon of teeth k (0-based) at local radius r [G-9] [G-10]"""
    r_k = r + case.rad[k]
    c = case.tool.psi[k] + lag_z - case.lam
    if case.first_order:
        R, eps = r_k + case.rho * np.cos(c), np.zeros_like(r_k)
    else:
        R = np.sqrt(r_k**2 + case.rho**2 + 2 * r_k * case.rho * np.cos(c))
        eps = np.arctan2(case.rho * np.sin(c), r_k + case.rho * np.cos(c))
    if case.rho == 0:
        R, eps = r_k, np.zeros_like(r_k)
    return np.where(r_k > 0, R, -1.0), eps


def at_height(t, z):
    """r, kappa, lag, edge factor at one height (the flank side at M and N)."""
    (Mr, Mz), (Nr, Nz) = tangent_points(t)
    kind = "flank" if z >= Nz else ("cone" if z < Mz else "arc")
    if kind == "flank":
        r, kappa = Nr + (z - Nz) * np.tan(t.beta), np.pi / 2 - t.beta
    elif kind == "cone":
        r, kappa = z / np.tan(t.alpha), t.alpha
    else:
        kappa = np.arccos(np.clip((t.Rz - z) / t.R, -1, 1))
        r = t.Rr + t.R * np.sin(kappa)
    r, z, kappa = (np.array([float(v)]) for v in (r, z, kappa))
    angle, slope = lag(t, kind, r, z, kappa)
    return r[0], kappa[0], angle[0], edge_length_factor(r, slope)[0]
