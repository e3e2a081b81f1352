"""What a record says of the machine, so that it can be read without the train."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import xarray as xr

from fmus import port
from orchestrator.results.film_regime import regime_coordinates
from orchestrator.scenario.parameters import bearing_parameters, wheel_unbalances
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.train.train import Train

_BEARING = {
    "bearing_diameter": ("diameter", "m", "journal diameter"),
    "bearing_width": ("width", "m", "width of the bearing"),
    "bearing_clearance": ("clearance", "m", "radial clearance"),
    "bearing_viscosity": ("viscosity", "Pa s", "dynamic viscosity of the oil"),
    "bearing_density": ("density", "kg/m3", "density of the oil"),
    "bearing_ambient_pressure": ("ambient_pressure", "Pa", "pressure at the bearing's ends, over the cavity"),
    "bearing_contact_modulus": ("contact_modulus", "Pa", "contact factor K'E' of Greenwood and Tripp"),
    "bearing_friction": ("friction", "1", "friction coefficient of solid contact"),
    "bearing_hardness": ("layer_hardness", "Pa", "hardness of the softer metal"),
    "bearing_roughness": ("roughness", "m", "combined roughness of journal and bore"),
}
_WHEEL = {
    "wheel_mass": ("mass", "kg", "mass of the wheel"),
    "wheel_polar_inertia": ("polar_inertia", "kg m2", "moment of inertia about the shaft's axis"),
    "wheel_transverse_inertia": ("transverse_inertia", "kg m2", "moment of inertia about a diameter"),
    "wheel_diameter": ("mean_diameter", "m", "mean diameter of blading or body, 0 where unknown"),
}
_SHOULDER = {
    "shoulder_length": ("length", "m", "length of the shoulder"),
    "shoulder_outer_diameter": ("widest", "m", "outer diameter of the shoulder, where it is largest"),
    "shoulder_inner_diameter": ("inner_diameter", "m", "inner diameter of the shoulder"),
}


def train_coordinates(scenario: Scenario, train: Train) -> dict[str, Any]:
    """Coordinates of a record that do not depend on time."""
    places = [train.z[seat.node] for seat in train.bearings]
    coordinates: dict[str, Any] = {
        "bearing": ("bearing", [seat.name for seat in train.bearings], {"long_name": "name of the bearing"}),
        "axis": ("axis", ["x", "y"], {"long_name": "x to the side, y up; z along the shaft"}),
        "coordinate": ("coordinate", list(port.POSITION), {"long_name": "coordinate of a journal"}),
        "depth": (
            "bearing",
            [scenario.depth_name_of(seat.name) for seat in train.bearings],
            {"long_name": "modelling depth of the bearing"},
        ),
        **regime_coordinates(scenario, train),
        "bearing_z": ("bearing", places, _words("m", "axial position of the bearing")),
        "z": ("node", list(train.z), _words("m", "axial position of the node")),
        "node_name": ("node", _node_names(train), {"long_name": "what sits at the node"}),
    }
    if train.wheels:
        names = [wheel.name for wheel in train.wheels]
        coordinates["wheel"] = ("wheel", names, {"long_name": "name of the wheel"})
        where = [train.z[wheel.node] for wheel in train.wheels]
        coordinates["wheel_z"] = ("wheel", where, _words("m", "axial position of the wheel"))
    return coordinates


def train_variables(scenario: Scenario, train: Train) -> dict[str, Any]:
    """Variables of a record that do not depend on time: ``name: (dimensions, values, attributes)``."""
    result = {
        "rotor_speed": ((), train.speed, _words("rad/s", "speed of rotation")),
        **_columns("bearing", train.bearings, _BEARING),
        "bearing_parameters": (
            ("bearing",),
            [json.dumps(bearing_parameters(seat, scenario.film)) for seat in train.bearings],
            {"long_name": "what the unit of the bearing was given, SI units, as JSON"},
        ),
        **_columns("shoulder", train.shoulders, _SHOULDER),
    }
    if train.wheels:
        result |= _columns("wheel", train.wheels, _WHEEL)
        nominal = [amount for amount, _ in wheel_unbalances(scenario, train)]
        result["wheel_unbalance"] = (("wheel",), nominal, _words("kg m", "nominal unbalance of the wheel"))
    return result


def bearing_value(record: xr.Dataset, name: str, bearing: str) -> float:
    """A property of a bearing, such as ``diameter``, in SI units.

    Raises
    ------
    KeyError
        When the record is of a version that did not keep it.
    """
    return float(record[f"bearing_{name}"].sel(bearing=bearing))


def _columns(dimension: str, items: Any, table: Mapping[str, tuple[str, str, str]]) -> dict[str, Any]:
    return {
        name: ((dimension,), [getattr(item, key) for item in items], _words(unit, text))
        for name, (key, unit, text) in table.items()
    }


def _node_names(train: Train) -> list[str]:
    """Names of bearings, wheels and couplings at each node; empty where there are none."""
    found: dict[int, list[str]] = {}
    for seat in (train.bearings, train.wheels, train.couplings):
        for item in seat:
            found.setdefault(item.node, []).append(item.name)
    return [", ".join(found.get(node, ())) for node in range(train.nodes)]


def _words(unit: str, text: str) -> dict[str, str]:
    return {"units": unit, "long_name": text}


def in_housing(record: xr.Dataset) -> xr.DataArray:
    """Displacement of the journals less that of their housings, as probes on the bearings read it [m]."""
    displacement = record["displacement"]
    if "housing_displacement" in record:
        displacement = displacement - record["housing_displacement"]
    return displacement
