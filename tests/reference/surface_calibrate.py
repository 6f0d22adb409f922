"""K_T, K_R and runout from surface errors: [wang2015] eq. (11)-(18), E-11 to E-17."""
from dataclasses import replace

import numpy as np
from scipy import optimize, stats

import surface_error as se
import surface_flexible as sf


def scaled(M):
    """Columns of unit length"""
    size = np.linalg.norm(M, axis=0)
    return M / np.where(size > 0, size, 1.0)


def rank_and_condition(M, floor=1e-9):
    s = np.linalg.svd(scaled(M), compute_uv=False)
    return int((s > floor).sum()), s[0] / s[-1] if s[-1] > 0 else np.inf


def covariance(J, residual, lost):
    """s^2 (J'J)^-1 with s^2 = RSS/(n - lost)"""
    s2 = residual @ residual / (len(residual) - lost)
    size = np.linalg.norm(J, axis=0)
    return s2 * np.linalg.inv(scaled(J).T @ scaled(J)) / np.outer(size, size)


def linear(M, y, lost=None):
    """Ordinary least squares with what can be said about it; no K where rank is short"""
    rank, cond = rank_and_condition(M)
    n, p = M.shape
    if rank < p:
        return dict(K=None, rank=rank, cond=cond)
    K = np.linalg.lstsq(scaled(M), y, rcond=None)[0] / np.linalg.norm(M, axis=0)
    residual = y - M @ K
    lost = p if lost is None else lost
    out = dict(K=K, rank=rank, cond=cond, residual=residual,
               rms=np.sqrt(np.mean(residual**2)))
    if n > lost:
        C = covariance(M, residual, lost)
        out["se"] = np.sqrt(np.diag(C))
        out["correlation"] = C[0, 1] / (out["se"][0] * out["se"][1])
        t = stats.t.ppf(0.975, n - lost)
        out["low"], out["high"] = K - t * out["se"], K + t * out["se"]
    return out


def nonlinear(predict, y, starts, scale, lost=None):
    """The best least-squares answer of several starts, its Jacobian and covariance"""
    scale = np.asarray(scale, float)
    fits = [optimize.least_squares(lambda q: predict(q * scale) - y, np.asarray(s) / scale,
                                   jac="3-point", diff_step=1e-5, xtol=1e-14, ftol=1e-14,
                                   gtol=1e-14) for s in starts]
    best = min(fits, key=lambda f: f.cost)
    lost = len(scale) if lost is None else lost
    out = dict(p=best.x * scale, residual=-best.fun, rms=np.sqrt(np.mean(best.fun**2)))
    if len(y) > lost:
        out["cov"] = covariance(best.jac / scale, best.fun, lost)
        out["se"] = np.sqrt(np.diag(out["cov"]))
    return out


def polar(e, cov=None):
    """rho and lambda of (rho cos lambda, rho sin lambda), standard errors to first order"""
    rho = np.hypot(*e)
    out = dict(rho=rho, lam=np.arctan2(e[1], e[0]))
    if cov is not None:
        D = np.array([[e[0] / rho, e[1] / rho], [-e[1] / rho**2, e[0] / rho**2]])
        out["se_rho"], out["se_lam"] = np.sqrt(np.diag(D @ cov @ D.T))
    return out


def eccentric(m, e):
    return replace(m, rho=float(np.hypot(*e)), lam=float(np.arctan2(e[1], e[0])))


def around(size, count=6):
    """Starts for the runout: nowhere near zero, all ways round"""
    a = 2 * np.pi * (np.arange(count) + 0.3) / count
    return size * np.column_stack([np.cos(a), np.sin(a)])


# Quasi-static readings: e[k, height] on the rotation grid from phi0, whole turns.

def nominal_rows(m, structure, phi0, per_tooth, heights, e, load):
    """Rows of eq. (18): [of_T, of_R] and nominal errors; rows that nothing moves left out"""
    phi = se.rotation(m, phi0, per_tooth, per_tooth)
    c = se.compliance(replace(m, rho=0.0), structure, phi, heights, load)
    M = np.column_stack([c.of_T.ravel(), c.of_R.ravel()])
    used = np.abs(M).max(axis=1) > 1e-12 * np.abs(M).max()
    return M[used], se.nominal(m, e, per_tooth).ravel()[used]


