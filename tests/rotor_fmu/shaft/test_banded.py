"""Banded factors and lowest modes against dense algebra and closed forms."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg as sl
import scipy.sparse as sp

from rotor_fmu.shaft.banded import cholesky, lower_band, lowest_modes


def chain(n, ends=1.0):
    """Masses 1 and springs 1 between them, and of stiffness `ends` to the ground at both ends."""
    main = np.full(n, 2.0)
    main[[0, -1]] = 1.0 + ends
    stiffness = sp.diags_array([main, -np.ones(n - 1), -np.ones(n - 1)], offsets=[0, 1, -1], format="csr")
    return sp.csr_array(sp.eye_array(n)), stiffness


def banded(n=30, reach=4, seed=3):
    """Positive definite, of half band width `reach`."""
    rng = np.random.default_rng(seed)
    lower = np.tril(np.triu(rng.normal(size=(n, n)), -reach)) + 5.0 * np.eye(n)
    return lower @ lower.T


@pytest.mark.parametrize("form", [np.asarray, sp.csr_array])
def test_factor_is_choleskys(form):
    matrix = banded()
    factor = cholesky(form(matrix))
    vectors = np.random.default_rng(1).normal(size=(30, 3))
    assert factor.band.shape == (5, 30)
    root = np.linalg.cholesky(matrix)
    np.testing.assert_allclose(factor.solve(vectors), np.linalg.solve(matrix, vectors), rtol=1e-11)
    np.testing.assert_allclose(factor.root_times(vectors), root.T @ vectors, rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(factor.root_solve(vectors), np.linalg.solve(root.T, vectors), rtol=1e-11)


def test_band_is_as_narrow_as_the_matrix():
    assert lower_band(np.diag([1.0, 2.0])).tolist() == [[1.0, 2.0]]
    assert lower_band(np.array([[1.0, 3.0], [3.0, 2.0]])).tolist() == [[1.0, 2.0], [3.0, 0.0]]


@pytest.mark.parametrize("n", [5, 3000])
def test_a_matrix_that_rounding_alone_makes_definite_is_refused(n):
    _, free = chain(n, ends=0.0)
    with pytest.raises(np.linalg.LinAlgError):
        cholesky(free + 1e-16 * sp.eye_array(n))
    _, held = chain(n)
    assert cholesky(held).solve(held @ np.ones((n, 1))) == pytest.approx(1.0, rel=1e-8)


@pytest.mark.parametrize("n", [12, 2400])
def test_modes_of_a_chain(n):
    """Fixed ends: 2 sin(k pi / (2 n + 2)); free ends: 2 sin(k pi / (2 n)) from k = 0 on."""
    k = np.arange(1, 11)
    squares, shapes = lowest_modes(*chain(n), 10)
    assert np.sqrt(squares) == pytest.approx(2.0 * np.sin(k * np.pi / (2 * n + 2)), rel=1e-9)
    assert shapes.T @ shapes == pytest.approx(np.eye(10), abs=1e-9)
    squares, _ = lowest_modes(*chain(n, ends=0.0), 10, shift=1e-5)
    assert squares == pytest.approx(4.0 * np.sin((k - 1) * np.pi / (2 * n)) ** 2, rel=1e-8, abs=1e-12)


def test_all_modes_of_a_large_matrix():
    mass, stiffness = chain(900)
    squares, _ = lowest_modes(mass, stiffness, 900)
    np.testing.assert_allclose(squares, sl.eigvalsh(stiffness.toarray()), rtol=1e-8)
