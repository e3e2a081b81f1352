"""What makes one bearing differ from another: geometry, oil, contact, resolution."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, isfinite

#: Admissible range of each parameter, ends included unless the range is open there.
_RANGES: dict[str, tuple[float, float, str]] = {
    "diameter": (0.0, inf, "> 0 (m)"),
    "width": (0.0, inf, "> 0 (m)"),
    "clearance": (0.0, inf, "> 0 (m)"),
    "viscosity": (0.0, inf, "> 0 (Pa s)"),
    "ambient_pressure": (0.0, inf, ">= 0 (Pa, over the cavity)"),
    "roughness": (0.0, inf, ">= 0 and at most clearance / 10 (m)"),
    "contact_modulus": (0.0, inf, ">= 0 (Pa)"),
    "friction": (0.0, inf, ">= 0"),
    "columns": (16, 512, "an integer from 16 to 512"),
    "rows": (3, 30, "an integer from 3 to 30"),
}
_BOUNDARIES = ("guembel", "reynolds")
_POSITIVE = ("diameter", "width", "clearance", "viscosity")
_INTEGER = ("columns", "rows")


@dataclass(frozen=True)
class BearingParameters:
    """One plain cylindrical bearing; the order and the meaning are the port's.

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
        (pressure and its gradient vanish together), which V1 alone offers, at some five times the effort.

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
    columns: int = 48
    rows: int = 8
    boundary: str = "guembel"

    def __post_init__(self) -> None:
        if self.boundary not in _BOUNDARIES:
            allowed = " or ".join(repr(b) for b in _BOUNDARIES)
            raise ValueError(f"bearing parameter boundary = {self.boundary!r}: must be {allowed}")
        for key, (low, high, allowed) in _RANGES.items():
            value = getattr(self, key)
            valid = isfinite(value) and low <= value <= high
            if key in _POSITIVE:
                valid = valid and value > 0.0
            if key in _INTEGER:
                valid = valid and value == int(value)
            if not valid:
                raise ValueError(f"bearing parameter {key} = {value!r}: must be {allowed}")
        if self.roughness > 0.1 * self.clearance:
            raise ValueError(
                f"bearing parameter roughness = {self.roughness!r}: must be {_RANGES['roughness'][2]}, "
                f"here {0.1 * self.clearance:g}"
            )

    @property
    def radius(self) -> float:
        """Journal radius, m."""
        return 0.5 * self.diameter

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
