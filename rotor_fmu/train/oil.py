"""The oil of a bearing in a train file: a grade, or two kinematic viscosities; or else one viscosity."""

from __future__ import annotations

import re
from typing import Any

from pydantic import Field, field_validator, model_validator

from fmus import port
from rotor_fmu.train.entry import Entry, within

CURVE = frozenset(("oil", "viscosity_index", "viscosity_40", "viscosity_100"))
"""Keys of which one or two say what oil it is."""
_GRADE = re.compile(r"\s*(?:ISO\s*)?VG\s*(\d+)\s*", re.IGNORECASE)
_PLACEHOLDER = 0.02
_FIRST_RISE = 10.0
_KINEMATIC = "m2/s; 46 mm2/s are 46e-6"


def _grade(text: str) -> int:
    found = _GRADE.fullmatch(text)
    if found is None or int(found[1]) not in port.GRADES:
        grades = ", ".join(map(str, port.GRADES))
        raise ValueError(f'oil = {text[:30]!r}; allowed is a grade of ISO 3448, as "VG 46", of {grades}')
    return int(found[1])


class OilKeys(Entry):
    """Keys of a `[[bearing]]` about its oil."""

    oil: str | None = None
    viscosity_index: float | None = within(0.0, 300.0, "", None)
    viscosity_40: float | None = within(2e-6, 0.1, _KINEMATIC, None)
    viscosity_100: float | None = within(1e-6, 0.1, _KINEMATIC, None)
    density: float = within(100.0, 3e3, "kg/m3; did you give t/m3?", port.default_of("density"))
    supply_temperature: float = within(
        200.0,
        500.0,
        "K; did you give degrees Celsius without saying so?",
        port.default_of("supply_temperature"),
    )
    heat_capacity: float = Field(
        port.default_of("heat_capacity"), ge=500.0, le=5e3, description="J/kg/K; did you give kJ?"
    )

    heat_storage: float = Field(0.0, ge=0.0, le=1e9, description="J/K")

    @property
    def curve(self) -> port.Oil | None:
        """Its viscosity over temperature; None where the viscosity is given."""
        if self.oil is not None:
            index = port.USUAL_INDEX if self.viscosity_index is None else self.viscosity_index
            return port.Oil.of_grade(_grade(self.oil), index)
        if self.viscosity_40 is None or self.viscosity_100 is None:
            return None
        return port.Oil(self.viscosity_40, self.viscosity_100)

    @property
    def in_seat(self) -> dict[str, float]:
        """What a seat has of it; the viscosity is that from which the search goes out."""
        curve = self.curve
        if curve is None:
            return {}
        first = curve.dynamic(self.supply_temperature + _FIRST_RISE, self.density)
        return {"viscosity": first, "viscosity_40": curve.at_40, "viscosity_100": curve.at_100}

    @field_validator("oil")
    @classmethod
    def _is_a_grade(cls, value: str | None) -> str | None:
        if value is not None:
            _grade(value)
        return value

    @model_validator(mode="after")
    def _is_one_oil(self) -> OilKeys:
        pair = self.viscosity_40, self.viscosity_100
        if self.oil is not None and pair != (None, None):
            raise ValueError("oil: given beside viscosity_40 or viscosity_100; allowed is one of them")
        if (pair[0] is None) != (pair[1] is None):
            raise ValueError("viscosity_40 and viscosity_100; allowed are both or none")
        if self.viscosity_index is not None and self.oil is None:
            raise ValueError("viscosity_index: given without a grade as oil, to which it belongs")
        _ = self.curve  # refuses what is no oil
        return self


def with_viscosity(data: dict[str, Any]) -> dict[str, Any]:
    """Entries of a bearing with a viscosity in place of one, where its oil is given; ValueError beside it."""
    if CURVE.isdisjoint(data):
        return data
    if "viscosity" in data:
        raise ValueError("viscosity: given beside an oil; allowed is one of them")
    return {**data, "viscosity": _PLACEHOLDER}
