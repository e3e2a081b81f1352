"""The temperature of the oil: at the equilibrium each film carries away what its friction makes.

An oil is supplied at one temperature T_s and leaves both ends at another; its film is as viscous as at the
mean of both (ISO 7902-1), T = T_s + P / (2 rho c Q), with friction power P and oil flow Q.  These follow from
where the journals float, and that from the viscosity, so both are found together.  A run then holds it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from orchestrator.errors import EquilibriumError
from orchestrator.master.start.equilibrium import find_start
from orchestrator.master.system import RESPONSE, System
from orchestrator.scenario.parameters import offset_names
from rotor_fmu.train.train import Train

Array = NDArray[np.float64]

ROUNDS = 40
"""Equilibria allowed to the search; some seven are usual."""
PRECISION = 1e-8
"""Of the rise of temperature."""
FIRST_RISE = 10.0
"""K, where the search begins."""
HOTTEST = 200.0
"""K of rise, beyond which there is no oil left."""

_VISCOSITY, _TEMPERATURE = "viscosity", RESPONSE["oil_temperature"]


def settle(rise_of: Callable[[Array], Array], rise: Array) -> Array:
    """Find the rises that make themselves, rise = rise_of(rise), by the secant method for each.

    Parameters
    ----------
    rise_of : callable
        Rise of the temperature [K] that follows from the viscosities at these rises.
    rise : ndarray
        Where to begin.

    Raises
    ------
    EquilibriumError
        When there are none up to `HOTTEST`.
    """
    missing = rise_of(rise) - rise
    step = 0.5 * missing
    for _ in range(ROUNDS):
        if np.all(np.abs(missing) <= PRECISION * np.maximum(rise, 1e-3)):
            return rise
        before = rise
        rise = np.clip(rise + step, 0.0, HOTTEST)
        change, moved = rise_of(rise) - rise - missing, rise - before
        missing = missing + change
        with np.errstate(divide="ignore", invalid="ignore"):
            secant = -missing * moved / change
        # rises make less friction: the slope of what is missing is below -1, or the secant is rounding
        step = np.where((moved != 0.0) & (change / np.where(moved, moved, 1.0) < -0.5), secant, 0.5 * missing)
    raise EquilibriumError(
        f"the oil finds no temperature: after {ROUNDS} equilibria the rise of {float(rise.max()):.3g} K is "
        f"still off by {float(np.abs(missing).max()):.3g} K; check oil, supply temperature and clearance"
    )


def effective_viscosities(system: System, train: Train, speed: float) -> dict[str, float]:
    """Find the viscosity of every oil whose temperature is not given.

    Parameters
    ----------
    system : System
        As `orchestrator.master.start.equilibrium.find_start` wants it; not to be used further.
    train : Train
        Some of its bearings have an oil.
    speed : float
        Rotor speed in rad/s.

    Returns
    -------
    dict
        Viscosity in Pa s by name of the bearing.

    Raises
    ------
    EquilibriumError
        As `find_start`, or when an oil finds no temperature.
    """
    warm = [
        (k, seat, seat.oil) for k, seat in enumerate(train.bearings)
        if seat.oil is not None and _VISCOSITY in system.bearings[k].file.variables
    ]  # fmt: skip
    supply = np.array([seat.supply_temperature for _, seat, _ in warm])
    found: dict[str, float] = {}

    def rise_of(rise: Array) -> Array:
        for (k, seat, oil), temperature in zip(warm, (supply + rise).tolist(), strict=True):
            found[seat.name] = oil.dynamic(temperature, seat.density)
            system.bearings[k].set_real([_VISCOSITY], np.array([found[seat.name]]))
        for bearing in system.bearings:
            bearing.set_real(offset_names(), np.zeros(len(offset_names())))
        find_start(system, train, speed)
        return system.responses[[k for k, _, _ in warm], _TEMPERATURE] - supply

    if warm:
        settle(rise_of, np.full(len(warm), FIRST_RISE))
    return found


def as_it_runs(train: Train, system: System) -> Train:
    """The train with the viscosities that its units have."""
    seats = []
    for seat, unit in zip(train.bearings, system.bearings, strict=True):
        if seat.oil is not None and _VISCOSITY in unit.file.variables:
            seat = replace(seat, viscosity=float(unit.get_real([_VISCOSITY])[0]))
        seats.append(seat)
    return replace(train, bearings=tuple(seats))
