"""The edge of a soft layer: limits of its flow, the equation it stands for, and exact derivatives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from bearing_fmu.contact.edge import edge_back, edge_flow, edge_pressure, edge_table
from bearing_fmu.contact.layer import deflection, layer_table, rough_flow
from bearing_fmu.kernels.compiled import kernel
from tests.bearing_fmu.bearings import TURBINE

LAYER = replace(TURBINE, layer_thickness=5e-3)
FALLS = [(6.4, 1.5, 2.5), (5.0, -2.0, 4.0), (40.0, 20.0, 15.0), (4.0, 3.98, 0.015), (3.0, 3.3, 0.2)]

pytestmark = pytest.mark.slow  # compiles for some ten seconds


@kernel
def _evaluate(inside, end, press, table, out):
    out[0:4] = edge_flow(inside, end, press, table)
    out[4:8] = edge_back(inside, end, press, table)
    out[8:11] = edge_pressure(inside, end, table)


def evaluate(inside, end, press):
    out = np.empty(11)
    _evaluate(inside, end, press, edge_table(LAYER), out)
    return out


def fields(s):
    """Flow, and how far asperities press back."""
    first, table = layer_table(LAYER)
    back = np.array([deflection.py_func(x, first, table)[0] for x in s])
    return np.array([rough_flow.py_func(x + b)[0] for x, b in zip(s, back, strict=True)]), back


@pytest.mark.parametrize("fall", FALLS)
def test_derivatives(fall):
    found, step = evaluate(*fall), 1e-6
    for k in range(3):
        ends = [evaluate(*(np.array(fall) + d * np.eye(3)[k])) for d in (step, -step)]
        log = np.log(ends[0][0] / ends[1][0]) / (2.0 * step)
        assert found[1 + k] == pytest.approx(log, rel=1e-5, abs=1e-7)
        assert found[5 + k] == pytest.approx((ends[0][4] - ends[1][4]) / (2.0 * step), rel=1e-4, abs=1e-7)
        if k < 2:
            assert found[9 + k] == pytest.approx((ends[0][8] - ends[1][8]) / (2.0 * step), rel=1e-4, abs=1e-7)


def test_limits_of_the_flow():
    """The mean where the film makes the whole fall, the harmonic one where it makes none."""
    s = np.linspace(1.5, 6.4, 4001)
    flow, _ = fields(s)
    assert evaluate(6.4, 1.5, 4.9 + 20.0)[0] == pytest.approx(flow.mean(), rel=2e-3)
    assert evaluate(6.4, 1.5, 0.0)[0] == pytest.approx(1.0 / np.mean(1.0 / flow), rel=2e-3)


@pytest.mark.parametrize("share", [0.5, 0.7, 0.9])
def test_the_power_is_near_the_solution(share):
    """Of 1 = int ds / (G + k / K): k by bisection."""
    s = np.linspace(1.5, 6.4, 4001)
    (flow, back), fall = fields(s), 4.9
    rigid, press = (1.0 - share) * fall, share * fall
    low, high = 0.0, 3.0 * press * flow.max()
    for _ in range(80):
        middle = 0.5 * (low + high)
        filled = np.trapezoid(flow / (rigid * flow + middle), s) > 1.0
        low, high = (middle, high) if filled else (low, middle)
    found = evaluate(6.4, 1.5, press)
    assert found[0] == pytest.approx(low / press, rel=0.12)
    assert found[4] == pytest.approx(np.trapezoid(back * flow / (rigid * flow + low), s), rel=0.2)
