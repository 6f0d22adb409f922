"""From force to coefficients: docs/theory/identification.md, from the formulas."""
from dataclasses import replace

import numpy as np
from scipy import optimize, stats

import force


def stacked(case, angle, phase=0.0, count=32):
    """[D] of one run, three rows a sample (eq. 20 of the paper)"""
    C = force.matrix(case, angle + phase, count)[:, :3]
    return C.reshape(-1, C.shape[-1])


def linear(D, F):
    """K by scaled SVD, and rank and condition of the scaled matrix [I-1] [I-6]"""
    size = np.linalg.norm(D, axis=0)
    if not np.all(size > 0):
        return None, int(np.linalg.matrix_rank(D)), np.inf
    U, sv, Vt = np.linalg.svd(D / size, full_matrices=False)
    rank = int(np.sum(sv > 1e-10 * sv[0]))
    K = (Vt.T @ ((U.T @ F) / sv)) / size if rank == D.shape[1] else None
    return K, rank, sv[0] / sv[-1]


def correlation(J):
    """Correlation of the estimates [I-4]"""
    size = np.linalg.norm(J, axis=0)
    inverse = np.linalg.inv((J / size).T @ (J / size))
    d = np.sqrt(np.diag(inverse))
    return inverse / np.outer(d, d)


def standard_errors(J, residual):
    """[I-2] for J = [D], [I-4] for the full Jacobian"""
    size = np.linalg.norm(J, axis=0)
    inverse = np.linalg.inv((J / size).T @ (J / size))
    variance = residual @ residual / (len(residual) - J.shape[1])
    return np.sqrt(variance * np.diag(inverse)) / size


def rms(residual):
    """Vector RMS and that of each axis [I-5]"""
    r = residual.reshape(-1, 3)
    axis = np.sqrt(np.mean(r**2, axis=0))
    return np.sqrt(np.mean(np.sum(r**2, axis=1))), axis


def interval(value, se, nu):
    """95 % interval [I-8]"""
    half = stats.t.ppf(0.975, nu) * se
    return value - half, value + half


def neighbour_correlation(residual):
    """Correlation of neighbouring residuals, all axes together (remark of I-8)"""
    r = residual.reshape(-1, 3)
    return np.sum(r[1:] * r[:-1]) / np.sum(r * r)


def fixed(case, angle, F, phase=0.0, extra=None):
    """Fit at fixed runout; `extra` columns: channel constants and slopes [I-7]"""
    D, y = stacked(case, angle, phase), np.asarray(F).ravel()
    if extra is not None:
        D = np.hstack([D, extra])
    K, rank, cond = linear(D, y)
    if K is None:
        return dict(K=None, rank=rank, cond=cond)
    res = y - D @ K
    total, axis = rms(res)
    return dict(K=K, se=standard_errors(D, res), rank=rank, cond=cond, rms=total,
                rms_axis=axis, residual=res, correlation=neighbour_correlation(res))


def channel_columns(t):
    """Constant and slope of each channel [I-7]"""
    x = (t - np.mean(t)) / (t[-1] - t[0])
    out = np.zeros((len(t), 3, 6))
    for c in range(3):
        out[:, c, c], out[:, c, 3 + c] = 1.0, x
    return out.reshape(-1, 6)


def with_parameters(case, names, p):
    """Case and phase with the unknowns put in: shift:k (0-based), ex, ey, phase (deg)"""
    offsets, phase = list(case.rad), 0.0
    ex, ey = case.rho * np.cos(case.lam), case.rho * np.sin(case.lam)
    for name, value in zip(names, p):
        if name.startswith("shift:"):
            offsets[int(name[6:])] = value
        elif name == "ex":
            ex = value
        elif name == "ey":
            ey = value
        else:
            phase = np.radians(value)
    new = replace(case, offsets=offsets, rho=np.hypot(ex, ey), lam=np.arctan2(ey, ex))
    return new, phase


def joint(case, angle, F, names, start, step=None):
    """Variable projection over the named unknowns [I-3] [I-4]"""
    y = np.asarray(F).ravel()
    scale = np.array([1.0 if n == "phase" else 0.01 for n in names])
    step = 1e-4 if step is None else step

    def residual(q):
        new, phase = with_parameters(case, names, q * scale)
        D = stacked(new, angle, phase)
        K, _, _ = linear(D, y)
        return y - D @ K

    def jacobian(q):
        J = [(residual(q + step * e) - residual(q - step * e)) / (2 * step)
             for e in np.eye(len(q))]
        return np.array(J).T

    fit = optimize.least_squares(residual, np.asarray(start, float) / scale, jac=jacobian,
                                 method="lm", xtol=1e-13, ftol=1e-13, gtol=1e-13)
    p = fit.x * scale
    new, phase = with_parameters(case, names, p)
    D = stacked(new, angle, phase)
    K, rank, cond = linear(D, y)
    columns = []
    for e in np.eye(len(p)):
        hi = stacked(*_moved(case, names, p + step * scale * e, angle)) @ K
        lo = stacked(*_moved(case, names, p - step * scale * e, angle)) @ K
        columns.append((hi - lo) / (2 * step * scale[np.argmax(e)]))
    res = y - D @ K
    J = np.hstack([D, np.array(columns).T])
    se = standard_errors(J, res)
    total, axis = rms(res)
    return dict(p=p, se_p=se[len(K):], K=K, se_K=se[:len(K)], rms=total, rms_axis=axis,
                cond=cond, rank=rank, correlation=correlation(J))


