"""A turn as a piecewise trigonometric polynomial: docs/theory/force.md F-10 to F-13 and
chip.md C-9, C-10, written down once more from the formulas.

For slots with the trochoidal chip; breaks are found by looking at every chip.
"""
import numpy as np

import chip
import geometry


def series(a, theta_p, count):
    """Coefficients y_n of theta_p + delta and C_n of its cosine, n < count [C-9]"""
    S, C, d, y = (np.zeros(count) for _ in range(4))
    C[0], y[0] = 1.0, theta_p
    for n in range(1, count):
        S[n] = -a * y[n - 1]
        C[n] = -sum(C[i] * C[n - i] + S[i] * S[n - i] for i in range(1, n)) / 2
        d[n] = S[n] - sum(i * d[i] * C[n - i] for i in range(1, n)) / n
        y[n] = d[n]
    return y, C


def over_mark(case, j, m, theta, count=16):
    """Chip of tooth j over the mark of the m-th tooth before [C-10]"""
    r = case.tool.D / 2
    R = r + case.rad
    k = (j - m) % case.tool.N
    turned = sum(case.tool.pitch[(j - i) % case.tool.N] for i in range(1, m + 1))
    feed = case.f / (2 * np.pi)
    y, C = series(feed / R[k], turned, count)
    c = np.cos(theta)
    powers = c[:, None] ** np.arange(count)
    return (R[j] - R[k] - R[k] * powers[:, 2:] @ C[2:]
            + feed * np.sin(theta) * (powers @ y))


def pieces(case, j, count=20000):
    """[from, to, m]: where the mark of the m-th tooth before bounds the chip."""
    r = case.tool.D / 2

    def mark(x):
        x = np.atleast_1d(x)
        code = chip.chip(case, j, x, np.full_like(x, r), np.zeros_like(x))[1]
        return np.where(code > 0, (code - 1) // 4, 0)

    th = -np.pi / 2 + 2 * np.pi * (np.arange(count + 1) + 0.1234567) / count
    m = mark(th)
    ends = []
    for i in np.nonzero(m[1:] != m[:-1])[0]:
        a, b = th[i], th[i + 1]
        for _ in range(60):
            mid = 0.5 * (a + b)
            a, b = (mid, b) if mark(mid)[0] == m[i] else (a, mid)
        ends.append((b, m[i], m[i + 1]))
    return [[a, b, after] for (a, _, after), (b, _, _) in zip(ends, ends[1:]) if after]


def harmonics(g, count=64):
    """Mean, a_k and b_k of a function of theta, shape (3,) and (harmonics, 3)"""
    values = g(2 * np.pi * np.arange(count) / count)
    c = np.fft.rfft(values, axis=0) / count
    return c[0].real, 2 * c[1:count // 2].real, -2 * c[1:count // 2].imag


class Force:
    """The force of one tooth over one mark per height, with its antiderivative."""

    def __init__(self, case, K, j, m):
        e = 1.0 if case.axial_edge else 1 / np.cos(case.tool.helix)

        def g(theta):
            h = over_mark(case, j, m, theta)
            t, r, a = (K[q] * h + K[q + 3] * e for q in range(3))
            s, c = np.sin(theta), np.cos(theta)
            return np.stack([-t * c - r * s, t * s - r * c, -a], -1)

        self.mean, self.a, self.b = harmonics(g)
        self.k = np.arange(1, len(self.a) + 1)

    def g(self, theta):
        x = self.k * theta
        return self.mean + np.cos(x) @ self.a + np.sin(x) @ self.b

    def slope(self, theta):
        x = self.k * theta
        return (np.cos(x) * self.k) @ self.b - (np.sin(x) * self.k) @ self.a

    def G(self, theta):
        """[F-10]"""
        x = self.k * theta
        return self.mean * theta + (np.sin(x) / self.k) @ self.a - (
            np.cos(x) / self.k) @ self.b


def forces(case, K, phi):
    """Shape (n, 3), as the sum of all steps of a turn and of the turns about it."""
    t = case.tool
    lag = geometry.at_height(t, case.a_p)[2]
    F = np.zeros((len(phi), 3))
    for j in range(t.N):
        for b_1, b_2, m in pieces(case, j):
            force = Force(case, K, j, m)
            for n, p in enumerate(phi):
                for turn in range(-1, 2 + int(lag / (2 * np.pi))):
                    theta = p - t.psi[j] + 2 * np.pi * turn
                    F[n] += (steps if lag > 1e-6 else share)(
                        force, theta, b_1, b_2, lag) * case.a_p
    return F


def steps(force, theta, b_1, b_2, lag):
    """The four brackets of a piece, over a_p [F-11]"""
    out = np.zeros(3)
    for b, sign in ((b_1, 1), (b_2, -1)):
        if theta > b:
            out += sign * (force.G(theta) - force.G(b))
        if theta - lag > b:
            out -= sign * (force.G(theta - lag) - force.G(b))
    return out / lag


def share(force, theta, b_1, b_2, lag):
    """The same for a short lag [F-13]"""
    out = np.zeros(3)
    if b_1 + lag < theta <= b_2 + lag:
        out += force.g(theta - lag / 2)
    for b, sign in ((b_1, 1), (b_2, -1)):
        x = (theta - b) / lag if lag else -1.0
        if 0 < x <= 1:
            out += sign * (force.g(b) * x + force.slope(b) * lag * x**2 / 2)
    return out
