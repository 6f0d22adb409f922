"""Quantities of a case as functions of arrays."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from . import _core
from ._case import CaseLike, as_case

Floats = npt.NDArray[np.float64]


def _finite(values: npt.ArrayLike, name: str) -> np.ndarray:
    """Real and finite numbers as float64, of any shape."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: real numbers are needed, not {array.dtype}")
    array = array.astype(np.float64, copy=False)
    if not np.isfinite(array).all():
        where = np.unravel_index(np.argmin(np.isfinite(array)), array.shape)
        at = "[" + ", ".join(str(i) for i in where) + "]" if array.ndim else ""
        raise ValueError(f"{name}{at} is {array[where]}: must be a finite number")
    return array


def _refuse(array: np.ndarray, wrong: np.ndarray, name: str, why: str) -> None:
    if wrong.any():
        where = np.unravel_index(np.argmax(wrong), array.shape)
        at = "[" + ", ".join(str(i) for i in where) + "]" if array.ndim else ""
        raise ValueError(f"{name}{at} = {array[where]:g}: {why}")


def _together(**arrays: np.ndarray) -> tuple[tuple[int, ...], list[np.ndarray]]:
    """The common shape, and the arrays of it, flat and contiguous."""
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise ValueError(f"these shapes do not go together: {shapes}") from None
    flat = [np.broadcast_to(array, shape).ravel() for array in arrays.values()]
    return shape, [np.ascontiguousarray(array) for array in flat]


def forces(case: CaseLike, phi_deg: npt.ArrayLike) -> Floats:
    """Force on the tool [N] at spindle angles, workpiece frame; equations F-1 to F-5.

    Parameters
    ----------
    case : Case, path of a case file, or dict
        As for :func:`simulate`; ``[sampling] tolerance`` is how exact.
    phi_deg : array_like, shape S
        Angles of the tip of tooth 1 [deg]: from +y clockwise seen from +z.

    Returns
    -------
    ndarray, shape S + (3,)
        Fx, Fy, Fz: the same bits as forces.csv of ``simulate`` at these angles.
    """
    phi = _finite(phi_deg, "phi_deg")
    given = as_case(case)._for("simulate")
    return _core.forces(given, np.ascontiguousarray(phi.ravel())).reshape(*phi.shape, 3)


def force_matrix(case: CaseLike, phi_deg: npt.ArrayLike) -> Floats:
    """The matrix [C] of the force that is linear in the coefficients: F = C K.

    Parameters
    ----------
    case : Case, path of a case file, or dict
        As for :func:`simulate`. Of the coefficients only exponents matter.
    phi_deg : array_like, shape S
        Spindle angles [deg].

    Returns
    -------
    ndarray, shape S + (3, k)
        In SI: times the coefficients K_tc, K_rc, K_ac [N/m^2], then, for a law with edge
        forces, K_te, K_re, K_ae [N/m] it is the force [N]. Power laws: K_t1, K_r1, K_a1
        [N/m^2] in place of the first three.
    """
    phi = _finite(phi_deg, "phi_deg")
    given = as_case(case)._for("simulate")
    matrix = _core.force_matrix(given, np.ascontiguousarray(phi.ravel()))
    return matrix.reshape(*phi.shape, 3, matrix.shape[-1])


def chip(
    case: CaseLike,
    tooth: npt.ArrayLike,
    theta_deg: npt.ArrayLike,
    height_mm: npt.ArrayLike = 0.0,
) -> Floats:
    """Uncut chip thickness [mm] along the horizontal ray; equations C-2 to C-7.

    Parameters
    ----------
    case : Case, path of a case file, or dict
        As for :func:`simulate`; ``[chip]`` says by which model.
    tooth : array_like of int
        From 1, in order of passage.
    theta_deg : array_like
        Nominal immersion angle [deg], from +y clockwise seen from +z.
    height_mm : array_like
        Above the tool tip [mm], at least 0.

    Returns
    -------
    ndarray
        Of the shape to which the three broadcast; 0 where the tooth is not in cut.
    """
    teeth = np.asarray(tooth)
    if teeth.dtype.kind not in "iu":
        raise TypeError(f"tooth: whole numbers are needed, not {teeth.dtype}")
    given = as_case(case)._for("simulate")
    outside = (teeth < 1) | (teeth > given.teeth)
    _refuse(teeth, outside, "tooth", f"there are teeth 1 to {given.teeth}")
    height = _finite(height_mm, "height_mm")
    _refuse(height, height < 0, "height_mm", "must be at least 0, the tool tip")
    theta = _finite(theta_deg, "theta_deg")
    shape, (j, t, z) = _together(tooth=teeth, theta_deg=theta, height_mm=height)
    return _core.chip(given, j.astype(np.int64), t, z).reshape(shape)


def multiplier(
    case: CaseLike, spindle_rpm: npt.ArrayLike, axial_depth_mm: npt.ArrayLike
) -> npt.NDArray[np.complex128]:
    """Floquet multiplier of largest modulus; the cut is stable where abs() < 1.

    Parameters
    ----------
    case : Case, path of a case file, or dict
        As for :func:`stability`, with ``[[mode]]``; ``[stability] tolerance`` is how
        exact. The feed per tooth is that of the case.
    spindle_rpm, axial_depth_mm : array_like, positive
        Speed [rpm] and axial depth [mm]; they broadcast together.

    Returns
    -------
    ndarray of complex128
        Of the shape to which the two broadcast; imaginary part not negative. Equation D-8.
    """
    speed = _finite(spindle_rpm, "spindle_rpm")
    depth = _finite(axial_depth_mm, "axial_depth_mm")
    _refuse(speed, speed <= 0, "spindle_rpm", "must be positive")
    _refuse(depth, depth <= 0, "axial_depth_mm", "must be positive")
    given = as_case(case)._for("stability")
    shape, (n, a) = _together(spindle_rpm=speed, axial_depth_mm=depth)
    return _core.multiplier(given, n, a).reshape(shape)

