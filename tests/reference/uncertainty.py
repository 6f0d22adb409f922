"""Draws of what was found, written once more: plain formulas and scipy's distributions.

Ids: U-1 to U-7 of docs/theory/uncertainty.md.
"""
import math

import numpy as np
from scipy import optimize, stats


def half_widths(covariance):
    """Half of the 95 % interval of each name, of `covariance` in summary.json.  U-1"""
    matrix = np.array(covariance["matrix"])
    half = np.array(covariance["interval_factors"]) * np.sqrt(np.diag(matrix))
    return dict(zip(covariance["names"], half))


def freedom(w):
    """nu with t_0.975(nu) = w; inf: normal.  U-3"""
    if w <= 1.96:
        return math.inf
    return optimize.brentq(lambda nu: stats.t.ppf(0.975, nu) - w, 0.3, 1e6)


def drawn(found, chance):
    """One draw from the chances of z and of u.  U-2, U-4, U-5

    Cholesky in the order of the numbers: the program takes the largest pivots, so the
    same chances give the same draw only where those come in that order."""
    x = np.array(found["found"])
    logs = np.array([n.startswith("mode[") and not n.endswith("angle_deg")
                     for n in found["names"]])
    size = np.where(logs, x, 1.0)
    L = np.linalg.cholesky(np.array(found["matrix"]) / np.outer(size, size))
    *p, u = chance
    nu = [freedom(w) for w in found["interval_factors"]]
    s = [1.0 if math.isinf(n) else math.sqrt(n / stats.chi2.ppf(u, n)) for n in nu]
    away = s * (L @ stats.norm.ppf(p))
    return np.where(logs, x * np.exp(away), x + away)


def eccentricity(e_x, e_y):
    """rho and lambda [deg].  U-6"""
    return math.hypot(e_x, e_y), math.degrees(math.atan2(e_y, e_x))


def spread(values):
    """Median, ends of the 95 % and between what they lie.  U-7"""
    x = np.sort(np.asarray(values, float))
    n = x.size
    below = lambda k: sum(math.comb(n, i) * 0.025**i * 0.975**(n - i) for i in range(k))
    places = [r for r in range(1, n) if below(r) <= 0.025]  # P(B < r)
    bounds = None
    if places:
        r = places[-1]
        s = next(s for s in range(1, n) if 1 - below(s) <= 0.025)
        bounds = ((x[r - 1], x[s - 1]), (x[n - s], x[n - r]))
    low, median, high = np.quantile(x, [0.025, 0.5, 0.975])
    return {"median": median, "low": low, "high": high, "sd": x.std(ddof=1),
            "mean": x.mean(), "bounds": bounds}


if __name__ == "__main__":  # numbers of tests/unit/sweep/distribution_test.cpp
    w = stats.t.ppf(0.975, 8)
    two = {"names": ["a", "b"], "found": [800, 10], "interval_factors": [w, 1.96],
           "matrix": [[900, -54], [-54, 4]]}
    print([float(v) for v in drawn(two, (0.3, 0.8, 0.6))])
    mode = {"names": ["mode[1].frequency_Hz", "mode[1].mass_kg"], "found": [900, 0.04],
            "interval_factors": [1.96, 1.96], "matrix": [[81, 0.018], [0.018, 1.6e-5]]}
    print([float(v) for v in drawn(mode, (0.9, 0.2, 0.5))])
