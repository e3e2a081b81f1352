"""What a plain journal bearing carries at most, in closed form: to refuse loads that no film carries."""

from __future__ import annotations

import math

from fmus.port.bore import from_text
from rotor_fmu.train.bore import leaning
from rotor_fmu.train.train import BearingSeat

ECCENTRICITY = 0.99
"""Eccentricity ratio at which the film counts as exhausted: a hundredth of the clearance is left."""


def most_load(seat: BearingSeat, speed: float, eccentricity: float = ECCENTRICITY) -> float:
    """Bound on the static load of an aligned film at an eccentricity ratio.

    Both limits of the Reynolds equation overestimate the film of finite width, the infinitely long bearing
    for want of side leakage, the short one for want of a pressure gradient along the circumference, so
    that the smaller of them is a bound. Half Sommerfeld condition; where the oil stands under pressure,
    the suction that is left adds that pressure times the projected area at most.

    Parameters
    ----------
    seat : BearingSeat
        The bearing.
    speed : float
        Rotor speed [rad/s].
    eccentricity : float
        Eccentricity ratio, less than 1.

    Returns
    -------
    float
        Load [N].

    References
    ----------
    Long bearing: Sommerfeld (1904) with Gümbel's condition; short bearing: Ocvirk, NACA TN 2808 (1952).
    """
    e, radius = eccentricity, 0.5 * seat.diameter
    rest = 1.0 - e * e
    shear = seat.viscosity * abs(speed) * radius * seat.width
    long = 6.0 * shear * (radius / seat.clearance) ** 2
    long *= e * math.sqrt(math.pi**2 - e * e * (math.pi**2 - 4.0)) / ((2.0 + e * e) * rest)
    short = 0.25 * shear * (seat.width / seat.clearance) ** 2
    short *= e * math.sqrt(16.0 * e * e + math.pi**2 * rest) / rest**2
    if arcs := from_text(seat.bore):
        # an arc carries less than the whole circle that it is a part of
        lean = leaning(arcs, -0.5 * math.pi)
        return (
            lean * min(long, short)
            + (seat.ambient_pressure + seat.feed_pressure) * seat.width * seat.diameter
        )
    return min(long, short) + seat.ambient_pressure * seat.width * seat.diameter
