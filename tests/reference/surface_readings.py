"""Readings of a machined wall, made by the transcription, with noise; as CSV files."""
from dataclasses import dataclass, replace

import numpy as np

import surface_error as se


@dataclass(frozen=True)
class Readings:
    """One number each: place along the wall, feed travel from there, height, error, tooth"""
    x: np.ndarray
    travel: np.ndarray
    height: np.ndarray
    error: np.ndarray
    tooth: np.ndarray  # from 1

    def noisy(self, size, seed, offset=0.0):
        noise = size * np.random.default_rng(seed).standard_normal(len(self.error))
        return replace(self, error=self.error + noise + offset)

    def write(self, file, labelled=True):
        columns = {"x_mm": self.x, "feed_offset_mm": self.travel, "height_mm": self.height,
                   "error_mm": self.error}
        if labelled:
            columns["tooth"] = self.tooth
        np.savetxt(file, np.column_stack(list(columns.values())), delimiter=",",
                   header=",".join(columns), comments="",
                   fmt=["%.17g"] * 4 + ["%d"] * labelled)
        return file.name


def imprints(m, structure_at, places, heights, K, load="distributed"):
    """Every tooth once at each place and height"""
    rows = []
    for x in places:
        e = se.imprint(m, structure_at(x), heights, K, load)
        rows += [(x, m.fz * i, h, e[n, i], i + 1) for n, h in enumerate(heights)
                 for i in range(m.N)]
    return Readings(*(np.array(c) for c in zip(*rows)))


def profiles(m, structure_at, places, heights, K, points, load="distributed"):
    """The rigorous surface, `points` equal steps over one turn's feed at each place"""
    rows = []
    for x in places:
        e, who = se.envelope(m, structure_at(x), heights, K, load, points=points)
        travel = se.feed_grid(m, points)
        rows += [(x, travel[k], h, e[k, n], who[k, n] + 1) for n, h in enumerate(heights)
                 for k in range(points)]
    return Readings(*(np.array(c) for c in zip(*rows)))


def rotations(m, structure, phi0, per_tooth, heights, K, load="distributed"):
    """Quasi-static readings of one turn; x counts from the reading at phi0"""
    phi = se.rotation(m, phi0, per_tooth, per_tooth * m.N)
    e, x = se.quasi_static(m, structure, phi, heights, K, load), m.fz / per_tooth
    rows = [(k * x, 0.0, h, e[k, n], se.owner(m, p) + 1) for k, p in enumerate(phi)
            for n, h in enumerate(heights)]
    return Readings(*(np.array(c) for c in zip(*rows)))
