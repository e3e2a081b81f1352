"""One shaft in meshes of any number of elements, and its exact free-free frequencies."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.linalg as sl
from scipy.optimize import brentq

from rotor_fmu.shaft.beam import shear_coefficient
from rotor_fmu.train.train import Material, Train, Wheel
from tests.rotor_fmu.published_rotors import uniform_shaft, with_bearings

LENGTH, DIAMETER = 6.0, 0.24
STEEL = Material("steel", 2.1e11, 0.3, 7850.0)
DISC = Wheel("disc", 0, 800.0, 100.0, 55.0, 1.0)
"""At the front end, outside the bearings: it tilts on a slope that is no master by itself."""


def meshed(elements: int) -> Train:
    """The shaft in elements of equal length, bearings about a third from either end."""
    seats = (max(elements // 3, 1), elements - max(elements // 3, 1))
    train = with_bearings(uniform_shaft(LENGTH, DIAMETER, elements, STEEL), *seats)
    return replace(train, wheels=(DISC,))


def exact_frequencies(near: np.ndarray) -> np.ndarray:
    """Timoshenko's frequencies [rad/s] next to given ones: zeros of a determinant by the transfer matrix.

    State (w, psi, M, Q), with M = E I psi', Q = kappa G A (w' - psi); the disc's inertia at the front end.
    """
    shoulder = uniform_shaft(LENGTH, DIAMETER, 1, STEEL).shoulders[0]
    bending = STEEL.youngs_modulus * shoulder.second_moment
    kappa = shear_coefficient(np.zeros(1), np.array([0.3]))[0]
    shear = kappa * STEEL.shear_modulus * shoulder.area
    # Forces in units of E I / L^2 and moments in units of E I / L, lengths in units of L.
    line, tilt = (
        STEEL.density * a * LENGTH**4 / bending / LENGTH**p
        for a, p in ((shoulder.area, 0), (shoulder.second_moment, 2))
    )
    soft = bending / (shear * LENGTH**2)
    mass, inertia = DISC.mass * LENGTH**3 / bending, DISC.transverse_inertia * LENGTH / bending

    def determinant(frequency: float) -> float:
        square = frequency**2
        system = np.array(
            [[0, 1, 0, soft], [0, 0, 1, 0], [0, -tilt * square, 0, -1], [-line * square, 0, 0, 0]]
        )
        front = np.array([[1, 0], [0, 1], [0, -inertia * square], [-mass * square, 0]])
        return float(np.linalg.det((sl.expm(system) @ front)[2:]))

    return np.array([brentq(determinant, 0.995 * w, 1.005 * w, xtol=1e-9, rtol=1e-13) for w in near])
