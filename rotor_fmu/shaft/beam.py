"""Timoshenko beam elements of circular cross-section, in one bending plane.

Plain cylinders here, all at once; whatever else a shoulder may be in `rotor_fmu.shaft.section`.

The shape functions are the static solution of the element without load between
its nodes (Przemieniecki 1968, section 5.6; Friswell, Penny, Garvey, Lees 2010,
section 5.4.4), so that stiffness and nodal statics are exact for any length and
shear deformation.  Mass, rotary and polar inertia are consistent with them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotor_fmu.shaft.section import joint_element, section_element
from rotor_fmu.train.train import Shoulder

Array = NDArray[np.float64]

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(4)  # exact to degree 7; the mass integrand has 6
_XI, _DXI = (_POINTS + 1.0) / 2.0, _WEIGHTS / 2.0


@dataclass(frozen=True, eq=False)
class ElementMatrices:
    """Matrices of e elements in (deflection, slope) of both ends.

    Attributes
    ----------
    stiffness : ndarray, (e, 4, 4)
        Bending and shear.
    stiffness_root : ndarray, (e, 2, 4)
        R with R.T R = stiffness: rigid motions come out as zeros to rounding of R, not of the stiffness.
    mass : ndarray, (e, 4, 4)
        Translational and rotary inertia.
    polar : ndarray, (e, 4, 4)
        Polar inertia along the element, weighted by the slopes of the cross-sections.
    weight : ndarray, (e, 4)
        Consistent load of a distributed force equal to the mass, i.e. gravity per unit of g.
    damping : ndarray, (e, 4, 4)
        Of the joints of elastic couplings.
    joint : ndarray of bool, (e,)
        Which elements are joints.
    """

    stiffness: Array
    stiffness_root: Array
    mass: Array
    polar: Array
    weight: Array
    damping: Array
    joint: NDArray[np.bool_]


def shear_coefficient(diameter_ratio: Array, poisson_ratio: Array) -> Array:
    """Cowper's shear coefficient of a hollow circular section.

    Parameters
    ----------
    diameter_ratio : ndarray
        Inner over outer diameter, 0 for a solid section.
    poisson_ratio : ndarray
        Poisson's ratio.

    Returns
    -------
    ndarray
        kappa; the shear stiffness is kappa G A (Cowper 1966, table 1).
    """
    m2 = diameter_ratio**2
    ring = (1.0 + m2) ** 2
    nu = poisson_ratio
    return 6.0 * (1.0 + nu) * ring / ((7.0 + 6.0 * nu) * ring + (20.0 + 12.0 * nu) * m2)


def element_matrices(shoulders: Sequence[Shoulder]) -> ElementMatrices:
    """Matrices of all shoulders at once.

    Parameters
    ----------
    shoulders : sequence of Shoulder
        One element each.

    Returns
    -------
    ElementMatrices
        In the plane's order (deflection, slope) front, (deflection, slope) rear.
    """
    plain = [shoulder for shoulder in shoulders if shoulder.plain]
    elements = _plain_elements(plain)
    if len(plain) == len(shoulders):
        return elements
    count, here = len(shoulders), np.array([shoulder.plain for shoulder in shoulders])
    sizes = {"stiffness_root": (2, 4), "weight": (4,)}
    names = ("stiffness", "stiffness_root", "mass", "polar", "weight", "damping")
    every = {name: np.zeros((count, *sizes.get(name, (4, 4)))) for name in names}
    for name, values in every.items():
        values[here] = getattr(elements, name)
    for k, shoulder in enumerate(shoulders):
        if shoulder.plain:
            continue
        one = (
            joint_element(shoulder.joint) if shoulder.joint else section_element(shoulder, shear_coefficient)
        )
        every["stiffness"][k], every["stiffness_root"][k] = one.root.T @ one.root, one.root
        every["mass"][k], every["polar"][k] = one.mass + one.rotary, 2.0 * one.rotary
        every["weight"][k], every["damping"][k] = one.weight, one.damping
    joint = np.array([shoulder.joint is not None for shoulder in shoulders])
    return ElementMatrices(**every, joint=joint)


def _plain_elements(shoulders: Sequence[Shoulder]) -> ElementMatrices:
    """Of plain cylinders."""
    E, nu, rho, A, second_moment, L, ratio = (
        np.array(
            [
                (
                    s.material.youngs_modulus,
                    s.material.poisson_ratio,
                    s.material.density,
                    s.area,
                    s.second_moment,
                    s.length,
                    s.inner_diameter / s.outer_diameter,
                )
                for s in shoulders
            ]
        )
        .reshape(-1, 7)
        .T
    )
    bending = E * second_moment
    shear = shear_coefficient(ratio, nu) * E / (2.0 * (1.0 + nu)) * A
    phi = 12.0 * bending / (shear * L**2)

    one = np.ones_like(L)
    stiffness = (bending / (L**3 * (1.0 + phi)))[:, None, None] * np.array(
        [
            [12.0 * one, 6.0 * L, -12.0 * one, 6.0 * L],
            [6.0 * L, (4.0 + phi) * L**2, -6.0 * L, (2.0 - phi) * L**2],
            [-12.0 * one, -6.0 * L, 12.0 * one, -6.0 * L],
            [6.0 * L, (2.0 - phi) * L**2, -6.0 * L, (4.0 + phi) * L**2],
        ]
    ).transpose(2, 0, 1)

    # Twice the strain energy as two squares: of constant curvature, and of end slopes against the chord.
    zero = np.zeros_like(L)
    root = np.sqrt(bending / L)[:, None, None] * np.array(
        [[zero, -one, zero, one], np.sqrt(3.0 / (1.0 + phi)) * np.array([2.0 / L, one, -2.0 / L, one])]
    ).transpose(2, 0, 1)

    deflection, rotation = shape_functions(L, phi, _XI)
    translational = (rho * A * L)[:, None, None] * _gram(deflection)
    rotary = (rho * second_moment * L)[:, None, None] * _gram(rotation)
    weight = (rho * A * L)[:, None] * np.einsum("p,epi->ei", _DXI, deflection)
    # Polar inertia of a circular section is twice the diametral one.
    undamped, joint = np.zeros_like(stiffness), np.zeros(len(L), dtype=np.bool_)
    return ElementMatrices(stiffness, root, translational + rotary, 2.0 * rotary, weight, undamped, joint)


def shape_functions(length: Array, phi: Array, xi: Array) -> tuple[Array, Array]:
    """Deflection and rotation of the cross-section along unloaded Timoshenko elements.

    Parameters
    ----------
    length, phi : ndarray, (e,)
        Length L [m] and shear parameter Phi = 12 E I / (kappa G A L^2).
    xi : ndarray, (p,)
        Positions z / L in the elements.

    Returns
    -------
    deflection, rotation : ndarray, (e, p, 4)
        Factors of (deflection, slope) front and (deflection, slope) rear.
    """
    L, s, x = length[:, None], phi[:, None], xi[None, :]
    ones = np.ones_like(L * x)
    deflection = np.stack(
        [
            1.0 - 3.0 * x**2 + 2.0 * x**3 + s * (1.0 - x),
            L * (x - 2.0 * x**2 + x**3 + s / 2.0 * (x - x**2)),
            3.0 * x**2 - 2.0 * x**3 + s * x,
            L * (x**3 - x**2 - s / 2.0 * (x - x**2)),
        ],
        axis=-1,
    )
    rotation = np.stack(
        [
            6.0 / L * (x**2 - x),
            1.0 - 4.0 * x + 3.0 * x**2 + s * (1.0 - x),
            6.0 / L * (x - x**2),
            ones * (3.0 * x**2 - 2.0 * x) + s * x,
        ],
        axis=-1,
    )
    return deflection / (1.0 + s[..., None]), rotation / (1.0 + s[..., None])


def _gram(shapes: Array) -> Array:
    """Integral over xi of the products of shape functions, symmetric to the last bit, (e, 4, 4)."""
    weighted = shapes * np.sqrt(_DXI)[:, None]
    return np.einsum("epi,epj->eij", weighted, weighted)
