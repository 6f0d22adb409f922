"""What readings of a wall will tell before they are taken: E-60 to E-63."""
import numpy as np
from scipy import stats

import surface_calibrate as cal
import surface_error as se


def form_columns(form, x, h):
    """E-61: each form has the columns of those before it"""
    columns = {"none": 0, "offset": 1, "tilt": 3, "curvature": 4}[form]
    about = [np.ones(len(x)), x - x.mean(), h - h.mean(), (h - h.mean())**2]
    return np.column_stack(about[:columns]) if columns else np.zeros((len(x), 0))


def covariance(J, noise):
    """E-60"""
    size = np.linalg.norm(J, axis=0)
    scaled = J / size
    return noise**2 * np.linalg.inv(scaled.T @ scaled) / np.outer(size, size)


def imprints(m, structure, heights, per_height, x0):
    """Travel, height and tooth of the readings of a design: every tooth as often"""
    in_each = per_height // m.N
    turns = max(1, in_each // 4)
    travel, height, tooth = [], [], []
    for h in heights:
        for turn in range(turns):
            for k in range(m.N):
                for _ in range(in_each // turns):
                    travel.append(x0 + m.fz * (k + turn * m.N))
                    height.append(h)
                    tooth.append(k)
    return np.array(travel), np.array(height), np.array(tooth)


def by_runout(m, structure, h, tooth, K, step=1e-6):
    """Derivatives of imprints by rho cos(lambda) and rho sin(lambda)"""
    e = np.array([m.rho * np.cos(m.lam), m.rho * np.sin(m.lam)])

    def predict(ecc):
        bent = cal.eccentric(m, ecc)
        at = np.zeros(len(h))
        M = cal.imprint_rows(bent, lambda _: structure, at, h, "distributed", tooth)
        return M @ K + se.runout_error(bent, tooth, h)

    return np.column_stack([(predict(e + d) - predict(e - d)) / (2 * step)
                            for d in step * np.eye(2)])


def half_widths(m, structure, heights, per_height, x0, K, form, noise):
    """Half of the 95 % intervals of K_tc, K_rc and the eccentricity; None: not told apart"""
    x, h, tooth = imprints(m, structure, heights, per_height, x0)
    F = form_columns(form, x, h)
    at = np.zeros(len(h))
    means = cal.imprint_rows(m, lambda _: structure, at, h, "distributed")
    single = cal.imprint_rows(m, lambda _: structure, at, h, "distributed", tooth)
    columns = np.column_stack([means, F])
    if len(h) <= columns.shape[1] + 2 or not cal.rank_and_condition(columns)[1] <= 1000:
        return None
    C = covariance(columns, noise)
    joint = covariance(np.column_stack([by_runout(m, structure, h, tooth, K), single, F]),
                       noise)
    along = np.array([np.cos(m.lam), np.sin(m.lam)])
    t = stats.t.ppf(0.975, len(h) - joint.shape[0])
    return t * np.sqrt([C[0, 0], C[1, 1], along @ joint[:2, :2] @ along])


def removal_rate(cut, teeth):
    """E-62, mm^3/min"""
    return (cut["axial_depth_mm"] * cut["radial_depth_mm"] * teeth *
            cut["feed_per_tooth_mm"] * cut["spindle_rpm"])
