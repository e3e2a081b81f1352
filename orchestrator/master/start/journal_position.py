"""Where each journal floats in its film under a given load, found through the bearing FMUs.

All bearings are searched side by side, in Initialization Mode, in which outputs follow
the inputs.  A state in which a unit fails gives no number; it counts as too far out.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fmus import port
from fmus.build.promises import AFFINE, ISOTROPIC
from orchestrator.errors import EquilibriumError
from orchestrator.fmi.unit import Unit
from orchestrator.master.system import RESPONSE, System

Array = NDArray[np.float64]

BISECTIONS = 45
"""Of the eccentricity of the aligned journal; leaves 1e-13 of the clearance."""

FURTHEST = 2.0
"""Displacement over the clearance in a bore that is not plain: between tilting pads there is more room."""

DIRECTIONS = 60
"""Allowed to the search of a direction; some ten are usual."""

ALIGNED = 1e-3
"""Angle in rad between force and load at which the search of a direction ends."""

NEWTON_STEPS = 40
"""Allowed to each stage of tilting; some five are usual."""

REACH = 0.3
"""Largest Newton step, as a share of the gap that is left."""

TOLERANCE = 1e-10
"""Of the film's force against the load."""

SLIGHT = 1e-3
"""Share of the largest load below which a bearing counts as carrying next to nothing."""

_GAP = RESPONSE["h_min"]
_FORCE = slice(RESPONSE["wrench.Fx"], RESPONSE["wrench.Fy"] + 1)
_STIFFNESS = slice(RESPONSE["K[1,1]"], RESPONSE["K[4,4]"] + 1)


def evaluate(system: System, positions: Array) -> None:
    """Bring the responses of all bearings, at rest at `positions` (bearings, 4), into `System.responses`."""
    system.bearing_inputs[:, :4] = positions
    system.bearing_inputs[:, 4:8] = 0.0
    system.bearing_group.push()
    system.bearing_group.fetch()


def least_forces(system: System, forces: Array, clearances: Array) -> Array:
    """Least scale of the force of each film (bearings,) in N, where a bearing carries next to nothing.

    A thousandth of what its film would give at one clearance off the middle, by its stiffness there.
    """
    loads = np.hypot(*forces.T)
    if loads.min() > SLIGHT * loads.max():
        return np.zeros_like(loads)
    evaluate(system, np.zeros((len(loads), 4)))
    stiffness = np.abs(system.responses[:, _STIFFNESS].reshape(-1, 4, 4)[:, :2, :2]).max(axis=(1, 2))
    return SLIGHT * np.where(np.isfinite(stiffness), stiffness, 0.0) * clearances


def aligned_positions(system: System, forces: Array, clearances: Array) -> Array:
    """Positions of aligned journals whose films give these forces.

    Along one direction of displacement the film's force grows, so that its size is bracketed and bisected.
    A bearing that promises to be affine needs no search.
    A bearing that promises to be isotropic is then turned until the force points as it shall: the angle
    between both stays.  For others the direction is searched, too: as the displacement makes a turn, so does
    the force, and the directions between which it passes the one wanted are brought together.

    Parameters
    ----------
    system : System
        In Initialization Mode, offsets zero.
    forces : ndarray (bearings, 2)
        Wanted forces on the journals in N; upwards under a weight, downwards where the shaft is held down.
    clearances : ndarray (bearings,)
        Radial clearances in m.

    Returns
    -------
    ndarray (bearings, 4)
        Positions relative to the bearings, tilts zero; those of bearings that are not isotropic to some
        `ALIGNED` rad, for Newton's method to go on from.  A bearing without load is left in its middle.

    Raises
    ------
    EquilibriumError
        When a film does not carry its load at any position.
    """
    isotropic, affine = (
        np.array([word in unit.file.promises for unit in system.bearings]) for word in (ISOTROPIC, AFFINE)
    )
    isotropic &= [_is_plain(unit) for unit in system.bearings]
    if affine.all():
        return _affine_positions(system, forces)
    loads, aim = np.hypot(*forces.T), np.arctan2(forces[:, 1], forces[:, 0])
    loaded = (loads > 0.0) & ~affine
    # Displaced against the force to begin with; at the angle 0 downwards, from there on with the rotation.
    angle = aim - 0.5 * np.pi
    share, turn, carried = _along(system, angle, forces, clearances)
    angle = np.where(isotropic, angle + turn, angle)
    ends = np.full((2, len(loads)), np.nan)  # directions from which the force must be turned forth and back
    turns = np.zeros_like(ends)
    searched = ~isotropic & loaded & (np.abs(turn) > ALIGNED)
    for _ in range(DIRECTIONS):
        if not searched.any():
            break
        back = (turn < 0.0).astype(int)
        each = np.flatnonzero(searched)
        ends[back[each], each], turns[back[each], each] = angle[each], turn[each]
        with np.errstate(invalid="ignore", divide="ignore"):
            between = ends[0] + np.clip(turns[0] / (turns[0] - turns[1]), 0.1, 0.9) * (ends[1] - ends[0])
        angle = np.where(searched, np.where(np.isfinite(between), between, angle + turn), angle)
        found = zip(_along(system, angle, forces, clearances), (share, turn, carried), strict=True)
        share, turn, carried = (np.where(searched, new, old) for new, old in found)
        searched &= np.abs(turn) > ALIGNED
    if searched.any():
        name = system.bearings[int(np.argmax(searched))].name
        raise EquilibriumError(
            f"{name}: no position found at which the force of the film is against its load"
        )
    short = loaded & ~(carried > 0.99 * loads)
    if short.any():
        worst = int(np.argmax(short))
        raise EquilibriumError(
            f"{system.bearings[worst].name}: the film carries {carried[worst]:.4g} N of the load "
            f"{loads[worst]:.4g} N at most"
        )
    share = np.where(loaded, share, 0.0)
    positions = np.zeros((len(loads), 4))
    positions[:, 0] = share * clearances * np.sin(angle)
    positions[:, 1] = -share * clearances * np.cos(angle)
    return np.where(affine[:, None], _affine_positions(system, forces), positions)


