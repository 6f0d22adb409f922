"""How cutter and wall give way: mm per N, written from [wang2015] eq. (4)-(7).

Heights z count from the cutter tip upward, y from the clamped foot of the wall.
"""
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre, polynomial
from scipy import linalg


@dataclass(frozen=True)
class Cutter:
    """A cantilever of two diameters: the arbor, and a fluted part below it."""
    overhang: float
    flute_length: float
    d_arbor: float
    d_equivalent: float
    E: float


@dataclass(frozen=True)
class Wall:
    """A plate clamped at x = 0, x = length and y = 0, free at y = height."""
    length: float
    height: float
    thickness: float
    E: float
    nu: float


def second_moment(d):
    return np.pi * d**4 / 64


def bending(a, b, lo, hi):
    """Integral of (a - s)(b - s) over s from lo to hi."""
    p = polynomial.polyint(polynomial.polymul([a, -1.0], [b, -1.0]))
    return polynomial.polyval(hi, p) - polynomial.polyval(lo, p)


def cutter_influence(c, z_obs, z_load):
    """Deflection at z_obs for 1 N at z_load, by the unit-load integral of eq. (4)."""
    s1, s2 = c.overhang - z_obs, c.overhang - z_load
    end, joint = min(s1, s2), c.overhang - c.flute_length
    arbor = bending(s1, s2, 0.0, min(end, joint)) / second_moment(c.d_arbor)
    flutes = bending(s1, s2, joint, end) / second_moment(c.d_equivalent) if end > joint else 0
    return (arbor + flutes) / c.E


def cutter_by_parts(c, h, F_z):
    """The paper's split of eq. (4), load in the fluted part: arbor, its slope, flutes."""
    Ls, p, u = c.overhang - c.flute_length, c.flute_length - F_z, c.flute_length - h
    EIs, EIt = c.E * second_moment(c.d_arbor), c.E * second_moment(c.d_equivalent)
    delta_s = (Ls**3 / 3 + p * Ls**2 / 2) / EIs
    theta_s = (Ls**2 / 2 + p * Ls) / EIs
    delta_t = (3 * p * u**2 - u**3 + max(F_z - h, 0.0) ** 3) / (6 * EIt)
    return delta_s + theta_s * u + delta_t


def twice_integrated(n, clamped_both):
    """Legendre series on [-1, 1] whose second derivative is one P_k.

    Clamped at both ends: P_2, P_3, ...; clamped at -1 only: P_0, P_1, ...
    """
    first = 2 if clamped_both else 0
    return [legendre.legint(np.eye(k + 1)[k], 2, lbnd=-1) for k in range(first, first + n)]


def basis(series, span, s, order):
    """Derivative `order` of each function at the places s of [0, span]: [place, function]."""
    t = 2 * np.asarray(s, float) / span - 1
    columns = [legendre.legval(t, legendre.legder(c, order)) for c in series]
    return np.array(columns).T * (2 / span) ** order


def gram(series, span, i, j):
    """Integral over the span of derivative i of one function times derivative j of another."""
    t, w = legendre.leggauss(len(series) + 6)
    s = (t + 1) * span / 2
    return (basis(series, span, s, i).T * (w * span / 2)) @ basis(series, span, s, j)


