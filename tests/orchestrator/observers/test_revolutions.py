"""Orders and extremes of each revolution, of motions whose parts are known."""

import numpy as np
import pytest

from orchestrator.master.system import RESPONSE
from orchestrator.observers.revolutions import Revolutions


class Machine:
    """One bearing that moves with given amplitudes of half, whole and double order about a place."""

    def __init__(self):
        self.bearings = ["front"]
        self.motion, self.forces = np.zeros((1, 8)), np.zeros((1, 4))
        self.responses, self.speed, self.angle = np.zeros((1, len(RESPONSE))), 100.0, 0.0

    def move(self, step, speed):
        self.angle += step * speed
        self.speed = speed
        x = 0.3 + np.real(sum(A * np.exp(1j * k * self.angle) for k, A in AMPLITUDES.items()))
        self.motion[0, :2] = x, 2.0 * x
        self.responses[0, RESPONSE["h_min"]] = 1.0 - x
        self.forces[0, 0] = 5.0 * x


STEP = 2.0 * np.pi / 100.0 / 200.7  # no whole number of them in a turn
AMPLITUDES = {0.5: 0.1j, 1.0: 0.4 - 0.2j, 2.0: -0.05 + 0.02j}


def driven(machine, kept, steps, first=0):
    for k in range(first, first + steps):
        machine.move(STEP, 100.0 - 0.005 * k)
        kept.watch(k * STEP, (k + 1) * STEP, None)


def test_orders_and_extremes_of_a_motion_that_is_known_at_falling_speed():
    machine = Machine()
    machine.move(0.0, 100.0)
    kept = Revolutions(machine)
    kept.begin(None)
    driven(machine, kept, 3000)
    assert kept.rows.held == int(machine.angle / (2.0 * np.pi))
    found = kept.amplitudes[1:, :, 0]
    for index, (order, amplitude) in enumerate(AMPLITUDES.items()):
        turned = np.exp(2j * np.pi * order * np.arange(1, kept.rows.held))  # angles count within a revolution
        np.testing.assert_allclose(found[:, index, 0] / turned, amplitude, atol=2e-3, err_msg=str(order))
        np.testing.assert_allclose(found[:, index, 1], 2.0 * found[:, index, 0], rtol=1e-9)
    assert np.isnan(kept.amplitudes[0, 0]).all()
    middles = 0.5 * (kept.times[1:] + kept.times[:-1]) / STEP
    np.testing.assert_allclose(kept.speeds[1:], 100.0 - 0.005 * middles, rtol=1e-4)
    largest = kept.extreme("force")[2, 0] / 5.0
    assert kept.extreme("least_gap")[2, 0] == pytest.approx(1.0 - largest, rel=1e-12)
    assert 0.0 < largest - 0.3 < sum(map(abs, AMPLITUDES.values()))
    assert kept.overall[2, 0, 1] == pytest.approx(2.0 * kept.overall[2, 0, 0], rel=1e-9)


def test_a_step_may_hold_several_turns():
    machine = Machine()
    kept = Revolutions(machine)
    kept.begin(None)
    machine.move(0.05, 100.0)  # 0.8 turns, then 2.4 more
    kept.watch(0.0, 0.05, None)
    machine.move(0.15, 100.0)
    kept.watch(0.05, 0.2, None)
    np.testing.assert_allclose(kept.times, 2.0 * np.pi / 100.0 * np.arange(1, 4), rtol=1e-12)
    np.testing.assert_allclose(kept.speeds, 100.0, rtol=1e-12)


def test_it_goes_on_where_it_was_saved():
    one, other = Machine(), Machine()
    for machine in (one, other):
        machine.move(0.0, 100.0)
    whole, first, second = Revolutions(one), Revolutions(other), Revolutions(other)
    whole.begin(None)
    first.begin(None)
    driven(one, whole, 900)
    driven(other, first, 300)
    second.restore({name: values.copy() for name, values in first.arrays().items()})
    driven(other, second, 600, first=300)
    for name, values in whole.arrays().items():
        np.testing.assert_array_equal(values, second.arrays()[name], err_msg=name)
