"""The port of a bearing: its inputs, its outputs, and the parameters that every depth has."""

from __future__ import annotations

from dataclasses import replace

from fmus.port.bore import PLAIN
from fmus.port.connector import (
    FORCE,
    KINEMATIC_TEXT,
    KINEMATIC_UNITS,
    NOMINAL_SPEED,
    POSITION,
    SPEED,
    WRENCH_TEXT,
    WRENCH_UNITS,
    kinematics,
    law,
)
from fmus.port.details import DETAILS, WHIRL
from fmus.port.failure import FAILURE
from fmus.port.variable import Variable

CLEARANCE = 8.62e-4
JOURNAL_HEIGHT = -0.5 * CLEARANCE  # a bearing on its own starts at half its clearance

BEARING_INPUTS: tuple[Variable, ...] = (
    *(
        replace(v, start=JOURNAL_HEIGHT) if v.name == "journal.y" else v
        for v in kinematics("journal", "journal", "input")
    ),
    *kinematics("housing", "housing", "input"),
    Variable(SPEED, "input", "rad/s", "rotor speed, positive from x to y", NOMINAL_SPEED, nominal=100.0),
)
_ON_STATE = tuple(v.name for v in BEARING_INPUTS)

_OFFSET_TEXT = "bearing centre in the fixed frame: "

CHANGEABLE: dict[str, str] = {
    "viscosity": "viscosity",
    "ambient_pressure": "ambient_pressure",
    "feed_pressure": "feed_pressure",
    "friction": "contact.friction",
    **{f"offset.{name}": f"offset.{name}" for name in POSITION},
}
"""Parameters that may change while a bearing runs, by the words of an event: the oil, its supply, the
surfaces, and where the bearing stands; the rest is what it was made as."""

