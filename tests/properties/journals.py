"""What hypothesis draws for films: bearings, positions and rates of the journal."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from hypothesis import strategies as st

from bearing_fmu import depths
from bearing_fmu.film import Film, make_film
from bearing_fmu.parameters import BearingParameters

DEPTHS = st.sampled_from([depth.name for depth in depths.depths() if not (depth.affine or depth.ahead)])
"""Films that take a new bearing at once."""
_RESOLUTIONS = st.sampled_from([(48, 8), (32, 6), (17, 3), (64, 10)])


def decimals(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers to nine decimals: none of the tiny ones with which only rounding can be studied."""
    return st.floats(low, high).map(lambda x: round(x, 9))


def logarithmic(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers between two positive ones, the same share of them in each decade."""
    return st.floats(math.log(low), math.log(high)).map(math.exp)


@st.composite
def bearings(draw, contact: bool | None = None, ambient: float = 1e6) -> BearingParameters:
    """A bearing from that of a pump to that of a ship, with solid contact or without (None: either)."""
    diameter = draw(logarithmic(0.02, 1.5))
    clearance = 0.5 * diameter * draw(logarithmic(5e-4, 5e-3))
    columns, rows = draw(_RESOLUTIONS)
    rough = draw(st.booleans()) if contact is None else contact
    touching = {
        "roughness": clearance * draw(st.sampled_from([1e-3, 5e-3, 2e-2])),
        "contact_modulus": draw(st.sampled_from([1e8, 1e9])),
        "friction": draw(st.floats(0.0, 0.3)),
    }
    return BearingParameters(
        diameter=diameter,
        width=diameter * draw(st.floats(0.2, 1.2)),
        clearance=clearance,
        viscosity=draw(logarithmic(2e-3, 0.5)),
        ambient_pressure=draw(decimals(0.0, ambient)),
        columns=columns,
        rows=rows,
        **(touching if rough else {}),
    )


def speeds() -> st.SearchStrategy[float]:
    """Speeds of rotation in both senses [rad/s]."""
    return st.one_of(logarithmic(5.0, 1500.0), logarithmic(5.0, 1500.0).map(lambda speed: -speed))


@st.composite
def positions(draw, deepest: float = 0.95, tilted: bool = True) -> np.ndarray:
    """Relative positions; the journal reaches `deepest` of the clearance at its worse end at most.

    Over the clearance, tilts over those that take all of it.
    """
    reach = draw(decimals(0.0, deepest))
    share = draw(decimals(0.0, 1.0)) if tilted else 0.0  # of the tilt in the reach
    at, tilt = (draw(decimals(-math.pi, math.pi)) for _ in range(2))
    ex, ey = (1.0 - share) * reach * math.cos(at), (1.0 - share) * reach * math.sin(at)
    return np.array([ex, ey, share * reach * math.cos(tilt), share * reach * math.sin(tilt)])


@st.composite
def rates(draw, largest: float = 0.5, tilted: bool = True) -> np.ndarray:
    """Rates over clearance and speed of rotation."""
    values = [draw(decimals(-largest, largest)) for _ in range(4)]
    return np.array(values) * ([1, 1, 1, 1] if tilted else [1, 1, 0, 0])


@lru_cache(maxsize=64)
def film(depth: str, parameters: BearingParameters) -> Film:
    """The film of a bearing; the table of its contact takes a tenth of a second."""
    return make_film(depth, parameters)


def turned(vector: np.ndarray, angle: float) -> np.ndarray:
    """Both pairs of a position, rate or wrench, turned about the axis."""
    c, s = math.cos(angle), math.sin(angle)
    x, y, a, b = vector
    return np.array([c * x - s * y, s * x + c * y, c * a - s * b, s * a + c * b])
