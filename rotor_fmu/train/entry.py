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
        description="1 to 40 letters a to z, digits, spaces, points, hyphens and underscores, a letter or "
        "digit first",
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


LARGEST_GRAVITY = 100.0
"""In any direction [m/s2]."""


def gravity_vector(value: Any) -> list[float]:
    """[x, y] or [x, y, z], or one number, which acts downwards."""
    down = [0.0, 0.0 - value] if _is_number(value) and value >= 0.0 else value
    if (
        not isinstance(down, list)
        or len(down) not in (2, 3)
        or not all(_is_number(g) and abs(g) <= LARGEST_GRAVITY for g in down)
    ):
        allowed = (
            f"[x, y] or [x, y, z], each a number of at most {LARGEST_GRAVITY:g} m/s2, or one number, not "
            'below 0, for that much downwards (along -y), or 0 or "none"'
        )
        raise PydanticCustomError("unit", "{allowed}", {"allowed": allowed})
    return [float(g) for g in down]


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


class Entry(BaseModel):
    """Immutable; an unknown key is an error, true or "1" are no numbers, "450 mm" is one."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    @field_validator("*", mode="before")
    @classmethod
    def _in_si(cls, value: Any, info: ValidationInfo) -> Any:
        assert info.field_name is not None
        unit = unit_of(cls, info.field_name)
        if info.field_name == "gravity" and value == "none":
            return 0.0
        try:
            return converted(value, unit) if unit else value
        except ValueError as error:
            if info.field_name == "gravity":
                return value  # `gravity_vector` says what is allowed
            raise PydanticCustomError("unit", "{allowed}", {"allowed": str(error)}) from None


def unit_of(model: type[BaseModel], name: str) -> str:
    """SI unit of a field, empty for one that is no measured number."""
    field = model.model_fields[name]
    if field.annotation in (str, Name):
        return ""
    return (field.description or "").partition(";")[0].strip()