_PARAMETERS: tuple[Variable, ...] = (
    *(
        Variable(name, "parameter", unit, text, start, minimum=minimum, nominal=nominal, above=above)
        for name, unit, text, start, minimum, nominal, above in (
            ("diameter", "m", "journal diameter d", 0.80, 0.0, 1.0, True),
            ("width", "m", "bearing width b", 0.64, 0.0, 1.0, True),
            ("clearance", "m", "radial clearance C = psi d/2", CLEARANCE, 0.0, 1e-3, True),
            ("viscosity", "Pa.s", "dynamic viscosity eta of the oil", 0.0242, 0.0, 1e-2, True),
            (
                "ambient_pressure",
                "Pa",
                "pressure at the bearing's ends, over the cavity",
                0.0,
                0.0,
                1e5,
                False,
            ),
            (
                "contact.roughness",
                "m",
                "combined roughness sigma of journal and bore",
                3e-6,
                0.0,
                1e-6,
                False,
            ),
            (
                "contact.modulus",
                "Pa",
                "contact factor K'E' of p_c = K'E' F_5/2(h/sigma)",
                1e9,
                0.0,
                1e9,
                False,
            ),
            ("contact.friction", "", "friction coefficient of solid contact", 0.1, 0.0, 0.1, False),
        )
    ),
    *(
        Variable(f"offset.{name}", "parameter", unit, _OFFSET_TEXT + text, 0.0, nominal=1e-4)
        for name, unit, text in zip(POSITION, KINEMATIC_UNITS[:4], KINEMATIC_TEXT[:4], strict=True)
    ),
    *(
        Variable(
            name, "parameter", "", f"film resolution {text}", start, minimum=low, maximum=high, kind="Integer"
        )
        for name, text, start, low, high in (
            ("film.columns", "around the circumference", 48, 16, 512),
            ("film.rows", "along the axis", 8, 3, 30),
        )
    ),
    *(
        Variable(
            name, "parameter", "", f"{text}: {', '.join(choices)}", choices[0], kind="String", choices=choices
        )
        for name, text, choices in (
            ("film.boundary", "where the film ruptures", ("guembel", "reynolds", "jfo")),
            ("film.turbulence", "how the oil flows", ("laminar", "constantinescu")),
            ("film.temperature", "the temperature of the oil", ("held", "followed")),
        )
    ),
    Variable(
        "density",
        "parameter",
        "kg/m3",
        "density of the oil",
        870.0,
        minimum=0.0,
        nominal=1e3,
        above=True,
    ),
    Variable(
        "feed_pressure",
        "parameter",
        "Pa",
        "pressure in the grooves, over the cavity",
        0.0,
        minimum=0.0,
        nominal=1e5,
    ),
    Variable(
        "bore",
        "parameter",
        "",
        f"{PLAIN}, or its arcs [[start, end, preload, towards], ...] in rad; between them grooves",
        PLAIN,
        kind="String",
    ),
    Variable(
        "feed_content",
        "parameter",
        "",
        "share of the gap that oil fills in the grooves; below 1 a starved supply, of a mass-conserving film",
        1.0,
        minimum=0.0,
        maximum=1.0,
        nominal=1.0,
    ),
    Variable(
        "feed_flow",
        "parameter",
        "m3/s",
        "flow into all grooves of a mass-conserving film; 0: as much as they take",
        0.0,
        minimum=0.0,
        nominal=1e-3,
    ),
    *(
        Variable(f"layer.{name}", "parameter", unit, text, start, minimum=0.0, nominal=nominal, above=above)
        for name, unit, text, start, nominal, above in (
            ("thickness", "m", "thickness of the bearing's soft layer; 0: rigid", 0.0, 1e-3, False),
            ("modulus", "Pa", "Young's modulus of the layer", 5e10, 1e10, True),
            ("poisson", "", "Poisson's ratio of the layer, below 0.5", 0.35, 0.1, False),
            ("hardness", "Pa", "hardness of the softer metal; bounds the contact of a layer", 2e8, 1e8, True),
        )
    ),
    *(
        Variable(
            f"oil.{name}", "parameter", unit, text, start, minimum=0.0, nominal=nominal, above=start > 0.0
        )
        for name, unit, text, start, nominal in (
            ("supply_temperature", "K", "temperature at which the oil is supplied", 313.15, 1e2),
            ("heat_capacity", "J/(kg.K)", "specific heat capacity of the oil", 2e3, 1e3),
            ("viscosity_40", "m2/s", "kinematic viscosity at 40 degrees Celsius; 0: not known", 0.0, 1e-5),
            ("viscosity_100", "m2/s", "kinematic viscosity at 100 degrees Celsius; 0: not known", 0.0, 1e-5),
            ("heat_storage", "J/K", "what warms with a followed film; 0: the oil in its gap", 0.0, 1e3),
        )
    ),
    WHIRL,
)

BEARING_PARAMETERS = tuple(replace(v, tunable=v.name in CHANGEABLE.values()) for v in _PARAMETERS)

_AT_START = _ON_STATE + tuple(v.name for v in BEARING_PARAMETERS)

