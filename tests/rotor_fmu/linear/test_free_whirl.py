"""Whirl branches of free shafts: closed forms, the two-plane solution, and what reductions keep of them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rotor_fmu.linear.free_whirl import WhirlError, free_branches, irs_iterates, modal_truncation
from rotor_fmu.linear.whirl import campbell, half_axes, whirl_modes
from rotor_fmu.reduction.reduce import reduce
from rotor_fmu.shaft.matrices import assemble
from rotor_fmu.train.file import load_train
from rotor_fmu.train.train import Material
from tests.published import published
from tests.rotor_fmu.published_rotors import friswell, lalanne_ferraris, springs, uniform_shaft

HERTZ = 2.0 * math.pi
SPEEDS = HERTZ * np.array([0.0, 12.5, 25.0, 37.5, 50.0])
METHODS = ("irs", "irs-plain", "guyan", "craig-bampton")


@pytest.fixture(scope="module")
def turbine():
    return assemble(load_train("turbine"))


@pytest.fixture(scope="module")
def exact(turbine):
    return free_branches(turbine, turbine.z, SPEEDS, 8)


def worst(shaft, model, exact):
    """Largest error at each speed."""
    return np.abs(free_branches(shaft, model.z, SPEEDS, 8).error(exact)).max(axis=(1, 2))


def test_slender_free_beam_at_rest():
    """Euler and Bernoulli: cos(b l) cosh(b l) = 1, w = (b l)^2 sqrt(EI / (rho A l^4))."""
    E, rho, length, diameter = 2.1e11, 7850.0, 10.0, 0.01
    model = assemble(uniform_shaft(length, diameter, 40, Material("steel", E, 0.3, rho)))
    found = free_branches(model, model.z, [0.0], 4)
    roots = np.array([4.730040745, 7.853204624, 10.995607838, 14.137165491])
    expected = roots**2 * math.sqrt(E * diameter**2 / 16.0 / (rho * length**4))
    assert found.forward[0] == pytest.approx(expected, rel=2e-5)
    assert found.backward[0] == pytest.approx(expected, rel=2e-5)


def test_branches_are_the_modes_of_the_two_planes(turbine, exact):
    """In x + i y as in (x, y): the same frequencies, the same directions."""
    modes = whirl_modes(turbine, SPEEDS[2], 24, above=2.0)
    for branch, sign in ((exact.backward, -1.0), (exact.forward, 1.0)):
        of_two_planes = modes.frequency[np.sign(modes.direction) == sign][:8]
        assert branch[2] == pytest.approx(of_two_planes, rel=1e-7)


def test_backward_falls_and_forward_rises_with_speed(exact):
    assert np.all(np.diff(exact.backward, axis=0) < 0.0)
    assert np.all(np.diff(exact.forward, axis=0) > 0.0)
    assert exact.backward[0] == pytest.approx(exact.forward[0], rel=1e-6)


def test_conical_precession_is_no_bending_mode():
    """A free shaft precesses as a rigid body at speed Ip / It: no branch of bending."""
    model = assemble(load_train("small"))
    speed = HERTZ * 50.0
    rigid = whirl_modes(model, speed, 1, above=1.0)
    assert rigid.frequency[0] / HERTZ < 10.0 and rigid.direction[0] == pytest.approx(1.0, abs=1e-6)
    assert free_branches(model, model.z, [speed], 3).both.min() > HERTZ * 50.0


class TestReductionsOfTheTurbine:
    """The first eight bending frequencies in each direction, 0 to 50 Hz of rotation, at equal size."""

    def test_default_irs(self, turbine, exact):
        assert worst(reduce(turbine, "irs"), turbine, exact).max() < 1e-4

    def test_plain_irs_converges_to_the_floor_of_its_transformation(self, turbine, exact):
        """What remains is what the modes at rest, the limit of the iteration, lack of a rotating shaft."""
        *_, last = irs_iterates(turbine, 100)
        found, floor = worst(last, turbine, exact), worst(modal_truncation(turbine), turbine, exact)
        assert found[0] < 1e-6
        assert np.all(found <= np.maximum(1e-4, 1.5 * floor))
        assert np.all(found[1:] >= 0.99 * floor[1:])

    def test_iterations_fall(self, turbine, exact):
        errors = np.array([worst(shaft, turbine, exact) for shaft in irs_iterates(turbine, 6)])
        assert np.all(np.diff(errors, axis=0) < 1e-7)

    def test_guyan_and_component_modes_of_equal_size_are_behind(self, turbine, exact):
        error = {method: worst(reduce(turbine, method), turbine, exact).max() for method in METHODS}
        assert error["guyan"] > 1e-3 > error["irs-plain"]
        assert error["craig-bampton"] > 10.0 * error["irs"]
        assert error["guyan"] > 10.0 * error["craig-bampton"]


@pytest.mark.parametrize("method", ["irs", "irs-plain", "craig-bampton"])
@published("three discs, half the degrees of freedom, three reductions", "Lalanne and Ferraris 1998", "0.5 %")
def test_reduced_rotors_meet_published_values(method):
    """Lalanne and Ferraris at 25000 1/min, half the degrees of freedom; Guyan is 7 % off at the fifth."""
    published = [55.411, 67.197, 157.898, 193.639, 249.851]
    bearings = springs(5e7, 7e7, 500.0, 700.0)
    shaft = reduce(assemble(lalanne_ferraris()), method, size=28)
    modes = whirl_modes(shaft, 25000.0 * HERTZ / 60.0, len(published), bearings=bearings)
    assert modes.frequency / HERTZ == pytest.approx(published, rel=5e-3)


def test_campbell_diagram_of_friswell_5_9_1():
    """Published at rest and at 4000 1/min; between them the branches are monotonic."""
    speeds = np.linspace(0.0, 4000.0, 5) * HERTZ / 60.0
    diagram = campbell(assemble(friswell()), speeds, 6, bearings=springs(1e6, 1e6))
    found = np.array([modes.frequency for modes in diagram]) / HERTZ
    assert found[0] == pytest.approx([13.7921, 13.7921, 43.6582, 43.6582, 114.0801, 114.0801], abs=6e-5)
    assert found[-1] == pytest.approx([13.5902, 13.9731, 40.0728, 46.9051, 95.5215, 131.6331], abs=6e-5)
    assert np.all(np.diff(found[:, 0::2], axis=0) < 0.0)
    assert np.all(np.diff(found[:, 1::2], axis=0) > 0.0)


def test_too_many_modes_are_refused():
    model = assemble(load_train("small"))
    shaft = reduce(model, "guyan", size=16)
    with pytest.raises(WhirlError, match=r"of 30 bending modes .* ask for fewer"):
        free_branches(shaft, model.z, [100.0], 30)


@pytest.mark.parametrize(
    ("x", "y", "expected"),
    [
        (2.0, -2.0j, (2.0, 2.0, 1.0)),  # x = 2 cos, y = 2 sin: from x to y
        (2.0, 2.0j, (2.0, 2.0, -1.0)),
        (3.0, -1.0j, (3.0, 1.0, 0.6)),
        (3.0, 4.0, (5.0, 0.0, 0.0)),
    ],
)
def test_half_axes(x, y, expected):
    turned = np.exp(0.7j)
    found = half_axes(np.array([x * turned]), np.array([y * turned]))
    assert [float(part[0]) for part in found] == pytest.approx(expected, abs=1e-12)
