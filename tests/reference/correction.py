"""A table that moves against runout, after [diez2010].

Written apart from the C++: dense grids instead of nodes and parabolas, the trapezoid rule
instead of quadrature, the motion as a plain function of the spindle angle, the plant by
solving its linear equations. Units: mm, N, s, rad; k0 in N/mm^(2-m). Forces on the tool,
teeth numbered in order of passage.

Ids: R-1, R-3 to R-6, R-11 to R-14, R-20 of docs/theory/correction.md.
"""
import numpy as np

TURN = 2 * np.pi


def delay(N, k):
    return k * TURN / N


def chip(phi, j, X, ft, rho, arc, marks):
    """Chip of tooth j at the spindle angles phi, the table at X(phi).  R-1

    marks: how many teeth before are looked at; 1 is the literal eq. (1)."""
    N = len(rho)
    theta = np.mod(phi - j * TURN / N, TURN)
    s = np.sin(theta)
    h = np.min([k * ft * s + rho[j] - rho[(j - k) % N]
                - (X(phi) - X(phi - delay(N, k))) * s for k in range(1, marks + 1)], axis=0)
    return np.where((theta > arc[0]) & (theta < arc[1]), np.maximum(h, 0), 0)


def forces(phi, X, cut):
    """(Fx, Fy, Fz) on the tool; Fz = -Fa as in docs/notation.md."""
    N = len(cut["rho"])
    F = np.zeros((3, len(phi)))
    law = cut["law"]
    for j in range(N):
        h = chip(phi, j, X, cut["ft"], cut["rho"], cut["arc"], cut["marks"])
        theta = phi - j * TURN / N
        t, r, a = (law["k" + s] * np.where(h > 0, h, 1) ** (1 - law["m" + s]) * (h > 0)
                   * cut["ap"] for s in "tra")
        F += [-np.cos(theta) * t - np.sin(theta) * r,
              np.sin(theta) * t - np.cos(theta) * r, -a]
    return F


def flutes(X, cut, count=200001):
    """Peak of |Fy| and chip area of each flute.

    A tooth owns the angles at which it is the nearest to the middle of the arc of cut."""
    N = len(cut["rho"])
    middle = sum(cut["arc"]) / 2
    out = []
    for j in range(N):
        own = j * TURN / N + middle + np.linspace(-0.5, 0.5, count) * (TURN / N - 2e-9)
        peak = np.max(np.abs(forces(own, X, cut)[1]))
        arc = j * TURN / N + np.linspace(*cut["arc"], count)
        h = chip(arc, j, X, cut["ft"], cut["rho"], cut["arc"], cut["marks"])
        out.append((peak, np.sum((h[1:] + h[:-1]) / 2) * (arc[1] - arc[0])))
    return np.array(out)


def arc_of(engagement, R, ae):
    """Entry and exit angle, R-2 without runout."""
    if engagement == "slot":
        return 0.0, np.pi
    reach = np.arccos((R - ae) / R)
    return (0.0, reach) if engagement == "up" else (np.pi - reach, np.pi)


def levels(rho):
    return np.asarray(rho) - np.mean(rho)


def square(rho, arc):
    """Levels that change half a pitch before the middle of a tooth's arc.  R-4"""
    x, N = levels(rho), len(rho)
    start = sum(arc) / 2 - np.pi / N
    return lambda phi: x[np.floor(np.mod(phi - start, TURN) * N / TURN).astype(int) % N]


def quintic(rho, arc, width):
    """The same with smooth changes of level.  R-4"""
    x, N = levels(rho), len(rho)
    start = sum(arc) / 2 - np.pi / N

    def motion(phi):
        u = np.mod(phi - start + np.pi / N, TURN) * N / TURN  # changes at whole u + 1/2
        j = np.floor(u).astype(int)
        v = np.clip(((u - j - 0.5) * TURN / N) / width + 0.5, 0, 1)
        rise = v**3 * (10 - 15 * v + 6 * v * v)
        return x[(j - 1) % N] + (x[j % N] - x[(j - 1) % N]) * rise

    return motion


def sine(rho, arc):
    """a sin + b cos through the levels by (smallest) least squares.  R-5"""
    x, N = levels(rho), len(rho)
    at = np.arange(N) * TURN / N + sum(arc) / 2
    a, b = np.linalg.lstsq(np.column_stack([np.sin(at), np.cos(at)]), x, rcond=1e-9)[0]
    return lambda phi: a * np.sin(phi) + b * np.cos(phi)


def harmonics(X, n_max, count=100000):
    """Complex amplitudes of harmonics 1 to n_max.  R-6"""
    phi = (np.arange(count) + 0.5) * TURN / count
    c = np.fft.rfft(X(phi)) * 2 / count
    n = np.arange(1, n_max + 1)
    return c[1:n_max + 1] * np.exp(-1j * n * TURN * 0.5 / count)


def plant(w, act, table, ks, cs):
    """X over x_com at one frequency: the equations of motion T-2 and T-4 solved.  R-11"""
    a0, a1, a2 = (1 / act["K0"], (act["T1"] + act["T2"]) / act["K0"],
                  act["T1"] * act["T2"] / act["K0"])
    s = 1j * w
    A = np.array([[a2 * s * s + a1 * s + a0, 0],
                  [-(ks + cs * s), table["m"] * s * s + table["c"] * s + table["k"]]])
    return np.linalg.solve(A, [1, 0])[1]


def inverse(c, Omega, act, table, ks, cs, Ts=0.0):
    """Harmonics of the command.  R-13"""
    n = np.arange(1, len(c) + 1)
    P = np.array([plant(k * Omega, act, table, ks, cs) for k in n])
    return c * np.exp(1j * n * Omega * Ts / 2) / P


def inverse_in_time(X, phi, Omega, act, d=1e-4):
    """a0 x + a1 x' + a2 x'' by difference quotients.  R-14"""
    x, up, down = X(phi), X(phi + d), X(phi - d)
    return (x + (act["T1"] + act["T2"]) * Omega * (up - down) / (2 * d)
            + act["T1"] * act["T2"] * Omega**2 * (up - 2 * x + down) / d**2) / act["K0"]


def lead(act, Ts):
    return act["T1"] + act["T2"] + Ts / 2


def ratio(F1, F2, ft, m):
    r = (F1 / F2) ** (1 / (1 - m))
    return ft * (r - 1) / (r + 1)
