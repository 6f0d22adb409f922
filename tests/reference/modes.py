"""Modes and actuators, written once more: plain formulas and scipy's fits.

Ids: M-1 to M-4, M-6 to M-8, M-11, M-13, M-15, M-16, M-20, M-21, M-30 to M-34 of docs/theory/modes.md.
"""
import numpy as np
from scipy import optimize, signal


def receptance(modes, f):
    """Sum of 1/(k - m w^2 + i c w) over (m, k, c).  M-3, M-6"""
    w = 2 * np.pi * np.asarray(f)
    return sum(1 / (k - m * w**2 + 1j * c * w) for m, k, c in modes)


def accelerance(modes, f):
    return -(2 * np.pi * np.asarray(f))**2 * receptance(modes, f)  # M-4


def noise(r, H, leverage):
    """Floor, fraction of magnitude and of phase: r complex, turned along H.  M-15

    The residuals are those of maximum likelihood but for their leverage."""
    scale = np.abs(H).max()
    power = np.tile(np.abs(H / scale)**2, 2)
    raw = np.concatenate([r.real, r.imag])**2 / scale**2
    y = raw / (1 - leverage)
    across = np.arange(power.size) >= len(r)

    def deviance(v, of):
        s2 = v[0] + np.where(across, v[2], v[1]) * power
        return np.sum(np.log(s2) + of / s2)

    found = []
    for spread in (lambda q: (q[0], 0, 0), lambda q: (q[0], q[1], q[1]), lambda q: q):
        q = len(found) + 1
        start = np.log([y.mean(), *([y.mean() / power.mean()] * 2)][:q])
        fit = optimize.minimize(lambda x: deviance(spread(np.exp(x)), y), start,
                                method="Nelder-Mead",
                                options={"xatol": 1e-10, "fatol": 1e-12, "maxiter": 10000,
                                         "maxfev": 10000})
        v = np.array(spread(np.exp(fit.x)))
        found.append((deviance(v, raw) + q * np.log(2 * len(r)), tuple(np.sqrt(v))))
    floor, magnitude, phase = min(found)[1]
    return floor * scale, magnitude, phase


def fit_accelerance(f, H, start):
    """Least squares over (m, k, c) of every mode, weighted by the noise.  M-7, M-16

    Returns the modes, their standard errors, both shape (modes, 3), and the noise."""
    x0 = np.asarray(start, float)
    p = np.ones(x0.size)
    along = across = np.full(len(f), 1 / np.abs(H).max())
    turn = np.ones(len(f))
    before = np.zeros(x0.size)

    def model(p):
        return accelerance(np.reshape(p, x0.shape) * x0, f)

    while np.max(np.abs(p - before)) > 1e-10:
        before = p

        def residual(p):
            d = (H - model(p)) * turn
            return np.concatenate([d.real * along, d.imag * across])

        fit = optimize.least_squares(residual, p, method="lm", xtol=1e-14, ftol=1e-14,
                                     gtol=1e-14)
        p = fit.x
        cov = np.linalg.inv(fit.jac.T @ fit.jac)
        turn = np.conj(model(p)) / np.abs(model(p))
        sigma = noise((H - model(p)) * turn, model(p),
                      np.einsum("ia,ab,ib->i", fit.jac, cov, fit.jac))
        along = 1 / np.hypot(sigma[0], sigma[1] * np.abs(model(p)))
        across = 1 / np.hypot(sigma[0], sigma[2] * np.abs(model(p)))
    se = np.sqrt(np.diag(cov)).reshape(x0.shape) * x0
    return p.reshape(x0.shape) * x0, se, sigma


def shared(w, poles, phi, j, k):
    """Receptance of motion j to a force along k as a sum of pairs of poles.  M-30

    poles of shape (modes,) above the real axis; phi (modes, 2), complex for complex shapes."""
    s = 1j * np.asarray(w)[:, None]
    residue = -1j * phi[:, j] * phi[:, k] / (2 * poles.imag)
    return (residue / (s - poles) + np.conj(residue) / (s - np.conj(poles))).sum(1)


def rank_one(Zxx, Zxy, Zyy):
    """The factor of a symmetric matrix of rank one, by its larger direct entry.  M-32"""
    if Zxx.real >= Zyy.real:
        first = np.sqrt(Zxx)
        return np.array([first, Zxy / first])
    first = np.sqrt(Zyy)
    return np.array([Zxy / first, first])


def told(omega, zeta, phi):
    """Mass, stiffness, damping, direction in degrees, imaginary fraction.  M-33"""
    m = 1 / np.sum(np.abs(phi)**2)
    return (m, m * omega**2, 2 * m * zeta * omega,
            np.degrees(np.arctan(phi[1].real / phi[0].real)),
            np.linalg.norm(phi.imag) / np.linalg.norm(phi))


