"""Constants of one bearing in the form the kernels take."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.contact.greenwood_tripp import SliceTable
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.status import FilmStatus

#: One record, since unpacking a tuple of numbers at each call would cost more than the short bearing.
SCALES = np.dtype(
    [
        ("radius", np.float64),
        ("width", np.float64),
        ("clearance", np.float64),
        ("viscosity", np.float64),
        ("friction", np.float64),
        ("sigma", np.float64),  # roughness over clearance
        ("deepest", np.float64),  # least admissible gap over clearance
        ("ambient", np.float64),  # ambient pressure over `pressure`, 1/s
        ("feed", np.float64),  # pressure in the grooves likewise
        ("pressure", np.float64),  # 6 eta R^2 / C^2, Pa s
        ("force", np.float64),  # `pressure` R b/2, N s
        ("slenderness", np.float64),  # (b/d)^2
        ("reynolds", np.float64),  # rho R C / eta where the film may be turbulent, else 0; s
        ("contact_first", np.float64),  # first eccentricity of the contact table, m
        ("contact_step", np.float64),  # its spacing, m
        ("yields", np.float64),  # eccentricity of a slice from which its contact reaches the hardness, m
        ("hardness", np.float64),  # of the softer metal, Pa
        ("flow", np.float64),  # C R b / 4, m3
        ("heat", np.float64),  # heat capacity of the oil by volume, J/(m3 K)
        ("supply", np.float64),  # temperature of its supply, K
        ("closes", np.int64),  # status where the gap is below the deepest one
        ("aligned", np.int64),  # 1 where tilts are ignored
        ("ruptures", np.int64),  # 1 for Reynolds' condition, 0 for Guembel's
    ]
)
Scales: TypeAlias = Any  # a record of SCALES


def scales(parameters: BearingParameters, table: SliceTable, aligned: bool) -> NDArray[np.void]:
    """Constants of the kernels for one bearing, shape (1,)."""
    radius, clearance = parameters.radius, parameters.clearance
    pressure = 6.0 * parameters.viscosity * (radius / clearance) ** 2
    record = np.zeros(1, SCALES)
    values: dict[str, float] = {
        "radius": radius,
        "width": parameters.width,
        "clearance": clearance,
        "viscosity": parameters.viscosity,
        "friction": parameters.friction,
        "sigma": parameters.roughness / clearance,
        "deepest": parameters.deepest_gap / clearance,
        "ambient": parameters.ambient_pressure / pressure,
        "feed": parameters.feed_pressure / pressure,
        "pressure": pressure,
        "force": pressure * radius * 0.5 * parameters.width,
        "slenderness": (parameters.width / parameters.diameter) ** 2,
        "reynolds": (
            parameters.density * radius * clearance / parameters.viscosity if parameters.is_turbulent else 0.0
        ),
        "contact_first": table.first,
        "contact_step": table.step,
        "yields": table.yields,
        "hardness": parameters.layer_hardness,
        "flow": 0.25 * clearance * radius * parameters.width,
        "heat": parameters.density * parameters.heat_capacity,
        "supply": parameters.supply_temperature,
        "closes": FilmStatus.TOO_DEEP if parameters.has_contact else FilmStatus.GAP_CLOSED,
        "aligned": aligned,
        "ruptures": parameters.boundary == "reynolds",
    }
    for name, value in values.items():
        record[name] = value
    return record
