"""Chip and force along the teeth of an end mill, from [wang2015] eq. (1)-(3).

Lengths in mm, angles in rad, forces in N. Teeth are numbered 1..N in the text and from 0
here. The edge is cut into disks; a disk that the engaged arc ends in counts in part.
"""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Milling:
    D: float
    N: int
    helix: float
    fz: float
    ae: float
    ap: float
    down: bool
    rho: float = 0.0
    lam: float = 0.0
    disks: int = 240

    @property
    def R(self):
        return self.D / 2

    @property
    def sigma(self):
        return 1.0 if self.down else -1.0

    @property
    def surface(self):
        """theta where the finished surface is touched"""
        return np.pi if self.down else 0.0

    @property
    def arc(self):
        """theta at entry and at exit"""
        p = np.arccos(np.clip(1 - self.ae / self.R, -1.0, 1.0))
        return (np.pi - p, np.pi) if self.down else (0.0, p)

    @property
    def nodes(self):
        """Ends of the disks"""
        return np.linspace(0.0, self.ap, self.disks + 1)

    @property
    def pitch(self):
        return 2 * np.pi / self.N

    def psi(self, z):
        return 2 * z * np.tan(self.helix) / self.D

    def theta(self, tooth, z, phi):
        return phi - self.pitch * tooth - self.psi(z)

    def radius(self, tooth, z):
        return self.R + self.rho * np.cos(self.lam - self.psi(z) - self.pitch * tooth)


def gaps(m, tooth, theta, z):
    """What lies between this tooth and the mark of the tooth 1..N before: [tooth before, ...]"""
    own = m.radius(tooth, z)
    return np.array([back * m.fz * np.sin(theta) + own - m.radius(tooth - back, z)
                     for back in range(1, m.N + 1)])


def chip(m, tooth, theta, z):
    """h of eq. (2)"""
    return np.maximum(0.0, gaps(m, tooth, theta, z).min(axis=0))


def normal(m, theta, KT, KR):
    """Share of a chip's force that pushes the cutter away from the finished surface"""
    return m.sigma * (KT * np.sin(theta) - KR * np.cos(theta))


def along(m, theta, KT, KR):
    """The same along the feed, on the cutter"""
    return -KT * np.cos(theta) - KR * np.sin(theta)


def windings(m, tooth, phi):
    """Whole turns that bring some of the edge to theta in [0, pi]"""
    top, bottom = np.max(m.theta(tooth, 0.0, phi)), np.min(m.theta(tooth, m.ap, phi))
    return 2 * np.pi * np.arange(np.ceil(-top / (2 * np.pi)),
                                 np.floor((np.pi - bottom) / (2 * np.pi)) + 1)


def clip(above, below, t1, t2):
    """Parts s_from..s_to (0 below, 1 above) of disks whose theta lies in [t1, t2].

    theta falls from `below` to `above`; a straight tooth is in or out as a whole.
    """
    fall = below - above
    if np.all(fall == 0.0):
        inside = (below >= t1) & (below <= t2)
        return np.zeros(below.shape), inside.astype(float)
    return (np.clip((below - t2) / fall, 0.0, 1.0), np.clip((below - t1) / fall, 0.0, 1.0))


class Pieces:
    """The engaged parts of the disks of one tooth at every phi: arrays [phi, disk]."""

    def __init__(self, m, tooth, turn, phi, window):
        z = m.nodes
        below = m.theta(tooth, z[:-1], phi[:, None]) + turn
        above = m.theta(tooth, z[1:], phi[:, None]) + turn
        self.m, self.tooth, self.below, self.above = m, tooth, below, above
        self.s_from, self.s_to = clip(above, below, *window)

    def place(self, s):
        """z and theta at the parts s of the disks"""
        z = self.m.nodes
        return z[:-1] + s * np.diff(z), self.below + s * (self.above - self.below)

    @property
    def middle(self):
        return (self.s_from + self.s_to) / 2

    @property
    def width(self):
        return np.maximum(self.s_to - self.s_from, 0.0) * np.diff(self.m.nodes)


def to_nodes(pieces, force):
    """Forces on the pieces given to the ends of their disks by the lever rule"""
    out = np.zeros((force.shape[0], force.shape[1] + 1))
    out[:, :-1] += force * (1 - pieces.middle)
    out[:, 1:] += force * pieces.middle
    return out


def loads(m, phi):
    """Per unit KT and KR, at every phi: loads on the nodes along y, and F_x.

    Returns (a, b, x_T, x_R): normal loads [phi, node] and sums [phi] [eq. (3), (9)].
    """
    phi = np.atleast_1d(np.asarray(phi, float))
    a, b = np.zeros((2, len(phi), m.disks + 1))
    x_T, x_R = np.zeros((2, len(phi)))
    for tooth in range(m.N):
        for turn in windings(m, tooth, phi):
            p = Pieces(m, tooth, turn, phi, m.arc)
            z, theta = p.place(p.middle)
            area = chip(m, tooth, theta, z) * p.width
            a += to_nodes(p, area * normal(m, theta, 1.0, 0.0))
            b += to_nodes(p, area * normal(m, theta, 0.0, 1.0))
            x_T += (area * along(m, theta, 1.0, 0.0)).sum(axis=1)
            x_R += (area * along(m, theta, 0.0, 1.0)).sum(axis=1)
    return a, b, x_T, x_R


def closed_form(m, phi, KT, KR):
    """F_n without runout, helical: eq. (3)'s A and B summed over the teeth"""
    total, (t1, t2) = 0.0, m.arc
    for tooth in range(m.N):
        for turn in windings(m, tooth, np.array([phi])):
            hi = np.clip(m.theta(tooth, 0.0, phi) + turn, t1, t2)
            lo = np.clip(m.theta(tooth, m.ap, phi) + turn, t1, t2)
            scale = m.sigma * m.fz * m.R / np.tan(m.helix)
            total += KT * scale * ((hi - lo) / 2 - (np.sin(2 * hi) - np.sin(2 * lo)) / 4)
            total -= KR * scale * (np.sin(hi) ** 2 - np.sin(lo) ** 2) / 2
    return total
