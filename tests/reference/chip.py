"""What a tooth meets: docs/theory/chip.md, written down once more from the formulas."""
import numpy as np

import geometry

IN_CUT = 1e-12  # mm


def feed_since(case, j, m):
    """Feed since the m-th tooth before tooth j [C-1]"""
    N = case.tool.N
    turned = sum(case.tool.pitch[(j - i) % N] for i in range(1, m + 1))
    return case.f * turned / (2 * np.pi)


def mark_angle(A, theta_p):
    """Root delta of sin(delta) + A (theta_p + delta) = 0; nan: no mark [C-5]"""
    A, theta_p = np.broadcast_arrays(A, theta_p)
    d_star = np.arccos(np.clip(np.abs(A), 0, 1))
    rising = A >= 0
    exists = np.where(rising, A * (theta_p - np.pi / 2) < 1,
                      (np.abs(A) < 1) & (np.sin(d_star) >= -A * (theta_p + d_star)))
    lo = np.where(rising, -np.pi / 2, 0.0)
    hi = np.where(rising, 0.0, d_star)
    d = np.clip(-A * theta_p / (1 + A + 1e-300), lo, hi)
    for _ in range(60):
        g = np.sin(d) + A * (theta_p + d)
        lo, hi = np.where(g <= 0, d, lo), np.where(g >= 0, d, hi)
        slope = np.cos(d) + A
        with np.errstate(all="ignore"):
            new = d - g / slope
        new = np.where((new >= lo) & (new <= hi), new, 0.5 * (lo + hi))
        if np.max(np.abs(new - d), initial=0.0, where=exists) < 1e-16:
            break
        d = new
    return np.where(exists, d, np.nan)


def surface_left(R_k, theta_p, f, theta):
    """Distance from the axis to the surface of an earlier tooth, -inf: none [C-6]"""
    with np.errstate(all="ignore"):
        A = f * np.cos(theta) / (2 * np.pi * R_k)
        d = mark_angle(np.where(R_k > 0, A, 0.0), theta_p)
    L = R_k * np.cos(d) - f / (2 * np.pi) * (theta_p + d) * np.sin(theta)
    return np.where(np.isnan(d) | (R_k <= 0), -np.inf, L)


def on_ray(y_lo, y_hi, c):
    """The l >= 0 with y_lo <= l c <= y_hi, as [from, to]."""
    with np.errstate(all="ignore"):
        lo, hi = y_lo / c, y_hi / c
    lo, hi = np.where(c < 0, hi, lo), np.where(c < 0, lo, hi)
    inside = (y_lo <= 0) & (0 <= y_hi)
    lo = np.where(c == 0, -np.inf, lo)
    hi = np.where(c == 0, np.where(inside, np.inf, -np.inf), hi)
    return lo, hi


def trochoidal(case, j, theta, r, lag_z):
    """inner end, outer end and code of the material on the ray [C-7]"""
    N = case.tool.N
    R_j, eps_j = geometry.runout(case, r, lag_z, j)
    th = theta + eps_j
    L = np.full_like(th, -np.inf)
    winner = np.zeros(th.shape, int)
    for m in range(1, (N if case.lookback == "all" else 1) + 1):
        k = (j - m) % N
        R_k, eps_k = geometry.runout(case, r, lag_z, k)
        turned = sum(case.tool.pitch[(j - i) % N] for i in range(1, m + 1))
        # the last passage: in (0, 2 pi], a full turn for the tooth itself
        ahead = turned + eps_k - eps_j if m < N else np.full_like(th, 2 * np.pi)
        ahead = np.where(ahead <= 0, ahead + 2 * np.pi, ahead)
        ahead = np.where(ahead > 2 * np.pi, ahead - 2 * np.pi, ahead)
        L_k = surface_left(R_k, ahead, case.f, th)
        better = L_k > L
        L, winner = np.where(better, L_k, L), np.where(better, m, winner)
    L = np.where(L > 0, L, 0.0)
    lo, hi = on_ray(case.y_lo, case.y_hi, np.cos(th))
    inner, outer = np.maximum(L, lo), np.minimum(R_j, hi)
    code = 1 + 4 * winner + (lo > L) + 2 * (hi < R_j)
    cut = (outer - inner > IN_CUT) & (R_j > 0)
    return inner, outer, np.where(cut, code, 0)


