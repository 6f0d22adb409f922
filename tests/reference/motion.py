"""Motion of a tool, a table and its actuator while the tool cuts, once more.

Nothing of this follows the C++: there the structure is integrated by matrix exponentials
over steps on which delays are whole numbers; here everything is one first-order system,
integrated by the classical Runge-Kutta method between the angles where a tooth enters or
leaves, with steps that are short at both ends, and the motion of the past is read from
cubic Hermite pieces (method of steps). A helix is a stack of straight slices.
Units: N, m, s, rad.

Below: what repeats after how many teeth, and lines of a spectrum.

Source: [diez2010] eq. 1 to 15 with their repairs, T-1, T-2 and T-4; power law with the
chip in units of 1 mm.
"""
import bisect
import dataclasses
import math

import numpy as np


@dataclasses.dataclass
class Cut:
    pitch: list            # angle from tooth to tooth
    offsets: list          # radial, of each tooth
    entry: float           # immersion angles of the stock
    leave: float
    depth: float
    feed: float            # per tooth
    rpm: float
    modes: list            # (mass, damping, stiffness, x, y), table modes with - sign
    linear: tuple = ()     # K_tc, K_rc, K_ac, K_te, K_re, K_ae
    power: tuple = ()      # (K_1, m, K_e) for t, r, a
    helix: float = 0.0
    diameter: float = 8e-3
    slices: int = 1
    flank: tuple = ()      # worn: land, force per volume, friction
    actuator: tuple = ()   # mode, gain, T_1, T_2, k_s, c_s
    command: object = None  # of time


