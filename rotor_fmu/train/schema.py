"""What a train file may hold, and the words for what is wrong with it.

The bounds are far outside of what machines have and inside of what a slip of unit gives; the description
of a field says its unit, and after a semicolon the usual slip.
"""

from __future__ import annotations

import typing
from collections.abc import Iterator, Mapping
from typing import Annotated, Any

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    ModelWrapValidatorHandler,
    PrivateAttr,
    ValidationError,
    model_validator,
)

from fmus import port
from rotor_fmu.train.coefficients import Matrix, matrix
from rotor_fmu.train.toml_source import Problem
from rotor_fmu.train.wording import choice, refusal

Name = Annotated[str, Field(min_length=1, max_length=40, pattern=r"^[A-Za-z0-9][A-Za-z0-9 _.\-]*$")]


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


_LENGTH = "m; did you give mm?"
_PRESSURE = "Pa; did you give MPa?"

COEFFICIENTS = frozenset(("stiffness", "damping", "table"))
BORE = {"diameter": 1.0, "width": 0.5, "clearance": 5e-4, "viscosity": 0.02, "roughness": 5e-7}
"""What a bearing without a bore has in place of one, for a journal of diameter 1: scales, and no film."""

_Matrix = Annotated[Matrix | None, BeforeValidator(matrix)]


class _Entry(BaseModel):
    """Immutable; an unknown key is an error, and true or "1" are no numbers."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class ShoulderRow(_Entry):
    """A row of shaft.csv: length, outer and inner diameter [m], material."""

    length: float = positive(20.0, _LENGTH)
    outer_diameter: float = positive(10.0, _LENGTH)
    inner_diameter: float = within(0.0, 10.0, _LENGTH)
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

    youngs_modulus: float = Field(gt=1e8, lt=1e13, description="Pa; did you give MPa?")
    poisson_ratio: float = Field(ge=0.0, lt=0.5)
    density: float = Field(gt=100.0, lt=3e4, description="kg/m3; did you give t/m3?")


class DampingEntry(_Entry):
    """[damping]: Rayleigh coefficients alpha [1/s], beta [s]."""

    alpha: float = within(0.0, 1e4, "1/s", 0.0)
    beta: float = within(0.0, 1.0, "s", 0.0)


class Placed(_Entry):
    """Something on the shaft: name and z [m]."""

    name: Name
    z: float = Field(ge=0.0, allow_inf_nan=False, description="m")


class WheelEntry(Placed):
    """[[wheel]]: see `rotor_fmu.train.train.Wheel`; z instead of a node."""

    mass: float = positive(1e6, "kg")
    polar_inertia: float = within(0.0, 1e7, "kg m2")
    transverse_inertia: float = within(0.0, 1e8, "kg m2")
    mean_diameter: float = within(0.0, 20.0, _LENGTH, 0.0)
    balance_factor: float = Field(1.0, ge=0.0, allow_inf_nan=False)
    unbalance_phase: float = angle(0.0)


class BearingEntry(Placed):
    """[[bearing]]: see `rotor_fmu.train.train.BearingSeat`; z instead of a node."""

    diameter: float = positive(10.0, _LENGTH)
    width: float = positive(10.0, _LENGTH)
    clearance: float = positive(0.1, "m; did you give mm?")
    viscosity: float = Field(gt=1e-5, le=1.0, allow_inf_nan=False, description="Pa s; did you give mPa s?")
    ambient_pressure: float = within(0.0, 1e8, "Pa", 0.0)
    roughness: float = positive(1e-4, "m; did you give um?", port.default_of("roughness"))
    contact_modulus: float = within(0.0, 1e13, _PRESSURE, port.default_of("contact_modulus"))
    friction: float = Field(port.default_of("friction"), ge=0.0, le=2.0)
    load: float | None = within(-1e9, 1e9, "N", None)
    residual_tilt_x: float = within(-0.01, 0.01, "rad", 0.0)
    residual_tilt_y: float = within(-0.01, 0.01, "rad", 0.0)
    stiffness: _Matrix = None
    damping: _Matrix = None
    table: str | None = None
    _has_film: bool = PrivateAttr(True)

    @property
    def has_film(self) -> bool:
        """Whether it has a bore, from which a film can be made."""
        return self._has_film

    @model_validator(mode="wrap")
    @classmethod
    def _without_bore(cls, data: Any, handler: ModelWrapValidatorHandler[BearingEntry]) -> BearingEntry:
        """A bearing of which coefficients are given may do without a bore."""
        bare = isinstance(data, dict) and not COEFFICIENTS.isdisjoint(data) and BORE.keys().isdisjoint(data)
        entry = handler({**BORE, **data} if bare else data)
        entry._has_film = not bare
        if entry.table is not None and (entry.stiffness is not None or entry.damping is not None):
            raise ValueError("table: given beside stiffness or damping; allowed is one of them")
        return entry


class TrainToml(_Entry):
    """train.toml; the order of wheels, bearings and couplings is that of the file."""

    name: Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9_\-]*$")]
    speed: float = positive(1e4, "rad/s; 3000 rev/min are 314.16")
    balance_grade: float = grade()
    shaft: str = "shaft.csv"
    damping: DampingEntry = DampingEntry()
    materials: Annotated[dict[str, MaterialEntry], Field(min_length=1)]
    wheel: list[WheelEntry] = []
    bearing: list[BearingEntry]
    coupling: list[Placed] = []


def explain(error: ValidationError, raw: Mapping[str, Any], model: type[BaseModel]) -> Iterator[Problem]:
    """Location and text of each problem: where, key = value, what is allowed.

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
            yield (), str(problem["msg"]).removeprefix("Value error, ")
            continue
        where, owner = _walk(location[:-1], raw, model)
        key, kind = str(location[-1]), problem["type"]
        if kind == "extra_forbidden":
            yield location, f"{where}{key}: unknown key; {choice(key, owner.model_fields if owner else ())}"
        elif kind == "missing":
            yield location, f"{where}{key}: missing; it must be given"
        else:
            field = owner.model_fields.get(key) if owner else None
            yield location, where + refusal(key, problem, field.description if field else None)


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
