"""Cells along the axis: what is exact for polynomials."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_fmu.kernels.cells import NEAR, axial_cells


@pytest.mark.parametrize("rows", [NEAR, 9, 16])
def test_cubic_polynomials_are_exact_between_the_middles(rows):
    cells = axial_cells(rows, 2.0)
    middles = cells.nodes[:rows]
    z = np.linspace(middles[0], middles[-1], 31)
    for power in range(4):
        np.testing.assert_allclose(cells.interpolation(z) @ middles**power, z**power, atol=1e-12)
        if power:
            slope = cells.slopes()[1:rows] @ middles**power
            np.testing.assert_allclose(slope, power * cells.faces[1:rows] ** (power - 1), atol=1e-10)


def test_slopes_at_the_ends_fall_to_none():
    cells = axial_cells(8, 2.0)
    slopes = cells.slopes() @ np.full(8, 3.0)
    half = 1.0 - cells.nodes[7]
    np.testing.assert_allclose(slopes[[0, 8, 9]], [3.0 / half, -3.0 / half, 0.0])
    np.testing.assert_allclose(slopes[1:8], 0.0, atol=1e-10)


def test_integrals():
    """Of constants exactly; else what is beyond the last middles is taken as there."""
    cells = axial_cells(16, 2.0)
    weights, moments = cells.integrals()
    assert weights.sum() == pytest.approx(2.0, rel=1e-14)
    assert abs(moments.sum()) < 1e-14
    places, parts = cells.lines()
    assert parts.sum() == pytest.approx(cells.nodes[15] - cells.nodes[0], rel=1e-14)
    assert parts @ places**3 == pytest.approx(0.0, abs=1e-14)
    linear = 1.0 + 0.5 * cells.nodes[:16]
    assert weights @ linear == pytest.approx(2.0, rel=1e-12)
    np.testing.assert_allclose(cells.means(lambda z: z[:, None] ** 2).sum(axis=1) @ cells.weights[:16], 2 / 3)