def simplified(case, j, theta, r, lag_z):
    """h and code of models none, feed and radial [C-2] [C-3] [C-4]"""
    N, s = case.tool.N, np.sin(theta)
    if case.model == "none":
        h, winner = feed_since(case, j, 1) * s, np.ones(theta.shape, int)
    else:
        R_j, _ = geometry.runout(case, r, lag_z, j)
        h, winner = np.full_like(theta, np.inf), np.zeros(theta.shape, int)
        for m in range(1, (N if case.lookback == "all" else 1) + 1):
            k = (j - m) % N
            R_k, _ = geometry.runout(case, r, lag_z, k)
            f_m = feed_since(case, j, m)
            h_m = (f_m + R_j - R_k) * s if case.model == "feed" else f_m * s + R_j - R_k
            h_m = np.where(R_k > 0, h_m, np.inf)  # leaves no mark
            h, winner = np.where(h_m < h, h_m, h), np.where(h_m < h, m, winner)
        h = np.where(np.isfinite(h), h, R_j)
        h = np.where(R_j > 0, h, 0.0)
    y = r * np.cos(theta)
    cut = (s > 0) & (y >= case.y_lo) & (y <= case.y_hi) & (h > IN_CUT)
    return np.where(cut, h, 0.0), np.where(cut, winner + 1, 0)


def chip(case, j, theta, r, lag_z):
    """h and a code that is 0 in air and constant where h is smooth. Arrays of one shape."""
    if case.model == "trochoidal":
        inner, outer, code = trochoidal(case, j, theta, r, lag_z)
        return np.where(code > 0, outer - inner, 0.0), code
    return simplified(case, j, theta, r, lag_z)


def intervals(case, j, r, lag_z, n=7200):
    """[from, to] of theta in cut, from in [-pi/2, 3 pi/2), ends bisected."""
    th = -np.pi / 2 + 2 * np.pi * (np.arange(n) + 0.1234567) / n

    def cut(x):
        x = np.atleast_1d(x)
        return chip(case, j, x, np.full_like(x, r), np.full_like(x, lag_z))[1] > 0

    inside = cut(th)
    ends = {}
    for i in np.nonzero(inside != np.roll(inside, -1))[0]:
        a, b = th[i], th[i] + 2 * np.pi / n
        for _ in range(60):
            mid = 0.5 * (a + b)
            a, b = (mid, b) if cut(mid)[0] == inside[i] else (a, mid)
        ends[i] = b
    starts = [ends[i] for i in sorted(ends) if not inside[i]]
    stops = [ends[i] for i in sorted(ends) if inside[i]]
    if not starts:
        return [[-np.pi / 2, 3 * np.pi / 2]] if inside.all() else []
    out = []
    for a in starts:
        b = min((x if x > a else x + 2 * np.pi) for x in stops)
        out.append([a, b])
    return out


def area(case, n=400):
    """Material per turn at r of the tip slice, by the volume integral [C-8]"""
    r, _, lag_z, _ = geometry.at_height(case.tool, 0.0)
    x, w = np.polynomial.legendre.leggauss(12)
    total = 0.0
    for j in range(case.tool.N):
        for a, b in intervals(case, j, r, lag_z):
            e = np.linspace(a, b, n + 1)
            mid, half = 0.5 * (e[1:] + e[:-1]), 0.5 * (e[1:] - e[:-1])
            th = (mid[:, None] + half[:, None] * x).ravel()
            wt = (half[:, None] * w).ravel()
            inner, outer, code = trochoidal(case, j, th, np.full_like(th, r),
                                            np.full_like(th, lag_z))
            eps = geometry.runout(case, r, lag_z, j)[1]
            g = (outer**2 - inner**2) / 2 + case.f / (2 * np.pi) * np.cos(th + eps) * (
                outer - inner)
            total += np.sum(wt * np.where(code > 0, g, 0.0))
    return total
