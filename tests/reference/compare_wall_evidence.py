"""calibrate's decision between forms of a wall, and its errors that readings share, against numpy.

Imprints at heights and places, one reading each, so that the model is linear: e = M K + form.
    scatter   |Z_k^T r|^2 = sum_l v_l |Z_k^T M Z_l|_F^2, no v_l negative            E-21
    fit       generalised least squares with normal priors of the form              E-23
    weights   chi^2^(-nu/2) |C|^(1/2) prod 1/tau, then mean and covariance over all E-24
"""
import pathlib
import sys
import tempfile
import unittest

import numpy as np

import compare_calibrate as cc
import program

HEIGHTS = np.linspace(0.25, 2.75, 11)
PLACES = np.array([20.07, 25.13, 30.11, 34.97, 40.03])
FORMS = ("none", "offset", "tilt", "curvature")
OFFSET, FORM = 10.0, 5.0  # um, one standard deviation beforehand


def columns(x, h, form):
    """[name, column]; how a wall leans along the feed is always open"""
    u = (2 * h - h.min() - h.max()) / np.ptp(h)
    out = [("lean", x - x.mean())]
    if FORMS.index(form) >= 1:
        out = [("offset", np.ones_like(x))] + out
    if FORMS.index(form) >= 2:
        out.append(("tilt", h - h.mean()))
    if FORMS.index(form) >= 3:
        out.append(("curvature", u * u))
    return out


def weight_of(name, column):
    """1/tau^2 of a coefficient; 0: open"""
    if name == "lean":
        return 0.0
    return (np.abs(column).max() / (OFFSET if name == "offset" else FORM)) ** 2


def groups(values):
    return (values[:, None] == np.unique(values)[None, :]).astype(float)


def shared(A, e, prior, Z):
    """v of one reading and of each Z from what a fit without them leaves (E-21)"""
    n = len(e)
    M = np.eye(n) - A @ np.linalg.solve(A.T @ A + np.diag(prior), A.T)
    r = M @ e
    q = np.array([r @ r] + [np.sum((z.T @ r) ** 2) for z in Z])
    E = np.array([[np.sum((a.T @ M @ b) ** 2) for b in [np.eye(n)] + Z] for a in [np.eye(n)] + Z])
    E[0, 0] = n - A.shape[1]
    E[0, 1:] = E[1:, 0] = [np.trace(z.T @ M @ z) for z in Z]
    kept = list(range(len(q)))
    while True:
        v = np.zeros(len(q))
        v[kept] = np.linalg.solve(E[np.ix_(kept, kept)], q[kept])
        worst = min(kept[1:], key=lambda k: v[k], default=None)
        if worst is None or v[worst] >= 0:
            return v
        kept.remove(worst)


def fit(M, e, cols, W):
    A = np.column_stack([M] + [c for _, c in cols])
    prior = np.array([0.0, 0.0] + [weight_of(n, c) for n, c in cols])
    C = np.linalg.inv(A.T @ W @ A + np.diag(prior))
    p = C @ A.T @ W @ e
    cost = (e - A @ p) @ W @ (e - A @ p) + prior @ p**2
    nu = len(e) - 2
    evidence = (-0.5 * nu * np.log(cost) + 0.5 * np.linalg.slogdet(C)[1]
                + 0.5 * np.log(prior[prior > 0]).sum())
    return p[:2], C[:2, :2], evidence


def decide(M, e, x, h):
    """Weights, and mean and covariance over all forms [MPa, um]"""
    cols = columns(x, h, "curvature")
    A = np.column_stack([M] + [c for _, c in cols])
    base = np.column_stack([M] + [c for _, c in columns(x, h, "offset")])
    left = e - base @ np.linalg.lstsq(base, e, rcond=None)[0]
    s2 = np.mean(left**2)
    prior = s2 * np.array([0.0, 0.0] + [weight_of(n, c) for n, c in cols])
    Z = [groups(h), groups(x)]
    v = shared(A, e, prior, Z)
    W = np.linalg.inv(v[0] * np.eye(len(e)) + sum(a * z @ z.T for a, z in zip(v[1:], Z)))
    fits = [fit(M, e, columns(x, h, form), W) for form in FORMS]
    w = np.exp([f[2] - max(g[2] for g in fits) for f in fits])
    w /= w.sum()
    mean = sum(a * f[0] for a, f in zip(w, fits))
    C = sum(a * (f[1] + np.outer(f[0] - mean, f[0] - mean)) for a, f in zip(w, fits))
    return dict(zip(FORMS, w)), mean, C, v