def joint_in_plane(case, angle, F, names, start):
    """joint of a cylinder of which x and y were measured: no K_a [I-3] [I-4]"""
    y = np.asarray(F)[:, :2].ravel()
    scale, step = 0.01, 1e-4

    def plane(p):
        new, phase = with_parameters(case, names, p)
        D = stacked(new, angle, phase).reshape(len(angle), 3, -1)[:, :2]
        return D.reshape(len(y), -1)[:, [0, 1, 3, 4]]

    def residual(q):
        D = plane(q * scale)
        return y - D @ np.linalg.lstsq(D, y, rcond=None)[0]

    fit = optimize.least_squares(residual, np.asarray(start, float) / scale,
                                 method="lm", xtol=1e-14, ftol=1e-14, gtol=1e-14)
    p = fit.x * scale
    D = plane(p)
    K = linear(D, y)[0]
    slopes = [(plane(p + step * scale * e) @ K - plane(p - step * scale * e) @ K) /
              (2 * step * scale) for e in np.eye(len(p))]
    res = y - D @ K
    se = standard_errors(np.hstack([D, np.array(slopes).T]), res)
    return dict(p=p, K=K, se_K=se[:4], se_p=se[4:], cond=linear(D, y)[2],
                rms=np.sqrt(res @ res / len(angle)))


def _moved(case, names, p, angle):
    new, phase = with_parameters(case, names, p)
    return new, angle, phase


def blocks(runs, names, p):
    """[D] of runs (case, angle, F, group), a block of columns for each group [I-19]"""
    groups = list(dict.fromkeys(group for _, _, _, group in runs))
    rows = []
    for case, angle, _, group in runs:
        own = stacked(with_parameters(case, names, p)[0], angle)
        row = np.zeros((len(own), own.shape[1] * len(groups)))
        at = groups.index(group) * own.shape[1]
        row[:, at:at + own.shape[1]] = own
        rows.append(row)
    return np.vstack(rows)


def joint_of_groups(runs, names, start, step=1e-5):
    """All coefficients and the one runout, at the phases of the records [I-19] [I-4]"""
    y = np.concatenate([np.ravel(F) for _, _, F, _ in runs])
    count = blocks(runs, names, start).shape[1]

    def residual(q):
        return y - blocks(runs, names, q[count:]) @ q[:count]

    def jacobian(q):
        columns = [-blocks(runs, names, q[count:])]
        for e in step * np.eye(len(start)):
            hi, lo = (blocks(runs, names, q[count:] + s * e) @ q[:count] for s in (1, -1))
            columns.append(-((hi - lo) / (2 * step))[:, None])
        return np.hstack(columns)

    K0, _, _ = linear(blocks(runs, names, start), y)
    fit = optimize.least_squares(residual, np.concatenate([K0, start]), jac=jacobian,
                                 x_scale="jac", method="lm", xtol=1e-14, ftol=1e-14)
    return fit.x, standard_errors(jacobian(fit.x), residual(fit.x))


def jacobian(case, angle, K, names, p, step=1e-5):
    """[D] and the derivatives by the runout, and those by the phase [I-4]"""
    new, _ = with_parameters(case, names, p)
    columns = []
    for e in step * np.eye(len(p)):
        hi, lo = (stacked(with_parameters(case, names, p + s * e)[0], angle) @ K
                  for s in (1, -1))
        columns.append((hi - lo) / (2 * step))
    hi, lo = (stacked(new, angle, s * step) @ K for s in (1, -1))
    return np.column_stack([stacked(new, angle)] + columns), (hi - lo) / (2 * step)


def information(J, N, noise, turns=1):
    """What a record tells of coefficients and runout, its phase unknown [I-20]"""
    left = J - np.outer(N, N @ J) / (N @ N)
    return turns / noise**2 * left.T @ left


def log_determinant(M, some):
    """Of the covariance of some parameters [I-21]"""
    return np.linalg.slogdet(np.linalg.inv(M)[np.ix_(some, some)])[1]


def separate(e1, e2, turned):
    """Parts of holder and tool of two eccentricities, by one system of equations [I-22]"""
    c, s = np.cos(turned), np.sin(turned)
    R = np.array([[c, -s], [s, c]])
    A = np.block([[np.eye(2), np.eye(2)], [R.T, np.eye(2)]])  # e2 = R^T h + t
    return np.split(np.linalg.solve(A, np.concatenate([e1, e2])), 2), np.linalg.inv(A)


def sweep(case, angle, F, offsets):
    """RMS over the offset of tooth 2, coefficients refitted (Fig. 9 of the paper)"""
    out = []
    for value in offsets:
        new, _ = with_parameters(case, ["shift:1"], [value])
        out.append(fixed(new, angle, F)["rms"])
    return np.array(out)


