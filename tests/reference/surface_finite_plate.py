"""A wall by conforming finite elements (Bogner, Fox and Schmit), written from B-3, B-9 and B-10.

The element is the product of two lines of cubic Hermite shapes, so that the plate is sums of
products of matrices of lines. Nothing of it is shared with the Ritz shapes of the program.
"""
from functools import lru_cache

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

GAUSS = np.polynomial.legendre.leggauss(4)  # exact for products of cubics


@lru_cache(maxsize=None)
def unit_hermite(s, order):
    """Derivative of the four shapes of an element of length 1 at s"""
    shapes = ([1, 0, -3, 2], [0, 1, -2, 1], [0, 0, 3, -2], [0, 0, -1, 1])
    return np.array([np.polyval(np.polyder(np.poly1d(p[::-1]), order), s) for p in shapes])


def hermite(s, length, order):
    """Derivative of the four shapes at s in [0, 1]: value and slope here, value and slope there"""
    return unit_hermite(s, order) * (1, length, 1, length) / length**order


def line(nodes, p, q, weight=None):
    """Integral of derivative p times derivative q of all shapes, times weight(element)"""
    size = 2 * len(nodes)
    out = np.zeros((size, size))
    for e, (a, b) in enumerate(zip(nodes, nodes[1:])):
        one = sum(w / 2 * np.outer(hermite((t + 1) / 2, b - a, p), hermite((t + 1) / 2, b - a, q))
                  for t, w in zip(*GAUSS)) * (b - a)
        at = slice(2 * e, 2 * e + 4)
        out[at, at] += one * (1.0 if weight is None else weight[e])
    return sparse.csr_matrix(out)


def even(nodes):
    """Integral of every shape"""
    out = np.zeros(2 * len(nodes))
    for e, (a, b) in enumerate(zip(nodes, nodes[1:])):
        out[2 * e:2 * e + 4] += sum(w / 2 * hermite((t + 1) / 2, b - a, 0)
                                    for t, w in zip(*GAUSS)) * (b - a)
    return out


def towards(targets, end, finest, growth=1.35):
    """Nodes of [0, end], the finer the nearer to a target"""
    nodes = sorted({0.0, float(end), *map(float, targets)})
    out = [0.0]
    for a, b in zip(nodes, nodes[1:]):
        steps = [finest]
        while sum(steps) < (b - a) / 2:
            steps.append(min(steps[-1] * growth, end / 10))
        half = np.cumsum(steps) * (b - a) / 2 / sum(steps)
        out += list(a + half) + list((b - half)[::-1][1:]) + [b]
    return np.array(out)


class FinitePlate:
    """`ends` as in the case file; `layers` [(from, thickness)] ascending"""

    def __init__(self, wall, x, y, ends="clamped", layers=(), finest=1e-3):
        scale = min(wall.length, wall.height)
        self.x = towards(x, wall.length, finest * scale)
        self.y = towards([*y, *(at for at, _ in layers)], wall.height, finest * scale)
        middle = (self.y[1:] + self.y[:-1]) / 2
        t = np.full(len(middle), wall.thickness)
        for at, thickness in layers:
            t[middle > at] = thickness
        D = wall.E * t**3 / (12 * (1 - wall.nu**2))  # B-9
        nu = wall.nu
        X = {pq: line(self.x, *pq) for pq in ((2, 2), (0, 0), (2, 0), (0, 2), (1, 1))}
        Y = {pq: line(self.y, *pq, D) for pq in X}
        K = (sparse.kron(X[2, 2], Y[0, 0]) + sparse.kron(X[0, 0], Y[2, 2])
             + nu * (sparse.kron(X[2, 0], Y[0, 2]) + sparse.kron(X[0, 2], Y[2, 0]))
             + 2 * (1 - nu) * sparse.kron(X[1, 1], Y[1, 1]))
        free_x = np.ones(2 * len(self.x), bool)
        free_x[:2] = ends in ("free", "free_start")
        free_x[-2:] = ends in ("free", "free_end")
        free_y = np.ones(2 * len(self.y), bool)
        free_y[:2] = False
        self.free = np.flatnonzero(np.kron(free_x, free_y))
        # Symmetric and definite: the diagonal is the pivot, in an order of its own pattern.
        self.solver = splu(K.tocsc()[self.free][:, self.free], permc_spec="MMD_AT_PLUS_A",
                           diag_pivot_thresh=0.0, options={"SymmetricMode": True})

    def at(self, x, y, slope=(0, 0)):
        """The number of the degree of freedom at a node: its value, or a slope"""
        i, j = np.abs(self.x - x).argmin(), np.abs(self.y - y).argmin()
        assert abs(self.x[i] - x) + abs(self.y[j] - y) < 1e-9, "no node there"
        return (2 * i + slope[0]) * 2 * len(self.y) + 2 * j + slope[1]

    def solve(self, load):
        w = np.zeros(len(load))
        w[self.free] = self.solver.solve(load[self.free])
        return w

    def single(self, x, y, slope=(0, 0)):
        """All deflections for 1 N, or for a couple of 1 N in the direction of the slope (B-10)"""
        load = np.zeros(4 * len(self.x) * len(self.y))
        load[self.at(x, y, slope)] = 1.0
        return self.solve(load)

    def pressure(self):
        return self.solve(np.kron(even(self.x), even(self.y)))

    def edge_load(self):
        edge = np.zeros(2 * len(self.y))
        edge[-2] = 1.0
        return self.solve(np.kron(even(self.x), edge))


@lru_cache(maxsize=64)
def finite(wall, x, y, ends="clamped", layers=(), finest=1e-3):
    """`x`, `y`, `layers` as tuples"""
    return FinitePlate(wall, x, y, ends, layers, finest)
