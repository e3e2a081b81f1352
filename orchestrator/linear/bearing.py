"""One bearing of a train on its own: data of the command of that name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from bearing_fmu import depths
from bearing_fmu.static.curves import NUMBERS, Bearing, Point
from fmus.port.variable import Value
from orchestrator.errors import OrchestratorError
from orchestrator.linear.case import HERTZ

Array = NDArray[np.float64]

SOMMERFELD = np.geomspace(0.05, 50.0, 37)
SPEEDS = np.linspace(0.1, 1.3, 25)
"""Over the speed of the investigation."""

_TITLES = {
    "sommerfeld": ("1", "Sommerfeld number W psi^2 / (b d eta omega)"),
    "eccentricity": ("1", "relative eccentricity"),
    "attitude": ("deg", "angle from the load to the journal, with the rotation"),
    "h_min": ("m", "least gap"),
    "p_max": ("Pa", "largest pressure"),
    "friction_power": ("W", "friction power"),
    "friction": ("1", "friction coefficient over the relative clearance"),
    "side_flow": ("m3/s", "oil pressed out at the ends"),
    "temperature_rise": ("K", "temperature rise of this oil"),
    "threshold": ("1", "speed times the root of C/g up to which a rigid rotor is stable"),
}
assert set(_TITLES) == set(NUMBERS)


@dataclass(frozen=True)
class BearingStudy:
    """What is found.

    Attributes
    ----------
    curves : xarray.Dataset
        Over (depth, sommerfeld number) at one speed.
    over_speed : xarray.Dataset
        Over (depth, rotation in Hz) under one load.
    pressure : xarray.Dataset or None
        Over (angle, z) under this load at this speed.
    refused : mapping
        Why depths are left out.
    """

    curves: xr.Dataset
    over_speed: xr.Dataset
    pressure: xr.Dataset | None
    refused: Mapping[str, str]


def study_bearing(
    values: Mapping[str, Value], clearance: float, load: Array, speed: float, names: Sequence[str]
) -> BearingStudy:
    """Investigate a bearing at several depths.

    Parameters
    ----------
    values : mapping
        Parameters by the names of the port's variables.
    clearance : float
        For dimensionless coefficients, m.
    load : ndarray, shape (2,)
        On the journal, N.
    speed : float
        rad/s.
    names : sequence of str
        Depths.

    Raises
    ------
    OrchestratorError
        When no depth can have this bearing.
    """
    made: dict[str, Bearing] = {}
    refused: dict[str, str] = {}
    for name in names:
        try:
            made[name] = Bearing(name, values)
        except ValueError as error:
            refused[name] = str(error)
    if not made:
        raise OrchestratorError("; ".join(f"{name}: {reason}" for name, reason in refused.items()))
    along = load / float(np.hypot(*load))
    curves, running = {}, {}
    for name, bearing in made.items():
        loads = [(along * bearing.load_of(float(so), speed)).tolist() for so in SOMMERFELD]
        curves[name] = bearing.points(loads, [speed] * len(loads))
        # downwards from the highest speed, where the film is thickest
        downwards = bearing.points([load.tolist()] * len(SPEEDS), (speed * SPEEDS[::-1]).tolist())
        running[name] = downwards[::-1]
    grid = {"sommerfeld": SOMMERFELD}
    first = next(iter(made.values()))
    return BearingStudy(
        _dataset(curves, grid, clearance, {"speed": speed, "unit_load": first.load_of(1.0, speed)}),
        _dataset(running, {"rotation": speed * SPEEDS / HERTZ}, clearance, {"name": "over-speed"}),
        _pressure(first, load, speed),
        refused,
    )


def _dataset(
    points: Mapping[str, Sequence[Point]],
    grid: Mapping[str, Array],
    clearance: float,
    attributes: dict[str, Any],
) -> xr.Dataset:
    ((over, values),) = grid.items()
    dims = ("depth", over)
    found: dict[str, Any] = {
        name: (
            dims,
            [[getattr(point, name) for point in line] for line in points.values()],
            {"units": unit, "long_name": title},
        )
        for name, (unit, title) in _TITLES.items()
        if name != over
    }
    axes = ("wrench", "displacement")
    for name, unit in (("stiffness", "N/m"), ("damping", "N s/m")):
        matrices = [
            [np.full((2, 2), np.nan) if getattr(p, name) is None else getattr(p, name) for p in line]
            for line in points.values()
        ]
        found[name] = (
            (*dims, *axes),
            np.array(matrices),
            {"units": unit, "long_name": f"{name} of the film"},
        )
    measured = {"units": "Hz"} if over == "rotation" else {"units": "1", "long_name": _TITLES[over][1]}
    coordinates = {
        "depth": list(points),
        over: (over, values, measured),
        "wrench": ["Fx", "Fy"],
        "displacement": ["x", "y"],
    }
    return xr.Dataset(found, coordinates, {"clearance": clearance, **attributes})


def _pressure(bearing: Bearing, load: Array, speed: float) -> xr.Dataset | None:
    """The film of the deepest depth under the load."""
    found = bearing.pressure(load.tolist(), speed)
    if found is None:
        return None
    fields: dict[str, Any] = {
        "pressure": (("angle", "z"), found.pressure, {"units": "Pa", "long_name": "film pressure"})
    }
    if found.content is not None:
        words = {"units": "1", "long_name": "share of the gap that oil fills"}
        fields["content"] = (("angle", "z"), found.content, words)
    return xr.Dataset(
        fields,
        {
            "angle": ("angle", np.degrees(found.angle), {"units": "deg", "long_name": "angle from x to y"}),
            "z": ("z", found.z, {"units": "m", "long_name": "axial position"}),
        },
        {"name": "pressure", "side_flow": found.side_flow},
    )


def film_depths() -> tuple[str, ...]:
    """Depths that have a film."""
    return depths.films()
