"""A cut as the transcription sees it: lengths in mm, angles in rad, forces in N."""
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Tool:
    D: float
    pitch: list  # rad, tooth k to k + 1
    helix: float = 0.0
    R: float = 0.0
    Rr: float = 0.0
    Rz: float = 0.0
    alpha: float = 0.0
    beta: float = 0.0
    lag_diameter: float = 0.0  # 0: D
    constant_helix: bool = False

    @property
    def N(self):
        return len(self.pitch)

    @property
    def psi(self):
        return np.concatenate([[0.0], np.cumsum(self.pitch)[:-1]])


@dataclass
class Case:
    tool: Tool
    f_z: float
    a_p: float
    y_lo: float = -np.inf
    y_hi: float = np.inf
    offsets: list = field(default_factory=list)
    rho: float = 0.0
    lam: float = 0.0
    first_order: bool = False
    model: str = "trochoidal"
    lookback: str = "all"
    power: tuple = ()  # exponents (m_t, m_r, m_a); empty: linear in the chip
    edge: bool = True  # whether the law has edge forces
    axial_edge: bool = False
    gauge_length: float = 0.0

    @property
    def f(self):
        return self.tool.N * self.f_z

    @property
    def rad(self):
        return np.asarray(self.offsets if len(self.offsets) else [0.0] * self.tool.N)


def stock_band(engagement, D, a_e=None, band=None):
    """[G-11]"""
    if engagement == "up":
        return D / 2 - a_e, np.inf
    if engagement == "down":
        return -np.inf, -(D / 2 - a_e)
    if engagement == "band":
        return band
    return -np.inf, np.inf
