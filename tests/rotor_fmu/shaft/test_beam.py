"""The Timoshenko element and the assembled shaft against beam theory."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as sl

from rotor_fmu.shaft.beam import shear_coefficient
from rotor_fmu.shaft.matrices import assemble, plane_x, plane_y
from rotor_fmu.train.file import load_train
from rotor_fmu.train.train import Material, Shoulder, Wheel
from tests.published import published
from tests.rotor_fmu.published_rotors import uniform_shaft

STEEL = Material("steel", 2.1e11, 0.3, 7850.0)
HUANG = np.array([139.8124893, 337.71959318, 576.08190182, 829.27662087, 1085.82358877])
"""Free-free, L 6 m, D 1.2 m, kappa of Cowper: the exact solution [Hz] of Huang (1961)."""


def elastic_frequencies(train, count):
    model = assemble(train)
    squared = sl.eigh(model.plane_stiffness.toarray(), model.plane_mass.toarray(), eigvals_only=True)
    return np.sqrt(squared[2 : 2 + count]) / (2.0 * math.pi)


@pytest.mark.parametrize(("elements", "error", "digits"), [(10, 1.186e-3, 3), (40, 7.43e-5, 2)])
def test_first_free_frequency_has_the_known_error(elements, error, digits):
    (frequency,) = elastic_frequencies(uniform_shaft(6.0, 1.2, elements, STEEL), 1)
    assert f"{frequency / HUANG[0] - 1.0:.{digits}e}" == f"{error:.{digits}e}"


@published("free frequencies of a thick beam", "Huang 1961", "second order; extrapolated 1e-6")
def test_free_frequencies_converge_to_huang_with_the_square_of_the_length():
    coarse, fine = (elastic_frequencies(uniform_shaft(6.0, 1.2, n, STEEL), 5) / HUANG - 1 for n in (80, 160))
    assert np.log2(coarse / fine) == pytest.approx(2.0, abs=0.01)
    extrapolated = HUANG * (1.0 + fine - (coarse - fine) / 3.0)
    assert extrapolated == pytest.approx(HUANG, rel=1e-6)


@published("shear coefficients of solid and thin sections", "Cowper 1966", "1e-12; thin 1e-8")
def test_shear_coefficient_of_cowper():
    solid, thin = shear_coefficient(np.array([0.0, 1.0 - 1e-9]), np.array([0.3, 0.3]))
    assert solid == pytest.approx(6.0 * 1.3 / (7.0 + 1.8), rel=1e-12)
    assert thin == pytest.approx(2.0 * 1.3 / (4.0 + 0.9), rel=1e-8)  # thin-walled tube, same table


@pytest.mark.parametrize("inner", [0.0, 0.25])
@pytest.mark.parametrize("elements", [1, 5])
def test_cantilever_under_end_force_and_moment(inner, elements):
    length, diameter, force, moment = 1.2, 0.4, 3.0e4, -2.0e4
    train = uniform_shaft(length, diameter, elements, STEEL, inner_diameter=inner)
    shoulder = train.shoulders[0]
    bending = STEEL.youngs_modulus * shoulder.second_moment
    kappa = shear_coefficient(np.array([inner / diameter]), np.array([0.3]))[0]
    shear = kappa * STEEL.shear_modulus * shoulder.area
    stiffness = assemble(train).plane_stiffness.toarray()
    load = np.zeros(len(stiffness))
    load[-2:] = force, moment
    end = np.linalg.solve(stiffness[2:, 2:], load[2:])[-2:]
    deflection = force * (length**3 / (3 * bending) + length / shear) + moment * length**2 / (2 * bending)
    slope = force * length**2 / (2 * bending) + moment * length / bending
    assert end == pytest.approx([deflection, slope], rel=1e-10)


def test_simply_supported_beam_sags_as_timoshenko_says():
    length, diameter, elements = 5.0, 0.6, 8
    train = uniform_shaft(length, diameter, elements, STEEL)
    shoulder = train.shoulders[0]
    bending = STEEL.youngs_modulus * shoulder.second_moment
    shear = shear_coefficient(np.zeros(1), np.array([0.3]))[0] * STEEL.shear_modulus * shoulder.area
    model = assemble(train)
    held = np.array([0, 2 * elements])
    free = np.setdiff1d(np.arange(2 * model.nodes), held)
    K = model.plane_stiffness.toarray()
    sag = np.zeros(2 * model.nodes)
    sag[free] = np.linalg.solve(K[np.ix_(free, free)], 9.81 * model.plane_gravity[free])
    q = -9.81 * STEEL.density * shoulder.area
    middle = q * (5.0 * length**4 / (384.0 * bending) + length**2 / (8.0 * shear))
    quarter = q * (57.0 * length**4 / (6144.0 * bending) + 3.0 * length**2 / (32.0 * shear))
    assert sag[elements] == pytest.approx(middle, rel=1e-10)
    assert sag[elements // 2] == pytest.approx(quarter, rel=1e-10)


@pytest.mark.parametrize("name", ["small", "turbine"])
class TestAssembly:
    def test_symmetries(self, name):
        model = assemble(load_train(name))
        for matrix in (model.M, model.K, model.D):
            assert abs(matrix - matrix.T).max() == 0.0
        assert abs(model.G + model.G.T).max() == 0.0
        assert np.linalg.eigvalsh(model.plane_mass.toarray())[0] > 0.0

    def test_rigid_body_motions_strain_nothing_and_carry_all_mass(self, name):
        train = load_train(name)
        model = assemble(train)
        ones, tilt = np.zeros(2 * model.nodes), np.zeros(2 * model.nodes)
        ones[0::2], tilt[0::2], tilt[1::2] = 1.0, model.z, 1.0
        scale = abs(model.plane_stiffness).max()
        assert np.abs(model.plane_stiffness @ ones).max() < 1e-12 * scale
        assert np.abs(model.plane_stiffness @ tilt).max() < 1e-12 * scale * train.length
        assert ones @ model.plane_mass @ ones == pytest.approx(train.mass, rel=1e-12)
        z = train.z
        centre = sum(s.mass * (z[k] + z[k + 1]) / 2 for k, s in enumerate(train.shoulders))
        centre += sum(w.mass * train.z[w.node] for w in train.wheels)
        assert ones @ model.plane_mass @ tilt == pytest.approx(centre, rel=1e-12)
        polar = sum(2.0 * s.material.density * s.second_moment * s.length for s in train.shoulders) + sum(
            w.polar_inertia for w in train.wheels
        )
        assert tilt @ model.plane_polar @ tilt == pytest.approx(polar, rel=1e-12)

    def test_root_of_the_stiffness_knows_rigid_motion_to_rounding(self, name):
        model = assemble(load_train(name))
        root, stiffness = model.stiffness_root, model.plane_stiffness
        size = np.sqrt(stiffness.diagonal())
        assert np.all(abs(root.T @ root - stiffness).toarray() <= 1e-14 * np.outer(size, size))
        ones, tilt = np.zeros(2 * model.nodes), np.zeros(2 * model.nodes)
        ones[0::2], tilt[0::2], tilt[1::2] = 1.0, model.z, 1.0
        scale = abs(root).sum(axis=1)
        assert np.all(np.abs(root @ ones) <= 1e-15 * scale)
        assert np.all(np.abs(root @ tilt) <= 1e-15 * scale * model.z[-1])

    def test_gravity_pulls_down_with_all_mass(self, name):
        train = load_train(name)
        model = assemble(train)
        assert model.gravity[1::4].sum() == pytest.approx(-train.mass, rel=1e-12)
        assert not model.gravity[0::4].any() and not model.gravity[3::4].any()
        # Moment about the origin in the y-z plane: a force along y at z and a moment about -x.
        moment = model.z @ model.gravity[1::4] - model.gravity[2::4].sum()
        tilt = np.zeros(2 * model.nodes)
        tilt[0::2], tilt[1::2] = model.z, 1.0
        ones = np.zeros(2 * model.nodes)
        ones[0::2] = 1.0
        assert moment == pytest.approx(-(ones @ model.plane_mass @ tilt), rel=1e-12)

    def test_planes_make_the_whole(self, name):
        model = assemble(load_train(name))
        x, y = plane_x(model.nodes), plane_y(model.nodes)
        assert abs(x.T @ model.K @ x - model.plane_stiffness).max() == 0.0
        assert abs(y.T @ model.M @ y - model.plane_mass).max() == 0.0
        assert abs(x.T @ model.K @ y).max() == 0.0
        assert abs(x.T @ model.G @ y - model.plane_polar).max() == 0.0


def test_gyroscopic_moments_of_a_disc():
    """The spin's angular momentum is Ip W (tilt_y, -tilt_x): its rate needs these moments."""
    disc = Wheel("w", 1, 5.0, 0.8, 0.5)
    train = replace(uniform_shaft(1.0, 0.1, 1, replace(STEEL, density=1e-9)), wheels=(disc,))
    G = assemble(train).G.toarray()
    tilt_x, tilt_y = 6, 7
    assert G[tilt_x, tilt_y] == pytest.approx(0.8)
    assert G[tilt_y, tilt_x] == pytest.approx(-0.8)


def test_a_step_in_diameter_sits_at_its_node():
    shoulders = (Shoulder(0.5, 0.2, 0.0, STEEL), Shoulder(0.25, 0.4, 0.1, STEEL))
    train = replace(uniform_shaft(1.0, 0.1, 1, STEEL), shoulders=shoulders)
    assert train.z == (0.0, 0.5, 0.75)
    first, second = (s.mass for s in shoulders)
    assert train.mass == pytest.approx(first + second)
