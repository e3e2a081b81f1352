"""Running alignment and equilibrium of a train in its films, as the master finds them through FMUs."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from orchestrator.study.paper.calibration.films import FORCE, GAP, LAW_K, WRENCH, Films
from rotor_fmu.shaft.statics import target_loads
from rotor_fmu.train.train import Train
from rotor_fmu.vibration.rotor import Rotor

Array = NDArray[np.float64]

_SPRING = 1e-3
"""Auxiliary springs against load over clearance; they hold the shaft and carry nothing in the end."""


def align(train: Train, rotor: Rotor, films: Films) -> None:
    """Set the offsets of the films so that every bearing runs under its target load.

    Parameters
    ----------
    train, rotor, films
        The parts; `rotor` is left in an auxiliary equilibrium.

    Raises
    ------
    ArithmeticError
        When a film does not carry its load or loads do not balance.
    """
    loads = target_loads(train)
    forces = np.column_stack([np.zeros_like(loads), loads])
    tilts = [(-seat.residual_tilt_x, -seat.residual_tilt_y) for seat in train.bearings]
    springs = _SPRING * loads / np.array([seat.clearance for seat in train.bearings])
    stiffness = np.zeros((len(loads), 4, 4))
    stiffness[:, 0, 0] = stiffness[:, 1, 1] = springs
    floating = [_aligned(films, i, force) for i, force in enumerate(loads)]
    anchor = np.zeros_like(forces)
    for _ in range(12):
        found = [_carry(films, i, forces[i], floating[i], tilts[i]) for i in range(len(loads))]
        floating = [position for position, _ in found]
        law = np.array([wrench for _, wrench in found])
        law[:, :2] += springs[:, None] * anchor
        rotor.start_from_law(law, stiffness, np.zeros_like(stiffness), orbit=False)
        shape = rotor.kinematics()[:, :4]
        missing = -springs[:, None] * (shape[:, :2] - anchor)
        if np.abs(missing).max() < 1e-9 * loads.max():
            films.offsets[:] = shape - np.array(floating)
            return
        forces, anchor = forces + missing, shape[:, :2]
    raise ArithmeticError(f"alignment: {np.abs(missing).max():.3g} N out of balance")


def find_equilibrium(rotor: Rotor, films: Films) -> tuple[Array, Array, Array]:
    """Laws F0, K, C at the static equilibrium of rotor and aligned films.

    Raises
    ------
    ArithmeticError
        When Newton's method does not converge.
    """
    motion = rotor.kinematics()
    clearances = np.array([[seat.clearance] for seat in films.seats])
    for _ in range(30):
        law = films.evaluate(motion)
        rotor.start_from_law(*law, orbit=False)
        step = rotor.kinematics() - motion
        size = float(np.abs(step[:, :2] / clearances).max())
        motion = motion + step * min(1.0, 0.1 / max(size, 1e-300))
        if size < 1e-10:
            F0, K, C = films.evaluate(motion)
            return F0.copy(), K.copy(), C.copy()
    raise ArithmeticError(f"equilibrium: the last step is {size:.2g} clearances")


def _aligned(films: Films, index: int, load: float) -> Array:
    """Position of an aligned journal under a vertical load: bisection of its eccentricity, then a turn."""
    clearance = films.seats[index].clearance
    low, high = 0.0, 1.0
    for _ in range(45):
        middle = 0.5 * (low + high)
        out = films.at_rest(index, np.array([0.0, -middle * clearance, 0.0, 0.0]))
        if out is None or math.hypot(*out[FORCE]) >= load:
            high = middle
        else:
            low = middle
    out = _held(films, index, np.array([0.0, -low * clearance, 0.0, 0.0]))
    if math.hypot(*out[FORCE]) < 0.99 * load:
        raise ArithmeticError(f"{films.seats[index].name}: the film does not carry {load:.4g} N")
    turn = 0.5 * math.pi - math.atan2(out[1], out[0])
    return np.array([low * clearance * math.sin(turn), -low * clearance * math.cos(turn), 0.0, 0.0])


def _held(films: Films, index: int, position: Array) -> Array:
    out = films.at_rest(index, position)
    if out is None:
        raise ArithmeticError(f"{films.seats[index].name}: no film at {position}")
    return out


def _carry(
    films: Films, index: int, force: Array, position: Array, tilts: tuple[float, float]
) -> tuple[Array, Array]:
    """Position with these tilts at which the film gives this force, and its wrench; tilted in four stages."""
    position, first = position.copy(), position[2:].copy()
    for share in (0.25, 0.5, 0.75, 1.0):
        position[2:] = first + share * (np.asarray(tilts) - first)
        for _ in range(40):
            out = _held(films, index, position)
            missing = force - out[FORCE]
            if math.hypot(*missing) < 1e-10 * math.hypot(*force):
                break
            step = np.linalg.solve(out[LAW_K].reshape(4, 4)[:2, :2], -missing)
            reach = 0.3 * max(out[GAP], 1e-2 * films.seats[index].clearance)
            position[:2] += step * min(1.0, reach / math.hypot(*step))
        else:
            raise ArithmeticError(f"{films.seats[index].name}: no position carries {force} N")
    return position, out[WRENCH].copy()
