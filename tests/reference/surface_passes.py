"""Several passes over a wall, each over what the last one left: E-40 and E-41.

Every disk of an edge has a radial depth of its own, and so an arc of its own.
"""
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline, RectBivariateSpline

import surface_chip as sc
import surface_error as se
import surface_structure as st
from surface_finite_plate import finite

GRID = 13  # heights between which influence and error are interpolated
TURN = 1200


def arcs(m, left):
    """theta at entry and exit of every disk, with left(z) more stock than m.ae"""
    z = (m.nodes[1:] + m.nodes[:-1]) / 2
    p = np.arccos(np.clip(1 - np.maximum(m.ae + left(z), 0.0) / m.R, -1.0, 1.0))  # E-40
    return (np.pi - p, np.pi + 0 * p) if m.down else (0 * p, p)


def normal_loads(m, phi, K, left):
    """Forces across the wall on the ends of the disks, [phi, node]"""
    out = np.zeros((len(phi), m.disks + 1))
    for tooth in range(m.N):
        for turn in sc.windings(m, tooth, phi):
            p = sc.Pieces(m, tooth, turn, phi, arcs(m, left))
            z, theta = p.place(p.middle)
            area = sc.chip(m, tooth, theta, z) * p.width
            out += sc.to_nodes(p, area * sc.normal(m, theta, *K))
    return out


def layers(wall, ap, levels):
    """(from, thickness) ascending, of a wall that was cut at {below: thickness}"""
    out, above = [], 0.0
    for below in sorted(levels, reverse=True):
        top = wall.height - below
        if above and top - ap > above + 1e-9:
            out.append((above, wall.thickness))
        out.append((top - ap, levels[below]))
        above = top
    if above and above < wall.height - 1e-9:
        out.append((above, wall.thickness))
    return tuple(out)


def influence(m, cutter, wall, x, below, levels, heights):
    """mm per N at heights for loads on the ends of the disks; the wall thinner where it was cut"""
    G = np.array([[st.cutter_influence(cutter, h, z) for z in m.nodes] for h in heights])
    if wall is None:
        return G
    at, foot = np.linspace(0.0, m.ap, GRID), wall.height - below - m.ap
    plate = finite(wall, (x,), tuple(foot + at), layers=layers(wall, m.ap, levels),
                   finest=4e-3)
    nodes = [plate.at(x, foot + z) for z in at]
    known = np.array([plate.single(x, foot + z)[nodes] for z in at])
    return G + RectBivariateSpline(at, at, known)(heights[:, None], m.nodes, grid=False)


@dataclass(frozen=True)
class Pass:
    """What one pass leaves: of `heights` the mean, least and largest errors"""
    thickness: float
    stock: float
    mean: np.ndarray
    least: np.ndarray
    largest: np.ndarray
    F_max: float
    thickness_left: float


def sequence(m, cutter, wall, x, K, cuts, heights):
    """A Pass for every (radial depth, feed per tooth, below the edge), without feedback"""
    at, out, even = np.linspace(0.0, m.ap, GRID), [], np.linspace(0.0, m.ap, 400)
    left, levels = {}, {}  # of the level that lies so far below the edge
    phi = se.whole_turn(TURN)
    for ae, fz, below in cuts:
        now = replace(m, ae=ae, fz=fz)
        stock = left.get(below, lambda z: 0.0 * z)
        thickness = levels.get(below, wall.thickness) if wall else 0.0
        load = normal_loads(now, phi, K, stock)
        where = np.concatenate([heights, at])
        d = load @ influence(now, cutter, wall, x, below, levels, where).T
        e = np.array([se.Envelope(now, h, se.table(phi, d[:, i])).at(se.feed_grid(now, 720))[0]
                      for i, h in enumerate(where)])
        if below in left:
            e = np.minimum(e, (ae + stock(where))[:, None])  # E-41
        left[below] = CubicSpline(at, e[len(heights):].mean(axis=1))
        gone = ae + stock(even).mean() - left[below](even).mean()
        wanted = e[:len(heights)]
        if wall:
            levels[below] = thickness - gone
        out.append(Pass(thickness, ae + stock(even).mean(), wanted.mean(axis=1),
                        wanted.min(axis=1), wanted.max(axis=1), load.sum(axis=1).max(),
                        levels.get(below, 0.0)))
    return out
