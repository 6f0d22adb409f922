"""Stability of milling once more, by semi-discretisation.

Nothing of this follows the C++: there the period is cut into spectral elements and the
modes are integrated exactly; here time goes in m equal steps per revolution, the
directional matrix is a mean over each step and over slices of the tool, the delayed
motion is the mean of two neighbouring samples, and the steps multiply up to the map of a
period. Its error falls with the square of the step, so two step numbers give the limit
(Richardson). Units: N, m, s, rad.

Source: [insperger2011], first order; the marks of earlier teeth as in C-4. A worn flank
(F-16) is a damper of the modes while a tooth is in cut, a mean over each step.
"""
import dataclasses

import numpy as np


@dataclasses.dataclass
class Mill:
    teeth: int
    K_t: float
    K_r: float
    entry: float          # immersion angles of the stock
    leave: float
    depth: float
    rpm: float
    modes: list           # (mass, damping, stiffness, x, y)
    helix: float = 0.0
    diameter: float = 0.01
    pitch: tuple = ()     # empty: equal
    offsets: tuple = ()   # empty: no runout
    feed: float = 5e-5    # per tooth
    power: tuple = ()     # (m_t, m_r, floor); K_t and K_r then at 1 mm
    flank: tuple = ()     # worn: (land, force per volume, friction)
    helices: tuple = ()   # empty: all teeth have `helix`

    def pitches(self):
        return np.array(self.pitch or [2 * np.pi / self.teeth] * self.teeth)

    def angles(self, z):
        """Of each tooth behind the tip of the first, at a height."""
        helix = np.array(self.helices or [self.helix] * self.teeth)
        tips = np.concatenate([[0], np.cumsum(self.pitches())[:-1]])
        return tips + 2 * z * np.tan(helix) / self.diameter


def pitches_at(angles):
    """Angle from each tooth to the next, from the angles of all."""
    return np.append(np.diff(angles), 2 * np.pi + angles[0] - angles[-1])


def marks(mill, theta, angles):
    """For each tooth: chip and how many teeth before left the surface, at angles theta."""
    n = mill.teeth
    pitch = pitches_at(angles)
    r = np.array(mill.offsets or [0.0] * n)
    per_angle = n * mill.feed / (2 * np.pi)
    h = np.empty((n, n) + theta.shape)
    for j in range(n):
        back = 0.0
        for m in range(1, n + 1):
            back += pitch[(j - m) % n]
            h[j, m - 1] = per_angle * back * np.sin(theta) + r[j] - r[(j - m) % n]
    return h.min(axis=1), h.argmin(axis=1)


def matrices(mill, steps):
    """Mean directional matrix of each step of a turn, by delay in steps.

    Shape (steps, steps + 2, 2, 2). A delay between two steps is shared among them, as a
    straight line between two samples has it."""
    n = mill.teeth
    fine = 40                    # samples of a step
    phi = (np.arange(steps * fine) + 0.5) * 2 * np.pi / (steps * fine)
    slices = 60 if mill.helix or mill.helices else 1
    out = np.zeros((steps, steps + 2, 2, 2))
    for z in (np.arange(slices) + 0.5) / slices * mill.depth:
        angles = mill.angles(z)
        pitch = pitches_at(angles)
        for j in range(n):
            theta = np.mod(phi - angles[j], 2 * np.pi)
            h, mark = (a[j] for a in marks(mill, theta, angles))
            cuts = (theta > mill.entry) & (theta < mill.leave) & (h > 0)
            s, c = np.sin(theta), np.cos(theta)
            t, r = np.full_like(s, mill.K_t), np.full_like(s, mill.K_r)
            if mill.power:
                m_t, m_r, floor = mill.power
                ratio = np.maximum(h, floor) / 1e-3
                t, r = t * (1 - m_t) * ratio**-m_t, r * (1 - m_r) * ratio**-m_r
            g = np.array([[(-c * t - s * r) * s, (-c * t - s * r) * c],
                          [(s * t - c * r) * s, (s * t - c * r) * c]])
            for m in range(n):
                part = np.where(cuts & (mark == m), g, 0.0) * mill.depth / slices
                mean = part.reshape(2, 2, steps, fine).mean(-1).transpose(2, 0, 1)
                delay = sum(pitch[(j - i) % n] for i in range(1, m + 2)) * steps / 2 / np.pi
                whole = int(np.floor(delay + 1e-6))
                beyond = max(0.0, delay - whole)
                beyond = 0.0 if beyond < 1e-6 else beyond
                out[:, whole] += (1 - beyond) * mean
                out[:, whole + 1] += beyond * mean
    return out


