"""An entry of a train file: immutable, strict, values in SI or with their unit; and the kinds of numbers."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationInfo, field_validator
from pydantic_core import PydanticCustomError

from rotor_fmu.train.units import converted

Name = Annotated[
    str,
    Field(
        pattern=r"^[A-Za-z0-9][A-Za-z0-9 _.\-]{0,39}$",
        description="1 to 40 letters, digits, spaces, points, hyphens and underscores, a letter or digit "
        "first",
    ),
]
"""Of trains, bearings, wheels, couplings and masses alike."""


def positive(high: float, unit: str, default: Any = ...) -> Any:
    """Return a field for a number above 0 and up to `high`."""
    return Field(default, gt=0.0, le=high, allow_inf_nan=False, description=unit)


def within(low: float, high: float, unit: str, default: Any = ...) -> Any:
    """Return a field for a number between `low` and `high`, ends included."""
    return Field(default, ge=low, le=high, allow_inf_nan=False, description=unit)


def angle(default: Any = ...) -> Any:
    """Return a field for an angle of up to a turn either way."""
    return within(-6.3, 6.3, "rad; did you give degrees?", default)


def grade(default: Any = ...) -> Any:
    """Return a field for a balance grade."""
    return within(0.0, 0.1, "m/s; G2.5 is 2.5e-3", default)


class Entry(BaseModel):
    """Immutable; an unknown key is an error, true or "1" are no numbers, "450 mm" is one."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    @field_validator("*", mode="before")
    @classmethod
    def _in_si(cls, value: Any, info: ValidationInfo) -> Any:
        assert info.field_name is not None
        unit = unit_of(cls, info.field_name)
        try:
            return converted(value, unit) if unit else value
        except ValueError as error:
            raise PydanticCustomError("unit", "{allowed}", {"allowed": str(error)}) from None


def unit_of(model: type[BaseModel], name: str) -> str:
    """SI unit of a field, empty for one that is no measured number."""
    field = model.model_fields[name]
    if field.annotation in (str, Name):
        return ""
    return (field.description or "").partition(";")[0].strip()
