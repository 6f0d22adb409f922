"""The three meanings of surface error without feedback: E-7 to E-9.

quasi_static: the deflection at every rotation against the feed, eq. (10).
imprint: what each tooth leaves at the moment it touches the finished surface.
envelope: the lowest of all tooth paths; what a probe meets.
Errors in mm, positive where material is left.
"""
from dataclasses import dataclass

import numpy as np

import surface_chip as sc


@dataclass(frozen=True)
class Compliance:
    """mm per MPa at given heights: deflection = of_T KT + of_R KR, arrays [phi, height]."""
    of_T: np.ndarray
    of_R: np.ndarray

    def deflection(self, KT, KR):
        return KT * self.of_T + KR * self.of_R


def compliance(m, structure, phi, heights, load="distributed"):
    """M(phi, h) of eq. (9)"""
    a, b, _, _ = sc.loads(m, phi)
    if load == "concentrated":
        c = structure.concentrated(heights)
        return Compliance(np.outer(a.sum(axis=1), c), np.outer(b.sum(axis=1), c))
    G = structure.influence(heights, m.nodes)
    return Compliance(a @ G.T, b @ G.T)


def rotation(m, phi0, per_tooth, count):
    """phi_k of the rotation grid"""
    return phi0 + m.pitch * np.arange(count) / per_tooth


def owner(m, phi):
    """Tooth whose tip entered last"""
    step = np.floor((np.asarray(phi) - m.arc[0]) / m.pitch + 1e-9)
    return np.mod(step, m.N).astype(int)


def runout_error(m, tooth, h):
    """e_rho of eq. (10)"""
    return -(m.radius(tooth, h) - m.R)


def quasi_static(m, structure, phi, heights, K, load="distributed"):
    """e(k, h) of eq. (10): [phi, height]"""
    d = compliance(m, structure, phi, heights, load).deflection(*K)
    return d + runout_error(m, owner(m, phi)[:, None], np.asarray(heights))


def nominal(m, e, per_tooth):
    """Means over whole multiples of N tooth feeds, eq. (14): [k, height]"""
    whole = len(e) // (m.N * per_tooth) * m.N
    return e[:whole * per_tooth].reshape(whole, per_tooth, -1).mean(axis=0)


def touching(m, tooth, h):
    """phi at which a tooth meets the finished surface at height h"""
    return m.surface + m.psi(h) + m.pitch * tooth


def imprint_operator(m, structure, heights, load="distributed"):
    """mm per MPa of tooth i at height h: (of_T, of_R), each [height, tooth]"""
    out = np.zeros((2, len(heights), m.N))
    for i, h in enumerate(heights):
        phi = touching(m, np.arange(m.N), h)
        c = compliance(m, structure, phi, [h], load)
        out[0, i], out[1, i] = c.of_T[:, 0], c.of_R[:, 0]
    return out


def imprint(m, structure, heights, K, load="distributed"):
    """e_i(h): [height, tooth]"""
    of_T, of_R = imprint_operator(m, structure, heights, load)
    tooth, h = np.arange(m.N), np.asarray(heights)[:, None]
    return K[0] * of_T + K[1] * of_R + runout_error(m, tooth, h)


def whole_turn(points):
    return 2 * np.pi * np.arange(points) / points


class Envelope:
    """Tooth paths laid over one another, at one height.

    `deflection(phi)` is what the cutter and the wall give way at this height.
    """

    def __init__(self, m, h, deflection, samples=2401):
        self.m = m
        turn = deflection(whole_turn(3600))
        room = np.ptp(turn) + 4 * m.rho + 4 * m.fz**2 / m.R + 0.02 * m.R
        reach = np.arccos(max(1 - room / m.R, np.cos(1.2)))
        theta = m.surface + np.linspace(-reach, reach, samples)
        self.paths = []
        for tooth in range(m.N):
            R = m.radius(tooth, h)
            phi = theta + m.psi(h) + m.pitch * tooth
            left = m.R + m.sigma * R * np.cos(theta) + deflection(phi)
            forward = m.N * m.fz * phi / (2 * np.pi) + R * np.sin(theta)
            order = np.argsort(forward)
            self.paths.append((forward[order], left[order]))

    def at(self, x):
        """Error and tooth at each x"""
        m, x = self.m, np.asarray(x, float)
        turn = m.N * m.fz  # each tooth comes again after one turn's feed
        best, who = np.full(x.shape, np.inf), np.full(x.shape, -1)
        for tooth, (forward, left) in enumerate(self.paths):
            first = int(np.floor((x.min() - forward[-1]) / turn))
            last = int(np.ceil((x.max() - forward[0]) / turn))
            for n in range(first, last + 1):
                e = np.interp(x - n * turn, forward, left, left=np.inf, right=np.inf)
                who = np.where(e < best, tooth, who)
                best = np.minimum(best, e)
        return best, who


def table(phi, values):
    """A function of the angle of one turn from samples of it"""
    return lambda at: np.interp(at, phi, values, period=2 * np.pi)


def turn_compliance(m, structure, heights, load="distributed", points=3600):
    """Compliance over one turn, in portions that fit in memory"""
    parts = [compliance(m, structure, part, heights, load)
             for part in np.array_split(whole_turn(points), max(1, points // 400))]
    return Compliance(np.vstack([p.of_T for p in parts]), np.vstack([p.of_R for p in parts]))


def feed_grid(m, points):
    """Equal steps over the feed of one turn"""
    return m.N * m.fz * np.arange(points) / points


def envelope(m, structure, heights, K, load="distributed", points=1500, turn=None):
    """Errors and teeth over one turn's feed: two arrays [x, height]"""
    turn = turn or turn_compliance(m, structure, heights, load)
    d = turn.deflection(*K)
    columns = [Envelope(m, h, table(whole_turn(len(d)), d[:, i])).at(feed_grid(m, points))
               for i, h in enumerate(heights)]
    return tuple(np.array(c).T for c in zip(*columns))


def cusp_radius(m):
    """R_e, the radius of a cusp"""
    return (m.R - m.sigma * m.N * m.fz / (2 * np.pi)) ** 2 / m.R


def touched(x, e, radius, period):
    """What a sphere of the radius reads along the feed of a surface that repeats [x]"""
    at = np.concatenate([x + n * period for n in range(-1 - int(radius / period),
                                                       2 + int(radius / period))])
    level = np.tile(e, len(at) // len(e))
    read = np.empty(len(x))
    for k, place in enumerate(x):
        off = at - place
        near = np.abs(off) < radius
        read[k] = np.max(level[near] - radius + np.sqrt(radius**2 - off[near] ** 2))
    return read


def leaning(slope, radius):
    """What it reads too much where the surface leans by slope = de/dh"""
    return radius * (np.sqrt(1 + slope**2) - 1)
