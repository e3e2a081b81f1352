"""What makes one bearing differ from another: geometry, oil, contact, resolution."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from fmus import port
from fmus.port.bore import PLAIN, Bore, from_text
from fmus.port.variable import Value

_ROUGHEST = 0.1
_COLUMNS, _ROWS = (int(port.bearing_parameter(key).start or 0) for key in ("columns", "rows"))


@dataclass(frozen=True)
class BearingParameters:
    """One bearing; the order and the meaning are the port's.

    Attributes
    ----------
    diameter, width : float
        Journal diameter d and bearing width b, m.
    clearance : float
        Radial clearance C = psi d / 2, m.
    viscosity : float
        Dynamic viscosity of the oil, Pa s.
    ambient_pressure : float
        Pressure at both ends of the bearing, over the cavity pressure, Pa.
    roughness : float
        Combined standard deviation of the asperity heights of journal and bore, m;
        0 switches the solid contact off.
    contact_modulus : float
        Factor K'E' of the Greenwood-Tripp pressure, Pa; 0 switches the solid contact off.
    friction : float
        Coulomb coefficient of the solid contact.
    columns, rows : int
        Resolution of the film around the circumference and along the axis.
    boundary : str
        Where the film ruptures: "guembel" (negative pressure zeroed, the port's condition) or "reynolds"
        (pressure and its gradient vanish together), at some five times the effort; or "jfo" (mass-conserving
        rupture and reformation in time, of the tilted film alone), with oil from grooves or the ends.
    turbulence : str
        "laminar", or "constantinescu": flow and friction by the local Reynolds number, see
        `bearing_fmu.films.turbulence`.
    density : float
        Of the oil, kg/m3.
    feed_pressure : float
        Pressure in the grooves, over the cavity pressure, Pa.
    feed_content, feed_flow : float
        Of mass-conserving films: share of the gap that oil fills in the grooves, below 1 a starved supply,
        which holds the cavity's pressure; flow into all grooves together, m3/s, from which their content
        follows, 0 where they take what they need.
    bore : str
        Its arcs, see `fmus.port.bore.from_text`.
    layer_thickness, layer_modulus, layer_poisson, layer_hardness : float
        Of the bearing's soft layer: thickness, m, 0 for a rigid bore, Young's modulus, Pa, Poisson's ratio,
        and hardness, Pa, see `bearing_fmu.contact.layer`; the hardness is told from also without a layer.
    supply_temperature, heat_capacity : float
        Of the oil, K and J/(kg K); they make the temperature that is told.
    temperature : str
        "held", the viscosity is a constant; or "followed", it goes with the temperature of a first-order
        balance in time, see `bearing_fmu.films.followed`.
    viscosity_40, viscosity_100 : float
        Kinematic viscosities of the oil at 40 and 100 degrees Celsius, m2/s, for the latter.
    heat_storage : float
        What warms with the oil, J/K; 0 for the oil in the centred gap alone.

    Raises
    ------
    ValueError
        A value out of its range; the message names the key, the value and the range.
    """

    diameter: float
    width: float
    clearance: float
    viscosity: float
    ambient_pressure: float = 0.0
    roughness: float = 0.0
    contact_modulus: float = 0.0
    friction: float = 0.0
    columns: int = _COLUMNS
    rows: int = _ROWS
    boundary: str = "guembel"
    turbulence: str = "laminar"
    density: float = port.default_of("density")
    feed_pressure: float = 0.0
    bore: str = PLAIN
    layer_thickness: float = port.default_of("layer_thickness")
    layer_modulus: float = port.default_of("layer_modulus")
    layer_poisson: float = port.default_of("layer_poisson")
    layer_hardness: float = port.default_of("layer_hardness")
    supply_temperature: float = port.default_of("supply_temperature")
    heat_capacity: float = port.default_of("heat_capacity")

    temperature: str = "held"
    viscosity_40: float = 0.0
    viscosity_100: float = 0.0
    heat_storage: float = 0.0

    feed_content: float = port.default_of("feed_content")
    feed_flow: float = port.default_of("feed_flow")

    def __post_init__(self) -> None:
        for key in port.BEARING_KEYS:
            value, variable = getattr(self, key), port.bearing_parameter(key)
            if not variable.admits(value):
                raise ValueError(f"bearing parameter {key} = {value!r}: must be {variable.range}")
        try:
            from_text(self.bore)
        except ValueError as error:
            raise ValueError(f"bearing parameter bore: {error}") from None
        if self.has_layer:
            self._check_layer()
        if self.temperature == "followed":
            self._check_heat()
        starved = self.feed_content < 1.0 or self.feed_flow > 0.0
        if starved and (self.boundary != "jfo" or not self.arcs):
            raise ValueError(
                "bearing parameters feed_content < 1 and feed_flow > 0: allowed with boundary = 'jfo' and "
                "grooves in the bore only"
            )
        if self.boundary == "jfo" and (self.tilts or self.has_pockets):
            raise ValueError(
                "bearing parameter boundary = 'jfo': allowed with fixed pads and without pockets only"
            )
        if self.boundary == "jfo" and not (self.arcs or self.ambient_pressure > 0.0):
            raise ValueError(
                "bearing parameter boundary = 'jfo': oil must come from somewhere; allowed with grooves in "
                "the bore, or with ambient_pressure > 0 at its ends"
            )
        if self.roughness > _ROUGHEST * self.clearance:
            raise ValueError(
                f"bearing parameter roughness = {self.roughness!r}: must be at most clearance / 10, "
                f"here {_ROUGHEST * self.clearance:g} m"
            )

    def _check_layer(self) -> None:
        if not self.layer_poisson < 0.5:
            raise ValueError(f"bearing parameter layer_poisson = {self.layer_poisson!r}: must be below 0.5")
        if not self.has_contact:
            raise ValueError(
                f"bearing parameter layer_thickness = {self.layer_thickness!r}: must be 0 without roughness "
                "and contact modulus"
            )
        if self.is_turbulent or self.boundary != "guembel" or self.bore != PLAIN:
            raise ValueError(
                f"bearing parameter layer_thickness = {self.layer_thickness!r}: must be 0 in turbulent films "
                "or bores that are not plain, and with Reynolds' condition"
            )

    def _check_heat(self) -> None:
        if self.has_layer or self.boundary == "jfo" or self.tilts:
            raise ValueError(
                "bearing parameter temperature = 'followed': allowed with a rigid bore that is fixed, and "
                "with Guembel's or Reynolds' condition"
            )
        if self.viscosity_40 == 0.0:
            raise ValueError(
                "bearing parameter temperature = 'followed': needs an oil, viscosity_40 and viscosity_100"
            )
        try:
            port.Oil(self.viscosity_40, self.viscosity_100)
        except ValueError as error:
            raise ValueError(f"bearing parameter {error}") from None

    @classmethod
    def of(cls, values: Mapping[str, Value]) -> BearingParameters:
        """The bearing of these values by the names of the port's variables."""
        given: dict[str, Any] = {key: values[name] for key, name in port.BEARING_KEYS.items()}
        given |= {key: int(given[key]) for key in ("columns", "rows")}
        return cls(**given)

    def values(self) -> dict[str, Value]:
        """What `of` takes."""
        return {name: getattr(self, key) for key, name in port.BEARING_KEYS.items()}

    @property
    def radius(self) -> float:
        """Journal radius, m."""
        return 0.5 * self.diameter

    @property
    def arcs(self) -> Bore:
        """Arcs of the bore; none of a plain one."""
        return from_text(self.bore)

    @property
    def tilts(self) -> bool:
        """Whether it has tilting pads."""
        return any(arc.tilts for arc in self.arcs)

    @property
    def has_pockets(self) -> bool:
        """Whether its bore has pockets."""
        return any(arc.share > 0.0 for arc in self.arcs)

    @property
    def is_turbulent(self) -> bool:
        """Whether flow and friction go by the local Reynolds number."""
        return self.turbulence != "laminar"

    @property
    def stored_heat(self) -> float:
        """What a film that is followed stores, J/K."""
        volume = 2.0 * math.pi * self.radius * self.clearance * self.width
        return self.heat_storage or self.density * self.heat_capacity * volume

    @property
    def has_layer(self) -> bool:
        """Whether the bore gives way."""
        return self.layer_thickness > 0.0

    @property
    def layer_compliance(self) -> float:
        """How far the layer recedes under a pressure, m/Pa."""
        nu = self.layer_poisson
        return (1.0 + nu) * (1.0 - 2.0 * nu) / (1.0 - nu) * self.layer_thickness / self.layer_modulus

    @property
    def has_contact(self) -> bool:
        """Whether the bearing has a solid contact model that can bear a closed gap."""
        return self.roughness > 0.0 and self.contact_modulus > 0.0

    @property
    def deepest_gap(self) -> float:
        """Least gap that is still evaluated, m (exclusive).

        Without solid contact the gap must stay open.  With it the larger of
        50 standard deviations of the asperities and a tenth of the clearance may
        overlap: far beyond every physical state (at 10 standard deviations the
        contact pressure is 300 times the contact modulus), yet near enough to
        keep Newton iterations on their feet.
        """
        if not self.has_contact:
            return 0.0
        return -max(50.0 * self.roughness, 0.1 * self.clearance)
