"""Where tilting pads stand and move is state of their FMU: taken on, taken back and read, to the bit."""

import math

import numpy as np
import pytest

from fmus import port
from fmus.port.bore import tilting, to_text

OUTPUTS = [v.name for v in (*port.BEARING_OUTPUTS, *port.BEARING_DETAILS)]
INPUTS = [v.name for v in port.BEARING_INPUTS]
STEP = 1e-4
FIVE = tilting(5, math.radians(62.0), 0.2, 0.55, 0.1, 1e-10)
BEARING = {"bore": to_text(FIVE), "film.columns": 40, "film.rows": 4}


def place(k: int) -> dict[str, float]:
    """Inputs of a journal on an orbit at step k, off the middle from the start on."""
    t, inputs = k * STEP, np.zeros(17)
    turn, swing = 300.0 * t, 1e-4
    inputs[:2] = 1e-4 + swing * np.cos(turn), -2e-4 + swing * np.sin(turn)
    inputs[4:6] = -300.0 * swing * np.sin(turn), 300.0 * swing * np.cos(turn)
    inputs[2], inputs[16] = 5e-5, 157.0
    return dict(zip(INPUTS, inputs, strict=True))


def go(unit, first: int, last: int) -> list[list[float]]:
    """Outputs of some steps."""
    found = []
    for k in range(first, last):
        unit.set(place(k + 1))
        assert unit.step(k * STEP, STEP), unit.said
        found.append(unit.get(*OUTPUTS))
    return found


@pytest.mark.parametrize("depth", ["v2", pytest.param("v1", marks=pytest.mark.slow)])
def test_pads_go_with_the_unit(hosts, depth):
    one, other = (hosts[f"bearing_{depth}.fmu"].open(name) for name in ("one", "other"))
    for unit in (one, other):
        unit.start(BEARING | place(0))
    go(one, 0, 12)
    at_12, handle = one.state(), one.keep()
    on = go(one, 12, 24)
    assert on[-1][OUTPUTS.index("pad_tilt[5]")] != 0.0
    other.restore(at_12)  # another instance, from bytes
    assert go(other, 12, 24) == on
    one.go_back(handle)
    one.set(place(20))
    assert one.step(12 * STEP, 8 * STEP)  # a step that was taken back leaves no trace, however far it went
    one.go_back(handle)
    assert go(one, 12, 24) == on
    assert one.serialise(handle) == at_12
    other.restore(at_12)
    other.set({**place(13), INPUTS[0]: math.nan})
    assert not other.step(12 * STEP, STEP)  # nor does one that fails
    assert go(other, 12, 24) == on
    for unit in (one, other):
        unit.slave.freeInstance()
