"""A tilting pad solved by other means: finite differences on a uniform grid, the tilt by Brent's method."""

from __future__ import annotations

import math

import numpy as np
import scipy.sparse as sp
from scipy.optimize import brentq
from scipy.sparse.linalg import spsolve

AROUND, ALONG = 161, 41


def pressure(arc: float, offset: float, near: float, beside: float, aspect: float) -> np.ndarray:
    """Guembel's pressure over 6 eta omega R^2/C^2, (AROUND, ALONG); half the pad's width, mirrored.

    The gap is 1 - near cos(t) - beside sin(t), t from the pivot; `aspect` is b/d.
    """
    t = np.linspace(-offset * arc, (1.0 - offset) * arc, AROUND)
    z = np.linspace(0.0, 1.0, ALONG)
    dt, dz = t[1] - t[0], z[1] - z[0]
    middle = 0.5 * (t[1:] + t[:-1])
    face = (1.0 - near * np.cos(middle) - beside * np.sin(middle)) ** 3 / dt**2
    axial = (1.0 - near * np.cos(t) - beside * np.sin(t)) ** 3 / (aspect * dz) ** 2
    slope = near * np.sin(t) - beside * np.cos(t)
    inner = AROUND - 2
    around = sp.diags([face[1:-1], -(face[1:] + face[:-1]), face[1:-1]], [-1, 0, 1], (inner, inner))
    second = sp.diags([1.0, -2.0, 1.0], [-1, 0, 1], (ALONG - 1, ALONG - 1)).tolil()
    second[0, 1] = 2.0  # mirrored at the mid-plane
    system = sp.kron(around, sp.eye(ALONG - 1)) + sp.kron(sp.diags(axial[1:-1]), second)
    found = np.zeros((AROUND, ALONG))
    sides = np.repeat(slope[1:-1], ALONG - 1)
    found[1:-1, :-1] = spsolve(system.tocsc(), sides).reshape(inner, ALONG - 1)
    return np.maximum(found, 0.0)


def force(arc: float, offset: float, near: float, beside: float, aspect: float) -> tuple[float, float]:
    """Force on the pad towards its pivot and across, over 6 eta omega R^3 b / C^2."""
    t = np.linspace(-offset * arc, (1.0 - offset) * arc, AROUND)
    along = np.trapezoid(pressure(arc, offset, near, beside, aspect), dx=1.0 / (ALONG - 1), axis=1)
    return float(np.trapezoid(along * np.cos(t), t)), float(np.trapezoid(along * np.sin(t), t))


def settled(arc: float, offset: float, near: float, aspect: float) -> tuple[float, float]:
    """Where the pad stands across (beside) without moment about its pivot, and its force on the journal."""
    most = (1.0 - near * math.cos((1.0 - offset) * arc)) / math.sin((1.0 - offset) * arc)
    beside = brentq(lambda b: force(arc, offset, near, b, aspect)[1], 0.0, 0.95 * most, xtol=1e-9)
    return float(beside), force(arc, offset, near, beside, aspect)[0]