_OUTPUTS: tuple[Variable, ...] = (
    *(
        Variable(name, "output", unit, f"wrench on the rotor: {text}", nominal=1e6, depends_on=_ON_STATE)
        for name, unit, text in zip(FORCE, WRENCH_UNITS, WRENCH_TEXT, strict=True)
    ),
    *law("output", depends_on=_ON_STATE),
    *(
        Variable(name, "output", unit, text, minimum=minimum, nominal=nominal, depends_on=_ON_STATE)
        for name, unit, text, minimum, nominal in (
            ("h_min", "m", "least gap over the whole film; negative: asperities flattened", None, 1e-4),
            ("h_min_centre", "m", "least gap on the centre line of the bearing", None, 1e-4),
            ("h_min_z", "m", "axial position of the least gap, from the mid-plane", None, 1e-1),
            ("p_max", "Pa", "largest film pressure", 0.0, 1e7),
            ("contact_force", "N", "integral of the solid contact pressure", 0.0, 1e6),
            ("contact.Fx", "N", "part of the wrench from solid contact: force in x", None, 1e6),
            ("contact.Fy", "N", "part of the wrench from solid contact: force in y", None, 1e6),
            ("contact.Mx", "N.m", "part of the wrench from solid contact: moment about x", None, 1e6),
            ("contact.My", "N.m", "part of the wrench from solid contact: moment about y", None, 1e6),
            ("friction_power", "W", "power lost in film shear and solid friction", 0.0, 1e6),
            ("eccentricity", "", "relative eccentricity at the mid-plane, |e|/C", 0.0, 1.0),
            ("sommerfeld", "", "So = |F| psi^2 / (b d eta omega)", 0.0, 1.0),
            ("contact_pressure", "Pa", "largest solid contact pressure", 0.0, 1e8),
            (
                "overlap",
                "m",
                "how deep journal and bore would overlap unloaded; 0 while they are apart",
                0.0,
                1e-5,
            ),
            (
                "wiped",
                "",
                "share of the bore in which the solid contact pressure reaches the hardness",
                0.0,
                0.1,
            ),
            ("contact_area", "", "share of the bore in which solids really touch", 0.0, 0.1),
            ("oil_flow", "m3/s", "oil that leaves at both ends of the bearing", 0.0, 1e-3),
            (
                "oil_temperature",
                "K",
                "of a film followed in time; else supply temperature and half the rise by friction power "
                "over oil flow, of 1000 K at most",
                0.0,
                1e2,
            ),
        )
    ),
)
BEARING_OUTPUTS = tuple(replace(v, starts_on=_AT_START) for v in _OUTPUTS)

BEARING_DETAILS = tuple(replace(v, depends_on=_ON_STATE, starts_on=_AT_START) for v in DETAILS)
"""Outputs that only some films of bladeloss tell, else 0; bearings of others need not have them."""

BEARING_KEYS: dict[str, str] = {
    "diameter": "diameter",
    "width": "width",
    "clearance": "clearance",
    "viscosity": "viscosity",
    "ambient_pressure": "ambient_pressure",
    "roughness": "contact.roughness",
    "contact_modulus": "contact.modulus",
    "friction": "contact.friction",
    "columns": "film.columns",
    "rows": "film.rows",
    "boundary": "film.boundary",
    "turbulence": "film.turbulence",
    "density": "density",
    "feed_pressure": "feed_pressure",
    "bore": "bore",
    "feed_content": "feed_content",
    "feed_flow": "feed_flow",
    "layer_thickness": "layer.thickness",
    "layer_modulus": "layer.modulus",
    "layer_poisson": "layer.poisson",
    "layer_hardness": "layer.hardness",
    "supply_temperature": "oil.supply_temperature",
    "heat_capacity": "oil.heat_capacity",
    "temperature": "film.temperature",
    "viscosity_40": "oil.viscosity_40",
    "viscosity_100": "oil.viscosity_100",
    "heat_storage": "oil.heat_storage",
}
"""Parameters of a bearing by the words that trains, scenarios and films have for them."""

BEARING_FAILURE = replace(FAILURE, depends_on=_ON_STATE, starts_on=_AT_START)
"""The last variable of each bearing."""

BEARING: tuple[Variable, ...] = (
    *BEARING_INPUTS,
    *BEARING_OUTPUTS,
    *BEARING_DETAILS,
    *BEARING_PARAMETERS,
    BEARING_FAILURE,
)
"""The unit of a bearing, in the order of its value references; a depth may have more parameters."""


def bearing_parameter(key: str) -> Variable:
    """The parameter of a bearing of this word, see `BEARING_KEYS`."""
    return next(v for v in BEARING_PARAMETERS if v.name == BEARING_KEYS[key])


def default_of(key: str) -> float:
    """Start value of a bearing's number of this word."""
    return float(bearing_parameter(key).start or 0.0)


def default_word(key: str) -> str:
    """Start value of a bearing's parameter that is a word."""
    return str(bearing_parameter(key).start)
