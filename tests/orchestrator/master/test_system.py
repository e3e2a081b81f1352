"""The graph of rotor and bearings: checks at load and the way of the values."""

import numpy as np
import pytest

from fmus import port
from orchestrator.errors import PortError
from orchestrator.fmi.unit import Unit
from orchestrator.master.graph import Connection, Graph
from orchestrator.master.system import RESPONSE, System, Wiring, _runs, port_connections
from tests.orchestrator.oscillator import released


def test_values_travel_along_the_port(store, toy_fmus):
    system = released(store, toy_fmus, stiffness=3e6)
    np.testing.assert_array_equal(system.bearing_inputs[0, :8], system.journals[0])
    assert system.journals[0, 0] == 1e-3
    system.rotor_group.feed()
    np.testing.assert_array_equal(system.laws[0], system.responses[0, 4:40])
    assert system.forces[0, 0] == pytest.approx(-3e3)
    assert system.responses[0, RESPONSE["K[1,1]"]] == 3e6
    system.close()


@pytest.mark.parametrize("changed", [[], [0], [1], [0, 1]])
def test_laws_that_changed_are_told(store, toy_fmus, changed):
    system = released(store, toy_fmus)
    names = [[port.at_bearing(i, name) for name in port.LAW] for i in (1, 2)]
    before = [system.rotor.get_real(part) for part in names]
    system.laws[:] = np.arange(72.0).reshape(2, 36) + 1.0
    system.tell_laws(changed)
    for k, part in enumerate(names):
        expected = system.laws[k] if k in changed else before[k]
        np.testing.assert_array_equal(system.rotor.get_real(part), expected)
    system.close()


def test_neighbours_travel_in_one_call():
    assert _runs([]) == []
    assert _runs([0, 1, 3, 5, 6, 7]) == [(0, 2), (3, 4), (5, 8)]


def test_force_wiring_leaves_the_tangents_at_zero(store, toy_fmus):
    system = released(store, toy_fmus, Wiring.FORCE)
    system.rotor_group.feed()
    np.testing.assert_array_equal(system.laws[0, :4], system.forces[0])
    assert not system.laws[0, 4:].any()
    system.close()


def test_speed_reaches_every_unit(store, toy_fmus):
    system = released(store, toy_fmus)
    assert system.bearing_inputs[0, 16] == pytest.approx(port.NOMINAL_SPEED, rel=1e-15)
    system.set_speed(12.0)
    for group in system.groups:
        group.push()
    assert [unit.get_real(["speed"])[0] for unit in system.units] == [12.0, 12.0, 12.0]
    system.close()


@pytest.mark.parametrize("load", [10.0, 1e5])
def test_a_relative_defect_is_the_largest_against_its_scale(store, toy_fmus, load):
    system = released(store, toy_fmus, stiffness=3e6)
    system.set_scale(load, [0.7, 1.3])
    for defect in np.random.default_rng(1).normal(size=(20, 2, 4)):
        assert system.relative(defect) == pytest.approx(np.max(np.abs(defect) / system.scale()), rel=1e-15)
    assert np.isnan(system.relative(np.array([[1.0, np.nan, 0.0, 0.0], [0.0] * 4])))
    system.close()


def test_a_unit_without_the_port_is_described(store, toy_fmus):
    spring = store.open(toy_fmus / "spring_damper.fmu")
    units = [Unit(spring, "rotor"), Unit(spring, "front")]
    with pytest.raises(PortError) as info:
        System(units[0], units[1:])
    lines = str(info.value).splitlines()
    assert len(lines) == 36 + 8
    assert lines[0].endswith("spring_damper.fmu: bearing[1].F0.Fx is missing (input, N)")
    for unit in units:
        unit.close()


def test_a_rotor_with_another_number_of_bearings_is_refused(store, toy_fmus):
    rotor = Unit(store.open(toy_fmus / "two_masses.fmu"), "rotor")
    spring = store.open(toy_fmus / "spring_damper.fmu")
    bearings = [Unit(spring, name) for name in ("front", "rear", "third")]
    with pytest.raises(PortError, match=r"bearing\[3\]\.journal\.tilt_rate_y is missing \(output, rad/s\)"):
        System(rotor, bearings)
    with pytest.raises(PortError, match="has more than the 1 bearings of the train"):
        System(rotor, bearings[:1])
    for unit in (rotor, *bearings):
        unit.close()


def test_two_units_of_one_name_are_refused(store, toy_fmus):
    spring = store.open(toy_fmus / "spring_damper.fmu")
    units = [Unit(spring, "same"), Unit(spring, "same")]
    with pytest.raises(PortError, match="name of its own"):
        Graph([(unit, ("speed",), ("h_min",)) for unit in units], [])
    for unit in units:
        unit.close()


def test_connections_of_the_port_pair_each_bearing_with_its_place_on_the_rotor():
    links = list(port_connections("rotor", ["A", "B"], Wiring.FORCE))
    assert Connection("B", "wrench.My", "rotor", "bearing[2].F0.My") in links
    assert Connection("rotor", "bearing[1].journal.tilt_x", "A", "journal.tilt_x") in links
    assert len(links) == 2 * (8 + 4)
    assert len(list(port_connections("rotor", ["A", "B"], Wiring.LAW))) == 2 * (8 + 36)
