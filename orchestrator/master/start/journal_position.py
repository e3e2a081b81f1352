"""Where each journal floats in its film under a given load, found through the bearing FMUs.

All bearings are searched side by side, in Initialization Mode, in which outputs follow
the inputs.  A state in which a unit fails gives no number; it counts as too far out.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from orchestrator.errors import EquilibriumError
from orchestrator.master.system import RESPONSE, System

Array = NDArray[np.float64]

BISECTIONS = 45
"""Of the eccentricity of the aligned journal; leaves 1e-13 of the clearance."""

NEWTON_STEPS = 40
"""Allowed to each stage of tilting; some five are usual."""

REACH = 0.3
"""Largest Newton step, as a share of the gap that is left."""

TOLERANCE = 1e-10
"""Of the film's force against the load."""

_GAP = RESPONSE["h_min"]
_FORCE = slice(RESPONSE["wrench.Fx"], RESPONSE["wrench.Fy"] + 1)
_STIFFNESS = slice(RESPONSE["K[1,1]"], RESPONSE["K[4,4]"] + 1)


def evaluate(system: System, positions: Array) -> None:
    """Bring the responses of all bearings, at rest at `positions` (bearings, 4), into `System.responses`."""
    system.bearing_inputs[:, :4] = positions
    system.bearing_inputs[:, 4:8] = 0.0
    system.bearing_group.push()
    system.bearing_group.fetch()


def aligned_positions(system: System, loads: Array, clearances: Array) -> Array:
    """Positions of aligned journals under vertical loads.

    A plain film has no preferred direction: its force grows with the eccentricity, and the angle
    between both follows. The eccentricity is bracketed and bisected, then the bearing is turned
    until the force points up.

    Parameters
    ----------
    system : System
        In Initialization Mode, offsets zero.
    loads : ndarray (bearings,)
        Upward forces on the journals in N.
    clearances : ndarray (bearings,)
        Radial clearances in m.

    Returns
    -------
    ndarray (bearings, 4)
        Positions relative to the bearings, tilts zero.

    Raises
    ------
    EquilibriumError
        When a film does not carry its load at any eccentricity.
    """
    positions = np.zeros((len(loads), 4))
    low, high = np.zeros_like(loads), np.ones_like(loads)
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        positions[:, 1] = -middle * clearances
        evaluate(system, positions)
        magnitude = np.hypot(*system.responses[:, _FORCE].T)
        too_far = ~(magnitude < loads)  # a failed state too
        high = np.where(too_far, middle, high)
        low = np.where(too_far, low, middle)
    positions[:, 1] = -low * clearances
    evaluate(system, positions)
    force = system.responses[:, _FORCE].copy()
    short = ~(np.hypot(*force.T) > 0.99 * loads)
    if not np.all(np.isfinite(force)):
        unit = system.bearings[int(np.argmin(np.isfinite(force).all(axis=1)))]
        raise EquilibriumError(f"{unit.name}: no film at any position: {unit.reason}")
    if short.any():
        raise EquilibriumError(
            f"{system.bearings[int(np.argmax(short))].name}: the film carries "
            f"{np.hypot(*force[np.argmax(short)]):.4g} N of the load {loads[np.argmax(short)]:.4g} N at most"
        )
    turn = 0.5 * np.pi - np.arctan2(force[:, 1], force[:, 0])
    positions[:, 0] = low * clearances * np.sin(turn)
    positions[:, 1] = -low * clearances * np.cos(turn)
    return positions


def carry(system: System, forces: Array, positions: Array) -> Array:
    """Newton's method for the positions x, y at which the films give these forces, tilts fixed.

    Parameters
    ----------
    system : System
        In Initialization Mode, offsets zero.
    forces : ndarray (bearings, 2)
        Wanted forces on the journals in N.
    positions : ndarray (bearings, 4)
        Where the search starts; also gives the tilts.

    Returns
    -------
    ndarray (bearings, 4)
        Positions; `System.responses` holds the responses there.

    Raises
    ------
    EquilibriumError
        Naming the worst bearing when the search does not converge.
    """
    positions = positions.copy()
    scale = np.maximum(np.hypot(*forces.T), 1e-300)
    error = np.full(len(scale), np.inf)
    for _ in range(NEWTON_STEPS):
        evaluate(system, positions)
        missing = forces - system.responses[:, _FORCE]
        error = np.hypot(*missing.T) / scale
        if np.all(error < TOLERANCE):
            return positions
        if not np.all(np.isfinite(error)):
            break
        stiffness = system.responses[:, _STIFFNESS].reshape(-1, 4, 4)[:, :2, :2]
        step = np.linalg.solve(stiffness, -missing[:, :, None])[:, :, 0]
        gap = system.responses[:, _GAP]
        reach = REACH * np.where(gap > 0.0, gap, np.hypot(positions[:, 0], positions[:, 1]) * 1e-2)
        length = np.maximum(np.hypot(*step.T), 1e-300)
        positions[:, :2] += step * np.minimum(1.0, reach / length)[:, None]
    worst = int(np.argmax(np.where(np.isfinite(error), error, np.inf)))
    raise EquilibriumError(
        f"{system.bearings[worst].name}: no position in the film carries {scale[worst]:.4g} N "
        f"at the tilts {positions[worst, 2]:.3g}, {positions[worst, 3]:.3g} rad"
    )


def tilted_positions(system: System, forces: Array, positions: Array, tilts: Array) -> Array:
    """Tilt the bearings step by step while the films go on carrying these forces.

    Parameters
    ----------
    system, forces, positions
        As for `carry`; `positions` solves it for the tilts that it holds.
    tilts : ndarray (bearings, 2)
        Wanted tilts of the journals against the bearings in rad.

    Returns
    -------
    ndarray (bearings, 4)
        Positions with these tilts.

    Raises
    ------
    EquilibriumError
        When the last, smallest step still fails.
    """
    start, done, share = positions[:, 2:].copy(), 0.0, 1.0
    while done < 1.0:
        aim = min(1.0, done + share)
        trial = positions.copy()
        trial[:, 2:] = start + aim * (tilts - start)
        try:
            positions, done = carry(system, forces, trial), aim
        except EquilibriumError:
            share *= 0.5
            if share < 1e-2:
                raise
    return positions