def quasi_static(m, structure, phi0, per_tooth, heights, e, load):
    """Stage 1 (nominal, linear), stage 2 (runout) and the joint fit of all four"""
    phi = se.rotation(m, phi0, per_tooth, len(e))
    y = e.ravel()
    one = linear(*nominal_rows(m, structure, phi0, per_tooth, heights, e, load))

    def predict(K, ecc):
        return se.quasi_static(eccentric(m, ecc), structure, phi, heights, K, load).ravel()

    spread = 1.5 * np.std(y - predict(one["K"], (0.0, 0.0)))
    two = nonlinear(lambda p: predict(one["K"], p), y, around(spread), [1e-3, 1e-3], lost=4)
    start = np.concatenate([one["K"], two["p"]])
    joint = nonlinear(lambda p: predict(p[:2], p[2:]), y, [start], [100, 100, 1e-3, 1e-3])
    return dict(nominal=one, runout={**two, **polar(two["p"], two["cov"])},
                joint={**joint, **polar(joint["p"][2:], joint["cov"][2:, 2:])})


# Imprints: one reading each of a tooth at a place (x, height).

def imprint_rows(m, structure_at, x, h, load, tooth=None):
    """[of_T, of_R] of each reading; without `tooth` those without runout"""
    plain = m if tooth is not None else replace(m, rho=0.0)
    out = np.zeros((len(x), 2))
    for place in np.unique(x):
        heights = np.unique(h[x == place])
        M = se.imprint_operator(plain, structure_at(place), heights, load)
        for n in np.flatnonzero(x == place):
            out[n] = M[:, np.searchsorted(heights, h[n]), 0 if tooth is None else tooth[n]]
    return out


def imprint(m, structure_at, x, h, e, load, offset=False):
    """Linear, all rows one by one; a constant datum offset may be a third unknown"""
    M = imprint_rows(m, structure_at, x, h, load)
    return linear(np.column_stack([M, np.ones(len(e))]) if offset else M, e)


def grouped(x, h, e):
    """Means of the readings at one place (x, height)"""
    places, back = np.unique(np.column_stack([x, h]), axis=0, return_inverse=True)
    count = np.bincount(back)
    return places[:, 0], places[:, 1], np.bincount(back, weights=e) / count


def imprint_runout(m, structure_at, x, h, e, tooth, K, load, lost=4):
    """Runout from labelled readings with the coefficients kept"""
    def predict(ecc):
        bent = eccentric(m, ecc)
        M = imprint_rows(bent, structure_at, x, h, load, tooth)
        return M @ K + se.runout_error(bent, tooth, h)

    spread = 1.5 * np.std(e - predict((0.0, 0.0)))
    two = nonlinear(predict, e, around(spread), [1e-3, 1e-3], lost=lost)
    return {**two, **polar(two["p"], two.get("cov"))}


# Envelope: means over whole turns' feed at (x, height).

def envelope_means(m, structure_at, x, h, load="distributed"):
    """K -> mean of the envelope at each place, the same cutter all the time"""
    parts = []
    for place in np.unique(x):
        at = np.flatnonzero(x == place)
        heights, back = np.unique(h[at], return_inverse=True)
        turn = se.turn_compliance(m, structure_at(place), heights, load)
        parts.append((at, heights, back, turn, structure_at(place)))

    def predict(K):
        out = np.zeros(len(x))
        for at, heights, back, turn, structure in parts:
            e, _ = se.envelope(m, structure, heights, K, load, turn=turn)
            out[at] = e.mean(axis=0)[back]
        return out
    return predict


def envelope(m, structure_at, x, h, e, start, load="distributed"):
    predict = envelope_means(m, structure_at, x, h, load)
    return nonlinear(predict, e, [start], [100.0, 100.0])


# Flexible: the deflection changes entry and chip.

def flexible_imprint(m, structure_at, x, h, feedback):
    """K -> imprint of each tooth at each (x, height): [reading, tooth]"""
    def predict(K):
        out = np.zeros((len(x), m.N))
        for place in np.unique(x):
            for n in np.flatnonzero(x == place):
                phi = se.touching(m, np.arange(m.N), h[n])
                d = sf.deflection(m, structure_at(place), phi, [h[n]], K, feedback)
                out[n] = d[:, 0] + se.runout_error(m, np.arange(m.N), h[n])
        return out
    return predict


def flexible_quasi_static(m, structure, phi0, per_tooth, heights, feedback, count=None):
    """K -> e[k, height]"""
    phi = se.rotation(m, phi0, per_tooth, count or per_tooth * m.N)

    def predict(K):
        d = sf.deflection(m, structure, phi, heights, K, feedback)
        return d + se.runout_error(m, se.owner(m, phi)[:, None], np.asarray(heights))
    return predict


def flexible(predict, e, start):
    """Gauss-Newton for K_T, K_R on any of the predictions above"""
    return nonlinear(lambda K: predict(K).ravel(), np.asarray(e).ravel(), [start],
                     [100.0, 100.0])
