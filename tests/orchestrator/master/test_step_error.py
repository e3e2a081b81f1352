"""The estimate of what the length of a step does, against motions that are known."""

import numpy as np
import pytest

from orchestrator.master.step_error import PASSED, error_of_step

STEP, RATE = 1e-3, 2e9
K = np.diag([2e8, 0.0, 0.0, 0.0])
C = np.diag([3e5, 0.0, 0.0, 0.0])


def estimate(motion, step):
    """Estimate over a step from 0 of a journal that moves as x, x' in x, against a linear film."""
    ends = [np.zeros((1, 8)) for _ in range(2)]
    for end, time in zip(ends, (0.0, step), strict=True):
        end[0, 0], end[0, 4] = motion(time)
    return error_of_step(*ends, np.array([[K, C]]), step)[0]


def test_a_cubic_motion_gives_the_mean_of_what_the_straight_wrench_misses():
    """By integration over the step: F(x(t)) of a linear film less the line between its ends."""
    a, b, c = 3.0, -4e3, 7e6

    def motion(t):
        return a * t + b * t**2 + c * t**3, a + 2 * b * t + 3 * c * t**2

    time = np.linspace(0.0, STEP, 20001)
    x, v = motion(time)
    wrench = -K[0, 0] * x - C[0, 0] * v
    line = wrench[0] + (wrench[-1] - wrench[0]) * time / STEP
    at_middle = (wrench - line)[10000]
    assert estimate(motion, STEP)[0] == pytest.approx(PASSED * 2.0 / 3.0 * at_middle, rel=1e-9)
    # The damper's part of a cubic motion is a parabola, whose mean is two thirds of its middle.
    damper = -C[0, 0] * (v - (v[0] + (v[-1] - v[0]) * time / STEP))
    assert float(np.mean(damper[:-1])) == pytest.approx(2.0 / 3.0 * damper[10000], rel=1e-6)


def test_it_is_of_second_order_where_the_motion_is_smooth():
    found = [
        estimate(lambda t: (np.sin(300 * t + 0.3), 300 * np.cos(300 * t + 0.3)), h)[0] for h in (1e-4, 5e-5)
    ]
    assert found[0] / found[1] == pytest.approx(4.0, rel=0.05)


def test_a_vibration_that_the_steps_alias_is_seen():
    """At whole periods in a step the ends are alike, at rest: only position against velocity tells."""
    turn = 2.0 * np.pi * 1.25 / STEP
    swing = estimate(lambda t: (np.sin(turn * t), turn * np.cos(turn * t)), STEP)[0]
    assert abs(swing) > 0.1 * PASSED * C[0, 0] * turn


def test_no_motion_no_error():
    assert not estimate(lambda t: (1e-5, 0.0), STEP).any()
    assert not estimate(lambda t: (2.0 * t, 2.0), STEP).any()