def flank_matrices(mill, steps):
    """Mean of dF/d(dq/dt) over each step, all teeth: the force against the speed."""
    out = np.zeros((steps, 2, 2))
    if not mill.flank:
        return out
    land, per_volume, friction = mill.flank
    # A triangle of the length of the land and the height land * (speed in / speed along).
    speed = mill.rpm * 2 * np.pi / 60 * mill.diameter / 2
    per_height = per_volume * land * land / 2 / speed
    fine, slices = 40, 60 if mill.helix or mill.helices else 1
    phi = (np.arange(steps * fine) + 0.5) * 2 * np.pi / (steps * fine)
    for z in (np.arange(slices) + 0.5) / slices * mill.depth:
        angles = mill.angles(z)
        for j in range(mill.teeth):
            theta = np.mod(phi - angles[j], 2 * np.pi)
            h = marks(mill, theta, angles)[0][j]
            cuts = (theta > mill.entry) & (theta < mill.leave) & (h > 0)
            inward = np.array([-np.sin(theta), -np.cos(theta)])
            back = np.array([-np.cos(theta), np.sin(theta)])  # against the cutting speed
            push = (inward + friction * back) * per_height * mill.depth / slices
            part = np.where(cuts, push[:, None] * -inward[None], 0.0)
            out += part.reshape(2, 2, steps, fine).mean(-1).transpose(2, 0, 1)
    return out


def state_space(mill):
    """A, B (force in), C (q out) of the modes."""
    k = len(mill.modes)
    A, B, C = np.zeros((2 * k, 2 * k)), np.zeros((2 * k, 2)), np.zeros((2, 2 * k))
    for i, (mass, damping, stiffness, x, y) in enumerate(mill.modes):
        A[i, k + i] = 1
        A[k + i, i], A[k + i, k + i] = -stiffness / mass, -damping / mass
        B[k + i] = np.array([x, y]) / mass
        C[:, i] = x, y
    return A, B, C


def exponential(M):
    """e^M by scaling and squaring."""
    s = max(0, int(np.ceil(np.log2(max(np.abs(M).sum(1).max(), 1e-30)))) + 4)
    X = M / 2.0**s
    term = total = np.eye(len(M))
    for i in range(1, 14):
        term = term @ X / i
        total = total + term
    for _ in range(s):
        total = total @ total
    return total


def multiplier(mill, steps):
    """|mu| over a turn, with `steps` steps in it."""
    dt = 60 / mill.rpm / steps
    A, B, C = state_space(mill)
    size = len(A)
    D = matrices(mill, steps)
    flank = flank_matrices(mill, steps)
    k = size // 2
    speeds = np.hstack([np.zeros((2, k)), C[:, :k]])  # dq/dt of the state
    longest = np.flatnonzero(np.abs(D).sum((0, 2, 3)) > 0).max()
    # Columns: the state now, then q at the last `longest` steps, newest first.
    rows = size + 2 * longest
    # q after a step from two values of the delayed q: linear between them.
    U = np.eye(rows)
    for i in range(steps):
        own = D[i].sum(axis=0)
        L = A + B @ own @ C + B @ flank[i] @ speeds
        # x' = L x + B f, f = -sum D q_delayed(t), q_delayed linear over the step
        big = np.zeros((size + 4, size + 4))
        big[:size, :size] = L
        big[:size, size:size + 2] = B
        big[size:size + 2, size + 2:] = np.eye(2) / dt
        E = exponential(big * dt)
        P, R0, R1 = E[:size, :size], E[:size, size:size + 2], E[:size, size + 2:]
        new = P @ U[:size]
        for d in np.flatnonzero(np.abs(D[i]).sum((1, 2)) > 0):
            M = D[i][d]
            # history block b holds q b steps ago; q(t_i - d) is block d, one later d - 1
            at = lambda b: (C @ U[:size] if b == 0 else  # noqa: E731
                            U[size + 2 * (b - 1):size + 2 * b])
            first, last = at(d), at(d - 1)
            new -= R0 @ M @ first + R1 @ M @ (last - first)
        U = np.vstack([new, C @ U[:size], U[size:rows - 2]])
    return np.abs(np.linalg.eigvals(U)).max()


def limit(mill, steps):
    """|mu| over a turn, extrapolated from two step numbers, and how far they differ."""
    coarse, fine = multiplier(mill, steps), multiplier(mill, 2 * steps)
    return fine + (fine - coarse) / 3, abs(fine - coarse)
