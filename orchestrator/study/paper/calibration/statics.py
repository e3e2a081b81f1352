"""Designs whose analysed bearing stands where the paper's does: rows 1, 2, 3 and 5, solved for.

The load fixes the mass of the wheels; the gap of an aligned journal at that load and Sommerfeld number the
clearance, and with it the viscosity; the gap of the tilted journal the residual tilt. Each is the root of one
equation, so a search over the figures that are left need not look for them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from scipy.optimize import brentq

from bearing_fmu.film import Film, make_film
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.static.equilibrium import carried
from orchestrator.study.paper.published import FORCE_BEFORE, GAP_MEAN, GAP_V2_OVER_V1, SOMMERFELD_BEFORE
from rotor_fmu.shaft.statics import target_loads
from rotor_fmu.train.turbine_geometry import TurbineDesign, turbine_train

ANALYSED = "LP1-front"
"""The analysed bearing."""
SPEED = 2.0 * math.pi * 25.0
_CLEARANCES = (1e-3, 4e-3)  # relative
_MOST_TILT = 3e-4  # rad


def settled(design: TurbineDesign) -> TurbineDesign:
    """The design with the wheel mass, clearance, viscosity and residual tilt that rows 1, 2, 3 and 5 ask for.

    Parameters
    ----------
    design : TurbineDesign
        Its residual tilt counts by its sign only, which says at which end the gap is least.

    Raises
    ------
    ValueError
        When the journal cannot stand so within the bounds.
    """
    design = _loaded(design, FORCE_BEFORE.value)
    aligned = GAP_MEAN.value + GAP_V2_OVER_V1.value
    psi = _root(lambda at: _least_gap(_film(design, at, "v2")) - aligned, *_CLEARANCES, "clearance")
    film = _film(design, psi, "v1")
    tilt = _root(lambda at: _least_gap(film, at) - GAP_MEAN.value, 0.0, _MOST_TILT, "tilt")
    journal = replace(
        design.lp, relative_clearance=psi, residual_tilt=math.copysign(tilt, design.lp.residual_tilt)
    )
    return replace(design, lp=journal, viscosity=_viscosity(design, psi))


def _root(miss: Callable[[float], float], low: float, high: float, name: str) -> float:
    try:
        return float(brentq(miss, low, high, rtol=1e-6))
    except ValueError:
        raise ValueError(f"no {name} between {low:g} and {high:g} gives the paper's gap") from None


def _loaded(design: TurbineDesign, load: float) -> TurbineDesign:
    """With wheels so heavy that the analysed bearing carries the load, which is linear in their mass."""

    def at(mass: float) -> float:
        train = turbine_train(replace(design, lp_wheel_mass=mass))
        return float(target_loads(train)[[seat.name for seat in train.bearings].index(ANALYSED)])

    low, high = 20e3, 40e3
    slope = (at(high) - at(low)) / (high - low)
    return replace(design, lp_wheel_mass=low + (load - at(low)) / slope)


def _viscosity(design: TurbineDesign, psi: float) -> float:
    journal = design.lp
    area = journal.width_ratio * journal.diameter**2
    return FORCE_BEFORE.value * psi**2 / (area * SPEED * SOMMERFELD_BEFORE.value)


def _film(design: TurbineDesign, psi: float, depth: str) -> Film:
    d = design.lp.diameter
    parameters = BearingParameters(
        d,
        design.lp.width_ratio * d,
        psi * d / 2.0,
        _viscosity(design, psi),
        design.ambient_pressure,
        design.roughness,
        design.contact_modulus,
        design.friction,
        columns=48,
        rows=8,
    )
    return make_film(depth, parameters)


def _least_gap(film: Film, tilt: float = 0.0) -> float:
    return carried(film, (0.0, -FORCE_BEFORE.value), SPEED, tilts=(tilt, 0.0)).response.h_min
