"""Bearings with tilting pads for the tests."""

from __future__ import annotations

import math

import numpy as np

from bearing_fmu.film import make_film
from bearing_fmu.tilting.film import TiltingFilm
from fmus.port.bore import tilting, to_text
from tests.bearing_fmu.bearings import lever, plain

DEG = math.radians(1.0)
ROUGH = {"roughness": 3e-6, "contact_modulus": 1e9, "friction": 0.1}
UP = np.array([0.0, 1.0, 0.0, 0.0])
FOUR = to_text(tilting(4, 80.0 * DEG, 0.0))


def film(depth="v2", bore=FOUR, aspect=0.5, whirl=0.0, **changes) -> TiltingFilm:
    made = make_film(depth, plain(aspect, bore=bore, **changes))
    assert isinstance(made, TiltingFilm)
    made.whirl = whirl
    return made


def step(bearing, state, q, v=(0.0,) * 4, dt=0.0, speed=1.0):
    """Outputs and state; position over the clearance, velocity over clearance and speed."""
    units, inputs = lever(bearing.parameters), np.zeros(17)
    inputs[:4], inputs[4:8], inputs[16] = np.asarray(q) * units, np.asarray(v) * units * abs(speed), speed
    return bearing.evaluate(state, inputs, dt)


def at_rest(bearing, q, speed=1.0):
    return step(bearing, bearing.rest(), q, speed=speed)


def matrices(out):
    return out[8:24].reshape(4, 4), out[24:40].reshape(4, 4)
