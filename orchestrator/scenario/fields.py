"""Kinds of values in a scenario file: their ranges, and the unit and usual slip of each; SI units and rad."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Finite = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]
Interval = Annotated[float, Field(ge=1e-9, le=1e6, allow_inf_nan=False, description="s")]
NotNegative = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
Angle = Annotated[
    float, Field(ge=-6.3, le=6.3, allow_inf_nan=False, description="rad; did you give degrees?")
]
Grade = Annotated[float | None, Field(ge=0.0, le=0.1, allow_inf_nan=False, description="m/s; G2.5 is 2.5e-3")]


class Model(BaseModel):
    """Immutable; an unknown key is an error, and true or "1" are no numbers."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)
