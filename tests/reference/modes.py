"""Modes and actuators, written once more: plain formulas and scipy's fits.

Ids: M-1 to M-4, M-6 to M-8, M-11, M-13 of docs/theory/modes.md.
"""
import numpy as np
from scipy import optimize, signal


def receptance(modes, f):
    """Sum of 1/(k - m w^2 + i c w) over (m, k, c).  M-3, M-6"""
    w = 2 * np.pi * np.asarray(f)
    return sum(1 / (k - m * w**2 + 1j * c * w) for m, k, c in modes)


def accelerance(modes, f):
    return -(2 * np.pi * np.asarray(f))**2 * receptance(modes, f)  # M-4


def fit_accelerance(f, H, start):
    """Least squares over (m, k, c) of every mode, from a start near by.  M-7

    Returns the modes and their standard errors, both shape (modes, 3)."""
    x0 = np.asarray(start, float)

    def residual(p):
        d = (accelerance(np.reshape(p, x0.shape) * x0, f) - H) / np.abs(H).max()
        return np.concatenate([d.real, d.imag])

    fit = optimize.least_squares(residual, np.ones(x0.size), method="lm", xtol=1e-14,
                                 ftol=1e-14, gtol=1e-14)
    s2 = 2 * fit.cost / (2 * len(f) - x0.size)
    se = np.sqrt(s2 * np.diag(np.linalg.inv(fit.jac.T @ fit.jac)))
    return fit.x.reshape(x0.shape) * x0, se.reshape(x0.shape) * x0


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