def waves(angle, highest):
    """1, cos, sin, cos 2, sin 2 ... of angles, shape (n, 2 highest + 1)"""
    k = np.arange(1, highest + 1)
    both = np.stack([np.cos(np.outer(angle, k)), np.sin(np.outer(angle, k))], axis=2)
    return np.hstack([np.ones((len(angle), 1)), both.reshape(len(angle), -1)])


def by_turn(angle, left, turns, highest):
    """[I-14] rows of what is left and their scatter, shape (3, 2 highest + 1)"""
    n = len(angle)
    scale = np.sqrt(np.where(np.arange(2 * highest + 1) == 0, n, 2.0 * n))
    turn = np.floor((angle - angle[0]) / (2 * np.pi) + 1e-9).astype(int)
    means = np.array([waves(angle[turn == t], highest).T @ left[turn == t]
                      / np.count_nonzero(turn == t) for t in range(turns)])
    rows = scale[:, None] * means.mean(axis=0)
    scatter = scale[:, None] ** 2 / turns * means.var(axis=0, ddof=1)
    slow = means[:, 0, :] - means[:, 0, :].mean(axis=0)
    r = np.clip(np.sum(slow[1:] * slow[:-1], axis=0) / np.sum(slow**2, axis=0), 0.0, 0.9)
    scatter[0] *= (1 + r) / (1 - r)
    return rows.T, scatter.T


def power(rows, scatter, h, tooth):
    """[I-14] of each row of a run: what differs from turn to turn, and what repeats"""
    free = 1 - np.minimum(h, 1)
    k = (np.arange(rows.shape[1]) + 1) // 2
    out = np.array(scatter)
    excess = rows**2 - free * scatter
    for q in range(3):
        for line in range(rows.shape[1]):
            same = tooth[k] == tooth[k[line]]
            for away in range(k[-1] + 1):
                near = same & (np.abs(k - k[line]) <= away)
                if free[q, near].sum() >= 12:
                    break
            f, e = free[q, near].sum(), excess[q, near].sum()
            if f < 5:
                f, e = free.sum(), excess.sum()
            out[q, line] += max(0.0, e / f)
    return out


def spectral_covariance(J, runs, left, teeth, highest):
    """[I-14] [I-15] of a joint fit of runs, each of whole turns at even angles

    J     of all runs, shape (3 n, unknowns), three rows a sample
    runs  (angle, turns) of each; left as they are, shape (n, 3) each
    """
    G = np.linalg.inv(J.T @ J)
    tooth = np.arange(highest + 1) % teeth == 0
    cov, first, single = 0, 0, []
    for (angle, turns), d in zip(runs, left):
        n = len(angle)
        own = J[first:first + 3 * n].reshape(n, 3, -1)
        first += 3 * n
        scale = np.sqrt(np.where(np.arange(2 * highest + 1) == 0, 1.0, 2.0) / n)
        x = np.einsum("nk,nqp->qkp", waves(angle, highest), own) * scale[None, :, None]
        h = np.einsum("qki,ij,qkj->qk", x, G, x)
        P = power(*by_turn(angle, d, turns, highest), h, tooth)
        u = x @ G
        cov = cov + np.einsum("qki,qk,qkj->ij", u, P, u)
        single.append(G @ np.einsum("nqp,nq->p", own, d))
    R = len(runs)
    if R > 1:
        ratio = np.sum(np.square(single), axis=0) / np.diag(cov)
        cov = cov * max(1.0, R / (R - 1) * np.mean(ratio))
    return cov


def widening(angles, left, unknowns):
    """[I-13] by how much intervals are wider than white noise would make them."""
    def c2(values, following):
        r = np.sum(values * following) / np.sum(values**2)
        r = min(max(r, 0.0), 0.999)
        return (1 + r) / (1 - r)

    counted = white = samples = 0.0
    for angle, d in zip(angles, left):
        n = len(angle)
        bins = int(min(max(round((n - 1) * 2 * np.pi / (angle[-1] - angle[0])), 1), 720))
        at = np.floor((angle / (2 * np.pi)) % 1.0 * bins + 1e-6).astype(int) % bins
        count = np.bincount(at, minlength=bins)
        mean = np.stack([np.bincount(at, d[:, q], bins) / np.maximum(count, 1)
                         for q in range(3)], axis=1)
        ends = np.zeros((1, 3))
        total = np.sum(d**2)
        used = np.count_nonzero(count)
        if n < 2 * used:
            own = c2(d, np.vstack([d[1:], ends])) * total
        else:
            w = d - mean[at]
            scatter = np.sum(w**2) / (n - used)
            repeats = max(0.0, np.sum(count[:, None] * mean**2) - used * scatter)
            own = (c2(w, np.vstack([w[1:], ends])) * (total - repeats)
                   + n / used * c2(mean, np.roll(mean, -1, axis=0)) * repeats)
        counted += own
        white += total
        samples += n
    return np.sqrt(min(max(counted / white, 1.0), max(1.0, samples / (unknowns + 1))))
