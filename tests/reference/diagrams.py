"""The limit of well-known cuts once more: semi-discretisation over one tooth pitch, and
Hill's determinant in the frequency domain.

Nothing here is that of the program: directional factors are integrated by hand, the
multiplier comes from first-order semi-discretisation [insperger2011] with two numbers of
steps, the limit from halving; the solution in the frequency domain looks for real
eigenvalues on a fixed grid of frequencies. Straight edges, equal teeth, no runout.
Units: N, m, s, rad.
"""
import dataclasses

import numpy as np


@dataclasses.dataclass
class Cut:
    teeth: int
    K_t: float
    K_r: float
    entry: float          # immersion angles of the stock
    leave: float
    modes: list           # (mass, hertz, ratio, x, y)


def engaged(kind, immersion):
    """Entry and exit of up or down milling, a_e = immersion * D."""
    arc = np.arccos(1 - 2 * immersion)
    return (0, arc) if kind == "up" else (np.pi - arc, np.pi)


def antiderivative(cut, theta):
    """Integral of (-c K_t - s K_r, s K_t - c K_r)^T (s, c) over theta, 2 x 2."""
    ss, cc = theta / 2 - np.sin(2 * theta) / 4, theta / 2 + np.sin(2 * theta) / 4
    sc = np.sin(theta) ** 2 / 2
    t, r = cut.K_t, cut.K_r
    return np.array([[-t * sc - r * ss, -t * cc - r * sc],
                     [t * ss - r * sc, t * sc - r * cc]])


