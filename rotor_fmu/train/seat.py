"""A bearing of a train: where it sits, and the data of its film, its solid contact and its pedestal."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from fmus import port
from fmus.port.bore import PLAIN

Pair = tuple[float, float]

DIRECTIONS = ("x", "y", "tilt_x", "tilt_y")


@dataclass(frozen=True)
class Pedestal:
    """Masses, springs and dampers between a bearing's housing and firm ground.

    Attributes
    ----------
    mass, stiffness, damping : tuple of float
        In x and in y [kg], [N/m], [N s/m].
    inertia, tilt_stiffness, tilt_damping : tuple of float
        About x and about y [kg m2], [N m/rad], [N m s/rad]; without the first two it does not tilt.
    """

    mass: Pair
    stiffness: Pair
    damping: Pair = (0.0, 0.0)
    inertia: Pair | None = None
    tilt_stiffness: Pair | None = None
    tilt_damping: Pair = (0.0, 0.0)

    def direction(self, index: int) -> tuple[float, float, float] | None:
        """Mass, stiffness and damping in one of `DIRECTIONS`, or None where it does not give way."""
        if index < 2:
            return self.mass[index], self.stiffness[index], self.damping[index]
        if self.inertia is None or self.tilt_stiffness is None:
            return None
        return self.inertia[index - 2], self.tilt_stiffness[index - 2], self.tilt_damping[index - 2]


@dataclass(frozen=True)
class FoundationMode:
    """A mode of the foundation: frequency [rad/s], damping ratio, shape, 4 n_b numbers, mass-normalised.

    The shape has x, y [1/sqrt(kg)], tilt_x, tilt_y [1/(m sqrt(kg))] of each bearing's housing.
    """

    frequency: float
    damping_ratio: float
    shape: tuple[float, ...]

    @classmethod
    def of_data(cls, data: dict[str, Any]) -> FoundationMode:
        """A mode of what `dataclasses.asdict` makes of one, through JSON."""
        return cls(**{**data, "shape": tuple(data["shape"])})


@dataclass(frozen=True)
class BearingSeat:
    """A journal bearing: where it sits and the data of its film and solid contact.

    Attributes
    ----------
    name : str
        Unique in the train.
    node : int
        Node at the bearing's mid-plane.
    diameter, width, clearance : float
        Journal diameter d, bearing width b, radial clearance C [m].
    viscosity : float
        Dynamic viscosity of the oil [Pa s].
    ambient_pressure : float
        Pressure at the bearing's ends, over the cavity [Pa].
    roughness, contact_modulus, friction : float
        Combined roughness [m], contact factor K'E' [Pa], friction coefficient of solid contact.
    density : float
        Of the oil [kg/m3].
    feed_pressure : float
        Pressure in the grooves, over the cavity [Pa].
    feed_content, feed_flow : float
        Starved supply of a mass-conserving film: content of the grooves; flow into all [m3/s], 0: what
        they take.
    bore : str
        Its arcs, see `fmus.port.bore.from_text`.
    layer_thickness, layer_modulus, layer_poisson, layer_hardness : float
        Soft layer: thickness [m], 0 for a rigid bore, Young's modulus [Pa], Poisson's ratio, hardness [Pa].
    supply_temperature, heat_capacity : float
        Of the oil [K], [J/(kg K)].
    heat_storage : float
        What warms with a film whose temperature is followed [J/K]; 0: the oil in its gap.
    viscosity_40, viscosity_100 : float
        Kinematic, at 40 and 100 degrees Celsius [m2/s]; 0: the viscosity is given.
    load : float or None
        Static target load on the shaft, against gravity [N]; None: from the catenary, or from the heights.
    residual_tilt_x, residual_tilt_y : float
        Rotation of the bearing's axis against the journal's running axis left by the alignment [rad].
    coefficients : str
        Stiffness and damping, constant or over speed, see `fmus.port.coefficient_rows`; empty: from the film.
    has_film : bool
        Whether the bore is known.  Without, diameter, width and clearance are but scales of motion.
    height : float or None
        Of the bearing's centre over a straight line, against gravity [m]; None: as the load asks for.
    sleeve : bool
        The journal is a sleeve of the film's diameter that the table of the shaft does not have.
    pedestal : Pedestal or None
        What its housing stands on; None: firm ground.
    """

    name: str
    node: int
    diameter: float
    width: float
    clearance: float
    viscosity: float
    ambient_pressure: float = 0.0
    roughness: float = port.default_of("roughness")
    contact_modulus: float = port.default_of("contact_modulus")
    friction: float = port.default_of("friction")
    density: float = port.default_of("density")
    feed_pressure: float = 0.0
    feed_content: float = port.default_of("feed_content")
    feed_flow: float = port.default_of("feed_flow")
    bore: str = PLAIN
    layer_thickness: float = port.default_of("layer_thickness")
    layer_modulus: float = port.default_of("layer_modulus")
    layer_poisson: float = port.default_of("layer_poisson")
    layer_hardness: float = port.default_of("layer_hardness")
    supply_temperature: float = port.default_of("supply_temperature")
    heat_capacity: float = port.default_of("heat_capacity")
    viscosity_40: float = 0.0
    viscosity_100: float = 0.0
    heat_storage: float = 0.0
    load: float | None = None
    residual_tilt_x: float = 0.0
    residual_tilt_y: float = 0.0
    coefficients: str = ""
    has_film: bool = True
    height: float | None = None
    sleeve: bool = False
    pedestal: Pedestal | None = None

    @classmethod
    def of_data(cls, data: dict[str, Any]) -> BearingSeat:
        """A bearing of what `dataclasses.asdict` makes of one, through JSON."""
        given = data.pop("pedestal")
        if given is not None:
            given = Pedestal(**{key: pair and tuple(pair) for key, pair in given.items()})
        return cls(**data, pedestal=given)

    @property
    def has_grooves(self) -> bool:
        """Whether its bore has grooves, from which oil comes."""
        return self.bore != PLAIN

    @property
    def oil(self) -> port.Oil | None:
        """The oil whose temperature is to be found; None where the viscosity is given."""
        return port.Oil(self.viscosity_40, self.viscosity_100) if self.viscosity_40 > 0.0 else None

    @property
    def relative_clearance(self) -> float:
        """Relative clearance psi = C / (d/2)."""
        return 2.0 * self.clearance / self.diameter

    def sommerfeld(self, force: float, speed: float) -> float:
        """So = F psi^2 / (b d eta omega) for a force [N] at a speed [rad/s]."""
        return force * self.relative_clearance**2 / (self.width * self.diameter * self.viscosity * speed)
