"""What a train file may hold, and the words for what is wrong with it."""

from __future__ import annotations

import difflib
import math
import typing
from collections.abc import Iterator, Mapping
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
Finite = Annotated[float, Field(allow_inf_nan=False)]
Name = Annotated[str, Field(min_length=1, max_length=40, pattern=r"^[A-Za-z0-9][A-Za-z0-9 _.\-]*$")]


class _Entry(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class ShoulderRow(_Entry):
    """A row of shaft.csv: length, outer and inner diameter [m], material."""

    length: Positive
    outer_diameter: Positive
    inner_diameter: NotNegative
    material: str

    @model_validator(mode="after")
    def _is_hollow_at_most(self) -> ShoulderRow:
        if self.inner_diameter >= self.outer_diameter:
            raise ValueError(
                f"inner_diameter = {self.inner_diameter!r}; allowed is less than outer_diameter, "
                f"{self.outer_diameter!r}"
            )
        return self


class MaterialEntry(_Entry):
    """[materials.NAME]: E [Pa], nu, rho [kg/m3]."""

    youngs_modulus: Annotated[float, Field(gt=1e8, lt=1e13)]
    poisson_ratio: Annotated[float, Field(ge=0.0, lt=0.5)]
    density: Annotated[float, Field(gt=100.0, lt=3e4)]


class DampingEntry(_Entry):
    """[damping]: Rayleigh coefficients alpha [1/s], beta [s]."""

    alpha: NotNegative = 0.0
    beta: NotNegative = 0.0


class Placed(_Entry):
    """Something on the shaft: name and z [m]."""

    name: Name
    z: NotNegative


class WheelEntry(Placed):
    """[[wheel]]: see `rotor_fmu.train.Wheel`; z instead of a node."""

    mass: Positive
    polar_inertia: NotNegative
    transverse_inertia: NotNegative
    mean_diameter: NotNegative = 0.0
    balance_factor: NotNegative = 1.0
    unbalance_phase: Finite = 0.0


class BearingEntry(Placed):
    """[[bearing]]: see `rotor_fmu.train.BearingSeat`; z instead of a node."""

    diameter: Positive
    width: Positive
    clearance: Positive
    viscosity: Annotated[float, Field(gt=0.0, le=10.0)]
    ambient_pressure: NotNegative = 0.0
    roughness: Annotated[float, Field(gt=0.0, le=1e-3)] = 3e-6
    contact_modulus: NotNegative = 1e9
    friction: Annotated[float, Field(ge=0.0, le=2.0)] = 0.1
    load: Positive | None = None
    residual_tilt_x: Annotated[float, Field(ge=-0.01, le=0.01)] = 0.0
    residual_tilt_y: Annotated[float, Field(ge=-0.01, le=0.01)] = 0.0


class TrainToml(_Entry):
    """train.toml; the order of wheels, bearings and couplings is that of the file."""

    name: Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9_\-]*$")]
    speed: Positive
    balance_grade: NotNegative
    shaft: str = "shaft.csv"
    damping: DampingEntry = DampingEntry()
    materials: Annotated[dict[str, MaterialEntry], Field(min_length=1)]
    wheel: list[WheelEntry] = []
    bearing: list[BearingEntry]
    coupling: list[Placed] = []

    @model_validator(mode="after")
    def _names_are_unique(self) -> TrainToml:
        for kind in ("wheel", "bearing", "coupling"):
            names = [entry.name for entry in getattr(self, kind)]
            twice = sorted({name for name in names if names.count(name) > 1})
            if twice:
                raise ValueError(f"{kind}: name = {twice[0]!r} occurs twice; allowed are unique names")
        return self


def explain(error: ValidationError, raw: Mapping[str, Any], model: type[BaseModel]) -> Iterator[str]:
    """One line a problem: where, key = value, what is allowed.

    Parameters
    ----------
    error : ValidationError
        What pydantic found.
    raw : mapping
        The data as read, to name entries by their name instead of a number.
    model : type of BaseModel
        The model that was asked for.
    """
    for problem in error.errors():
        location = problem["loc"]
        if not location:
            yield str(problem["msg"]).removeprefix("Value error, ")
            continue
        where, owner = _walk(location[:-1], raw, model)
        key, kind, context = location[-1], problem["type"], problem.get("ctx", {})
        if kind == "extra_forbidden":
            allowed = list(owner.model_fields) if owner else []
            close = difflib.get_close_matches(str(key), allowed, n=1)
            hint = f"did you mean {close[0]!r}? " if close else ""
            yield f"{where}{key}: unknown key; {hint}allowed are {', '.join(allowed)}"
        elif kind == "missing":
            yield f"{where}{key}: missing; it must be given"
        else:
            value = problem["input"]
            if isinstance(value, float) and not math.isfinite(value):
                kind = "finite_number"
            text = _ALLOWED.get(kind, problem["msg"]).format(**context)
            yield f"{where}{key} = {value!r}; allowed is {text}"


_ALLOWED = {
    "greater_than": "a number greater than {gt:g}",
    "greater_than_equal": "a number of at least {ge:g}",
    "less_than": "a number less than {lt:g}",
    "less_than_equal": "a number of at most {le:g}",
    "float_parsing": "a number",
    "float_type": "a number",
    "finite_number": "a finite number",
    "string_type": "a text in quotes",
    "string_pattern_mismatch": "a name that matches {pattern}",
    "list_type": "a list of tables, [[...]]",
    "dict_type": "a table, [...]",
    "model_type": "a table, [...]",
}


def _walk(
    path: tuple[int | str, ...], raw: Any, model: type[BaseModel] | None
) -> tuple[str, type[BaseModel] | None]:
    """Readable prefix of a location and the model of the entry it leads to."""
    words: list[str] = []
    for step in path:
        try:
            raw = raw[step]
        except (KeyError, IndexError, TypeError):
            raw = {}
        if isinstance(step, int):
            name = raw.get("name") if isinstance(raw, dict) else None
            words[-1] += f" {name!r}" if isinstance(name, str) else f" number {step + 1}"
            continue
        words.append(str(step))
        field = model.model_fields.get(step) if model else None
        if field is not None:
            inner = [field.annotation, *typing.get_args(field.annotation)]
            models = [a for a in inner if isinstance(a, type) and issubclass(a, BaseModel)]
            model = models[0] if models else None
    return "".join(f"{word}: " for word in words), model
