"""The soft layer: asperities up to its hardness, and the oil's flow between them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from bearing_fmu.contact.asperities import asperity_integral
from bearing_fmu.contact.greenwood_tripp import slice_table
from bearing_fmu.contact.layer import bounded_pressure, deflection, layer_table, layered_pressure, rough_flow
from bearing_fmu.kernels.unsymmetric_solver import factorise_ring, ring_work, solve_ring
from bearing_fmu.kernels.vector import padded
from tests.bearing_fmu.bearings import TURBINE
from tests.faults import fault

LAYER = replace(TURBINE, layer_thickness=5e-3)


def test_compliance_is_that_of_a_bonded_layer():
    """White metal of 5 mm, 50 GPa, 0.35: 6 um under 100 MPa."""
    assert LAYER.layer_compliance * 100e6 == pytest.approx(6.23e-6, rel=1e-3)


def test_gap_balances_the_layer_against_the_asperities():
    s = np.linspace(-20.0, 6.9, 501)
    pressure = layered_pressure(LAYER, s)
    gap = s + LAYER.layer_compliance / LAYER.roughness * pressure
    expected = bounded_pressure(LAYER.contact_modulus * asperity_integral(2.5, gap), LAYER.layer_hardness)
    np.testing.assert_allclose(pressure, expected, atol=1e-6 * LAYER.layer_hardness)
    assert pressure.max() < LAYER.layer_hardness


def test_deflection_and_its_derivatives():
    first, table = layer_table(LAYER)
    step = 1e-5
    for s in (-8.03, -1.51, 0.02, 1.33, 3.17, 6.61):
        value, slope, bend = deflection.py_func(s, first, table)
        ahead, behind = (deflection.py_func(s + d, first, table) for d in (step, -step))
        assert value >= 0.0
        assert slope == pytest.approx((ahead[0] - behind[0]) / (2 * step), abs=1e-7)
        assert bend == pytest.approx((ahead[1] - behind[1]) / (2 * step), abs=1e-4)
    assert deflection.py_func(7.0, first, table) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(("u", "factor"), [(0.5, 0.3198), (1.0, 0.4859), (3.0, 0.8323), (6.0, 0.9687)])
def test_flow_factor_is_patir_and_chengs(u, factor):
    assert rough_flow.py_func(u)[0] == pytest.approx(factor * u**3, rel=2e-4)


def test_flow_falls_on_smoothly_below_the_published_range():
    step = 1e-6
    for u in (-1.0, 0.2, 0.5, 0.7, 4.0):
        flow, slope = rough_flow.py_func(u)
        ahead, behind = rough_flow.py_func(u + step)[0], rough_flow.py_func(u - step)[0]
        assert 0.0 < behind < flow < ahead
        assert slope == pytest.approx((ahead - behind) / (2 * step), rel=1e-5)


def test_a_yielding_slice_presses_less_than_a_rigid_one():
    """At an overlap of five roughnesses the rigid asperities press with gigapascals."""
    rigid, soft = slice_table(TURBINE), slice_table(LAYER)
    index = int((TURBINE.clearance + 5 * TURBINE.roughness - rigid.first) / rigid.step)
    assert soft.coefficients[index, 1, 0] < 0.1 * rigid.coefficients[index, 1, 0]


@pytest.mark.slow  # compiles for some ten seconds
@pytest.mark.parametrize("diagonal", [4.0, 0.0])
@pytest.mark.parametrize("n", [4, 5, 8, 10, 16])
def test_ring_of_unsymmetric_blocks(n, diagonal):
    """Also without anything on the diagonal, where pairs of pivots there do not serve.

    Columns are eliminated in turn, without pivots among them, which costs digits of such a matrix.
    """
    rng = np.random.default_rng(3)
    count, width, sides = 7, padded(n), 2
    blocks = rng.normal(size=(count, n, n)) * 0.3 + diagonal * np.eye(n)
    if diagonal == 0.0:
        blocks[:, range(n), range(n)] = 0.0
        blocks[:, ::2, 1::2] = blocks[:, 1::2, ::2] = 0.0
    lower, upper = rng.uniform(0.2, 1.0, size=(2, count, n))
    full = np.zeros((count, n, count, n))
    for i in range(count):
        k = (i + 1) % count
        full[i, :, i, :] += blocks[i]
        full[k, range(n), i, range(n)] -= lower[i]
        full[i, range(n), k, range(n)] -= upper[i]
    right = rng.normal(size=(count, sides, n))
    b, low, up, x = np.zeros((count, n, width)), *np.zeros((2, count, width)), np.zeros((count, sides, width))
    b[:, :, :n], low[:, :n], up[:, :n], x[:, :, :n] = blocks.transpose(0, 2, 1), lower, upper, right
    b, low, up, x = b.ravel(), low.ravel(), up.ravel(), x.ravel()
    w, y = np.zeros((2, count * n * width))
    work = ring_work(n)
    assert factorise_ring(b, low, up, w, y, work, count, n, width)
    solve_ring(b, low, up, w, y, x, work, count, n, width, sides)
    found = x.reshape(count, sides, width)[:, :, :n]
    for k in range(sides):
        expected = np.linalg.solve(full.reshape(count * n, -1), right[:, k].ravel())
        np.testing.assert_allclose(found[:, k].ravel(), expected, rtol=1e-11 if diagonal else 1e-8)


@fault(
    "film",
    "a soft layer where its film offers none",
    "one line with key, value and what is allowed",
    guard="bearing_fmu.parameters:BearingParameters._check_layer",
)
@pytest.mark.parametrize(
    "change",
    [{"layer_poisson": 0.5}, {"roughness": 0.0}, {"turbulence": "constantinescu"}, {"boundary": "reynolds"}],
)
def test_what_does_not_go_together(change):
    with pytest.raises(ValueError, match=r"bearing parameter layer_\w+ = .*: must be"):
        replace(LAYER, **change)
