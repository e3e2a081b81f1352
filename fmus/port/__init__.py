"""The port: every variable that the rotor FMU and the bearing FMUs exchange.

This is the one declaration of the interface.  The builder writes the
modelDescription from it, the facades address their values by it, the master and
the SSP export connect by it.  SI units and rad throughout.

Frame: fixed, z along the shaft, y up.  ``q = (x, y, tilt_x, tilt_y)`` is the
displacement of the journal centre at the bearing's mid-plane and the rotation of
the journal axis about x and y, so that at the axial distance z from the mid-plane
the journal centre lies at ``(x + tilt_y z, y - tilt_x z)``; ``v = dq/dt``.

The affine law: a bearing returns, besides the wrench ``F(q, v)`` on the rotor, ::

    K = -dF/dq,   C = -dF/dv,   F0 = F + K q + C v

so that ``F0 - K q' - C v'`` is the wrench near the state; q and v are those of the journal in its housing,
less the housing's own.  The rotor integrates that law; see the README of this folder.  Of a film with memory
K and C are taken at what it remembers; on a soft layer K counts besides what the wall goes on to give way
over the next step, an extrapolation in time.
"""

from __future__ import annotations

from fmus.port.arc import Bore
from fmus.port.balance import ENERGY, VIBRATION, WORK
from fmus.port.bearing import (
    BEARING,
    BEARING_DETAILS,
    BEARING_FAILURE,
    BEARING_INPUTS,
    BEARING_KEYS,
    BEARING_OUTPUTS,
    BEARING_PARAMETERS,
    CHANGEABLE,
    bearing_parameter,
    default_of,
    default_word,
)
from fmus.port.bore import from_text as bore_in
from fmus.port.bore import pads_in, room_in
from fmus.port.connector import (
    F0,
    FORCE,
    FOUNDATION,
    HOUSING,
    JOURNAL,
    KINEMATICS,
    LAW,
    NOMINAL_SPEED,
    POSITION,
    SPEED,
    VELOCITY,
    WRENCH,
    C,
    K,
)
from fmus.port.details import MOST_PADS, WHIRL
from fmus.port.drive import (
    COURSE,
    FRICTION_POWER,
    LOSSES,
    LOST,
    RELEASED,
    ROTATION,
    SWITCHES,
    TORQUE,
    VACUUM_BROKEN,
    switch,
)
from fmus.port.failure import FAILURE, Failure
from fmus.port.linear_bearing import (
    DAMPING,
    LINEAR_PARAMETERS,
    STATIC_POSITION,
    STATIC_WRENCH,
    STIFFNESS,
    coefficient_rows,
    coefficient_text,
    coefficient_values,
    rows_of_values,
)
from fmus.port.oil import GRADES, USUAL_INDEX, Oil, viscosity_index
from fmus.port.rotor_variables import PARTS, at_bearing, rotor
from fmus.port.variable import UNITS, Causality, Kind, Unit, Value, Variability, Variable, with_starts

__all__ = [
    "BEARING",
    "BEARING_DETAILS",
    "BEARING_FAILURE",
    "BEARING_INPUTS",
    "BEARING_KEYS",
    "BEARING_OUTPUTS",
    "BEARING_PARAMETERS",
    "CHANGEABLE",
    "COURSE",
    "DAMPING",
    "ENERGY",
    "F0",
    "FAILURE",
    "FORCE",
    "FOUNDATION",
    "FRICTION_POWER",
    "GRADES",
    "HOUSING",
    "JOURNAL",
    "KINEMATICS",
    "LAW",
    "LINEAR_PARAMETERS",
    "LOSSES",
    "LOST",
    "MOST_PADS",
    "NOMINAL_SPEED",
    "PARTS",
    "POSITION",
    "RELEASED",
    "ROTATION",
    "SPEED",
    "STATIC_POSITION",
    "STATIC_WRENCH",
    "STIFFNESS",
    "SWITCHES",
    "TORQUE",
    "UNITS",
    "USUAL_INDEX",
    "VACUUM_BROKEN",
    "VELOCITY",
    "VIBRATION",
    "WHIRL",
    "WORK",
    "WRENCH",
    "Bore",
    "C",
    "Causality",
    "Failure",
    "K",
    "Kind",
    "Oil",
    "Unit",
    "Value",
    "Variability",
    "Variable",
    "at_bearing",
    "bearing_parameter",
    "bore_in",
    "coefficient_rows",
    "coefficient_text",
    "coefficient_values",
    "default_of",
    "default_word",
    "pads_in",
    "room_in",
    "rotor",
    "rows_of_values",
    "switch",
    "viscosity_index",
    "with_starts",
]
