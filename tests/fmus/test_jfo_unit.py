"""The memory of a mass-conserving film is state of its FMU: taken on, taken back and read, to the bit."""

import numpy as np
import pytest

from fmus import port
from orchestrator.fmi.file import FmuFile
from orchestrator.fmi.unit import Unit
from orchestrator.master.rollback import forgets
from tests.fmus.orbit import STEP, Orbit

OUTPUTS = [v.name for v in port.BEARING_OUTPUTS]
pytestmark = pytest.mark.slow  # the kernel compiles for a minute
BEARING = {
    "film.boundary": "jfo",
    "bore": "[[0.2, 2.94, 0, 0], [3.34, 6.08, 0, 0]]",
    "film.columns": 24,
    "film.rows": 4,
}


ORBIT = Orbit((2e-4, -4e-4), OUTPUTS)
place, go = ORBIT.place, ORBIT.go


@pytest.fixture
def units(hosts):
    opened = [hosts["bearing_v1.fmu"].open(name) for name in ("one", "other")]
    for unit in opened:
        unit.start(BEARING | place(0))
    yield opened
    for unit in opened:
        unit.slave.freeInstance()


def test_what_the_film_remembers_goes_with_the_unit(units):
    one, other = units
    go(one, 0, 20)
    at_20, handle = one.state(), one.keep()
    on = go(one, 20, 40)
    other.restore(at_20)  # another instance, from bytes
    assert go(other, 20, 40) == on
    one.go_back(handle)
    assert go(one, 20, 40) == on
    # a step that was taken back leaves no trace, however far it went
    one.go_back(handle)
    one.set(place(30))
    assert one.step(20 * STEP, 10 * STEP)
    one.go_back(handle)
    assert go(one, 20, 40) == on
    assert one.serialise(handle) == at_20


def test_it_is_no_trifle(units):
    """After another past the same state gives another force."""
    one, other = units
    go(one, 0, 40)
    one.set(place(0))
    other.set(place(0))
    assert one.step(40 * STEP, STEP)
    assert other.step(40 * STEP, STEP)
    force = [np.hypot(*unit.get("wrench.Fx", "wrench.Fy")) for unit in (one, other)]
    assert abs(force[0] / force[1] - 1.0) > 1e-3


@pytest.mark.parametrize(
    ("depth", "values", "forgotten"),
    [
        ("v1", {"film.boundary": "guembel"}, True),
        ("v1", {"film.boundary": "reynolds"}, True),
        ("v1", {"film.boundary": "jfo"}, False),
        ("v1", {"layer.thickness": 5e-3}, False),
        ("v3", {"layer.thickness": 5e-3}, True),  # stays rigid
        ("v3", {"film.temperature": "followed"}, False),
    ],
)
def test_the_master_marks_units_that_remember_only(built, tmp_path, depth, values, forgotten):
    file = FmuFile(built[f"bearing_{depth}.fmu"], tmp_path)
    unit = Unit(file, "bearing")
    unit.set_parameters(values)
    assert forgets(unit) is forgotten
    unit.close()
    file.end_library()
