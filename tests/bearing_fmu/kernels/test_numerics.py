"""The building blocks: axial basis, ring solver, cut integral."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_fmu.kernels.axial import axial_basis, gauss_lobatto
from bearing_fmu.kernels.cyclic_solver import factorise, substitute
from bearing_fmu.kernels.guembel import bearing_part
from bearing_fmu.kernels.vector import padded


@pytest.mark.parametrize("count", [4, 7, 10])
def test_gauss_lobatto_is_exact_to_its_degree(count):
    x, w = gauss_lobatto(count)
    for degree in range(2 * count - 2):
        assert w @ x**degree == pytest.approx(2.0 / (degree + 1) if degree % 2 == 0 else 0.0, abs=1e-13)


@pytest.mark.parametrize("rows", [3, 8, 13])
def test_axial_basis_differentiates_its_polynomials(rows):
    basis = axial_basis(rows)
    t = np.arctanh(basis.nodes * np.tanh(basis.clustering)) / basis.clustering
    values, slopes = (1 - t**2) * t**2, 2 * t - 4 * t**3
    np.testing.assert_allclose(basis.slopes @ values[:rows], slopes, atol=1e-11)
    z = np.linspace(-1, 1, 11)
    tz = np.arctanh(z * np.tanh(basis.clustering)) / basis.clustering
    np.testing.assert_allclose(basis.interpolation(z) @ values[:rows], (1 - tz**2) * tz**2, atol=1e-12)
    assert basis.weights.sum() == pytest.approx(2.0, rel=1e-14)


@pytest.mark.parametrize("columns, n, sides", [(48, 8, 1), (17, 5, 2), (20, 11, 4)])
def test_ring_solver_against_dense_solution(columns, n, sides):
    rng = np.random.default_rng(3)
    width = padded(n)
    b, c = np.zeros((columns, n, width)), np.zeros((columns, width))
    c[:, :n] = rng.uniform(0.1, 2.0, (columns, n)) * 10.0 ** rng.uniform(-4, 0, (columns, 1))
    for i in range(columns):
        g = rng.normal(size=(n, n))
        b[i, :, :n] = 0.1 * g @ g.T + np.diag(c[i, :n] + c[i - 1, :n])
    dense = np.zeros((columns, n, columns, n))
    for i in range(columns):
        k = (i + 1) % columns
        dense[i, :, i, :] += b[i, :, :n]
        dense[i, :, k, :] -= np.diag(c[i, :n])
        dense[k, :, i, :] -= np.diag(c[i, :n])
    right = np.zeros((columns, sides, width))
    right[:, :, :n] = rng.normal(size=(columns, sides, n))
    expected = np.linalg.solve(
        dense.reshape(columns * n, -1), right[:, :, :n].swapaxes(1, 2).reshape(columns * n, sides)
    )
    flat, w, wt = b.ravel().copy(), np.zeros(b.size), np.zeros(b.size)
    assert factorise(flat, c.ravel(), w, wt, np.zeros(n * width), np.zeros(8 * width), columns, n, width)
    x = right.ravel().copy()
    substitute(flat, c.ravel(), w, wt, x, np.zeros(sides * width), columns, n, width, sides)
    result = x.reshape(columns, sides, width)[:, :, :n].swapaxes(1, 2).reshape(columns * n, sides)
    np.testing.assert_allclose(result, expected, atol=1e-12 * np.abs(expected).max())


def test_indefinite_system_is_refused():
    columns, n, width = 16, 8, 8
    b = np.tile(-np.eye(n), (columns, 1)).ravel().copy()
    c, w = np.ones(columns * width), np.zeros(b.size)
    assert not factorise(b, c, w, w.copy(), np.zeros(n * width), np.zeros(width), columns, n, width)


def cut(p):
    parts = np.zeros((4, p.size))
    bearing_part(p, p.size, *parts)
    return parts


def test_cut_integral_of_a_cosine():
    """The positive part of cos has the integral 2; the error falls with the fourth power of the cell.

    The trapezoidal rule is exact to high order away from the zeros, and the zeros of a sine are straight.
    """
    errors = []
    for count in (20, 40, 80):
        t = 2 * np.pi * np.arange(count) / count + 0.123
        errors.append(abs(cut(np.cos(t))[0].sum() * 2 * np.pi / count - 2.0))
    assert errors[0] < 0.02
    assert errors[0] / errors[2] > 10.0


def test_cut_derivatives_and_their_continuity():
    rng = np.random.default_rng(2)
    p, w = rng.normal(size=24), rng.normal(size=24)
    _, own, ahead, behind = cut(p)
    gradient = w * own + np.roll(w, -1) * behind + np.roll(w * ahead, 1)
    for k in range(p.size):
        d = 1e-7 * np.eye(p.size)[k]
        difference = w @ (cut(p + d)[0] - cut(p - d)[0]) / 2e-7
        assert gradient[k] == pytest.approx(difference, abs=1e-7)
    gradients = []
    for tiny in (-1e-9, 1e-9):
        p[5] = tiny
        _, own, ahead, behind = cut(p)
        gradients.append(w * own + np.roll(w, -1) * behind + np.roll(w * ahead, 1))
    np.testing.assert_allclose(*gradients, atol=1e-7)


def test_cut_leaves_positive_pressure_alone():
    p = 2.0 + np.cos(np.arange(30.0))
    np.testing.assert_allclose(cut(p)[0], p, rtol=1e-15)
    assert np.all(cut(-p)[0] == 0.0)
