"""A table that moves against runout, after [diez2010].

Written apart from the C++: dense grids instead of nodes and parabolas, the trapezoid rule
instead of quadrature, the motion as a plain function of the spindle angle, the plant by
solving its linear equations. Units: mm, N, s, rad; k0 in N/mm^(2-m). Forces on the tool,
teeth numbered in order of passage.

Ids: R-1, R-3 to R-8, R-11 to R-14, R-20, R-27 to R-33 of docs/theory/correction.md, L-7 to L-12 of
controller.md.
"""
import numpy as np

TURN = 2 * np.pi


def delay(N, k):
    return k * TURN / N


def chip(phi, j, X, ft, rho, arc, marks):
    """Chip of tooth j at the spindle angles phi, the table at X(phi).  R-1

    marks: how many teeth before are looked at; 1 is the literal eq. (1)."""
    N = len(rho)
    theta = np.mod(phi - j * TURN / N, TURN)
    s = np.sin(theta)
    h = np.min([k * ft * s + rho[j] - rho[(j - k) % N]
                - (X(phi) - X(phi - delay(N, k))) * s for k in range(1, marks + 1)], axis=0)
    return np.where((theta > arc[0]) & (theta < arc[1]), np.maximum(h, 0), 0)


def forces(phi, X, cut):
    """(Fx, Fy, Fz) on the tool; Fz = -Fa as in docs/notation.md."""
    N = len(cut["rho"])
    F = np.zeros((3, len(phi)))
    law = cut["law"]
    for j in range(N):
        h = chip(phi, j, X, cut["ft"], cut["rho"], cut["arc"], cut["marks"])
        theta = phi - j * TURN / N
        t, r, a = (law["k" + s] * np.where(h > 0, h, 1) ** (1 - law["m" + s]) * (h > 0)
                   * cut["ap"] for s in "tra")
        F += [-np.cos(theta) * t - np.sin(theta) * r,
              np.sin(theta) * t - np.cos(theta) * r, -a]
    return F


def flutes(X, cut, count=200001):
    """Peak of |Fy| and chip area of each flute.

    A tooth owns the angles at which it is the nearest to the middle of the arc of cut."""
    N = len(cut["rho"])
    middle = sum(cut["arc"]) / 2
    out = []
    for j in range(N):
        own = j * TURN / N + middle + np.linspace(-0.5, 0.5, count) * (TURN / N - 2e-9)
        ends = np.arange(N) * TURN / N + np.array([[cut["arc"][0]], [cut["arc"][1]]])
        beside = (ends.ravel() + [[-1e-9], [1e-9]]).ravel()  # forces jump there
        beside = own[0] + np.mod(beside - own[0], TURN)
        own = np.concatenate([own, beside[beside < own[-1]]])
        peak = np.max(np.abs(forces(own, X, cut)[1]))
        arc = j * TURN / N + np.linspace(*cut["arc"], count)
        h = chip(arc, j, X, cut["ft"], cut["rho"], cut["arc"], cut["marks"])
        out.append((peak, np.sum((h[1:] + h[:-1]) / 2) * (arc[1] - arc[0])))
    return np.array(out)


def arc_of(engagement, R, ae):
    """Entry and exit angle, R-2 without runout."""
    if engagement == "slot":
        return 0.0, np.pi
    reach = np.arccos((R - ae) / R)
    return (0.0, reach) if engagement == "up" else (np.pi - reach, np.pi)


def levels(rho):
    return np.asarray(rho) - np.mean(rho)


def square(rho, arc):
    """Levels that change half a pitch before the middle of a tooth's arc.  R-4"""
    x, N = levels(rho), len(rho)
    start = sum(arc) / 2 - np.pi / N
    return lambda phi: x[np.floor(np.mod(phi - start, TURN) * N / TURN).astype(int) % N]


def quintic(rho, arc, width):
    """The same with smooth changes of level.  R-4"""
    x, N = levels(rho), len(rho)
    start = sum(arc) / 2 - np.pi / N

    def motion(phi):
        u = np.mod(phi - start + np.pi / N, TURN) * N / TURN  # changes at whole u + 1/2
        j = np.floor(u).astype(int)
        v = np.clip(((u - j - 0.5) * TURN / N) / width + 0.5, 0, 1)
        rise = v**3 * (10 - 15 * v + 6 * v * v)
        return x[(j - 1) % N] + (x[j % N] - x[(j - 1) % N]) * rise

    return motion


def sine(rho, arc):
    """a sin + b cos through the levels by (smallest) least squares.  R-5"""
    x, N = levels(rho), len(rho)
    at = np.arange(N) * TURN / N + sum(arc) / 2
    a, b = np.linalg.lstsq(np.column_stack([np.sin(at), np.cos(at)]), x, rcond=1e-9)[0]
    return lambda phi: a * np.sin(phi) + b * np.cos(phi)


