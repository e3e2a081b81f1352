"""The oil of a bearing: its viscosity over temperature, by grade or by two kinematic viscosities.

::

    log10 log10(nu + 0.7) = A - B log10(T),   nu in mm2/s, T in K

(Ubbelohde and Walther; ASTM D341, for more than 2 mm2/s), through the viscosities at 40 and 100 degrees
Celsius. A grade of ISO 3448 is its viscosity at 40 degrees Celsius; with the viscosity index (ISO 2909, ASTM
D2270) that at 100 degrees Celsius follows.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

GRADES = (2, 3, 5, 7, 10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500, 2200, 3200)
"""ISO 3448: what they are called."""
_AT_40 = {2: 2.2, 3: 3.2, 5: 4.6, 7: 6.8}
"""mm2/s at 40 degrees Celsius where that is not the name."""
USUAL_INDEX = 95.0
"""Viscosity index of straight mineral oils."""

WARM, HOT = 313.15, 373.15
_MM2 = 1e-6
_SHIFT = 0.7
# ASTM D2270: from which viscosity at 100 degrees Celsius on L = a Y^2 + b Y + c and H = d Y^2 + e Y + f
_REFERENCE = (
    (2.0, 1.14673, 1.7576, -0.109, 0.84155, 1.5521, -0.077),
    (3.8, 3.38095, -15.4952, 33.196, 0.78571, 1.7929, -0.183),
    (4.4, 2.5000, -7.2143, 13.812, 0.82143, 1.5679, 0.119),
    (5.0, 0.10100, 16.6350, -45.469, 0.04985, 9.1613, -18.557),
    (6.4, 3.35714, -23.5643, 78.466, 0.22619, 7.7369, -16.656),
    (7.0, 0.01191, 21.4750, -72.870, 0.79762, -0.7321, 14.610),
    (7.7, 0.41858, 16.1558, -56.040, 0.05794, 10.5156, -28.240),
    (9.0, 0.88779, 7.5527, -16.600, 0.26665, 6.7015, -10.810),
    (12.0, 0.76720, 10.7972, -38.180, 0.20073, 8.4658, -22.490),
    (15.0, 0.97305, 5.3135, -2.200, 0.28889, 5.9741, -4.930),
    (18.0, 0.97256, 5.2500, -0.980, 0.24504, 7.4160, -16.730),
    (22.0, 0.91413, 7.4759, -21.820, 0.20323, 9.1267, -34.230),
    (28.0, 0.87031, 9.7157, -50.770, 0.18411, 10.1015, -46.750),
    (40.0, 0.84703, 12.6752, -133.310, 0.17029, 11.4866, -80.620),
    (55.0, 0.85921, 11.1009, -83.19, 0.17130, 11.3680, -76.940),
    (70.0, 0.83531, 14.6731, -216.246, 0.16841, 11.8493, -96.947),
)


@dataclass(frozen=True)
class Oil:
    """An oil by its kinematic viscosity at 40 and at 100 degrees Celsius [m2/s].

    Raises
    ------
    ValueError
        Viscosities that are not those of an oil.
    """

    at_40: float
    at_100: float

    def __post_init__(self) -> None:
        if not 1e-6 <= self.at_100 < self.at_40 <= 0.1:
            raise ValueError(
                f"viscosity_100 = {self.at_100:g} m2/s; allowed is from 1e-6 m2/s to less than viscosity_40, "
                f"{self.at_40:g} m2/s, at most 0.1 m2/s"
            )

    @classmethod
    def of_grade(cls, grade: int, index: float = USUAL_INDEX) -> Oil:
        """The oil of a grade of ISO 3448 and of a viscosity index; ValueError where there is none."""
        if grade not in GRADES:
            raise ValueError(f"oil VG {grade}; allowed are VG {', '.join(map(str, GRADES))}")
        warm = _AT_40.get(grade, float(grade))
        low, high = 1.0, warm
        for _ in range(100):
            middle = 0.5 * (low + high)
            low, high = (
                (middle, high) if middle < 2.0 or viscosity_index(warm, middle) < index else (low, middle)
            )
        if not 2.0 < high < 0.9 * warm:
            raise ValueError(f"oil VG {grade}: has no viscosity index {index:g} after ISO 2909")
        return cls(warm * _MM2, high * _MM2)

    def kinematic(self, temperature: float) -> float:
        """Kinematic viscosity [m2/s] at a temperature [K]."""
        warm, hot = (math.log10(math.log10(nu / _MM2 + _SHIFT)) for nu in (self.at_40, self.at_100))
        slope = (warm - hot) / math.log10(HOT / WARM)
        return (10.0**10.0 ** (warm - slope * math.log10(temperature / WARM)) - _SHIFT) * _MM2

    def temperature(self, kinematic: float) -> float:
        """Temperature [K] at which it has a kinematic viscosity [m2/s]."""
        warm, hot, here = (
            math.log10(math.log10(nu / _MM2 + _SHIFT)) for nu in (self.at_40, self.at_100, kinematic)
        )
        return WARM * (HOT / WARM) ** ((warm - here) / (warm - hot))

    def dynamic(self, temperature: float, density: float) -> float:
        """Dynamic viscosity [Pa s] at a temperature [K], with the density [kg/m3]."""
        return density * self.kinematic(temperature)


def viscosity_index(at_40: float, at_100: float) -> float:
    """Viscosity index (ISO 2909) of viscosities at 40 and 100 degrees Celsius [mm2/s], 2 at least."""
    _, a, b, c, d, e, f = next(row for row in reversed(_REFERENCE) if at_100 >= row[0])
    low, high = ((a * at_100 + b) * at_100 + c, (d * at_100 + e) * at_100 + f)
    if at_40 >= high:
        return 100.0 * (low - at_40) / (low - high)
    return 100.0 + (10.0 ** (math.log10(high / at_40) / math.log10(at_100)) - 1.0) / 0.00715
