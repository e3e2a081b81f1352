"""Where tilting pads stand and move is state of their FMU: taken on, taken back and read, to the bit."""

import math

import pytest

from fmus import port
from fmus.port.bore import tilting, to_text
from tests.fmus.orbit import INPUTS, STEP, Orbit
from tests.marks import slow

OUTPUTS = [v.name for v in (*port.BEARING_OUTPUTS, *port.BEARING_DETAILS)]
FIVE = tilting(5, math.radians(62.0), 0.2, 0.55, 0.1, 1e-10)
BEARING = {"bore": to_text(FIVE), "film.columns": 40, "film.rows": 4}


ORBIT = Orbit((1e-4, -2e-4), OUTPUTS)
place, go = ORBIT.place, ORBIT.go


@pytest.mark.parametrize("depth", ["v2", slow("v1")])
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