class Motion:
    def __init__(self, cut, steps):
        self.cut, self.steps = cut, steps
        n = len(cut.pitch)
        self.teeth = n
        self.omega = cut.rpm * 2 * math.pi / 60
        psi = np.concatenate([[0.0], np.cumsum(cut.pitch)[:-1]])
        self.edge_per_width = math.hypot(1.0, math.tan(cut.helix))
        z = (np.arange(cut.slices) + 0.5) * cut.depth / cut.slices
        # Rows: one for each tooth and slice.
        self.tooth = np.repeat(np.arange(n), cut.slices)
        self.behind = (psi[:, None] + z * 2 * math.tan(cut.helix) / cut.diameter).ravel()
        self.width = cut.depth / cut.slices
        looks = range(1, 2 * n + 1)
        back = np.array([[sum(cut.pitch[(j - i) % n] for i in range(1, m + 1))
                          for m in looks] for j in range(n)])
        steps_back = np.array([[cut.offsets[j] - cut.offsets[(j - m) % n] for m in looks]
                               for j in range(n)])
        self.delays = sorted(set(np.round(back.ravel(), 12)))
        self.which = np.searchsorted(self.delays, back - 1e-9)[self.tooth]
        self.feed_back = (n * cut.feed / (2 * math.pi) * back)[self.tooth]
        self.offset_back = steps_back[self.tooth]
        self.direction = np.array([[m[3], m[4]] for m in cut.modes])
        self.M = np.array([m[0] for m in cut.modes])
        self.C = np.array([m[1] for m in cut.modes])
        self.K = np.array([m[2] for m in cut.modes])
        r = len(cut.modes)
        self.size = 2 * r + (2 if cut.actuator else 0)
        self.times, self.states, self.slopes = [0.0], [np.zeros(self.size)], []
        self.known = {}

    # -- the past -------------------------------------------------------------------
    def state(self, t):
        """Cubic Hermite through the nodes; nothing moved before the start."""
        if t <= 0:
            return np.zeros(self.size)
        i = min(bisect.bisect_right(self.times, t), len(self.slopes) - 1) - 1
        a, b = self.times[i], self.times[i + 1]
        dt = b - a
        u = (t - a) / dt
        v = 1 - u
        return (v * v * (1 + 2 * u) * self.states[i] + u * u * (3 - 2 * u) * self.states[i + 1]
                + u * v * dt * (v * self.slopes[i] - u * self.left[i + 1]))

    def q(self, state):
        return state[:len(self.M)] @ self.direction

    # -- the cut ----------------------------------------------------------------------
    def chips(self, t, q, inside):
        """Of every tooth and slice: h and the immersion angle."""
        theta = self.omega * t - self.behind
        if t not in self.known:  # the stages of a step share their times
            self.known = {**dict(list(self.known.items())[-2:]),
                          t: np.array([self.q(self.state(t - d / self.omega))
                                       for d in self.delays])}
        old = self.known[t]
        s, c = np.sin(theta), np.cos(theta)
        moved = q - old
        over = (self.feed_back * s[:, None] + self.offset_back
                + moved[self.which][..., 0] * s[:, None]
                + moved[self.which][..., 1] * c[:, None])
        h = np.where(self.engaged(inside), over.min(axis=1), 0.0)
        return np.maximum(h, 0.0), s, c

    def engaged(self, t):
        theta = np.mod(self.omega * t - self.behind, 2 * math.pi)
        return (theta > self.cut.entry) & (theta < self.cut.leave)

    def force(self, t, state, inside=None):
        """On the tool; `inside`: a time on that side of t which counts at an entry."""
        h, s, c = self.chips(t, self.q(state), t if inside is None else inside)
        cutting = h > 0
        if self.cut.linear:
            K = self.cut.linear
            f = [np.where(cutting, (K[a] * h + K[a + 3] * self.edge_per_width) * self.width,
                          0.0) for a in range(3)]
        else:
            u = np.where(cutting, h, 1e-3) / 1e-3
            f = [np.where(cutting, (K * 1e-3 * u ** (1 - m) + K_e * self.edge_per_width)
                          * self.width, 0.0) for K, m, K_e in self.cut.power]
        if self.cut.flank:  # F-16
            land, per_volume, friction = self.cut.flank
            r = len(self.M)
            into = np.array([s, c]).T @ self.q(state[r:2 * r])
            slope = into / (self.omega * self.cut.diameter / 2)
            pressed = np.where(cutting, 0.5 * land**2 * slope, 0.0) * self.width * per_volume
            f[0], f[1] = f[0] + friction * pressed, f[1] + pressed
        return np.array([(-f[0] * c - f[1] * s).sum(), (f[0] * s - f[1] * c).sum(),
                         -f[2].sum()])

    # -- the structure ------------------------------------------------------------------
    def rate(self, t, z, inside):
        r = len(self.M)
        eta, v = z[:r], z[r:2 * r]
        load = self.direction @ self.force(t, z, inside)[:2] - self.C * v - self.K * eta
        out = np.zeros(self.size)
        if self.cut.actuator:
            mode, gain, T_1, T_2, k_s, c_s = self.cut.actuator
            p, dp = z[2 * r], z[2 * r + 1]
            load[mode] += k_s * p + c_s * dp
            want = self.cut.command(t) if self.cut.command else 0.0
            out[2 * r] = dp
            out[2 * r + 1] = (gain * want - p - (T_1 + T_2) * dp) / (T_1 * T_2)
        out[:r], out[r:2 * r] = v, load / self.M
        return out

    def nodes(self, turns):
        """Times of all steps: short where something enters or leaves."""
        events = {0.0}
        lags = [0.0] if self.cut.slices == 1 else []
        for j in range(self.teeth):
            psi = sum(self.cut.pitch[:j])
            for edge in (self.cut.entry, self.cut.leave):
                for lag in lags:
                    events.add(round((psi + edge + lag) % (2 * math.pi), 12))
        marks = sorted(events) + [2 * math.pi]
        turn = []
        for a, b in zip(marks, marks[1:]):
            n = max(8, math.ceil(self.steps * (b - a) / (2 * math.pi)))
            x = np.arange(n) / n
            if self.cut.slices == 1:
                x = 0.5 * x + 0.5 * (x**3 * (10 - 15 * x + 6 * x**2))
            turn += list(a + (b - a) * x)
        turn = np.array(turn)
        all_turns = [turn + 2 * math.pi * k for k in range(turns)]
        return np.concatenate(all_turns + [[2 * math.pi * turns]]) / self.omega

    def run(self, turns):
        times = self.nodes(turns)
        z = self.states[0]
        self.left = [None]
        for a, b in zip(times, times[1:]):
            dt, inside = b - a, 0.5 * (a + b)
            same = a > 0 and (self.engaged(inside) == self.engaged(last)).all()
            k1 = self.left[-1] if same else self.rate(a, z, inside)
            last = inside
            self.slopes.append(k1)
            k2 = self.rate(0.5 * (a + b), z + 0.5 * dt * k1, inside)
            k3 = self.rate(0.5 * (a + b), z + 0.5 * dt * k2, inside)
            k4 = self.rate(b, z + dt * k3, inside)
            z = z + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            self.times.append(b)
            self.states.append(z)
            self.left.append(self.rate(b, z, inside))
        self.slopes.append(self.left[-1])
        return self


def passes(force, teeth, peak):
    """After how many teeth the force is as it was (T-15); rows of two whole turns."""
    per_tooth = len(force) // (2 * teeth)
    for k in range(1, teeth + 1):
        shift = k * per_tooth
        last = force[len(force) // 2:]
        before = force[len(force) // 2 - shift:len(force) - shift]
        if np.abs(last - before).max() <= peak / 300:
            return k
    return None


def hann_amplitudes(q):
    """Amplitudes at the frequencies of a discrete Fourier transform (T-13)."""
    n = len(q)
    window = np.sin(np.pi * np.arange(n) / n) ** 2
    return 4 / n * np.abs(np.fft.rfft((q - q.mean()) * window))


def line_near(amplitude, k):
    """Place and height of the line whose largest sample is the k-th (T-14)."""
    side = 1 if amplitude[k + 1] > amplitude[k - 1] else -1
    r = amplitude[k + side] / amplitude[k]
    d = (2 * r - 1) / (1 + r)
    return k + side * d, amplitude[k] / (np.sinc(d) / (1 - d * d))