def harmonics(X, n_max, count=100000):
    """Complex amplitudes of harmonics 1 to n_max.  R-6"""
    phi = (np.arange(count) + 0.5) * TURN / count
    c = np.fft.rfft(X(phi)) * 2 / count
    n = np.arange(1, n_max + 1)
    return c[1:n_max + 1] * np.exp(-1j * n * TURN * 0.5 / count)


def plant(w, act, table, ks, cs):
    """X over x_com at one frequency: the equations of motion T-2 and T-4 solved.  R-11"""
    a0, a1, a2 = (1 / act["K0"], (act["T1"] + act["T2"]) / act["K0"],
                  act["T1"] * act["T2"] / act["K0"])
    s = 1j * w
    A = np.array([[a2 * s * s + a1 * s + a0, 0],
                  [-(ks + cs * s), table["m"] * s * s + table["c"] * s + table["k"]]])
    return np.linalg.solve(A, [1, 0])[1]


def inverse(c, Omega, act, table, ks, cs, Ts=0.0):
    """Harmonics of the command.  R-13"""
    n = np.arange(1, len(c) + 1)
    P = np.array([plant(k * Omega, act, table, ks, cs) for k in n])
    return c * np.exp(1j * n * Omega * Ts / 2) / P


def inverse_in_time(X, phi, Omega, act, d=1e-4):
    """a0 x + a1 x' + a2 x'' by difference quotients.  R-14"""
    x, up, down = X(phi), X(phi + d), X(phi - d)
    return (x + (act["T1"] + act["T2"]) * Omega * (up - down) / (2 * d)
            + act["T1"] * act["T2"] * Omega**2 * (up - 2 * x + down) / d**2) / act["K0"]


def lead(act, Ts):
    return act["T1"] + act["T2"] + Ts / 2


def ratio(F1, F2, ft, m):
    r = (F1 / F2) ** (1 / (1 - m))
    return ft * (r - 1) / (r + 1)


def differences(X, cut, count=4001):
    """v_j: the peak of each flute over their mean, less 1.  L-9"""
    p = flutes(X, cut, count)[:, 0]
    return p / p.mean() - 1


def chip_equations(rho, arc, n_max, second_axis, count=181):
    """A and e_0 of the chip differences, one row for each tooth and angle.  R-7 R-8"""
    N = len(rho)
    x = levels(rho)
    theta = arc[0] + (arc[1] - arc[0]) * (np.arange(count) + 0.5) / count
    rows, right = [], []
    for j in range(N):
        phi = j * TURN / N + theta
        columns = []
        for weight in ([np.sin(theta), np.cos(theta)] if second_axis else [np.sin(theta)]):
            for n in range(1, n_max + 1):
                if n % N:
                    columns += [(wave(n * phi) - wave(n * (phi - TURN / N))) * weight
                                for wave in (np.cos, np.sin)]
        rows.append(np.column_stack(columns))
        right.append(np.full(count, x[j] - x[(j - 1) % N]))
    return np.vstack(rows), np.concatenate(right)


def least_chip_rms(rho, arc, n_max, second_axis):
    """Root mean square that is left at best, and a bound below it: the part of e_0 that is
    orthogonal to every column, by the singular value decomposition.  R-30"""
    A, e = chip_equations(rho, arc, n_max, second_axis)
    x = np.linalg.lstsq(A, e, rcond=1e-9)[0]
    U, s, _ = np.linalg.svd(A, full_matrices=False)
    U = U[:, s > 1e-9 * s[0]]
    normal = e - U @ (U.T @ e)
    size = np.linalg.norm(normal)
    return (np.linalg.norm(e - A @ x) / np.sqrt(len(e)),
            normal @ e / size / np.sqrt(len(e)) if size > 1e-12 else 0.0)


def wave_sum(c):
    """A motion of harmonics."""
    n = np.arange(1, len(c) + 1)
    return lambda phi: np.real(np.exp(1j * np.multiply.outer(phi, n)) @ c)


def unevenness(c, cut):
    """Sum of squares that harmonics leave.  R-28"""
    return np.sum(differences(wave_sum(c), cut, 20001) ** 2)


def wave_model(cut, count, act, table, ks, cs, d=2e-4):
    """dv_j over the amplitudes of the command, a_1 b_1 a_2 ...  R-31"""
    columns = []
    for k in range(count):
        n = k // 2 + 1
        c = np.zeros(n, complex)
        c[-1] = (1, -1j)[k % 2] * plant(n * cut["Omega"], act, table, ks, cs)
        up, down = (differences(wave_sum(s * d * c), cut, 20001) for s in (1, -1))
        columns.append((up - down) / (2 * d))
    return np.array(columns).T


