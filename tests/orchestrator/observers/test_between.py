"""What bearings tell between two of their evaluations, against a film known in closed form."""

import numpy as np
import pytest

from orchestrator.master.system import RESPONSE
from orchestrator.observers.between import Between, Bores

CLEARANCE, WIDTH = 1e-3, 0.5
OFFSETS = np.array([[1e-5, -2e-5, 1e-5, 2e-5], [0.0, 0.0, 0.0, 0.0]])
ORBIT, SPEED = np.array([3e-4, 2e-4, 2e-4, -1e-4]), 150.0
NOTHING = np.zeros((2, 0))


def motion(time):
    """Both journals on an orbit, (2, 8)."""
    turn, phase = SPEED * time, np.array([0.0, 0.5, 1.0, 1.5])
    q, v = ORBIT * np.cos(turn + phase), -SPEED * ORBIT * np.sin(turn + phase)
    return np.tile(np.concatenate([q, v]), (2, 1)) + np.pad(OFFSETS, ((0, 0), (0, 4)))


def told(time, dent=0.0):
    """What bearings tell: a spring that stiffens, F = -a q - b q^3, and the gap of a round bore."""
    at = motion(time)
    q = at[:, :4]
    values = np.zeros((2, len(RESPONSE)))
    a, b = 1e9, 1e15
    values[:, :4] = -a * q - b * q**3
    stiffness = np.einsum("bi,ij->bij", a + 3.0 * b * q**2, np.eye(4))
    values[:, 4:8] = values[:, :4] + np.einsum("bij,bj->bi", stiffness, q)
    values[:, 8:24] = stiffness.reshape(2, 16)
    x, y, tilt_x, tilt_y = (q - OFFSETS).T
    ends = [np.hypot(x + s * 0.5 * WIDTH * tilt_y, y - s * 0.5 * WIDTH * tilt_x) for s in (-1.0, 1.0)]
    values[:, RESPONSE["h_min"]] = CLEARANCE - np.maximum(*ends) - dent
    values[:, RESPONSE["h_min_centre"]] = CLEARANCE - np.hypot(x, y)
    values[:, RESPONSE["eccentricity"]] = np.hypot(x, y) / CLEARANCE
    values[:, RESPONSE["p_max"]] = 1e6 * time
    return values


def passed_over(span, dent=0.0):
    """Records at an eighth, half, and seven eighths of an interval, filled in, and what they should be."""
    bores = Bores([CLEARANCE] * 2, [WIDTH] * 2, OFFSETS)
    between, both = Between(bores, len(RESPONSE)), np.ones(2, dtype=bool)
    between.kept(0, ~both, (told(0.0), NOTHING), motion(0.0))
    assert between.complete == 1
    times = span * np.array([0.125, 0.5, 0.875])
    for row in range(1, 4):
        between.kept(row, both, (told(0.0, dent), NOTHING), motion(0.0))
        assert between.complete == 1
    given = (told(span, dent), NOTHING), motion(span)
    assert not between.evaluated(both, span, 4, *given)
    bores.move(0, 1, 1.0)  # later

    def places(rows, bearing):
        return np.array([motion(times[row - 1])[b] for row, b in zip(rows, bearing, strict=True)])

    rows, bearing, found = between.fill(np.concatenate([[0.0], times]), places)
    assert sorted(zip(rows, bearing, strict=True)) == [(r, b) for r in (1, 2, 3) for b in (0, 1)]
    order = np.lexsort((bearing, rows))
    found, bearing, at = found[order], bearing[order], times[rows[order] - 1]
    assert (between.complete, between.filled) == (4, 6)
    assert between.fill(times, places) is None
    return found, np.array([told(t, dent)[b] for t, b in zip(at, bearing, strict=True)])


def test_wrenches_between_evaluations_are_right_to_third_order():
    error = []
    for span in (4e-4, 2e-4, 1e-4):
        found, exact = passed_over(span)
        error.append(np.abs(found[:, :4] - exact[:, :4]).max() / np.abs(exact[:, :4]).max())
    assert error[0] < 1e-4
    assert error[0] > 7.0 * error[1] > 49.0 * error[2]


@pytest.mark.parametrize("dent", [0.0, 2e-5], ids=["round", "a dent"])
def test_gaps_and_eccentricity_of_round_bores_are_those_of_the_motion(dent):
    found, exact = passed_over(2e-3, dent)
    for name in ("h_min", "h_min_centre", "eccentricity"):
        np.testing.assert_allclose(found[:, RESPONSE[name]], exact[:, RESPONSE[name]], rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(found[:, RESPONSE["p_max"]], exact[:, RESPONSE["p_max"]], rtol=1e-12)


def test_gaps_that_are_no_round_bore_s_run_straight():
    found, _ = passed_over(2e-3, dent=2e-4)
    first, last = told(0.0, 2e-4), told(2e-3, 2e-4)
    at = RESPONSE["h_min"]
    np.testing.assert_allclose(found[2:4, at], 0.5 * (first + last)[:, at], rtol=1e-12)


def test_what_is_held_goes_on_from_its_arrays():
    bores = Bores([CLEARANCE] * 2, [WIDTH] * 2, OFFSETS)
    between, first = Between(bores, len(RESPONSE)), np.array([True, False])
    between.kept(0, np.zeros(2, dtype=bool), (told(0.0), NOTHING), motion(0.0))
    between.kept(1, first, (told(1.0), NOTHING), motion(1.0))
    assert between.complete == 1
    other = Between(bores, len(RESPONSE))
    assert other.restore({f"between.{name}": x.copy() for name, x in between.arrays().items()}) == 1
    for name, values in between.arrays().items():
        np.testing.assert_array_equal(other.arrays()[name], values)


def test_a_bore_that_moves():
    """Gaps follow it, also behind a checkpoint."""
    bores = Bores([CLEARANCE], [0.0], np.zeros((1, 4)))
    between = Between(bores, len(RESPONSE))
    bores.move(0, 1, -2e-4)
    sunk = np.array([[0.0, -2e-4, 0.0, 0.0]])
    assert bores.gaps(np.array([0]), sunk, bores.offsets)[1] == pytest.approx([CLEARANCE])
    again = Bores([CLEARANCE], [0.0], np.zeros((1, 4)))
    Between(again, len(RESPONSE)).restore({f"between.{k}": x for k, x in between.arrays().items()})
    np.testing.assert_array_equal(again.offsets, bores.offsets)
