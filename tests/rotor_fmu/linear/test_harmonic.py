"""Unbalance and static response on linear bearings, and the report of a reduction's errors."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rotor_fmu.linear.harmonic import static_response, unbalance_response
from rotor_fmu.linear.reduction_report import reduction_report
from rotor_fmu.linear.resonance import refined
from rotor_fmu.linear.whirl import half_axes, whirl_modes
from rotor_fmu.reduction.reduce import reduce
from rotor_fmu.shaft.matrices import assemble
from rotor_fmu.train.file import load_train
from rotor_fmu.train.train import Material, Wheel
from tests.rotor_fmu.published_rotors import friswell, springs, uniform_shaft, with_bearings

GRAVITY = 9.80665


def test_jeffcott_rotor():
    """A disc in the middle of a light shaft: r = U w^2 / (k - m w^2 + i c w), circular and forward."""
    mass, diameter, length, stiffness, damping = 50.0, 0.06, 1.0, 3e6, 800.0
    shaft = uniform_shaft(length, diameter, 2, Material("light", 2.1e11, 0.3, 1e-6))
    train = replace(with_bearings(shaft, 0, 2), wheels=(Wheel("disc", 1, mass, 0.6, 0.3),))
    bearings = springs(stiffness, stiffness, damping, damping)
    speed, unbalance, phase = 180.0, 0.01, 0.7
    response = unbalance_response(assemble(train), speed, bearings, [unbalance * np.exp(1j * phase)])

    section = shaft.shoulders[0]
    bending = 2.1e11 * section.second_moment
    shear = 6.0 * 1.3 / (7.0 + 1.8) * section.material.shear_modulus * section.area
    flexibility = length**3 / (48.0 * bending) + length / (4.0 * shear)
    support = 2.0 * (stiffness + 1j * speed * damping)
    dynamic = 1.0 / (flexibility + 1.0 / support)
    x = unbalance * np.exp(1j * phase) * speed**2 / (dynamic - mass * speed**2)
    assert response.shape[4:6] == pytest.approx([x, -1j * x], rel=1e-7)
    force = -(unbalance * np.exp(1j * phase) + mass * x) * speed**2 / 2.0
    assert response.wrench[:, 0] == pytest.approx([force, force], rel=1e-7)


def test_reaction_of_the_weight_on_one_plane():
    train = friswell()
    bearings = springs(1e6, 2e6)
    _, wrench = static_response(assemble(train), bearings)
    light, heavy = 32.58973, 51.52526
    shaft = train.mass - light - heavy
    front = GRAVITY * (shaft / 2.0 + light * 2.0 / 3.0 + heavy / 3.0)
    rear = GRAVITY * (shaft / 2.0 + light / 3.0 + heavy * 2.0 / 3.0)
    assert wrench[:, 1] == pytest.approx([front, rear], rel=1e-9)
    assert wrench[:, 0] == pytest.approx([0.0, 0.0], abs=1e-6)


@pytest.fixture(scope="module")
def reports():
    """Of the turbine on bearings of equal stiffness and damping, at its speed."""
    train = load_train("turbine")
    model = assemble(train)
    bearings = springs(2e9, 4e9, 5e6, 1e7, count=11)
    phases = np.array([w.unbalance_phase for w in train.wheels])
    unbalance = np.array(train.nominal_unbalance) * np.exp(1j * phases)
    speeds = [50.0 * math.pi]
    return {
        method: reduction_report(model, reduce(model, method), bearings, speeds, unbalance, count=12)
        for method in ("irs", "irs-plain")
    }


def test_report_of_the_default(reports):
    report = reports["irs"]
    assert report.static.worst < 1e-9
    assert report.free.worst < 1e-6
    assert report.supported.worst < 1e-3
    assert report.unbalance.worst < 2e-3


def test_report_shows_what_plain_irs_loses(reports):
    """Near exact while free, well behind where bearings hold the shaft."""
    plain, default = reports["irs-plain"], reports["irs"]
    assert plain.free.worst < 2e-4
    assert plain.static.worst > 1e-3
    assert plain.unbalance.worst > 4.0 * default.unbalance.worst
    assert plain.supported.worst > 10.0 * default.supported.worst


def test_report_of_no_reduction_has_no_error():
    train = load_train("small")
    model = assemble(train)
    unbalance = np.array(train.nominal_unbalance)
    report = reduction_report(
        model, reduce(model, "none"), springs(1e8, 2e8, 1e5, 1e5), [100.0, 314.0], unbalance, count=8
    )
    for pair in (report.free, report.supported, report.static, report.unbalance):
        assert pair.worst < 1e-6


def test_report_as_text(reports):
    lines = str(reports["irs"]).splitlines()
    assert lines[0].startswith("irs, 220 degrees of freedom, ")
    assert lines[1].startswith("static bearing forces: ")
    assert len(lines) == 4


def test_a_sharp_resonance_is_found_between_speeds_of_a_grid():
    """The small shaft, undamped, on light bearings, for which 7456 um at 23.038 Hz are given.

    The bearings themselves are not: stiffness and damping are the round numbers that give about these.
    What stands for itself is that no speed nearby gives more, and the grid alone gives far less.
    """
    train = replace(load_train("small"), rayleigh_alpha=0.0, rayleigh_beta=0.0)
    shaft, bearings = assemble(train), springs(5e8, 5e8, 2e4, 2e4)
    unbalance = train.nominal_unbalance * np.exp(1j * np.array([w.unbalance_phase for w in train.wheels]))

    def amplitude(speed):
        shape = unbalance_response(shaft, speed, bearings, unbalance).shape.reshape(-1, 4)
        return float(half_axes(shape[:, 0], shape[:, 1])[0].max())

    grid = 2.0 * math.pi * np.arange(20.0, 26.0, 0.25)
    modes = whirl_modes(shaft, 2.0 * math.pi * 23.0, 2, bearings=bearings)
    poles = list(zip(modes.frequency, modes.damping_ratio, strict=True))
    found = refined(amplitude, grid, poles)
    height = [amplitude(speed) for speed in found]
    best = int(np.argmax(height))
    assert max(map(amplitude, grid)) < 3e-3
    assert height[best] == pytest.approx(7456e-6, rel=5e-3)
    assert found[best] / (2.0 * math.pi) == pytest.approx(23.038, abs=2e-3)
    close = np.linspace(0.9999, 1.0001, 201) * found[best]
    assert max(map(amplitude, close)) <= height[best] * (1.0 + 1e-12)


def test_speeds_that_differ_by_rounding_make_no_peak():
    """A response that rises, with noise of its last digits, at a speed that is twice in the grid."""
    speed = 2.0 * math.pi * 30.0
    twin = math.nextafter(speed, 0.0)
    assert twin != speed
    found = refined(lambda at: at * (1.0 + 1e-15 * (at == twin)), [100.0, twin, speed, 300.0], [(speed, 0.0)])
    assert np.diff(found).min() > 1e-10 * speed
    values = np.array([at * (1.0 + 1e-15 * (at == twin)) for at in found])
    assert np.all(np.diff(values) > 0.0)


def test_peaks_of_every_probe_are_found():
    """Of 1 / (1 + ((w - w0) / d)^2) at two places with resonances apart, broad beside the grid."""
    places, width = np.array([123.4, 231.7]), 5.0
    found = refined(lambda at: 1.0 / (1.0 + ((at - places) / width) ** 2), np.linspace(50.0, 300.0, 60), [])
    for place in places:
        assert np.abs(found - place).min() < 1e-3 * width
