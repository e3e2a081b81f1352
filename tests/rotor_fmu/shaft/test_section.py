"""Shoulders that are no plain cylinder, against closed forms."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import scipy.integrate
import scipy.linalg as sl
import scipy.optimize
import scipy.special as special

from rotor_fmu.reduction.reduce import reduce
from rotor_fmu.shaft.beam import element_matrices, shear_coefficient
from rotor_fmu.shaft.matrices import assemble
from rotor_fmu.shaft.section import section_element
from rotor_fmu.shaft.stress import bending_stress
from rotor_fmu.train.train import Coupling, Joint, LumpedMass, Material, Ring, Shoulder, Train
from tests.published import published
from tests.rotor_fmu.published_rotors import seat
from tests.rotor_fmu.published_rotors import with_bearings as on_bearings

STEEL = Material("steel", 2.1e11, 0.3, 7850.0)
BRONZE = Material("bronze", 1.1e11, 0.34, 8800.0)
AIR = Material("air", 2.1e11, 0.3, 0.0)
TUBE = Shoulder(0.4, 0.3, 0.1, STEEL)


def shaft(*shoulders, **kept):
    return Train("shaft", 100.0, 0.0, 0.0, 2.5e-3, shoulders, (), (), **kept)


def cantilever(*shoulders):
    """Deflection and slope at the rear end under a unit force there, the front end clamped."""
    K = assemble(shaft(*shoulders)).plane_stiffness.toarray()[2:, 2:]
    load = np.zeros(len(K))
    load[-2] = 1.0
    return np.linalg.solve(K, load)[-2:]


def frequencies(train, count, clamped=False):
    """Of one plane [rad/s]."""
    model = assemble(train)
    K, M = (A.toarray()[2 * clamped :, 2 * clamped :] for A in (model.plane_stiffness, model.plane_mass))
    return np.sqrt(np.maximum(sl.eigh(K, M, eigvals_only=True)[:count], 0.0))


def test_the_general_element_of_a_cylinder_is_the_plain_one():
    plain, general = element_matrices([TUBE]), section_element(TUBE, shear_coefficient)
    scale = np.abs(plain.stiffness[0])
    assert np.abs(general.root.T @ general.root - plain.stiffness[0]).max() < 1e-11 * scale.max()
    for found, expected in (
        (general.root, plain.stiffness_root[0]),
        (general.mass + general.rotary, plain.mass[0]),
        (2.0 * general.rotary, plain.polar[0]),
        (general.weight, plain.weight[0]),
    ):
        assert np.abs(found - expected).max() < 1e-11 * np.abs(expected).max()


def test_a_cylinder_cut_into_rings_is_that_cylinder():
    rings = Shoulder.of_rings(0.4, [Ring(0.2, 0.1, STEEL), Ring(0.25, 0.2, STEEL), Ring(0.3, 0.25, STEEL)])
    cut, whole = element_matrices([rings]), element_matrices([TUBE])
    for name in ("stiffness", "mass", "polar", "weight"):
        assert getattr(cut, name) == pytest.approx(getattr(whole, name), rel=1e-11)
    assert rings.mass == pytest.approx(TUBE.mass, rel=1e-14)
    assert rings.section_moduli == pytest.approx(TUBE.section_moduli, rel=1e-14)


def test_layers_bend_with_the_sum_of_their_stiffnesses():
    """Also where they count for stiffness or for mass alone."""
    layers = (
        Ring(0.4, 0.3, BRONZE),
        Ring(0.5, 0.4, STEEL, counts="mass"),
        Ring(0.1, 0.0, BRONZE, counts="stiffness"),
    )
    part = Shoulder(0.4, 0.3, 0.1, STEEL, layers=layers)
    moments = [math.pi / 64.0 * (a**4 - b**4) for a, b in ((0.3, 0.1), (0.4, 0.3), (0.1, 0.0))]
    areas = [math.pi / 4.0 * (a**2 - b**2) for a, b in ((0.3, 0.1), (0.4, 0.3), (0.1, 0.0))]
    moduli = STEEL.youngs_modulus, BRONZE.youngs_modulus, BRONZE.youngs_modulus
    bending = sum(E * moment for E, moment in zip(moduli, moments, strict=True))
    G = STEEL.shear_modulus, BRONZE.shear_modulus, BRONZE.shear_modulus
    shears = [g * A for g, A in zip(G, areas, strict=True)]
    nu = (0.3 * shears[0] + 0.34 * (shears[1] + shears[2])) / sum(shears)
    kappa = shear_coefficient(np.zeros(1), np.array([nu]))[0]
    expected = 0.4**3 / (3.0 * bending) + 0.4 / (kappa * sum(shears)), 0.4**2 / (2.0 * bending)
    assert cantilever(part) == pytest.approx(expected, rel=1e-10)
    mass = 7850.0 * areas[0] + 8800.0 * areas[1] + 7850.0 * math.pi / 4.0 * (0.5**2 - 0.4**2)
    assert part.mass == pytest.approx(0.4 * mass, rel=1e-14)
    assert element_matrices([part]).weight[0, [0, 2]].sum() == pytest.approx(part.mass, rel=1e-12)
    # Of steel at 0.3 m and bronze at 0.4 m the steel is stressed more; the mass is not stressed at all.
    assert part.section_moduli[0] == pytest.approx(bending / (2.1e11 * 0.15), rel=1e-14)


def test_a_cone_under_a_force_at_its_tip():
    """64 F L^3 / (3 pi E d1 d2^3) of bending, 4 F L / (kappa G pi d1 d2) of shear; one element, or two."""
    thick, thin, L = 0.3, 0.1, 0.8
    kappa = shear_coefficient(np.zeros(1), np.array([0.3]))[0]
    expected = 64.0 * L**3 / (3.0 * math.pi * 2.1e11 * thin * thick**3)
    expected += 4.0 * L / (kappa * STEEL.shear_modulus * math.pi * thin * thick)
    whole = Ring(thick, 0.0, STEEL, thin)
    assert cantilever(Shoulder.of_rings(L, [whole]))[0] == pytest.approx(expected, rel=1e-11)
    halves = [
        Shoulder.of_rings(share * L, [ring])
        for share, ring in ((0.25, whole.part(0.0, 0.25)), (0.75, whole.part(0.25, 1.0)))
    ]
    assert cantilever(*halves)[0] == pytest.approx(expected, rel=1e-11)
    assert sum(half.mass for half in halves) == pytest.approx(7850.0 * math.pi / 12.0 * L * 0.13, rel=1e-13)
    first = halves[0].mass * halves[0].centroid + halves[1].mass * (0.2 + halves[1].centroid)
    x = np.linspace(0.0, L, 2001)
    section = 7850.0 * math.pi / 4.0 * (thick + (thin - thick) * x / L) ** 2
    assert first == pytest.approx(scipy.integrate.trapezoid(section * x, x), rel=1e-6)


@published("frequencies of a slender cone", "Kirchhoff 1882; Mabie and Rogers 1972", "3e-5")
def test_a_cone_swings_as_bessel_functions_say():
    """Slender truncated cone, thick end clamped: w = Z(2 sqrt(b x)) / x, Z of J2, Y2, I2, K2, x from apex.

    Kirchhoff (1882); Mabie and Rogers, J. Acoust. Soc. Am. 51 (1972) 1771.
    """
    thick, ratio, L = 0.02, 0.4, 10.0
    tip, base = ratio * L / (1.0 - ratio), L / (1.0 - ratio)

    def shapes(x, order):
        """Derivatives of Z_2(2 sqrt(b x)) / x: of x^(-n/2) Z_n it is -+ sqrt(b) x^(-(n+1)/2) Z_(n+1)."""
        u, n = 2.0 * math.sqrt(shapes.b * x), 2 + order
        scale = shapes.b ** (order / 2.0) * x ** (-n / 2.0)
        return scale * np.array(
            [
                (-1.0) ** order * special.jv(n, u),
                (-1.0) ** order * special.yv(n, u),
                special.iv(n, u),
                (-1.0) ** order * special.kv(n, u),
            ]
        )

    def determinant(b):
        shapes.b = b
        rows = [shapes(tip, 2), shapes(tip, 3), shapes(base, 0), shapes(base, 1)]
        return np.linalg.det(np.array([row / np.abs(row).max() for row in rows]))

    grid = np.linspace(0.1, 20.0, 400)
    values = [determinant(b) for b in grid]
    roots = [
        scipy.optimize.brentq(determinant, a, b, xtol=1e-13)
        for a, b, u, v in zip(grid, grid[1:], values, values[1:], strict=False)
        if u * v < 0.0
    ]
    # E I w'''' ~ rho A omega^2 w at d = thick x / base: omega = b c, c^2 = E d^2 / (16 rho x^2)
    speed = math.sqrt(2.1e11 / 7850.0) * thick / base / 4.0
    expected = speed * np.array(roots[:3])
    elements = 24
    cone = Ring(thick, 0.0, STEEL, ratio * thick)
    pieces = [
        Shoulder.of_rings(L / elements, [cone.part(k / elements, (k + 1) / elements)])
        for k in range(elements)
    ]
    assert frequencies(shaft(*pieces), 3, clamped=True) == pytest.approx(expected, rel=3e-5)


def coupled(joint, *, beta=0.0):
    """Two bodies at a coupling, on light stubs."""
    stub = Shoulder(0.1, 0.3, 0.0, AIR)
    train = shaft(
        stub, Shoulder(0.0, 0.3, 0.0, AIR, joint=joint), stub,
        couplings=(Coupling("c", 2),),
        masses=(LumpedMass("front", 1, 400.0, 60.0, 30.0), LumpedMass("rear", 2, 100.0, 18.0, 9.0)),
    )  # fmt: skip
    return replace(train, rayleigh_beta=beta)


def test_two_bodies_at_an_elastic_coupling():
    """omega^2 = k (1 / m1 + 1 / m2) against each other, likewise in angle; damping ratio c omega / (2 k)."""
    joint = Joint(3e7, 2e5, 4e3, 50.0)
    expected = math.sqrt(2e5 * (1.0 / 30.0 + 1.0 / 9.0)), math.sqrt(3e7 * (1.0 / 400.0 + 1.0 / 100.0))
    train = coupled(joint, beta=1e-3)
    assert frequencies(train, 4)[2:] == pytest.approx(expected, rel=1e-5)
    model = assemble(train)
    reduced = reduce(model, "none")
    M, D, K = (A[: len(A) // 2, : len(A) // 2] for A in (reduced.M, reduced.D, reduced.K))
    assert np.abs(D - model.plane_damping.toarray()).max() < 1e-9 * np.abs(D).max()
    squares, modes = sl.eigh(K, M)
    damping = np.einsum("ik,ij,jk->k", modes, D, modes)[2:4] / (2.0 * np.sqrt(squares[2:4]))
    ratio = [c / (2.0 * k) * omega for c, k, omega in zip((50.0, 4e3), (2e5, 3e7), expected, strict=True)]
    assert damping == pytest.approx(ratio, rel=1e-4)  # of the springs alone, not of Rayleigh's beta


def test_a_stiff_joint_is_none_and_a_hinge_bears_no_moment():
    part = Shoulder(0.5, 0.2, 0.0, STEEL)
    whole = shaft(*[part] * 4, masses=(LumpedMass("m", 2, 500.0),))

    def jointed(angular):
        joint = Shoulder(0.0, 0.2, 0.0, STEEL, joint=Joint(1e13, angular))
        return shaft(
            part, part, joint, part, part, masses=(LumpedMass("m", 2, 500.0),), couplings=(Coupling("c", 3),)
        )

    assert frequencies(jointed(1e13), 6)[2:] == pytest.approx(frequencies(whole, 6)[2:], rel=1e-4)
    hinged = jointed(0.0)
    model = assemble(hinged)
    assert model.stiffness_root.shape == (9, 12)
    assert np.linalg.matrix_rank(model.plane_stiffness.toarray() / 1e8) == 9
    bending = bending_stress(hinged)
    assert np.abs(bending.operator.toarray()[[2, 3]]).max() == pytest.approx(
        np.abs(bending_stress(whole).operator.toarray()[2]).max()
    )


def test_a_disc_on_a_shaft_without_mass():
    """Jeffcott: k = 1 / (L^3 / (48 E I) + L / (4 kappa G A)) in the middle of pinned ends."""
    part = Shoulder(0.25, 0.1, 0.0, AIR)
    train = replace(shaft(*[part] * 8, masses=(LumpedMass("disc", 4, 200.0),)), bearings=(seat(0), seat(8)))
    kappa = shear_coefficient(np.zeros(1), np.array([0.3]))[0]
    compliance = 2.0**3 / (48.0 * 2.1e11 * part.second_moment) + 2.0 / (
        4.0 * kappa * AIR.shear_modulus * part.area
    )
    model = assemble(train)
    pinned = [i for i in range(18) if i not in (0, 16)]
    K, M = (A.toarray()[np.ix_(pinned, pinned)] for A in (model.plane_stiffness, model.plane_mass))
    found = math.sqrt(sl.eigh(K, M, eigvals_only=True)[0])
    assert found == pytest.approx(1.0 / math.sqrt(200.0 * compliance), rel=2e-6)
    for method in ("irs", "guyan", "craig-bampton", "none"):
        assert np.all(np.linalg.eigvalsh(reduce(model, method).M) > 0.0)
    with pytest.raises(ValueError, match="the shaft has no mass"):
        assemble(on_bearings(shaft(*[part] * 4), 0, 4))


@pytest.mark.parametrize("turned", [0.0, 0.7, math.pi / 2.0])
def test_gravity_in_any_direction_bends_the_same(turned):
    train = on_bearings(shaft(*[TUBE] * 4), 0, 4)
    other = replace(train, gravity=(9.80665 * math.sin(turned), -9.80665 * math.cos(turned)))
    below, aside = assemble(train), assemble(other)
    for k in range(5):
        x, y = aside.gravity[4 * k : 4 * k + 2]
        down = below.gravity[4 * k + 1]
        assert (x, y) == pytest.approx((-down * math.sin(turned), down * math.cos(turned)))
    assert aside.plane_gravity == pytest.approx(below.plane_gravity)
    assert np.hypot(*bending_stress(other).weight.reshape(2, -1)) == pytest.approx(
        np.abs(bending_stress(train).weight.reshape(2, -1)[1])
    )
