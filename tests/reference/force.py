"""From chip to force: docs/theory/force.md, written down once more from the formulas.

The edge is cut into cells; a cell within which the chip switches is cut in eight until it is
shorter than 1e-13 of the edge, every other cell takes six Gauss nodes. Accuracy against
four times as many cells: see check_worked.py (1e-9 N; 1e-3 of the peak or better where
the edge reaches the axis).
"""
import numpy as np

import chip
import geometry

GAUSS = np.polynomial.legendre.leggauss(6)
PROBES = np.array([0.0, 0.382, 0.709, 1.0])
PARTS = 8


def frame(theta, kappa):
    """Columns t, r, a in x, y, z [F-3]; shape (..., 3, 3)"""
    s, c, sk, ck = np.sin(theta), np.cos(theta), np.sin(kappa), np.cos(kappa)
    zero = np.zeros_like(s)
    return np.stack([np.stack([-c, s, zero], -1),
                     np.stack([-s * sk, -c * sk, ck], -1),
                     np.stack([-s * ck, -c * ck, -sk], -1)], -1)


def element(case, h, kappa, dS_ds):
    """Force per ds for unit coefficients [F-1] [F-2] [F-9]; list of (direction, value)"""
    h_n = np.maximum(h * np.sin(kappa), 0.0)  # h_0 = 1 mm
    cutting = [(q, h_n ** (1 - m)) for q, m in enumerate(case.power or (0, 0, 0))]
    edge = np.sin(kappa) if case.axial_edge else dS_ds
    return cutting + [(q, edge) for q in range(3)] * case.edge


def _cells(case, phi, kind, s0, s1, j, count):
    """Smooth cells in cut: index of phi, ends in s."""
    t = case.tool
    e = np.linspace(0, 1, count + 1)
    if geometry.point(t, kind, s0, np.array([s0]))[0][0] < 1e-9 * t.D:
        e = e**3  # the edge reaches the axis: finer there
    e = s0 + (s1 - s0) * e
    a, b = (np.tile(v, len(phi)) for v in (e[:-1], e[1:]))
    i = np.repeat(np.arange(len(phi)), count)
    keep = []
    while len(a):
        s = a[:, None] + (b - a)[:, None] * PROBES
        code = chip_along(case, j, phi[i][:, None], kind, s0, s)[1]
        same = (code == code[:, :1]).all(axis=1)
        use = same & (code[:, 0] > 0)
        keep.append((i[use], a[use], b[use]))
        split = ~same & (b - a > 1e-13 * (s1 - s0))
        ends = np.linspace(a[split], b[split], PARTS + 1)
        i, a, b = np.tile(i[split], PARTS), ends[:-1].ravel(), ends[1:].ravel()
    return [np.concatenate(v) for v in zip(*keep)]


def chip_along(case, j, phi, kind, s0, s):
    t = case.tool
    r, z, kappa = geometry.point(t, kind, s0, s)
    angle, slope = geometry.lag(t, kind, r, z, kappa)
    theta = phi - t.psi[j] - angle  # [G-1]
    h, code = chip.chip(case, j, theta, r, angle)
    return h, code, theta, r, z, kappa, angle, slope


def matrix(case, phi, count=64):
    """[C] with the three moments below it [F-4] [F-6] [F-7]; shape (n, 6, columns)

    The moments are about (0, 0, gauge length).
    """
    phi = np.atleast_1d(np.asarray(phi, float))
    out = np.zeros((len(phi), 6, 6 if case.edge else 3))
    for j in range(case.tool.N):
        for kind, s0, s1 in geometry.segments(case.tool, case.a_p):
            for block in np.array_split(np.arange(len(phi)), max(1, len(phi) // 128)):
                i, a, b = _cells(case, phi[block], kind, s0, s1, j, count)
                _add(case, out, block[i], phi[block[i]], a, b, kind, s0, j)
    return out


def _add(case, out, i, phi, a, b, kind, s0, j):
    x, w = GAUSS
    s = 0.5 * (a + b)[:, None] + 0.5 * (b - a)[:, None] * x
    weight = 0.5 * (b - a)[:, None] * w
    h, _, theta, r, z, kappa, angle, slope = chip_along(case, j, phi[:, None], kind, s0, s)
    R, eps = geometry.runout(case, r, angle, j)
    if case.model == "none":
        R, eps = r, np.zeros_like(r)
    th = theta + eps
    B = frame(th, kappa)
    arm = np.stack([R * np.sin(th), R * np.cos(th), z - case.gauge_length], -1)
    dS_ds = geometry.edge_length_factor(r, slope)
    for column, (q, value) in enumerate(element(case, h, kappa, dS_ds)):
        dF = B[..., q] * (value * weight)[..., None]
        rows = np.concatenate([dF, np.cross(arm, dF)], -1).sum(axis=1)
        np.add.at(out, (i, slice(None), column), rows)


def forces(case, K, phi, count=64):
    """Fx Fy Fz Mx My Mz; Mz is the torque. Shape (n, 6)"""
    return matrix(case, phi, count) @ np.asarray(K, float)


def cumulative(case, K, phi, count=4000):
    """Force of a constant-lead cylinder with offsets by the integral over theta [F-5]

    G_j by many Gauss cells over one turn and straight interpolation at cell ends: only
    as a check of F-5 itself, to about 1e-6 of the peak.
    """
    t = case.tool
    lead = (t.lag_diameter or t.D) / (2 * np.tan(t.helix))
    total_lag = case.a_p / lead
    x, w = np.polynomial.legendre.leggauss(8)
    F = np.zeros((len(phi), 3))
    for j in range(t.N):
        for n, p in enumerate(phi):
            lo, hi = p - t.psi[j] - total_lag, p - t.psi[j]
            e = np.linspace(lo, hi, count + 1)
            th = (0.5 * (e[1:] + e[:-1])[:, None] + 0.5 * (hi - lo) / count * x).ravel()
            wt = np.tile(0.5 * (hi - lo) / count * w, count)
            h, code = chip.chip(case, j, th, np.full_like(th, t.D / 2), np.zeros_like(th))
            g = element(case, h, np.pi / 2, 1 / np.cos(t.helix))
            B = frame(th, np.full_like(th, np.pi / 2))
            cut = code > 0
            for k, (q, value) in zip(K, g):
                F[n] += lead * k * np.sum(B[..., q] * (value * cut * wt)[:, None], axis=0)
    return F


def slot_means(N, a_p, f_z, K, e):
    """Mean force of a slot without runout [F-8]"""
    tc, rc, ac, te, re, ae = K
    return np.array([-N * a_p * (rc * f_z / 4 + re * e / np.pi),
                     N * a_p * (tc * f_z / 4 + te * e / np.pi),
                     -N * a_p * (ac * f_z / np.pi + ae * e / 2)])


def torque_power(case, K, phi, Omega):
    """Torque [N mm] and power [N mm/s] [F-6]"""
    T = forces(case, K, phi)[:, 5]
    return T, T * Omega
