"""Forces along x and z that bend cutter and wall by their lever arms: E-42 to E-44."""
import numpy as np
from scipy.interpolate import RectBivariateSpline

import surface_chip as sc
import surface_structure as st
from surface_finite_plate import finite

GRID = 13


def moments(m, phi, K, K_a, thickness):
    """On the ends of the disks, [phi, node]: F_n, F_x, and the couples of E-42"""
    names = ("n", "x", "wx", "cz", "wz")
    out = {name: np.zeros((len(phi), m.disks + 1)) for name in names}
    for tooth in range(m.N):
        for turn in sc.windings(m, tooth, phi):
            p = sc.Pieces(m, tooth, turn, phi, m.arc)
            z, theta = p.place(p.middle)
            area = sc.chip(m, tooth, theta, z) * p.width
            y = m.radius(tooth, z) * np.cos(theta)
            face = -m.R + m.ae  # of the stock, along the normal of the finished wall
            arm = m.sigma * y - (face - thickness / 2)  # in front of the middle plane
            F_x, F_z = area * sc.along(m, theta, *K), -K_a * area
            for name, force in (("n", area * sc.normal(m, theta, *K)), ("x", F_x),
                                ("wx", m.sigma * arm * F_x), ("cz", y * F_z),
                                ("wz", m.sigma * arm * F_z)):
                out[name] += sc.to_nodes(p, force)
    return out


def cutter_couples(cutter, heights, nodes, step=1e-3):
    """Two forces a small step apart"""
    return np.array([[(st.cutter_influence(cutter, h, z + step)
                       - st.cutter_influence(cutter, h, z - step)) / (2 * step)
                      for z in nodes] for h in heights])


def wall_tables(m, wall, x, ends, heights):
    """G, and the answers to couples along x and along z (B-10), [height, node]"""
    at, foot = np.linspace(0.0, m.ap, GRID), wall.height - m.ap
    plate = finite(wall, (x,), tuple(foot + at), ends)
    nodes = [plate.at(x, foot + z) for z in at]
    tables = []
    for slope in ((0, 0), (1, 0), (0, 1)):
        known = np.array([plate.single(x, foot + z, slope)[nodes] for z in at]).T
        tables.append(RectBivariateSpline(at, at, known)(heights, m.nodes))
    return tables


def deflections(m, cutter, wall, x, ends, loads, axes, heights):
    """(across the wall, along the feed) [phi, height], positive: material left, forward"""
    G_c = np.array([[st.cutter_influence(cutter, h, z) for z in m.nodes] for h in heights])
    G, G_x, G_z = wall_tables(m, wall, x, ends, heights)
    across = loads["n"] @ (G_c + G).T
    along = np.zeros(across.shape)
    if "z" in axes:
        turned = loads["cz"] @ cutter_couples(cutter, heights, m.nodes).T + loads["wz"] @ G_z.T
        across = across - m.sigma * turned  # E-43
    if "x" in axes:
        across = across - m.sigma * loads["wx"] @ G_x.T
        along = loads["x"] @ G_c.T
    return across, along