def runout_model(cut, d=2e-4):
    """dv_j over what each tooth stands out.  R-31"""
    columns = []
    for each in np.eye(len(cut["rho"])):
        up, down = (differences(np.zeros_like, dict(cut, rho=cut["rho"] + s * d * each), 20001)
                    for s in (1, -1))
        columns.append((up - down) / (2 * d))
    return np.array(columns).T


def relative(values):
    return (max(values) - min(values)) / max(values)


def transition_candidate(cut, width, n, count=4001):
    """Factor of so many harmonics of a width that makes the peaks of two teeth alike, and
    the differences of peaks and areas with it; among these R-27 chooses."""
    c = harmonics(quintic(cut["rho"], cut["arc"], width), n, 20000)
    side = lambda f: np.diff(flutes(wave_sum(f * c), cut, count)[:, 0])[0]
    f, last, before = 1.0, 0.8, side(0.8)
    while abs(f - last) > 1e-9:  # the secant method
        now = side(f)
        f, last, before = f - now * (f - last) / (now - before), f, now
    left = flutes(wave_sum(f * c), cut, count)
    return f, relative(left[:, 0]), relative(left[:, 1])


def command_range(cut, width, n, factor, act, table, ks, cs):
    """Peak to peak of the command that brings the table there."""
    c = factor * harmonics(quintic(cut["rho"], cut["arc"], width), n, 20000)
    u = wave_sum(inverse(c, cut["Omega"], act, table, ks, cs))(np.linspace(0, TURN, 2000))
    return np.ptp(u)


def choose_transition(candidates):
    """(w, n) of the rows w, n, D, A.  R-27"""
    least = min(c[2] for c in candidates)
    return min((c for c in candidates if c[2] <= least + 0.001), key=lambda c: c[3])[:2]


def broyden(J, s, change):
    """R-29"""
    return J + np.outer(change - J @ s, s) / (s @ s)


def spindle_speed(X, phi, f, Omega, d=1e-5):
    """Speed that stands in for a motion, from when the tool is where.  R-32

    X: motion of the table [mm], f: feed a turn [mm]. The tool is at v t - (table's X = 0);
    that the chips are those of X means v t = f phi/2 pi - X."""
    v = f * Omega / TURN
    time = lambda angle: (f * angle / TURN - X(angle)) / v
    return 2 * d / (time(phi + d) - time(phi - d))


def inertia_torque(X, phi, f, Omega, J, d=1e-4):
    """J dOmega/dt = J Omega dOmega/dphi.  R-33 without the cut"""
    speed = lambda angle: spindle_speed(X, angle, f, Omega)
    return J * speed(phi) * (speed(phi + d) - speed(phi - d)) / (2 * d)


class Estimator:
    """Recursive least squares of how waves change the flutes.  L-10 L-11

    In units of the wave's scale; written with matrices, one for each flute."""

    def __init__(self, S, trust, noise, forgetting, rate):
        N, m = S.shape
        self.theta = np.hstack([np.zeros((N, 1)), S])
        self.most = np.array([1.0] + [trust**2 * np.mean(S**2)] * m)
        self.P = np.diag(self.most)
        self.R, self.rate = noise**2, rate
        slow = 1 - 0.05 * (1 - forgetting)
        self.L = np.diag([forgetting**-0.5] + [slow**-0.5] * m)
        self.u = np.zeros(m)

    def turn(self, v):
        x = np.concatenate([[1.0], self.u])
        g = self.P @ x / (self.R + x @ self.P @ x)
        self.theta += np.outer(v - self.theta @ x, g)
        self.P = self.L @ (self.P - np.outer(g, x @ self.P)) @ self.L
        shrink = np.sqrt(np.minimum(1, self.most / np.diag(self.P)))
        self.P = self.P * np.outer(shrink, shrink)
        S = self.theta[:, 1:]
        G = S @ S.T
        G = G + 1e-4 * np.trace(G) / len(G) * np.eye(len(G)) + 1e-12 * np.eye(len(G))
        self.u = self.u - self.rate * S.T @ np.linalg.solve(G, self.theta @ x)
        return self.u


def changed_tooth(W, e):
    """Which tooth explains a change best, how well, and by how much it changed.  L-12"""
    product = W.T @ e
    square = np.sum(W * W, axis=0)
    explained = product**2 / (square * (e @ e))
    i = int(np.argmax(explained))
    return i, explained[i], product[i] / square[i]


def wave(a, b, alpha):
    """What is added to the table at an angle in turns.  L-7"""
    n = np.arange(1, len(a) + 1)
    return np.cos(TURN * np.outer(alpha, n)) @ a + np.sin(TURN * np.outer(alpha, n)) @ b


def unwrapped(angle, change, W):
    """L-8"""
    return angle + (change - W * np.round(change / W))
