"""Deflection that changes the cut it comes from: E-10.

delta = G f(delta) at every phi, marched tooth by tooth until the turn repeats.
    entry         the edge cuts only where it reaches into the stock: R + sigma R_i cos(theta)
                  + delta <= a_e, by the real tooth (without feedback, by R)
    regenerative  entry; and the chip is that between this path and the marks before, both bent
    direct        entry; and the chip is that between this path, bent, and marks unbent
Only phi and phi - 2 pi m/N see one another, so any set of phi in one pitch is marched at once.
"""
from dataclasses import dataclass

import numpy as np

import surface_chip as sc

FEEDBACKS = ("none", "entry", "regenerative", "direct")


@dataclass(frozen=True)
class Turn:
    """The periodic state: step n is phi + 2 pi n/N, n = 0..N-1."""
    delta: np.ndarray  # [step, phi, node]
    load: np.ndarray   # [step, phi, node], along y
    F_x: np.ndarray    # [step, phi]
    turns: int


def between(nodes, s):
    """Values at the parts s of the disks, straight between their ends"""
    return nodes[:, :-1] * (1 - s) + nodes[:, 1:] * s


def enter(pieces, delta):
    """Keep of the disks only what reaches into the stock"""
    m = pieces.m

    def reach(s):
        z, theta = pieces.place(s)
        R_i = m.radius(pieces.tooth, z)
        return m.ae - (m.R + m.sigma * R_i * np.cos(theta) + between(delta, s))

    lo, hi = pieces.s_from, pieces.s_to
    g_lo, g_hi = reach(lo), reach(hi)
    drop = np.where(g_lo == g_hi, 1.0, g_lo - g_hi)
    cross = lo + (hi - lo) * np.clip(g_lo / drop, 0.0, 1.0)
    pieces.s_from = np.where((g_lo < 0) & (g_hi >= 0), cross, lo)
    pieces.s_to = np.where((g_lo >= 0) & (g_hi < 0), cross, hi)
    out = (g_lo < 0) & (g_hi < 0)
    pieces.s_to = np.where(out, pieces.s_from, pieces.s_to)


def bent_chip(pieces, delta, before, feedback):
    """h of eq. (2) with the paths bent; before[back - 1] is delta one to N pitches ago"""
    m, s = pieces.m, pieces.middle
    z, theta = pieces.place(s)
    gaps = sc.gaps(m, pieces.tooth, theta, z)
    if feedback in ("regenerative", "direct"):
        turned = m.sigma * np.cos(theta)
        gaps = gaps + turned * between(delta, s)
        if feedback == "regenerative":
            gaps = gaps - turned * np.array([between(b, s) for b in before])
    return np.maximum(0.0, gaps.min(axis=0))


def forces(m, phi, K, delta, before, feedback):
    """Loads along y on the nodes [phi, node] and F_x [phi] at a given deflection"""
    f, F_x = np.zeros((len(phi), m.disks + 1)), np.zeros(len(phi))
    window = m.arc if feedback == "none" else (0.0, np.pi)
    for tooth in range(m.N):
        for turn in sc.windings(m, tooth, phi):
            p = sc.Pieces(m, tooth, turn, phi, window)
            if feedback != "none":
                enter(p, delta)
            area = bent_chip(p, delta, before, feedback) * p.width
            _, theta = p.place(p.middle)
            f += sc.to_nodes(p, area * sc.normal(m, theta, *K))
            F_x += (area * sc.along(m, theta, *K)).sum(axis=1)
    return f, F_x


def slopes(evaluate, delta, f, step=1e-7):
    """df/ddelta [phi, loaded, moved]: a node moves only itself and its two neighbours"""
    n = delta.shape[1]
    out = np.zeros((len(delta), n, n))
    for first in range(3):
        moved = delta.copy()
        moved[:, first::3] += step
        change = (evaluate(moved)[0] - f) / step
        for node in range(first, n, 3):
            near = slice(max(0, node - 1), node + 2)
            out[:, near, node] = change[:, near]
    return out


def balance(evaluate, G, delta, tolerance=1e-12):
    """delta = G f(delta) by Newton with halved steps where it does not get better"""
    f, F_x = evaluate(delta)
    for _ in range(60):
        miss = delta - f @ G.T
        worst = np.abs(miss).max(axis=1)
        if worst.max() < tolerance:
            return delta, f, F_x
        J = np.eye(len(G)) - G @ slopes(evaluate, delta, f)
        step = np.linalg.solve(J, -miss[:, :, None])[:, :, 0]
        part = np.ones(len(delta))
        for _ in range(12):
            trial = delta + part[:, None] * step
            f, F_x = evaluate(trial)
            worse = np.abs(trial - f @ G.T).max(axis=1) > (1 - 0.1 * part) * worst
            if not (worse & (worst > tolerance)).any():
                break
            part = np.where(worse, part / 2, part)
        if part.min() < 1e-3 and not (part > 1e-3)[worst > tolerance].any():
            break  # nothing gets better
        delta = trial
    if worst.max() > 1e3 * tolerance:
        raise ArithmeticError(f"no balance of force and deflection: {worst.max():.2g} mm left")
    return delta, f, F_x


def march(m, G, phi, K, feedback, tolerance=1e-9, most=400):
    """The periodic state at phi (within one pitch) and its N - 1 later pitches."""
    phi = np.atleast_1d(np.asarray(phi, float))
    history = [np.zeros((len(phi), m.disks + 1))] * m.N  # the last N steps, newest last
    for turn in range(1, most + 1):
        old, f, F_x = history, [], []
        for n in range(m.N):
            before = history[::-1]

            def evaluate(delta, at=phi + m.pitch * n, before=before):
                return forces(m, at, K, delta, before, feedback)

            start = history[0] if turn > 1 else history[-1]  # one turn ago
            delta, load, along = balance(evaluate, G, start)
            history = history[1:] + [delta]
            f.append(load)
            F_x.append(along)
        if max(np.abs(a - b).max() for a, b in zip(old, history)) < tolerance:
            return Turn(np.array(history), np.array(f), np.array(F_x), turn)
    raise ArithmeticError(f"no periodic state after {most} turns")


def periodic(m, structure, phi, K, feedback):
    """As `march` for any phi: the state at each of them, deflection [phi, node]"""
    phi = np.asarray(phi, float)
    G = structure.influence(m.nodes, m.nodes)
    step = np.floor(phi / m.pitch + 1e-12).astype(int)
    folded = np.round(phi - step * m.pitch, 12)
    once, back = np.unique(folded, return_inverse=True)
    state = march(m, G, once, K, feedback)
    at = (np.mod(step, m.N), back)
    return state.delta[at], state.load[at], state.F_x[at]


def at_heights(m, delta, heights):
    """Deflection between the nodes: [phi, height]"""
    return np.array([np.interp(heights, m.nodes, d) for d in delta])


def deflection(m, structure, phi, heights, K, feedback):
    """[phi, height]"""
    load = periodic(m, structure, phi, K, feedback)[1]
    return load @ structure.influence(heights, m.nodes).T
