"""Elements of shoulders that are no plain cylinder: layers, tapers, parts without mass or stiffness, joints.

Like the plain element of `rotor_fmu.shaft.beam` these have the static solution without load between their
nodes as shape functions.  With s the distance from the front end, bending stiffness B(s) = sum E I over the
stiff rings and shear stiffness S(s),

    slope' = M / B,   deflection' = slope + V / S,   M = m + V (c - s),

where c is chosen so that curvature at constant moment m and shear V do not mix: c is the centre of 1 / B.
Then m = (slope_2 - slope_1) / a and V = (w_2 - w_1 - c slope_1 - (L - c) slope_2) / b with the flexibilities
a = int 1 / B ds and b = int (s - c)^2 / B + 1 / S ds.  Stiffness and nodal statics are exact for any taper
but for the quadrature, whose error falls exponentially with its points; mass and weight are consistent.

The stiff rings bend about one axis with plane sections, B = sum E I.  In shear, S = kappa sum G A with
Cowper's kappa for the outline of all of them: a cylinder cut into rings is that cylinder.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.train.train import Joint, Ring, Shoulder

Array = NDArray[np.float64]

_POINTS = 24
"""Of the quadrature; a cone whose diameter grows fivefold is integrated to 1e-9."""


class Element(NamedTuple):
    """One element in (deflection, slope) of both ends, as in `rotor_fmu.shaft.beam.ElementMatrices`."""

    root: Array
    mass: Array
    rotary: Array
    weight: Array
    damping: Array


def section_element(shoulder: Shoulder, shear_coefficient: Callable[[Array, Array], Array]) -> Element:
    """The element of a shoulder of rings."""
    x, weights, running = _quadrature()
    L = shoulder.length
    bending, shear = _stiffness(shoulder, x, shear_coefficient)
    mass, rotary = _inertia(shoulder, x)
    s = L * x

    def whole(values: Array) -> Array:
        return L * (weights @ values)

    a = whole(1.0 / bending)
    centre = float(whole(s / bending) / a)
    b = whole((s - centre) ** 2 / bending + 1.0 / shear)
    root = np.array(
        [
            np.array([0.0, -1.0, 0.0, 1.0]) / math.sqrt(a),
            np.array([1.0, centre, -1.0, L - centre]) / math.sqrt(b),
        ]
    )
    # Generalised forces m and V for unit displacements of the ends, and what they make of the element.
    moment = root[0] / math.sqrt(a)
    force = -root[1] / math.sqrt(b)
    curvature = (moment + np.multiply.outer(centre - s, force)) / bending[:, None]
    slope = np.array([0.0, 1.0, 0.0, 0.0]) + L * (running @ curvature)
    deflection = np.array([1.0, 0.0, 0.0, 0.0]) + L * (running @ (slope + force / shear[:, None]))
    return Element(
        root,
        _gram(deflection, L * weights * mass),
        _gram(slope, L * weights * rotary),
        whole(mass[:, None] * deflection),
        np.zeros((4, 4)),
    )


def joint_element(joint: Joint) -> Element:
    """The element of the springs and dampers of a coupling; it has no mass."""
    apart = np.array([[-1.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 1.0]])
    stiffness = np.array([joint.translational_stiffness, joint.angular_stiffness])
    damping = np.array([joint.translational_damping, joint.angular_damping])
    nothing = np.zeros((4, 4))
    return Element(
        np.sqrt(stiffness)[:, None] * apart,
        nothing,
        nothing,
        np.zeros(4),
        apart.T @ (damping[:, None] * apart),
    )


def _stiffness(
    shoulder: Shoulder, x: Array, shear_coefficient: Callable[[Array, Array], Array]
) -> tuple[Array, Array]:
    """Bending and shear stiffness at shares x of the length."""
    bending, shear, contraction = np.zeros_like(x), np.zeros_like(x), np.zeros_like(x)
    widest, narrowest = np.zeros_like(x), np.full_like(x, np.inf)
    for ring in shoulder.rings:
        if ring.stiff:
            outer, inner = _diameters(ring, x)
            area = math.pi / 4.0 * (outer**2 - inner**2)
            bending += ring.material.youngs_modulus * math.pi / 64.0 * (outer**4 - inner**4)
            shear += ring.material.shear_modulus * area
            contraction += ring.material.poisson_ratio * ring.material.shear_modulus * area
            widest, narrowest = np.maximum(widest, outer), np.minimum(narrowest, inner)
    return bending, shear * shear_coefficient(narrowest / widest, contraction / shear)


def _inertia(shoulder: Shoulder, x: Array) -> tuple[Array, Array]:
    """Mass and rotary inertia by length at shares x of the length."""
    mass, rotary = np.zeros_like(x), np.zeros_like(x)
    for ring in shoulder.rings:
        if ring.heavy:
            outer, inner = _diameters(ring, x)
            mass += ring.material.density * math.pi / 4.0 * (outer**2 - inner**2)
            rotary += ring.material.density * math.pi / 64.0 * (outer**4 - inner**4)
    return mass, rotary


def _diameters(ring: Ring, x: Array) -> tuple[Array, Array]:
    outer, inner = ((1.0 - x) * f(0.0) + x * f(1.0) for f in (ring.outer, ring.inner))
    return outer, inner


def _gram(shapes: Array, weights: Array) -> Array:
    """Integral of the products of shape functions, symmetric to the last bit, (4, 4)."""
    weighted = shapes * np.sqrt(weights)[:, None]
    return np.einsum("pi,pj->ij", weighted, weighted)


@cache
def _quadrature() -> tuple[Array, Array, Array]:
    """Points and weights on (0, 1), and the matrix that integrates from 0 to each point, (p, p)."""
    points, weights = np.polynomial.legendre.leggauss(_POINTS)
    # By the Legendre polynomials through the points: int P_n = (P_n+1 - P_n-1) / (2 n + 1).
    values = np.polynomial.legendre.legvander(points, _POINTS)
    degree = np.arange(_POINTS)
    integrals = np.empty((_POINTS, _POINTS))
    integrals[:, 0] = points + 1.0
    integrals[:, 1:] = (values[:, 2:] - values[:, :-2]) / (2.0 * degree[1:] + 1.0)
    coefficients = (degree[:, None] + 0.5) * values[:, :-1].T * weights
    return (points + 1.0) / 2.0, weights / 2.0, integrals @ coefficients / 2.0