def fit_shared(f, responses, start, complex_shapes):
    """Common modes of accelerances {"xy": H}, each weighted by its own noise.  M-31

    start: rows of omega, zeta, Re phi x, y[, Im phi x, y]. Without residual terms.
    Returns those rows, their covariance over the flattened rows, and the models."""
    w = 2 * np.pi * f
    x0 = np.asarray(start, float)
    p = np.ones(x0.size)
    weights = {name: (1, 1 / np.abs(H).max(), 1 / np.abs(H).max())
               for name, H in responses.items()}

    def models(p):
        rows = p.reshape(x0.shape) * x0
        omega, zeta = rows[:, 0], rows[:, 1]
        poles = -zeta * omega + 1j * omega * np.sqrt(1 - zeta**2)
        phi = rows[:, 2:4] + (1j * rows[:, 4:6] if complex_shapes else 0)
        return {name: -w**2 * shared(w, poles, phi, "xy".index(name[0]), "xy".index(name[1]))
                for name in responses}

    def residual(p):
        M = models(p)
        out = []
        for name, H in responses.items():
            turn, along, across = weights[name]
            d = (H - M[name]) * turn
            out += [d.real * along, d.imag * across]
        return np.concatenate(out)

    before = np.zeros(x0.size)
    while np.max(np.abs(p - before)) > 1e-9:
        before = p
        fit = optimize.least_squares(residual, p, method="lm", xtol=1e-13, ftol=1e-13,
                                     gtol=1e-13)
        p = fit.x
        cov = np.linalg.inv(fit.jac.T @ fit.jac)
        leverage = np.einsum("ia,ab,ib->i", fit.jac, cov, fit.jac)
        M = models(p)
        for i, (name, H) in enumerate(responses.items()):
            turn = np.conj(M[name]) / np.abs(M[name])
            n = 2 * len(f)
            floor, magnitude, phase = noise((H - M[name]) * turn, M[name],
                                            leverage[i * n:(i + 1) * n])
            weights[name] = (turn, 1 / np.hypot(floor, magnitude * np.abs(M[name])),
                             1 / np.hypot(floor, phase * np.abs(M[name])))
    scale = x0.ravel()
    return p.reshape(x0.shape) * x0, cov * np.outer(scale, scale), models(p), weights


def gain(H, M, weights):
    """By which real factor of M a response is fitted best, with its error.  M-34"""
    turn, along, across = weights
    A = np.concatenate([(M * turn).real * along, (M * turn).imag * across])
    b = np.concatenate([(H * turn).real * along, (H * turn).imag * across])
    return A @ b / (A @ A), 1 / np.sqrt(A @ A)


def h1(force, response, starts, n, rate, window_end):
    """H1 and coherence of blows whose pulses begin at given samples.  M-20, M-21

    Blocks begin a hundredth before the pulse; what stands there is taken off. The pulse
    ends below 3 % of the largest force; the force is kept for four times its width and fades over four more."""
    lead = int(0.01 * n)
    window = window_end ** (np.arange(n) / n)
    ff = xx = xf = 0
    for start in starts:
        y = force[start - lead:start - lead + n] - force[start - lead:start].mean()
        x = response[start - lead:start - lead + n] - response[start - lead:start].mean()
        low = np.abs(force[start:]) < 0.03 * np.abs(force).max()
        width = int(np.argmax(low)) + 1
        fade = np.clip((np.arange(n) - lead - 5 * width) / (4 * width), 0, 1)
        F = np.fft.rfft(y * window * (0.5 + 0.5 * np.cos(np.pi * fade)))
        X = np.fft.rfft(x * window)
        ff, xx, xf = ff + np.abs(F)**2, xx + np.abs(X)**2, xf + X * np.conj(F)
    return np.fft.rfftfreq(n, 1 / rate), xf / ff, np.abs(xf)**2 / (ff * xx)


def step(gain, S, P, t):
    """Step response of gain/(1 + S s + P s^2), by state-space simulation.  M-8, M-11"""
    out = np.zeros_like(t)
    after = t > 0
    if after.any():
        system = signal.TransferFunction([gain], [P, S, 1]).to_ss()
        A, B, C = system.A, system.B, system.C
        values, V = np.linalg.eig(A)
        # x(t) = A^-1 (e^(A t) - 1) B
        inner = (V * 1) @ np.diag(1 / values)
        W = np.linalg.solve(V, B)
        e = np.exp(np.outer(t[after], values)) - 1
        out[after] = np.real((e * W[:, 0]) @ (C @ inner).ravel())
    return out


def fit_step(t, y, height, t0, start):
    """Least squares over gain, S, P and the rest for a known start.  M-13"""
    x0 = np.asarray(start, float)

    def residual(p):
        gain, S, P = p[:3] * x0
        return (p[3] * height + height * step(gain, S, P, t - t0) - y) / height

    fit = optimize.least_squares(residual, [1, 1, 1, 0], method="lm", xtol=1e-14,
                                 ftol=1e-14, gtol=1e-14)
    s2 = 2 * fit.cost / (len(t) - 4)
    se = np.sqrt(s2 * np.diag(np.linalg.inv(fit.jac.T @ fit.jac)))
    return fit.x[:3] * x0, se[:3] * x0
