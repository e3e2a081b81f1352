"""A bearing of any depth under a series of static loads, in the figures that tables of bearings have."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from bearing_fmu import depths
from bearing_fmu.film import Film
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.static.equilibrium import Carried, carried_each, threshold
from bearing_fmu.static.pressure import PressureMap, pressure_map, short_side_flow
from fmus import port
from fmus.port.variable import Value

Floats = NDArray[np.float64]

_COLUMNS, _ROWS = 192, 16  # of the film at least where flow is counted, which 48 x 8 misses by up to 5 %

HEAT_CAPACITY = 1.8e6
"""Of oil by volume, J/(m3 K) (DIN 31652)."""


@dataclass(frozen=True)
class Point:
    """A bearing under a static load; not numbers where it finds no position.

    Attributes
    ----------
    sommerfeld, eccentricity : float
        W psi^2 / (b d eta w); displacement in the bore over the clearance.
    attitude : float
        Angle from the load to the journal in the sense of rotation, deg.
    h_min, p_max, friction_power : float
        m, Pa, W.
    friction : float
        Coefficient over the relative clearance, P / (W R w psi).
    side_flow : float
        Oil pressed out at the ends, m3/s; not a number where the depth does not tell.
    temperature_rise : float
        Of this oil if it takes all heat, K.
    stiffness, damping : ndarray, shape (2, 2)
        In the fixed frame, N/m and N s/m.
    threshold : float
        See `bearing_fmu.static.equilibrium.threshold`.
    """

    sommerfeld: float
    eccentricity: float = np.nan
    attitude: float = np.nan
    h_min: float = np.nan
    p_max: float = np.nan
    friction_power: float = np.nan
    friction: float = np.nan
    side_flow: float = np.nan
    temperature_rise: float = np.nan
    stiffness: Floats | None = None
    damping: Floats | None = None
    threshold: float = np.nan


NUMBERS = tuple(f.name for f in fields(Point) if f.name not in ("stiffness", "damping"))


class Bearing:
    """A bearing at one depth.

    Parameters
    ----------
    depth : str
        One of `depths.films`.
    values : mapping
        Parameters by the names of the port's variables.

    Raises
    ------
    ValueError
        The depth cannot have such a bearing; says why.
    """

    def __init__(self, depth: str, values: Mapping[str, Value]) -> None:
        self.depth = depths.find(depth)
        centred = {key: value for key, value in values.items() if not key.startswith("offset.")}
        film = self.depth.make(centred)
        if not isinstance(film, Film):
            raise ValueError(f"depth {depth} is none of the films of this package")
        self._film, self._parameters = film, BearingParameters.of(centred)
        # of tilting pads stiffness and damping are those of a whirl with the rotation, as in tables
        whirling = self.depth.make({**centred, port.WHIRL.name: 1.0}) if self._parameters.tilts else film
        assert isinstance(whirling, Film)
        self._whirling = whirling

    def load_of(self, sommerfeld: float, speed: float) -> float:
        """Load of a Sommerfeld number at a speed [rad/s], N."""
        p = self._parameters
        return sommerfeld * p.viscosity * abs(speed) * p.width * p.diameter * (p.radius / p.clearance) ** 2

    def points(self, loads: Sequence[Sequence[float]], speeds: Sequence[float]) -> list[Point]:
        """Under loads [N] at speeds [rad/s], each found from the one before."""
        found = carried_each(self._film, loads, speeds)
        sizes = [math.hypot(*load) / self.load_of(1.0, w) for load, w in zip(loads, speeds, strict=True)]
        return [
            Point(size) if one is None else self._point(one, size)
            for one, size in zip(found, sizes, strict=True)
        ]

    def _point(self, found: Carried, sommerfeld: float) -> Point:
        if self._whirling is not self._film:
            place = np.array([*found.position, 0.0, 0.0])
            found = replace(found, response=self._whirling.respond(place, np.zeros(4), found.speed))
        p, there = self._parameters, found.response
        load, speed = float(np.hypot(*found.load)), abs(found.speed)
        k, b = (p.clearance * matrix for matrix in found.matrices())
        flow = self._side_flow(found)
        return Point(
            sommerfeld,
            float(np.hypot(*found.position)) / p.clearance,
            float(np.degrees(found.attitude)),
            there.h_min,
            there.p_max,
            there.friction_power,
            there.friction_power / (load * p.radius * speed) * p.radius / p.clearance,
            flow,
            there.friction_power / (HEAT_CAPACITY * flow) if flow > 0.0 else np.nan,
            there.stiffness[:2, :2],
            there.damping[:2, :2],
            threshold(k, b),
        )

    def _side_flow(self, found: Carried) -> float:
        p = self._parameters
        if self.depth.name == "v3":
            eccentricity = float(np.hypot(*found.position)) / p.clearance
            return np.nan if p.ambient_pressure > 0.0 else short_side_flow(p, eccentricity, found.speed)
        return self._pressure(found).side_flow

    def _pressure(self, found: Carried) -> PressureMap:
        still, place = np.zeros(4), np.array([*found.position, 0.0, 0.0])
        p = self._parameters
        fine = replace(p, columns=max(p.columns, _COLUMNS), rows=max(p.rows, _ROWS))
        return pressure_map(fine, place, still, found.speed)

    def pressure(self, load: Sequence[float], speed: float) -> PressureMap | None:
        """The film under a load [N] at a speed [rad/s], as V1 solves it; None where there is none."""
        (found,) = carried_each(self._film, [load], [speed])
        return None if found is None else self._pressure(found)
