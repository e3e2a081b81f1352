"""Loops over the bearings, compiled and as they stand, against the same by numpy."""

import numpy as np
import pytest

from orchestrator.master import interface, step_error
from orchestrator.master.step_error import PASSED, error_of_step
from orchestrator.master.system import RESPONSE, law_wrenches
from orchestrator.observers import extremes
from orchestrator.observers.extremes import EXTREMES, Noted, extremes_of

N = 3
LOOPS = {
    interface: ("largest_relative", "defects", "within"),
    step_error: ("_missed",),
    extremes: ("_take", "_note"),
}


@pytest.fixture(autouse=True, params=["compiled", "as it stands"])
def way(request, monkeypatch):
    if request.param == "as it stands":
        for module, names in LOOPS.items():
            for name in names:
                monkeypatch.setattr(module, name, getattr(module, name).py_func)


@pytest.fixture
def rng():
    return np.random.default_rng(7)


def test_a_defect_is_what_the_law_has_missed(rng):
    laws, motion, forces = (rng.normal(size=(N, width)) for width in (36, 8, 4))
    defect = np.full((N, 4), np.nan)
    interface.defects(laws, motion, forces, defect)
    np.testing.assert_allclose(defect, forces - law_wrenches(laws, motion), rtol=1e-12)


def test_the_largest_component_counts_against_load_or_force():
    defect, forces = np.zeros((N, 4)), np.array([[3.0, 4.0], [0.0, 0.0], [0.0, 0.0]])
    loads, levers = np.full(N, 2.0), np.array([1.0, 1.0, 0.25])
    for at, size in (
        ((0, 0), 0.2),
        ((1, 1), 0.5),
        ((2, 3), 2.0),
    ):  # against 5, 2, and 2 on a lever of a quarter
        defect[at] = -1.0
        assert interface.largest_relative(defect, forces, loads, levers) == pytest.approx(size)
    defect[0, 2] = np.nan
    assert np.isnan(interface.largest_relative(defect, forces, loads, levers))


@pytest.mark.parametrize("bad", [2.0, -2.0, np.nan, np.inf])
def test_values_within_a_bound(bad):
    values = np.ones((N, 8))
    assert interface.within(values, 2.0)
    values[1, 3] = bad
    assert not interface.within(values, 2.0)


def test_the_error_of_a_length_is_the_middle_of_a_cubic_in_the_tangent(rng):
    start, turned, tangent, H = (
        rng.normal(size=(N, 8)),
        rng.normal(size=(N, 4)),
        rng.normal(size=(N, 2, 4, 4)),
        0.1,
    )
    v0, v1 = start[:, 4:], start[:, 4:] + turned
    q1 = start[:, :4] + H * (rng.normal(size=(N, 4)) + v0)
    q = H * (v0 - v1) / 8.0
    v = 1.5 * (q1 - start[:, :4] - 0.5 * H * (v0 + v1)) / H
    missed = np.einsum("bij,bj->bi", tangent[:, 0], q) + np.einsum("bij,bj->bi", tangent[:, 1], v)
    found = error_of_step(start, np.hstack([q1, v1]), tangent, H)
    np.testing.assert_allclose(found, -2.0 / 3.0 * PASSED * missed, rtol=1e-9)


def test_extremes_are_the_least_gaps_and_the_largest_of_all_else_with_their_instants(rng):
    steps = rng.normal(size=(4, N, len(RESPONSE)))
    defects, lengths = rng.normal(size=(2, 4, N, 4))
    evaluated = rng.random((4, N)) < 0.7
    noted = Noted(N)
    for k, step in enumerate(steps):
        noted.note(float(k), step, defects[k], lengths[k], evaluated[k])
    outputs = ("h_min", "h_min_centre", "contact_force", "contact_pressure", "wiped")
    told = [steps[..., RESPONSE[name]] * (-1.0 if name.startswith("h_") else 1.0) for name in outputs]
    sizes = [
        np.hypot(*pair.T).T for pair in (steps[..., :2], steps[..., 2:4], defects[..., :2], lengths[..., :2])
    ]
    every = np.stack([*sizes[:2], *told, *sizes[2:]], axis=-1)
    every[..., :-1][~evaluated] = -np.inf
    np.testing.assert_array_equal(noted.peaks, every.max(axis=0))
    np.testing.assert_array_equal(noted.since, noted.peaks)
    known = noted.peaks > -np.inf
    np.testing.assert_array_equal(noted.times[known], every.argmax(axis=0)[known])
    gap = EXTREMES.index("least_gap")
    np.testing.assert_array_equal(extremes_of(steps[0])[:, :7], np.stack([*sizes[:2], *told], axis=-1)[0])
    noted.since[:] = -np.inf
    noted.note(9.0, np.full_like(steps[0], np.nan))
    assert np.isnan(noted.since[:, gap]).all() and not np.isnan(noted.peaks).any()
