"""Reductions: published iterations, bounds, exact statics, and the errors they promise."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
import scipy.linalg as sl

from rotor_fmu.reduction.irs import ReductionError, improved_reduced_system, irs_iterations
from rotor_fmu.reduction.masters import default_interface, default_masters
from rotor_fmu.reduction.reduce import METHODS, reduce
from rotor_fmu.reduction.ritz import craig_bampton, guyan
from rotor_fmu.shaft.matrices import assemble
from rotor_fmu.train.file import load_train
from rotor_fmu.train.train import Material
from tests.rotor_fmu.published_rotors import uniform_shaft

GRAVITY = 9.80665
REDUCTIONS = [m for m in METHODS if m != "none"]
STATIC = [m for m in METHODS if m not in ("none", "irs-plain")]


@pytest.fixture(scope="module")
def turbine():
    return assemble(load_train("turbine"))


@pytest.fixture(scope="module")
def reduced(turbine):
    return {method: reduce(turbine, method) for method in REDUCTIONS}


def plane(model):
    """Stiffness and mass of one plane, dense."""
    return model.plane_stiffness.toarray(), model.plane_mass.toarray()


def elastic(shaft):
    """Elastic frequencies of one plane."""
    half = shaft.size // 2
    squared = sl.eigh(shaft.K[:half, :half], shaft.M[:half, :half], eigvals_only=True)
    return np.sqrt(squared[2:])


@pytest.fixture(scope="module")
def exact(turbine):
    return np.sqrt(sl.eigh(*plane(turbine), eigvals_only=True)[2:])


@pytest.fixture(scope="module")
def cantilever():
    diameter = 3e-6  # so slender that shear and rotary inertia are gone
    section = uniform_shaft(1.0, diameter, 1, Material("any", 1.0, 0.3, 1.0)).shoulders[0]
    material = Material("unit", 1.0 / section.second_moment, 0.3, 1.0 / section.area)
    model = assemble(uniform_shaft(1.0, diameter, 10, material))
    return model.plane_mass[2:, 2:], model.stiffness_root[:, 2:]


@pytest.fixture(scope="module")
def cantilever_history(cantilever):
    masters = np.array([2, 6, 10, 14, 18])  # deflections of nodes 2, 4, ... 10, the root being held
    *_, last = itertools.islice(irs_iterations(*cantilever, masters), 6)
    return last.history


class TestEulerBernoulliCantilever:
    """L = EI = rho A = 1, ten elements, masters every second deflection; independent figures [rad/s]."""

    FULL = (3.516018, 22.035221, 61.712923, 121.01713, 200.363329)
    GUYAN = (3.516114, 22.057338, 62.218025, 124.725017, 205.277265)
    FIRST = (3.516018, 22.035221, 61.713116, 121.081836, 200.585047)
    LATER = ((2, (121.019634, 200.379944)), (3, (121.017234, 200.364817)), (5, (121.01713, 200.363354)))

    def test_full(self, cantilever):
        mass, root = cantilever
        frequencies = np.sqrt(sl.eigh((root.T @ root).toarray(), mass.toarray(), eigvals_only=True)[:5])
        assert frequencies == pytest.approx(self.FULL, abs=6e-7)

    def test_guyan_and_first_iteration(self, cantilever_history):
        assert cantilever_history[0] == pytest.approx(self.GUYAN, abs=6e-7)
        assert cantilever_history[1] == pytest.approx(self.FIRST, abs=6e-7)

    @pytest.mark.parametrize(("iteration", "expected"), LATER)
    def test_later_iterations(self, cantilever_history, iteration, expected):
        assert cantilever_history[iteration][3:] == pytest.approx(expected, abs=6e-7)


def test_iterations_fall_monotonically_to_the_exact_frequencies(turbine, exact):
    reduced = reduce(turbine, "irs-plain")
    history = np.array([h[:16] for h in reduced.history])
    assert np.all(np.diff(history, axis=0) < 1e-8 * history[1:])
    assert history[-1][:8] == pytest.approx(exact[:8], rel=1e-8)
    assert history[-1] == pytest.approx(exact[:16], rel=1e-6)
    assert len(history) < 40


@pytest.mark.parametrize("method", REDUCTIONS)
def test_frequencies_are_bounds_from_above(reduced, exact, method):
    frequencies = elastic(reduced[method])
    assert np.all(frequencies > exact[: len(frequencies)] * (1.0 - 1e-8))


def test_irs_is_exact_where_guyan_and_component_modes_of_the_same_size_are_not(reduced, exact):
    error = {m: np.max(np.abs(elastic(r)[:10] / exact[:10] - 1.0)) for m, r in reduced.items()}
    assert error["irs"] < 1e-7 and error["irs-plain"] < 1e-7
    assert error["craig-bampton"] > 50.0 * error["irs"] and error["guyan"] > 1e-3


@pytest.mark.parametrize("method", REDUCTIONS)
def test_size_and_shapes(turbine, reduced, method):
    r = reduced[method]
    assert r.size == 220
    assert r.T.shape == (turbine.size, r.size)
    assert r.bearing.shape == (44, r.size)
    assert r.wheels.shape == (78, r.size)
    np.testing.assert_allclose(r.bearing, r.T[turbine.bearing_dofs.ravel()], rtol=1e-6, atol=0.0)
    assert abs(r.G + r.G.T).max() == 0.0
    assert r.gravity == pytest.approx(r.T.T @ turbine.gravity)
    for small, large in ((r.M, turbine.M), (r.K, turbine.K), (r.D, turbine.D), (r.G, turbine.G)):
        np.testing.assert_allclose(small, r.T.T @ (large @ r.T), rtol=0.0, atol=1e-9 * abs(small).max())


@pytest.mark.parametrize("method", REDUCTIONS)
def test_rigid_body_motions_survive(turbine, reduced, method):
    r = reduced[method]
    tilt = np.zeros(turbine.size)
    tilt[0::4], tilt[3::4] = turbine.z - 30.0, 1.0
    coordinates = np.linalg.lstsq(r.T, tilt, rcond=None)[0]
    assert r.T @ coordinates == pytest.approx(tilt, abs=1e-7)


def supported_statics(M_like, bearing, gravity, springs=2e9):
    stiffness = M_like + bearing.T @ (springs * bearing)
    return np.linalg.solve(stiffness, GRAVITY * gravity)


@pytest.mark.parametrize("method", STATIC)
def test_statics_at_the_bearings_are_exact(turbine, reduced, method):
    """Journals on springs, under gravity: the same loads and journal positions as without reduction."""
    bearing = np.eye(turbine.size)[turbine.bearing_dofs.ravel()]
    full = supported_statics(turbine.K.toarray(), bearing, turbine.gravity)
    r = reduced[method]
    x = supported_statics(r.K, r.bearing, r.gravity)
    assert r.bearing @ x == pytest.approx(bearing @ full, abs=1e-9 * abs(full).max())
    if method in ("irs", "craig-bampton"):
        assert r.T @ x == pytest.approx(full, abs=1e-9 * abs(full).max())


def test_fixed_interface_modes_are_the_beams_own():
    train = uniform_shaft(2.0, 0.1, 12, Material("steel", 2.1e11, 0.3, 7850.0))
    model = assemble(train)
    clamped = np.array([0, 1, 24, 25])
    basis = craig_bampton(model.plane_mass, model.plane_stiffness, clamped, modes=22)
    V = basis.vectors
    assert V.shape == (26, 26)
    frequencies = sl.eigh(V.T @ model.plane_stiffness @ V, V.T @ model.plane_mass @ V, eigvals_only=True)
    exact = sl.eigh(*plane(model), eigvals_only=True)
    assert frequencies[2:] == pytest.approx(exact[2:], rel=1e-6)


def test_none_keeps_everything():
    model = assemble(load_train("small"))
    r = reduce(model, "none")
    assert r.size == model.size
    assert sorted(np.linalg.eigvalsh(r.M)) == pytest.approx(sorted(np.linalg.eigvalsh(model.M.toarray())))


def test_a_size_beyond_the_shaft_is_no_reduction():
    model = assemble(load_train("small"))
    assert reduce(model, "irs", size=500).size == model.size


@pytest.mark.parametrize("method", REDUCTIONS)
def test_small_train_reduces_too(method):
    model = assemble(load_train("small"))
    r = reduce(model, method, size=32)
    assert r.size <= 40
    exact = np.sqrt(sl.eigh(*plane(model), eigvals_only=True)[2:5])
    assert elastic(r)[:3] == pytest.approx(exact, rel=2e-2)


def test_default_masters(turbine):
    interface = default_interface(turbine)
    assert len(interface) == 22
    for count in (30, 64, 80, 500):
        masters = default_masters(turbine, count)
        assert len(masters) == count == len(set(masters.tolist()))
        assert set(interface) <= set(masters)
    wheels = set((turbine.wheel_dofs[:, 0] // 2).tolist())
    assert wheels <= set(default_masters(turbine, 80).tolist())
    assert np.array_equal(default_masters(turbine, 10**6), np.arange(2 * turbine.nodes))


def test_unknown_method(turbine):
    with pytest.raises(ValueError, match="reduction 'serep' is unknown; allowed are irs"):
        reduce(turbine, "serep")


@pytest.mark.parametrize("masters", [[], [3, 3], [-1, 4], [0, 10**6]])
def test_impossible_masters(turbine, masters):
    with pytest.raises(ValueError, match="allowed are distinct degrees of freedom from 0 to 557"):
        reduce(turbine, "guyan", masters=np.array(masters, dtype=int))


def test_masters_must_hold_the_shaft(turbine):
    with pytest.raises(ValueError, match="leave a rigid-body motion free"):
        guyan(turbine.plane_mass, turbine.plane_stiffness, np.array([4]))


def test_non_convergence_is_an_error(turbine):
    masters = default_masters(turbine, 40)
    with pytest.raises(ReductionError, match=r"after 2 iterations the lowest 30 frequencies still change by"):
        improved_reduced_system(
            turbine.plane_mass, turbine.stiffness_root, masters, modes=30, tolerance=1e-9, max_iterations=2
        )


def test_complement_carries_the_gyroscopic_effect(turbine, reduced):
    """At 25 Hz the lowest eight bending modes, both whirl directions, of the unreduced train."""
    from rotor_fmu.linear.whirl import whirl_modes

    speed = 50.0 * math.pi
    full = whirl_modes(turbine, speed, 16, above=2.0).frequency
    error = {
        m: np.max(np.abs(whirl_modes(reduced[m], speed, 16, above=2.0).frequency / full - 1.0))
        for m in ("irs", "irs-plain", "guyan")
    }
    assert error["irs"] < 5e-7
    assert error["irs-plain"] < 2e-4
    assert error["guyan"] > 1e-3