def _is_plain(unit: Unit) -> bool:
    """Whether a bearing has no other bore than the plain one, as far as it says."""
    bore = port.BEARING_KEYS["bore"]
    return bore not in unit.file.variables or unit.get_string(bore) == port.default_word("bore")


def _affine_positions(system: System, forces: Array) -> Array:
    """Positions at which affine bearings give the forces, the least ones where stiffness leaves a choice."""
    evaluate(system, np.zeros((len(forces), 4)))
    missing = forces - system.responses[:, _FORCE]
    stiffness = system.responses[:, _STIFFNESS].reshape(-1, 4, 4)[:, :2, :2]
    positions = np.zeros((len(forces), 4))
    positions[:, :2] = (np.linalg.pinv(stiffness) @ -missing[:, :, None])[:, :, 0]
    return positions


def _along(system: System, angle: Array, forces: Array, clearances: Array) -> tuple[Array, Array, Array]:
    """Displace journals in one direction until their films give forces of the size wanted.

    Returns the displacements over the clearances, the angles by which the forces are off, and their
    sizes, less than wanted where a film does not carry that much.  The displacement points down at the angle
    0 and goes with the rotation from x to y.
    """
    positions, loads = np.zeros((len(forces), 4)), np.hypot(*forces.T)
    along, down = clearances * np.sin(angle), -clearances * np.cos(angle)
    low = np.zeros_like(loads)
    high = np.array([1.0 if _is_plain(unit) else FURTHEST for unit in system.bearings])
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        positions[:, 0], positions[:, 1] = middle * along, middle * down
        evaluate(system, positions)
        magnitude = np.hypot(*system.responses[:, _FORCE].T)
        too_far = ~(magnitude < loads)  # a failed state too
        high = np.where(too_far, middle, high)
        low = np.where(too_far, low, middle)
    positions[:, 0], positions[:, 1] = low * along, low * down
    evaluate(system, positions)
    force = system.responses[:, _FORCE].copy()
    if not np.all(np.isfinite(force)):
        unit = system.bearings[int(np.argmin(np.isfinite(force).all(axis=1)))]
        raise EquilibriumError(f"{unit.name}: no film at any position: {unit.reason}")
    turn = np.arctan2(forces[:, 1], forces[:, 0]) - np.arctan2(force[:, 1], force[:, 0])
    turn = np.where(turn > np.pi, turn - 2.0 * np.pi, np.where(turn < -np.pi, turn + 2.0 * np.pi, turn))
    return low, turn, np.hypot(*force.T)


def carry(system: System, forces: Array, positions: Array, least: Array) -> Array:
    """Newton's method for the positions x, y at which the films give these forces, tilts fixed.

    Parameters
    ----------
    system : System
        In Initialization Mode, offsets zero.
    forces : ndarray (bearings, 2)
        Wanted forces on the journals in N.
    positions : ndarray (bearings, 4)
        Where the search starts; also gives the tilts.
    least : ndarray (bearings,)
        From `least_forces`.

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
    scale = np.maximum(np.hypot(*forces.T), np.maximum(least, 1e-300))
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
        done = (error < TOLERANCE) & (np.linalg.det(stiffness) == 0.0)  # a seal, say, that only damps
        stiffness = np.where(done[:, None, None], np.eye(2), stiffness)
        step = np.linalg.solve(stiffness, -missing[:, :, None])[:, :, 0]
        gap = system.responses[:, _GAP]
        reach = REACH * np.where(gap > 0.0, gap, np.hypot(positions[:, 0], positions[:, 1]) * 1e-2)
        length = np.maximum(np.hypot(*step.T), 1e-300)
        positions[:, :2] += step * np.minimum(1.0, reach / length)[:, None]
    worst = int(np.argmax(np.where(np.isfinite(error), error, np.inf)))
    raise EquilibriumError(
        f"{system.bearings[worst].name}: no position in the film carries {np.hypot(*forces[worst]):.4g} N "
        f"at the tilts {positions[worst, 2]:.3g}, {positions[worst, 3]:.3g} rad"
    )


def tilted_positions(system: System, forces: Array, positions: Array, tilts: Array, least: Array) -> Array:
    """Tilt the bearings step by step while the films go on carrying these forces.

    Parameters
    ----------
    system, forces, positions, least
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
            positions, done = carry(system, forces, trial, least), aim
        except EquilibriumError:
            share *= 0.5
            if share < 1e-2:
                raise
    return positions
