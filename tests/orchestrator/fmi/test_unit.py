"""One FMU instance: prepared blocks, statuses with their reasons, states, instantiation."""

import sys
from pathlib import Path

import numpy as np
import pytest

from fmus import port
from orchestrator.errors import FmuError, PortError
from orchestrator.fmi.block import Block
from orchestrator.fmi.unit import Status, Unit, UnitError
from tests.faults import fault


@pytest.fixture
def spring(store, toy_fmus):
    unit = Unit(store.open(toy_fmus / "spring_damper.fmu"), "LP1-front")
    yield unit
    unit.close()


def started(unit, **parameters):
    unit.set_parameters({"spring.stiffness": 2e6, "spring.damping": 1e3, "clearance": 1e3, **parameters})
    unit.enter_initialization()
    unit.exit_initialization()
    return unit


def test_blocks_move_values_between_unit_and_array(spring):
    started(spring)
    given = np.arange(1.0, 9.0)
    inputs = Block(spring, port.JOURNAL, given)
    taken = np.empty(4)
    outputs = Block(spring, port.FORCE, taken)
    inputs.set()
    spring.do_step(0.0, 1e-3)
    outputs.get()
    np.testing.assert_allclose(taken, -2e6 * given[:4] - 1e3 * given[4:], rtol=1e-15)
    given[:] = 0.0
    inputs.set()
    spring.do_step(1e-3, 1e-3)
    outputs.get()
    assert not taken.any()


def test_a_bound_call_outlives_its_block(spring):
    """The call alone keeps the arrays that it points to."""
    started(spring)
    get = Block(spring, [*port.FORCE, *port.K], np.empty(20)).get
    junk = [np.full(n, 7, dtype=np.uint32) for n in (4, 20, 20, 40)]
    get()
    del junk


def test_block_refuses_an_array_that_it_cannot_address(spring):
    with pytest.raises(ValueError, match="contiguous"):
        Block(spring, port.FORCE, np.zeros(8)[::2])


def test_a_refused_step_names_the_unit_and_its_reason(spring):
    started(spring, refuse_after=1.5e-3)
    spring.do_step(0.0, 1e-3)
    with pytest.raises(UnitError, match=r"LP1-front: fmi2DoStep .* discard: 100% of the") as info:
        spring.do_step(1e-3, 1e-3)
    assert info.value.status is Status.DISCARD
    assert info.value.unit == "LP1-front"


def test_an_exception_inside_a_unit_is_fatal_and_named(spring):
    started(spring, break_after=0.5e-3)
    with pytest.raises(UnitError, match="LP1-front") as info:
        spring.do_step(0.0, 1e-3)
    assert info.value.status >= Status.ERROR


def test_states_come_back_through_handles_and_bytes(store, toy_fmus):
    unit = Unit(store.open(toy_fmus / "two_masses.fmu"), "rotor")
    unit.set_parameters({"bearing[1].start.x": 1e-3})
    unit.enter_initialization()
    unit.exit_initialization()
    names = [port.at_bearing(1, name) for name in port.JOURNAL]

    def path():
        positions = []
        for k in range(5):
            unit.do_step(k * 1e-3, 1e-3)
            positions.append(unit.get_real(names))
        return np.array(positions)

    state = unit.get_state()
    data = unit.serialize(state)
    first = path()
    unit.set_state(state)
    np.testing.assert_array_equal(path(), first)
    unit.free_state(state)
    copy = unit.deserialize(data)
    unit.set_state(copy)
    np.testing.assert_array_equal(path(), first)
    unit.close()


def test_eleven_instances_share_one_extraction_and_keep_apart(store, toy_fmus):
    file = store.open(toy_fmus / "spring_damper.fmu")
    assert store.open(toy_fmus / ".." / toy_fmus.name / "spring_damper.fmu") is file
    units = [started(Unit(file, f"B{i}"), **{"spring.stiffness": 1e6 * i}) for i in range(1, 12)]
    for unit in units:
        unit.set_real(["journal.x"], np.array([1.0]))
        unit.do_step(0.0, 1e-3)
    assert [unit.get_real(["wrench.Fx"])[0] for unit in units] == [-1e6 * i for i in range(1, 12)]
    for unit in units:
        unit.close()


def test_the_store_leaves_nothing_behind(store, toy_fmus):
    folder = store.open(toy_fmus / "spring_damper.fmu").folder
    assert folder.is_dir()
    store.close()
    assert not folder.exists()


@fault(
    "unit",
    "libraries of pythonfmu that write to freed memory when the process ends",
    "they are ended before",
    guard="orchestrator.fmi.file:FmuStore.close",
)
def test_the_store_ends_the_libraries_that_were_used(store, toy_fmus):
    """A library of pythonfmu that ends at the exit of the process only writes to freed memory."""
    file = store.open(toy_fmus / "spring_damper.fmu")
    unused = store.open(toy_fmus / "two_masses.fmu")
    unit = started(Unit(file, "spring"))
    unit.close()
    ended = []
    file.library.finalizePythonInterpreter = lambda: ended.append(file)
    store.close()
    assert ended == [file]
    assert "library" not in unused.__dict__


@fault(
    "machine",
    "runs in a loop in one process, each with FMUs extracted anew",
    "libraries are unloaded and the import path is as before: some 0.1 MB a run stay, not 0.8",
    guard="orchestrator.fmi.file:FmuFile.end_library",
)
@pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="no /proc to see what is loaded")
def test_nothing_of_a_closed_store_stays_loaded(store, toy_fmus):
    def held():
        return str(store.folder) in Path("/proc/self/maps").read_text(), str(store.folder) in " ".join(
            sys.path
        )

    started(Unit(store.open(toy_fmus / "spring_damper.fmu"), "spring")).close()
    assert held() == (True, True)
    store.close()
    assert held() == (False, False)


@fault(
    "unit",
    "an FMU that is not there",
    "FmuError; file, how to build it",
    guard="orchestrator.fmi.file:FmuFile.__init__",
)
def test_a_missing_file_is_named(store, toy_fmus):
    with pytest.raises(FmuError, match=r"bearing_v9\.fmu: no such file"):
        store.open(toy_fmus / "bearing_v9.fmu")


def test_a_file_that_is_no_fmu_is_named(store, tmp_path):
    (tmp_path / "text.fmu").write_text("not a zip")
    with pytest.raises(FmuError, match=r"text\.fmu: not a readable FMU"):
        store.open(tmp_path / "text.fmu")


@fault(
    "unit",
    "a parameter that an FMU does not have",
    "PortError; file, unit, variable",
    guard="orchestrator.fmi.unit:Unit.variable",
)
def test_an_unknown_variable_is_named(spring):
    with pytest.raises(PortError, match="no variable 'stiffnes'"):
        spring.set_parameters({"stiffnes": 1.0})
