"""Static bearing loads of a train whose bearings stand at given heights: what a run starts its search from.

A journal does not sink in its film straight against its load: in a short plain bearing (Ocvirk 1952, NACA TN
2808) it goes aside by the attitude angle, so that at light loads it hardly sinks at all.
"""

from __future__ import annotations

import math

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fmus import port
from rotor_fmu.shaft.banded import cholesky
from rotor_fmu.shaft.matrices import ShaftModel, assemble
from rotor_fmu.train.train import BearingSeat, Train

Array = NDArray[np.float64]

STEPS = 100
"""Of Newton's method; some ten are usual."""

TOLERANCE = 1e-10
"""Of the last step of the eccentricities."""

REACH = 0.2
"""Largest step of an eccentricity, and share of what is left to the wall that a step may take."""


def loads_at_heights(train: Train, gravity: float) -> Array:
    """Static bearing loads of a train whose bearings stand at given heights over a straight line.

    Journals sink as in short plain bearings, or on the stiffness given in place of a film; the start of a run
    finds how far they sink in their own films.

    Parameters
    ----------
    train : Train
        With the heights of all bearings.
    gravity : float
        g [m/s2].

    Returns
    -------
    ndarray, (n_b,)
        As from `rotor_fmu.shaft.statics.target_loads`.

    Raises
    ------
    ValueError
        When no balance is found.
    """
    seats = train.bearings
    heights = np.array([seat.height or 0.0 for seat in seats])
    stiffness, firm = _reactions(assemble(train), gravity)
    films = np.array([not seat.coefficients for seat in seats])
    at = np.zeros(len(seats))  # eccentricities, or displacements in clearances
    for _ in range(STEPS):
        load, growth, sunk, sinking = np.array(
            [_film(seat, e, train) for seat, e in zip(seats, at, strict=True)]
        ).T
        missing = firm + stiffness @ (heights - sunk) - load
        step = np.linalg.solve(np.diag(growth) + stiffness * sinking, missing)
        room = np.where(films, REACH * (1.0 - np.abs(at)), np.inf)
        at = at + step * min(1.0, (room / np.maximum(np.abs(step), 1e-300)).min())
        if np.abs(step).max() < TOLERANCE:
            break
    else:
        raise ValueError(
            f"train {train.name}: no static balance of bearings at these heights; check them and clearances"
        )
    return np.asarray(load + missing)


def _reactions(model: ShaftModel, gravity: float) -> tuple[Array, Array]:
    """Forces R = firm + stiffness @ y of bearings on the shaft whose journals are held at y (n_b,)."""
    dofs = model.bearing_dofs[:, 0] // 2  # deflection of the plane: 2 k of 4 k
    inner = np.setdiff1d(np.arange(2 * model.nodes), dofs)
    K, load = sp.csr_array(model.plane_stiffness), gravity * model.plane_gravity
    across = K[inner][:, dofs].toarray()
    moved = cholesky(sp.csr_array(K[inner][:, inner])).solve(np.column_stack([load[inner], -across]))
    stiffness = K[dofs][:, dofs].toarray() + across.T @ moved[:, 1:]
    return stiffness, across.T @ moved[:, 0] - load[dofs]


def _film(seat: BearingSeat, e: float, train: Train) -> tuple[float, float, float, float]:
    """Load against gravity and its slope over the eccentricity, of either sign; how far it sinks, too."""
    if seat.coefficients:
        row = min(port.coefficient_rows(seat.coefficients), key=lambda row: abs(row[0] - train.speed))
        up = np.array(train.upwards)
        k = float(up @ np.reshape(row[1:17], (4, 4))[:2, :2] @ up) * seat.clearance
        return k * e, k, seat.clearance * e, seat.clearance
    rest, b = 1.0 - e * e, 16.0 / math.pi**2 - 1.0
    size = seat.viscosity * train.speed * seat.diameter * seat.width**3 / seat.clearance**2 * math.pi / 8.0
    root = math.sqrt(1.0 + b * e * e)
    load = size * e * root / rest**2
    growth = size * (root / rest**2 + e * (b * e / root / rest**2 + 4.0 * e * root / rest**3))
    # cos of the attitude angle, whose tangent is pi sqrt(1 - e^2) / (4 e)
    sunk = seat.clearance * e * abs(e) * 4.0 / (math.pi * root)
    sinking = seat.clearance * abs(e) * 4.0 / math.pi * (2.0 / root - b * e * e / root**3)
    return load, growth, sunk, sinking