class WallEvidence(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="trochoid_")
        self.addCleanup(self.folder.cleanup)

    def operator(self):
        """um per MPa at every place and height, place by place"""
        rows = []
        for x in PLACES:
            tables = cc.tables("imprint", surface={"heights_mm": list(HEIGHTS)},
                               force={"K_tc_MPa": 1.0, "K_rc_MPa": 1.0, "K_ac_MPa": 0.0,
                                      "K_te_N_per_mm": 0.0, "K_re_N_per_mm": 0.0,
                                      "K_ae_N_per_mm": 0.0})
            tables["wall"] = {**cc.WALL, "position_mm": float(x)}
            del tables["surface"]["errors"]
            answer = program.run("surface", program.case_text("operator", tables),
                                 self.folder.name, f"operator_{x}")
            rows += [[at["operator"]["K_tc_mm_per_MPa"], at["operator"]["K_rc_mm_per_MPa"]]
                     for at in answer.result["heights"]]
        return 1e3 * np.array(rows)

    def test_forms_and_shared_errors(self):  # [E-20] [E-21] [E-22] [E-23] [E-24]
        M = self.operator()
        x, h = np.repeat(PLACES, len(HEIGHTS)), np.tile(HEIGHTS, len(PLACES))
        u = (h - 1.5) / 1.25
        cases = {"straight": (0.0, 0.0, 1), "waves": (0.8, 0.0, 2), "bow": (0.0, 4.0, 3),
                 "both": (0.6, 3.0, 4)}
        likeliest = set()
        for name, (waves, bow, seed) in cases.items():
            with self.subTest(case=name):
                random = np.random.default_rng(seed)
                e = (M @ [800.0, 300.0] + bow * (1 - u * u) + random.normal(0, 0.5, len(x))
                     + waves * (groups(h) @ random.normal(size=len(HEIGHTS))
                                + groups(x) @ random.normal(size=len(PLACES))))
                weights, mean, C, v = decide(M, e, x, h)
                got = self.calibrate(name, x, h, e)
                for tried in got["explanations"]:
                    self.assertAlmostEqual(tried["weight"], weights[tried["form"]], delta=2e-3)
                likeliest.add(got["explanations"][0]["form"])
                for i, key in enumerate(("K_tc_MPa", "K_rc_MPa")):
                    se = np.sqrt(C[i, i])
                    self.assertAlmostEqual(got["coefficients"][key]["value"], mean[i],
                                           delta=0.01 * se, msg=key)
                    self.assertAlmostEqual(got["coefficients"][key]["se"], se, delta=0.01 * se)
                self.assertAlmostEqual(1e3 * got["scatter"]["own_mm"], np.sqrt(v[0]), delta=1e-3)
                self.assertAlmostEqual(1e3 * got["scatter"]["shared_mm"],
                                       np.sqrt(v[1:].sum()), delta=2e-3)
        self.assertGreater(len(likeliest), 1)  # else it decides nothing

    def calibrate(self, name, x, h, e):
        file = pathlib.Path(self.folder.name) / f"{name}.csv"
        file.write_text("x_mm,height_mm,error_mm\n" + "".join(
            f"{a!r},{b!r},{c!r}\n" for a, b, c in zip(x.tolist(), h.tolist(), (1e-3 * e).tolist())))
        tables = cc.tables("imprint")
        tables["surface"].update(errors="auto", outliers="keep")
        text = program.case_text(name, tables) + (
            f'\n[[surface_measurement]]\nfile = "{file}"\n')
        answer = program.run("calibrate", text, self.folder.name, name)
        self.assertEqual(answer.code, 0, answer.stderr)
        return answer.result


if __name__ == "__main__":
    if not pathlib.Path(program.PROGRAM).exists():
        sys.exit(77)
    unittest.main()
