"""How quantities are shown to people: name, unit and digits; everything else is SI."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

HERTZ = 2.0 * math.pi
"""rad/s of one revolution a second."""


@dataclass(frozen=True)
class Quantity:
    """How a quantity is shown.

    Attributes
    ----------
    label : str
        Its name.
    unit : str
        Unit shown.
    factor : float
        Shown value = SI value times this.
    digits : str
        Format of a value.
    """

    label: str
    unit: str
    factor: float
    digits: str

    @property
    def axis(self) -> str:
        """Name and unit, as on an axis."""
        return f"{self.label} [{self.unit}]"

    def number(self, value: float) -> str:
        """An SI value as shown, without unit; a dash for none."""
        return "-" if math.isnan(value) else f"{value * self.factor:{self.digits}}"

    def text(self, value: float) -> str:
        """An SI value as shown, with its unit."""
        return f"{self.number(value)} {self.unit}"

    def fitting(self, largest: float) -> Quantity:
        """With a smaller unit where the largest value shown would be all zeros behind the point.

        ``MN`` becomes ``kN``, ``kN`` becomes ``N`` (also in moments) and ``mm`` becomes ``µm``, so that
        machines of a few kilograms can be read, too.
        """
        found = self
        if self.unit == "mm" and 0 < abs(largest) * self.factor < 0.1:
            return replace(self, unit="µm", factor=self.factor * 1e3, digits=".1f")
        for large, small in (("MN", "kN"), ("kN", "N")):
            if found.unit.startswith(large) and 0 < abs(largest) * found.factor < 0.1:
                found = replace(found, unit=small + found.unit.removeprefix(large), factor=found.factor * 1e3)
        return found


FORCE = Quantity("bearing force", "MN", 1e-6, ".2f")
MOMENT = Quantity("bearing moment", "MN m", 1e-6, ".2f")
FOUNDATION = Quantity("force on the foundation", "MN", 1e-6, ".2f")
HOUSING = Quantity("displacement of the housing", "µm", 1e6, ".1f")
GAP = Quantity("least gap", "µm", 1e6, ".1f")
AMPLITUDE = Quantity("vibration amplitude", "mm", 1e3, ".3f")
STRESS = Quantity("normal stress", "N/mm²", 1e-6, ".1f")
VIBRATION = Quantity("shaft vibration", "µm", 1e6, ".0f")
PRESSURE = Quantity("pressure", "MPa", 1e-6, ".2f")
CONTACT_PRESSURE = Quantity("contact pressure", "MPa", 1e-6, ".0f")
NUMBER = Quantity("", "", 1.0, ".0f")
SOMMERFELD = Quantity("Sommerfeld number", "", 1.0, ".2f")
RATIO = Quantity("ratio", "", 1.0, ".3g")
SHARE = Quantity("share", "%", 100.0, ".2g")


def small(value: float) -> str:
    """A length [m] in µm: a digit behind the point, and of less than one µm two digits; a dash for none."""
    size = 1e6 * value
    if math.isnan(size):
        return "-"
    return f"{size:.1f} µm" if abs(size) >= 1.0 or size == 0.0 else f"{size:.2g} µm"


def shown(value: float, quantity: Quantity) -> str:
    """A value in the unit that suits its size."""
    if value == 0.0:
        return f"0 {quantity.unit}".strip()
    return quantity.fitting(value).fitting(value).text(value).strip()
