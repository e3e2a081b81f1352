"""The largest pressure, between the nodes and close to an end, at the default grid."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_fmu.film import make_film
from bearing_fmu.kernels.compiled import kernel
from bearing_fmu.kernels.summit import crest
from tests.bearing_fmu.bearings import plain, respond
from tests.bearing_fmu.films.independent_peak import independent_peak
from tests.benchmarks.corners import survey
from tests.published import published

FINE = (192, 24)


@kernel
def _crest(five):
    return crest(five)


@pytest.mark.parametrize("shift", [-0.5, -0.2, 0.0, 0.37])
def test_crest_of_a_polynomial(shift):
    at = np.arange(-2.0, 3.0) - shift
    assert _crest(3.0 - at**2 + 0.1 * at**3 - 0.02 * at**4) == pytest.approx(3.0, abs=4e-3)
    assert _crest(np.full(5, 2.0)) == 2.0


def error(depth, aspect, q, v):
    coarse, fine = (
        respond(make_film(depth, plain(aspect, columns=columns, rows=rows)), q, v).p_max
        for columns, rows in ((48, 8), FINE)
    )
    return abs(coarse / fine - 1.0)


@pytest.mark.parametrize(
    "aspect, q",
    [
        (1.0, (0.6, 0.0, 0.0, 0.38)),  # M1 of the reference table
        (1.0, (0.417, -0.442, 0.208, 0.329)),  # 15 % off by eight rows
        (0.8, (-0.192, -0.432, -0.308, 0.466)),  # 14 %
    ],
)
@published("peaks of misaligned journals", "independent finite volumes", "largest pressure 1 % at 48 x 8")
def test_peak_by_an_independent_solution(aspect, q):
    exact = independent_peak(aspect, np.array(q), 240, 160)
    assert 1e3**2 * 0.25 * exact == pytest.approx(respond(make_film("v1", plain(aspect)), q).p_max, rel=0.01)


@published(
    "misaligned journals with squeeze, least gaps of 1 to 10 % of the clearance",
    "two doublings of the grid",
    "largest pressure 2 % at 48 x 8",
)
def test_peaks_of_random_misaligned_journals():
    errors = [error("v1", aspect, q, v) for aspect, _, q, v in survey(60)]
    assert np.median(errors) < 0.004
    assert max(errors) < 0.02


def test_peaks_of_random_aligned_journals():
    """With a third of the rotor's speed across: part of the peaks lies beside the middle."""
    random, errors = np.random.default_rng(3), []
    for _ in range(40):
        least, way, e_way = random.choice([0.02, 0.05, 0.1, 0.3]), *random.uniform(0.0, 6.3, 2)
        q = (1.0 - least) * np.array([np.cos(way), np.sin(way), 0.0, 0.0])
        v = random.uniform(0.0, 0.5) * np.array([np.cos(e_way), np.sin(e_way), 0.0, 0.0])
        errors.append(error("v2", random.choice([0.5, 0.8, 1.0]), q, v))
    assert np.median(errors) < 0.006
    assert max(errors) < 0.02


def test_peak_is_continuous_where_grids_take_over():
    film = make_film("v1", plain(0.8))
    for start, end in (((0.5, 0, 0, 0.2), (0.5, 0, 0, 0.47)), ((0.8, 0.1, 0.0, 0.02), (0.93, 0.1, 0, 0.02))):
        for v in ((0.0, 0.0, 0.0, 0.0), (-0.2, 0.3, 0.0, 0.0)):
            way = np.linspace(start, end, 2000)
            peaks = np.array([respond(film, q, v).p_max for q in way])
            assert np.abs(np.diff(np.log(peaks))).max() < 0.02
