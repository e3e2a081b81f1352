"""What stands in a checkpoint beside its numbers, and what is wrong with one in words."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from orchestrator.master.stepping import DEEPEST
from rotor_fmu.train.wording import shown


class Meta(BaseModel):
    """Instant, step control and identity of the FMUs."""

    model_config = ConfigDict(strict=True, extra="ignore")

    step: int = Field(ge=0)
    time: float = Field(ge=0.0, allow_inf_nan=False)
    level: int = Field(ge=0, le=DEEPEST)
    counts: dict[str, float]
    evaluations: list[int]
    fmus: list[str]
    about: dict[str, Any]


def problem_of(error: ValidationError) -> str:
    """The first of what is wrong, in a line: place, value, what is allowed."""
    first = error.errors()[0]
    where, value = ".".join(map(str, first["loc"])), shown(first["input"])
    given = f"{where} = {value}: " if where and first["type"] != "missing" else f"{where}: " if where else ""
    return " ".join(f"{given}{first['msg']}".split())