class Plate:
    """Ritz over X_m(x) Y_n(y), eq. (7); `terms` along x and y."""

    def __init__(self, wall, terms=None):
        if terms is None:
            terms = (36, 30) if wall.length <= 2.5 * wall.height else (60, 40)
        self.wall = wall
        self.X, self.Y = twice_integrated(terms[0], True), twice_integrated(terms[1], False)
        a, b, nu = wall.length, wall.height, wall.nu
        X = {ij: gram(self.X, a, *ij) for ij in ((0, 0), (1, 1), (2, 2), (2, 0), (0, 2))}
        Y = {ij: gram(self.Y, b, *ij) for ij in ((0, 0), (1, 1), (2, 2), (2, 0), (0, 2))}
        self.stiffness = wall.E * wall.thickness**3 / (12 * (1 - nu**2))
        form = (np.kron(X[2, 2], Y[0, 0]) + np.kron(X[0, 0], Y[2, 2])
                + nu * (np.kron(X[2, 0], Y[0, 2]) + np.kron(X[0, 2], Y[2, 0]))
                + 2 * (1 - nu) * np.kron(X[1, 1], Y[1, 1]))
        self.scale = 1 / np.sqrt(np.diag(form))
        self.factor = linalg.cho_factor(self.stiffness * form * np.outer(self.scale, self.scale))

    def functions(self, x, y):
        """X_m(x) Y_n(y) at the places (x, y), one row each."""
        x, y = np.broadcast_arrays(np.atleast_1d(x), np.atleast_1d(y))
        fx, fy = basis(self.X, self.wall.length, x, 0), basis(self.Y, self.wall.height, y, 0)
        return np.einsum("pm,pn->pmn", fx, fy).reshape(len(x), -1)

    def solve(self, work):
        """Coefficients C_mn for the work of the load on each function."""
        work = np.asarray(work).T
        return self.scale * linalg.cho_solve(self.factor, (work.T * self.scale).T).T

    def point(self, x, y_obs, y_load):
        """Deflection at (x, y_obs) for 1 N at (x, y_load): [observed, loaded]."""
        return self.functions(x, y_obs) @ self.solve(self.functions(x, y_load)).T

    def line(self, x, y_obs, y_from, y_to):
        """Deflection at (x, y_obs) for 1 N spread evenly from y_from to y_to."""
        t, w = legendre.leggauss(len(self.Y) + 4)
        y = y_from + (t + 1) * (y_to - y_from) / 2
        work = (w / 2) @ self.functions(x, y)
        return self.functions(x, y_obs) @ self.solve(work)

    def uniform(self, x, y):
        """Deflection at (x, y) for a pressure of 1 on the whole plate."""
        whole_x = gram_with_one(self.X, self.wall.length)
        whole_y = gram_with_one(self.Y, self.wall.height)
        return self.functions(x, y) @ self.solve(np.outer(whole_x, whole_y).ravel())


def gram_with_one(series, span):
    t, w = legendre.leggauss(len(series) + 6)
    return (w * span / 2) @ basis(series, span, (t + 1) * span / 2, 0)


@lru_cache(maxsize=8)
def plate(wall):
    return Plate(wall)


@dataclass(frozen=True)
class Structure:
    """What gives way, at one place x of the wall; `a_p` puts the cutter tip at y = b - a_p."""
    cutter: Cutter
    wall: Wall | None
    x: float
    a_p: float

    def wall_influence(self, z_obs, z_load):
        if self.wall is None:
            return np.zeros((len(z_obs), len(z_load)))
        foot = self.wall.height - self.a_p
        return plate(self.wall).point(self.x, foot + np.asarray(z_obs),
                                      foot + np.asarray(z_load))

    def influence(self, z_obs, z_load):
        """G(z_obs, z_load) of cutter and wall together [observed, loaded], eq. (8)."""
        return _influence(self, tuple(z_obs), tuple(z_load))

    def concentrated(self, z_obs):
        """c(h) of the paper's load: at a_p/2 on the cutter, a uniform line on the wall."""
        c = np.array([cutter_influence(self.cutter, h, self.a_p / 2) for h in z_obs])
        if self.wall is None:
            return c
        foot = self.wall.height - self.a_p
        return c + plate(self.wall).line(self.x, foot + np.asarray(z_obs), foot,
                                         self.wall.height)


@lru_cache(maxsize=512)
def _influence(structure, z_obs, z_load):
    G = np.array([[cutter_influence(structure.cutter, h, z) for z in z_load] for h in z_obs])
    return G + structure.wall_influence(z_obs, z_load)
