"""What a train file may hold.

The bounds are far outside of what machines have and inside of what a slip of unit gives; the description
of a field says its unit, and after a semicolon the usual slip.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import (
    BeforeValidator,
    Field,
    ModelWrapValidatorHandler,
    PrivateAttr,
    field_validator,
    model_validator,
)
from pydantic_core import PydanticCustomError

from fmus import port
from rotor_fmu.train.bore import BoreKeys
from rotor_fmu.train.coefficients import Matrix, matrix
from rotor_fmu.train.entry import Entry, Name, angle, grade, gravity_vector, positive, within
from rotor_fmu.train.oil import OilKeys, with_viscosity
from rotor_fmu.train.pedestal import PedestalEntry

LEAST_LENGTH = 1e-5
"""Of a shoulder [m]; what is shorter is left over from sums of lengths and would cost digits."""


_LENGTH = "m; did you give mm?"
_PRESSURE = "Pa; did you give MPa?"

COEFFICIENTS = frozenset(("stiffness", "damping", "table"))
BORE = {"diameter": 1.0, "width": 0.5, "clearance": 5e-4, "viscosity": 0.02, "roughness": 5e-7}
"""What a bearing without a bore has in place of one, for a journal of diameter 1: scales, and no film."""

_Matrix = Annotated[Matrix | None, BeforeValidator(matrix)]


class ShoulderRow(Entry):
    """A row of shaft.csv, see the README of the rotor; lengths and diameters [m]."""

    length: float = positive(20.0, _LENGTH)
    outer_diameter: float = positive(10.0, _LENGTH)
    inner_diameter: float = within(0.0, 10.0, _LENGTH, 0.0)
    material: str = ""
    rear_outer_diameter: float | None = positive(10.0, _LENGTH, None)
    rear_inner_diameter: float | None = within(0.0, 10.0, _LENGTH, None)
    stiffness_outer_diameter: float | None = within(0.0, 10.0, _LENGTH, None)
    stiffness_inner_diameter: float | None = within(0.0, 10.0, _LENGTH, None)
    counts: Literal["both", "stiffness", "mass"] = "both"
    z: float | None = within(0.0, 1000.0, _LENGTH, None)

    @property
    def stiffness_diameters(self) -> tuple[float, float]:
        """Outer and inner diameter of what is stiff."""
        outer, inner = self.stiffness_outer_diameter, self.stiffness_inner_diameter
        return (
            self.outer_diameter if outer is None else outer,
            self.inner_diameter if inner is None else inner,
        )

    @model_validator(mode="after")
    def _is_hollow_at_most(self) -> ShoulderRow:
        front = self.outer_diameter, self.inner_diameter
        rear = self.rear_outer_diameter, self.rear_inner_diameter
        outer, inner = (a if b is None else b for a, b in zip(front, rear, strict=True))
        pairs = {"": front, "stiffness_": self.stiffness_diameters, "rear_": (outer, inner)}
        for prefix, (outer, inner) in pairs.items():
            if inner >= outer and (prefix != "stiffness_" or outer > 0.0):
                allowed = f"less than {prefix}outer_diameter, {outer!r}"
                raise ValueError(f"{prefix}inner_diameter = {inner!r}; allowed is {allowed}")
        apart = (self.stiffness_outer_diameter, self.stiffness_inner_diameter) != (None, None)
        if apart and (rear != (None, None) or self.counts != "both"):
            raise ValueError(
                "stiffness_outer_diameter and stiffness_inner_diameter; allowed are none beside a taper or "
                "counts: give two rows, one that counts for stiffness and one for mass"
            )
        return self


class MaterialEntry(Entry):
    """[materials.NAME]: E [Pa], nu, rho [kg/m3]; yield strength [Pa], which runs compare the stress with."""

    youngs_modulus: float = Field(gt=1e8, lt=1e13, description="Pa; did you give MPa?")
    poisson_ratio: float = Field(ge=0.0, lt=0.5)
    density: float = Field(ge=0.0, lt=3e4, description="kg/m3; did you give t/m3?")
    yield_strength: float | None = Field(None, gt=1e7, lt=1e11, description="Pa; did you give MPa?")

    @field_validator("density")
    @classmethod
    def _is_none_or_that_of_a_solid(cls, value: float) -> float:
        if 0.0 < value <= 100.0:
            allowed = "a number greater than 100 kg/m3, or 0; did you give t/m3?"
            raise PydanticCustomError("unit", "{allowed}", {"allowed": allowed})
        return value


class DampingEntry(Entry):
    """[damping]: Rayleigh coefficients alpha [1/s], beta [s]."""

    alpha: float = within(0.0, 1e4, "1/s", 0.0)
    beta: float = within(0.0, 1.0, "s", 0.0)


class Placed(Entry):
    """Something on the shaft: name and z [m]."""

    name: Name
    z: float = Field(ge=0.0, allow_inf_nan=False, description="m")


Side = Literal["front", "rear"] | None
"""Of an elastic coupling that stands at the same z."""


class WheelEntry(Placed):
    """[[wheel]]: see `rotor_fmu.train.train.Wheel`; z instead of a node."""

    mass: float = positive(1e6, "kg")
    polar_inertia: float = within(0.0, 1e7, "kg m2")
    transverse_inertia: float = within(0.0, 1e8, "kg m2")
    mean_diameter: float = within(0.0, 20.0, _LENGTH, 0.0)
    balance_factor: float = Field(1.0, ge=0.0, allow_inf_nan=False)
    unbalance_phase: float = angle(0.0)
    side: Side = None


class MassEntry(Placed):
    """[[mass]]: see `rotor_fmu.train.train.LumpedMass`; z instead of a node."""

    mass: float = within(0.0, 1e6, "kg")
    polar_inertia: float = within(0.0, 1e7, "kg m2", 0.0)
    transverse_inertia: float = within(0.0, 1e8, "kg m2", 0.0)
    side: Side = None


class BearingEntry(BoreKeys, OilKeys, Placed):
    """[[bearing]]: see `rotor_fmu.train.train.BearingSeat`; z instead of a node."""

    diameter: float = positive(10.0, _LENGTH)
    width: float = positive(10.0, _LENGTH)
    clearance: float = positive(0.1, "m; did you give mm?")
    viscosity: float = Field(gt=1e-5, le=1.0, allow_inf_nan=False, description="Pa s; did you give mPa s?")
    ambient_pressure: float = within(0.0, 1e8, "Pa", 0.0)
    roughness: float = positive(1e-4, "m; did you give um?", port.default_of("roughness"))
    contact_modulus: float = within(0.0, 1e13, _PRESSURE, port.default_of("contact_modulus"))
    friction: float = Field(port.default_of("friction"), ge=0.0, le=2.0)
    feed_pressure: float = within(0.0, 1e8, _PRESSURE, 0.0)
    feed_content: float = Field(port.default_of("feed_content"), ge=0.0, le=1.0)
    feed_flow: float = within(0.0, 10.0, "m3/s", port.default_of("feed_flow"))
    layer_thickness: float = within(0.0, 0.1, "m; did you give mm?", 0.0)
    layer_modulus: float = positive(1e12, _PRESSURE, port.default_of("layer_modulus"))
    layer_poisson: float = Field(port.default_of("layer_poisson"), ge=0.0, lt=0.5)
    layer_hardness: float = positive(1e11, _PRESSURE, port.default_of("layer_hardness"))
    load: float | None = within(-1e9, 1e9, "N", None)
    residual_tilt_x: float = within(-0.01, 0.01, "rad", 0.0)
    residual_tilt_y: float = within(-0.01, 0.01, "rad", 0.0)
    height: float | None = within(-0.1, 0.1, _LENGTH, None)
    sleeve: bool = False
    stiffness: _Matrix = Field(None, description="N/m")
    damping: _Matrix = Field(None, description="N s/m")
    table: str | None = None
    pedestal: PedestalEntry | None = None
    _has_film: bool = PrivateAttr(True)

    @property
    def has_film(self) -> bool:
        """Whether it has a bore, from which a film can be made."""
        return self._has_film

    @property
    def bore_text(self) -> str:
        """Its bore for the unit."""
        return self.text(self.clearance)

    @model_validator(mode="wrap")
    @classmethod
    def _without_bore(cls, data: Any, handler: ModelWrapValidatorHandler[BearingEntry]) -> BearingEntry:
        """A bearing of which coefficients are given may do without a bore."""
        bare = isinstance(data, dict) and not COEFFICIENTS.isdisjoint(data) and BORE.keys().isdisjoint(data)
        given = with_viscosity(data) if isinstance(data, dict) else data
        entry = handler({**BORE, **data} if bare else given)
        entry._has_film = not bare
        _ = entry.bore_text  # refuses what is no bore
        if entry.table is not None and (entry.stiffness is not None or entry.damping is not None):
            raise ValueError("table: given beside stiffness or damping; allowed is one of them")
        return entry


class CouplingEntry(Placed):
    """[[coupling]]: rigid, or with the springs and dampers of `rotor_fmu.train.shoulder.Joint`."""

    translational_stiffness: float | None = positive(1e13, "N/m; did you give N/mm?", None)
    angular_stiffness: float | None = within(0.0, 1e13, "N m/rad", None)
    translational_damping: float = within(0.0, 1e10, "N s/m", 0.0)
    angular_damping: float = within(0.0, 1e10, "N m s/rad", 0.0)

    @property
    def elastic(self) -> bool:
        """Whether it has springs."""
        return self.translational_stiffness is not None

    @model_validator(mode="after")
    def _has_both_stiffnesses(self) -> CouplingEntry:
        both = self.translational_stiffness, self.angular_stiffness
        if (both[0] is None) != (both[1] is None):
            given, missing = ("translational", "angular") if both[1] is None else ("angular", "translational")
            raise ValueError(
                f"{given}_stiffness without {missing}_stiffness; allowed are both, for an elastic coupling, "
                "or none, for a rigid one"
            )
        if both[0] is None and (self.translational_damping or self.angular_damping):
            raise ValueError("damping of a rigid coupling; allowed is it beside both stiffnesses")
        return self


class TrainToml(Entry):
    """train.toml; the order of wheels, bearings and couplings is that of the file."""

    name: Name
    speed: float = positive(1e4, "rad/s; 3000 rev/min are 314.16")
    balance_grade: float = grade()
    gravity: Annotated[list[float], BeforeValidator(gravity_vector)] = Field(
        [0.0, -9.80665], description="m/s2"
    )
    shaft: str = "shaft.csv"
    foundation: str | None = None
    damping: DampingEntry = DampingEntry()
    materials: Annotated[dict[str, MaterialEntry], Field(min_length=1)]
    wheel: list[WheelEntry] = []  # noqa: RUF012
    bearing: list[BearingEntry]
    coupling: list[CouplingEntry] = []  # noqa: RUF012
    mass: list[MassEntry] = []  # noqa: RUF012