def step_edges(cut, m):
    """About m steps of a pitch, with entry and exit between two of them: the order of
    the method is two only then."""
    pitch = 2 * np.pi / cut.teeth
    ends = np.unique(np.round([0, cut.entry % pitch, cut.leave % pitch, pitch], 12))
    edges = [0.0]
    for a, b in zip(ends, ends[1:]):
        edges += list(np.linspace(a, b, max(m // 3, round(m * (b - a) / pitch)) + 1)[1:])
    return np.array(edges)


def mean_matrices(cut, edges):
    """Mean of the directional matrix over each step, per depth."""
    pitch = 2 * np.pi / cut.teeth
    out = np.zeros((len(edges) - 1, 2, 2))
    for j in range(cut.teeth):
        ends = np.clip(edges + j * pitch, cut.entry, cut.leave)
        values = np.array([antiderivative(cut, e) for e in ends])
        out += np.diff(values, axis=0) / np.diff(edges)[:, None, None]
    return out


def state_space(cut):
    k = len(cut.modes)
    A, B, C = np.zeros((2 * k, 2 * k)), np.zeros((2 * k, 2)), np.zeros((2, 2 * k))
    for i, (mass, hertz, ratio, x, y) in enumerate(cut.modes):
        w = 2 * np.pi * hertz
        A[i, k + i] = 1
        A[k + i, i], A[k + i, k + i] = -w**2, -2 * ratio * w
        B[k + i] = np.array([x, y]) / mass
        C[:, i] = x, y
    return A, B, C


def exponentials(L):
    """e^L of a stack, by scaling and squaring."""
    s = max(0, int(np.ceil(np.log2(np.abs(L).sum(-1).max()))) + 3)
    X = L / 2.0**s
    total = np.eye(L.shape[-1]) + X
    term = X
    for i in range(2, 12):
        term = term @ X / i
        total = total + term
    for _ in range(s):
        total = total @ total
    return total


class Semi:
    """One cut at one speed, for any depth: about m steps of a tooth pitch."""

    def __init__(self, cut, rpm, m):
        self.A, self.B, self.C = state_space(cut)
        edges = step_edges(cut, m)
        self.D = mean_matrices(cut, edges)
        self.dt = np.diff(edges) / (2 * np.pi * rpm / 60)

    def multiplier(self, depth):
        """The multiplier of largest modulus over a pitch."""
        size, m = len(self.A), len(self.dt)
        D = depth * self.D
        # x' = (A + B D C) x - B D q(t - tau), q(t - tau) linear over a step
        big = np.zeros((m, size + 4, size + 4))
        big[:, :size, :size] = self.A + self.B @ D @ self.C
        big[:, :size, size:size + 2] = -self.B @ D
        big[:, size:size + 2, size + 2:] = \
            np.eye(2) / self.dt[:, None, None]
        E = exponentials(big * self.dt[:, None, None])
        P, R0, R1 = E[:, :size, :size], E[:, :size, size:size + 2], E[:, :size, size + 2:]
        # Rows: state, then q one to m steps ago.
        U = np.eye(size + 2 * m)
        for i in range(m):
            first = U[size + 2 * (m - 1):]
            last = U[size + 2 * (m - 2):size + 2 * (m - 1)]
            new = P[i] @ U[:size] + R0[i] @ first + R1[i] @ (last - first)
            U = np.vstack([new, self.C @ U[:size], U[size:size + 2 * (m - 1)]])
        values = np.linalg.eigvals(U)
        return values[np.argmax(np.abs(values))]


def limit_depth(cut, rpm, depths, m=48):
    """Least depth with |mu| = 1, extrapolated from m and 2 m steps; mu there (2 m)."""
    found = []
    for steps in (m, 2 * m):
        semi = Semi(cut, rpm, steps)
        stable = 0.0
        for depth in depths:
            if abs(semi.multiplier(depth)) > 1:
                break
            stable = depth
        else:
            return None, None
        unstable = depth
        while unstable - stable > 1e-6 * unstable:
            middle = (stable + unstable) / 2
            if abs(semi.multiplier(middle)) > 1:
                unstable = middle
            else:
                stable = middle
        found.append(unstable)
    return found[1] + (found[1] - found[0]) / 3, semi.multiplier(unstable)


def kind(mu):
    return ("period_doubling" if mu.real < 0 and abs(mu.imag) < 1e-6 else
            "period_one" if abs(mu.imag) < 1e-6 else "hopf")


def receptance(cut, w):
    G = np.zeros((len(w), 2, 2), complex)
    for mass, hertz, ratio, x, y in cut.modes:
        n = 2 * np.pi * hertz
        H = 1 / (mass * (n**2 - w**2 + 2j * ratio * n * w))
        G += H[:, None, None] * np.outer((x, y), (x, y))
    return G


def coefficient(cut, n):
    """n-th Fourier coefficient of the directional matrix over a pitch, per depth: one
    integral over the arc of a tooth."""
    theta = np.linspace(cut.entry, cut.leave, 4001)
    s, c = np.sin(theta), np.cos(theta)
    g = np.array([[-c * cut.K_t - s * cut.K_r, s * cut.K_t - c * cut.K_r]]) * \
        np.array([[s], [c]])
    g = g.transpose(1, 0, 2) * np.exp(-1j * n * cut.teeth * theta)
    w = np.full(theta.size, theta[1] - theta[0])
    w[[0, -1]] /= 2
    return np.array([[(g[i, j] * w).sum() for j in range(2)] for i in range(2)]) * \
        cut.teeth / (2 * np.pi)


def frequency_limit(cut, rpm, h, band=(100, 4000), step=0.25, lag=0.0):
    """Least depth with a real eigenvalue 1 of D-22, h harmonics on each side. With a helix
    the wave n of the force is turned along the edge, by `lag` [rad] from tip to top."""
    passing = 2 * np.pi * rpm / 60 * cut.teeth
    A = {n: coefficient(cut, n) * np.exp(-0.5j * n * cut.teeth * lag) *
         np.sinc(n * cut.teeth * lag / 2 / np.pi) for n in range(-2 * h, 2 * h + 1)}
    w = 2 * np.pi * np.arange(*band, step)
    k = np.arange(-h, h + 1)
    turned = 1 - np.exp(-1j * w * 2 * np.pi / passing)  # the same at every harmonic
    size = 2 * len(k)
    M = np.zeros((len(w), size, size), complex)
    inside = 2 * np.pi * np.array(band)
    for a in range(len(k)):
        wk = w + k[a] * passing
        G = receptance(cut, wk)
        G[np.abs(wk) > inside[1]] = 0
        for b in range(len(k)):
            M[:, 2 * a:2 * a + 2, 2 * b:2 * b + 2] = \
                (G @ A[k[a] - k[b]]) * turned[:, None, None]
    values = np.linalg.eigvals(M)
    best, where = np.inf, 0
    for i in range(len(w) - 1):
        now, after = values[i], values[i + 1]
        for v in now[now.real > 1e-12 + 1 / (1.2 * best if best < np.inf else 1)]:
            to = after[np.argmin(np.abs(after - v))]
            if v.imag * to.imag < 0:
                t = v.imag / (v.imag - to.imag)
                real = v.real + t * (to.real - v.real)
                if real > 0 and 1 / real < best:
                    best, where = 1 / real, (w[i] + t * (w[i + 1] - w[i])) / 2 / np.pi
    return best, where
