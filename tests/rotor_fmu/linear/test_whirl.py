"""Whirl frequencies against published rotors and closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rotor_fmu.linear import eigenmodes
from rotor_fmu.linear.whirl import campbell, whirl_modes
from rotor_fmu.reduction.reduce import reduce
from rotor_fmu.shaft.matrices import assemble
from rotor_fmu.train.file import load_train
from rotor_fmu.train.train import Material, Train, Wheel
from tests.published import published
from tests.rotor_fmu.published_rotors import friswell, lalanne_ferraris, springs, uniform_shaft, with_bearings

RPM = 2.0 * math.pi / 60.0


def hertz(modes):
    return modes.frequency / (2.0 * math.pi)


@pytest.mark.parametrize(
    ("rpm", "published"),
    [
        (0.0, [13.7921, 13.7921, 43.6582, 43.6582, 114.0801, 114.0801]),
        (4000.0, [13.5902, 13.9731, 40.0728, 46.9051, 95.5215, 131.6331]),
    ],
)
@published(
    "whirl of two discs on isotropic supports, at rest and at 4000 rev/min",
    "Friswell et al. 2010, example 5.9.1",
    "every printed digit",
)
def test_isotropic_supports_of_friswell_5_9_1(rpm, published):
    modes = whirl_modes(assemble(friswell()), rpm * RPM, 6, bearings=springs(1e6, 1e6))
    assert hertz(modes) == pytest.approx(published, abs=6e-5)
    if rpm:
        assert modes.direction == pytest.approx([-1, 1, -1, 1, -1, 1], abs=1e-9)


@published(
    "two discs on damped supports: frequencies, damping ratios",
    "Friswell et al. 2010, example 5.9.5",
    "every printed digit",
)
def test_damped_supports_of_friswell_5_9_5():
    modes = whirl_modes(assemble(friswell()), 4000.0 * RPM, 6, bearings=springs(1e6, 1e6, 3e3, 3e3))
    assert hertz(modes) == pytest.approx([13.6819, 14.0716, 41.9829, 50.6487, 104.2484, 105.6629], abs=6e-5)
    assert modes.damping_ratio == pytest.approx([0.0474, 0.0535, 0.2704, 0.2404, 0.5236, 0.7089], abs=6e-5)


@pytest.mark.parametrize(
    ("rpm", "published"),
    [
        (0.0, [60.615, 63.025, 169.496, 185.563, 329.605, 362.078, 529.333, 557.573]),
        (25000.0, [55.411, 67.197, 157.898, 193.639, 249.851, 407.463, 446.713]),
    ],
)
@published(
    "three discs on anisotropic supports, at rest and at 25000 rev/min",
    "Lalanne and Ferraris 1998",
    "0.0006 Hz",
)
def test_anisotropic_supports_of_lalanne_and_ferraris(rpm, published):
    bearings = springs(5e7, 7e7, 500.0, 700.0)
    modes = whirl_modes(assemble(lalanne_ferraris()), rpm * RPM, len(published), bearings=bearings)
    assert hertz(modes) == pytest.approx(published, abs=6e-4)


def test_overhung_disc_whirls_as_its_closed_form():
    """A heavy disc on a massless cantilever: det(K - w^2 M + w W G) = 0 in complex coordinates."""
    E, length, diameter, speed = 2e11, 0.8, 0.04, 400.0
    mass, polar, transverse = 20.0, 0.8, 0.45
    material = Material("light", E, 0.3, 1e-6)
    shaft = uniform_shaft(length, diameter, 4, material)
    train = Train("disc", 1.0, 0.0, 0.0, 0.0, shaft.shoulders, (Wheel("d", 4, mass, polar, transverse),),
                  with_bearings(shaft, 0).bearings)  # fmt: skip
    clamp = springs(1e15, 1e15, count=1)
    clamp.stiffness[:, 2, 2] = clamp.stiffness[:, 3, 3] = 1e15
    modes = whirl_modes(assemble(train), speed, 4, bearings=clamp)

    bending = E * math.pi * diameter**4 / 64.0
    kappa = 6.0 * 1.3 / (7.0 + 1.8)
    shear = kappa * E / 2.6 * math.pi * diameter**2 / 4.0
    flexibility = np.array(
        [[length**3 / (3 * bending) + length / shear, length**2 / (2 * bending)],
         [length**2 / (2 * bending), length / bending]]
    )  # fmt: skip
    k = np.linalg.inv(flexibility)
    # (k11 - m w^2)(k22 - Id w^2 + Ip W w) - k12^2 = 0; positive roots whirl forward.
    translation, tilting = [-mass, 0.0, k[0, 0]], [-transverse, polar * speed, k[1, 1]]
    roots = np.polysub(np.polymul(translation, tilting), [k[0, 1] ** 2])
    expected = np.sort(np.roots(roots).real)
    found = np.sort(modes.frequency * np.sign(modes.direction))
    assert found == pytest.approx(expected, rel=1e-6)


def test_sparse_solver_agrees_with_the_dense_one(monkeypatch):
    model = reduce(assemble(load_train("turbine")), "craig-bampton")
    speed = 50.0 * math.pi
    sparse = whirl_modes(model, speed, 16, above=2.0)
    monkeypatch.setattr(eigenmodes, "_DENSE", model.size)
    dense = whirl_modes(model, speed, 16, above=2.0)
    assert dense.frequency == pytest.approx(sparse.frequency, rel=1e-6)
    assert dense.direction == pytest.approx(sparse.direction, abs=1e-6)


def test_elastic_whirl_splits_with_speed():
    model = assemble(load_train("small"))
    still, turning = campbell(model, [0.0, 300.0], 6, above=30.0)
    at_rest = still.frequency[0::2]
    assert still.frequency[1::2] == pytest.approx(at_rest, rel=1e-7)
    assert np.all(turning.frequency[turning.direction < 0] < at_rest)
    assert np.all(turning.frequency[turning.direction > 0] > at_rest)


def test_rayleigh_damping_of_free_modes():
    """With D = alpha M + beta K and no rotation, zeta = alpha / (2 w) + beta w / 2."""
    train = load_train("small")
    modes = whirl_modes(assemble(train), 0.0, 6, above=5.0)
    natural = np.abs(modes.eigenvalues)
    expected = train.rayleigh_alpha / (2.0 * natural) + train.rayleigh_beta * natural / 2.0
    assert modes.damping_ratio == pytest.approx(expected, rel=1e-6)


def test_the_share_of_the_shaft_is_that_of_its_strain_energy():
    """A disc on a massless shaft on springs: the deflection of two springs in series."""
    E, length, diameter, mass = 2e11, 1.0, 0.05, 50.0
    shaft = uniform_shaft(length, diameter, 2, Material("light", E, 0.3, 1e-6))
    train = Train("disc", 1.0, 0.0, 0.0, 0.0, shaft.shoulders, (Wheel("d", 1, mass, 0.0, 1e-6),),
                  with_bearings(shaft, 0, 2).bearings)  # fmt: skip
    bending = E * math.pi * diameter**4 / 64.0
    shear = 6.0 * 1.3 / 8.8 * E / 2.6 * math.pi * diameter**2 / 4.0
    flexible = length**3 / (48.0 * bending) + length / (4.0 * shear)
    for spring in (1e5, 1e6, 1e8):
        modes = whirl_modes(assemble(train), 0.0, 2, bearings=springs(spring, spring))
        assert modes.bending == pytest.approx([flexible / (flexible + 0.5 / spring)] * 2, rel=1e-5)
    assert whirl_modes(assemble(train), 0.0, 2).bending == pytest.approx(1.0)
