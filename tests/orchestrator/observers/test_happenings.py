"""A fan that loses a piece, is tripped by its vibration and slows down, through the FMUs."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from fmus import port
from orchestrator.case.simulate import Execution, simulate
from orchestrator.errors import ScenarioError
from orchestrator.fmi.folder import build
from orchestrator.master.coupling.base import Advance
from orchestrator.observers.between import Bores
from orchestrator.observers.checkpoint import Checkpoints, read
from orchestrator.observers.happenings import Happenings
from orchestrator.results.ledger import ledger_of
from orchestrator.scenario.events import BladeLoss, Change, Trip, VacuumBreak, from_json, to_json
from orchestrator.scenario.file import load_scenario
from orchestrator.scenario.schedule import from_attributes
from rotor_fmu.train.file import load_train
from tests.faults import fault

FAN = Path(__file__).parents[2] / "examples" / "fan"
STEP = Advance(1, np.zeros((1, 4)))


class Machine:
    """A system of one bearing, as far as conditions look at it."""

    def __init__(self):
        self.motion, self.responses, self.speed = np.zeros((1, 8)), np.ones((1, 52)), 100.0
        self.switched, self.bearings, self.bearing_group = [], [Bearing()], Group()

    def switch(self, name, by=1.0):
        self.switched.append(name if by == 1.0 else (name, by))


class Bearing:
    """A unit with parameters."""

    def __init__(self):
        self.name, self.values = "front", {"offset.y": 1e-4, "viscosity": 0.02}
        self.file, self.steps = SimpleNamespace(promises={"memoryless"}, variables={}), []

    def do_step(self, time, step):
        self.steps.append((time, step))

    def get_real(self, names):
        return [self.values[name] for name in names]

    def set_real(self, names, values):
        self.values |= dict(zip(names, values, strict=True))


class Group:
    """Tells what was evaluated again."""

    def __init__(self):
        self.fetched = []

    def fetch(self, chosen):
        self.fetched += chosen


def watched(machine, *events):
    happenings = Happenings(machine, events, np.zeros((1, 4)))
    happenings.begin(None)
    return happenings


def test_an_instant_is_met():
    machine = Machine()
    happenings = watched(machine, Trip(time=0.5), VacuumBreak(time=0.0))
    assert machine.switched == [port.VACUUM_BROKEN]
    happenings.watch(0.4, 0.5, STEP)
    assert machine.switched == [port.VACUUM_BROKEN, port.RELEASED]
    assert happenings.happened == []  # known beforehand


def test_a_vibration_must_last():
    """A turn takes 0.063 s: an orbit that dips below the limit in between still counts, a rest does not."""
    machine = Machine()
    happenings = watched(machine, Trip(vibration=1e-5, lasting=0.2))
    for k in range(1, 100):
        time = 0.01 * k
        resting = 0.15 < time < 0.3
        machine.motion[0, 0] = 0.0 if resting or k % 3 else 2e-5
        happenings.watch(time - 0.01, time, STEP)
    (trip,) = happenings.happened
    assert trip.time == pytest.approx(0.5, abs=0.011)  # 0.3 s is the first time behind the rest
    again = watched(machine, Trip(vibration=1e-5, lasting=0.2))
    again.restore({name: values.copy() for name, values in happenings.arrays().items()})
    assert again.happened == happenings.happened


def test_gap_and_speed():
    machine = Machine()
    happenings = watched(machine, Trip(least_gap=1e-5), VacuumBreak(speed=50.0))
    happenings.watch(0.0, 0.1, STEP)
    assert machine.switched == []
    machine.responses[:] = 5e-6
    machine.speed = 40.0
    happenings.watch(0.1, 0.2, STEP)
    assert machine.switched == [port.RELEASED, port.VACUUM_BROKEN]


def test_a_blade_is_lost_and_a_bearing_sinks_by_condition():
    """Each loss by a condition has its own digit; a speed that began below its limit counts from above."""
    machine = Machine()
    lost = {"wheel": "wheel", "unbalance": 0.1}
    sinks = Change(bearing="front", parameter="offset.y", by=-2e-5, speed=110.0)
    thin = Change(bearing="front", parameter="viscosity", value=0.01, time=0.15)
    happenings = watched(
        machine, BladeLoss(**lost, time=0.1), BladeLoss(**lost, least_gap=1e-6),
        BladeLoss(**lost, speed=105.0), sinks, thin,
    )  # fmt: skip
    happenings._bores = bores = Bores([1e-3], [0.5], np.zeros((1, 4)))
    machine.speed = 106.0
    happenings.watch(0.0, 0.1, STEP)
    assert machine.switched == [(port.LOST, 2.0)]
    machine.speed = 111.0
    happenings.watch(0.1, 0.2, STEP)
    assert machine.bearings[0].values == {"offset.y": pytest.approx(8e-5), "viscosity": 0.01}
    np.testing.assert_allclose(bores.offsets, [[0.0, -2e-5, 0.0, 0.0]])
    assert machine.bearings[0].steps == [(0.1, 0.1)] * 2 and machine.bearing_group.fetched == [0, 0]
    found = [(event.kind, event.time) for event in happenings.happened]
    assert found == [("blade-loss", 0.1), ("change", 0.2)]
    assert from_json(to_json(happenings.happened)) == tuple(happenings.happened)


def test_a_change_where_the_bearing_stands_behind():
    """With many rates: no step twice over; only behind a condition do all begin anew from here."""
    machine, begun = Machine(), []
    stepper = SimpleNamespace(level=2, begin_anew=begun.append)
    timed = Change(bearing="front", parameter="viscosity", value=0.01, time=0.05)
    happenings = watched(machine, timed, Change(bearing="front", parameter="offset.y", by=1e-6, speed=110.0))
    happenings.watch(0.0, 0.1, STEP._replace(evaluated=np.array([False])))
    happenings.record(1, 0.1, stepper)
    assert machine.bearings[0].values["viscosity"] == 0.01 and not begun
    machine.speed = 111.0
    happenings.watch(0.1, 0.2, STEP._replace(evaluated=np.array([False])))
    for step in (2, 3):
        happenings.record(step, 0.1 * step, stepper)
    assert begun == [2] and not machine.bearings[0].steps and not machine.bearing_group.fetched


@fault(
    "input",
    "an event that changes what may not change, or without a value",
    "exit 2; the key, the value and what is allowed",
    guard="orchestrator.scenario.problems:shape_problems",
)
def test_refused_changes():
    for change, allowed in (
        ({"parameter": "clearance", "value": 1e-4}, "clearance"),
        ({"parameter": "viscosity", "value": -1.0}, "allowed is > 0"),
        ({"parameter": "viscosity"}, "; allowed is either value or by"),
    ):
        event = {"kind": "change", "bearing": "fan-side", "time": 0.1, **change}
        with pytest.raises(ScenarioError, match=allowed):
            load_scenario(FAN / "coast-down.toml", {"events": [event]})
    for event, allowed in (
        (
            {"kind": "change", "bearing": "fan-site", "time": 0.1, "parameter": "viscosity", "by": 0.1},
            "fan-side",
        ),
        ({"wheel": "wheel", "unbalance": 0.01, "speed": 100.0}, "beside a table rotation"),
    ):
        with pytest.raises(ScenarioError, match=allowed):
            load_scenario(FAN / "loss.toml", {"event": None, "events": [event]})


@pytest.fixture(scope="module")
def fan(once):
    return once("fan", lambda folder: build(folder, [load_train(FAN)], ["v3"]))


def test_a_coast_down_obeys_its_torques(fan):
    """What the rotation loses is what friction and windage took; housings move, the record knows it all."""
    changes = {"end": 0.16, "ledger": True, "events": [
        {"wheel": "wheel", "unbalance": 0.05, "time": 0.02},
        {"kind": "trip", "vibration": 2e-5, "lasting": 0.01},
        {"kind": "vacuum-break", "time": 0.13},
    ], "rotation": {"windage_broken": 0.5}, "record": {"interval": 2e-4}}  # fmt: skip
    record = simulate(load_scenario(FAN / "coast-down.toml", changes), fan).record
    assert record.attrs["status"] == "finished"
    schedule = from_attributes(record.attrs)
    loss, trip, broken = schedule.events
    assert (loss.kind, trip.kind, broken.kind) == ("blade-loss", "trip", "vacuum-break")
    time, speed = record["time"].values, record["rotation_speed"].values
    assert np.ptp(speed[time <= trip.time]) == 0.0
    power = record["friction_power"].sum("bearing").values
    power = power + np.where(time > 0.13, 0.5, 0.045) * speed**3
    for start, end in ((trip.time + 1e-3, 0.129), (0.131, 0.16)):
        inside = (time >= start) & (time <= end)
        lost = 0.5 * 34.0 * (speed[inside][0] ** 2 - speed[inside][-1] ** 2)
        assert lost == pytest.approx(np.trapezoid(power[inside], time[inside]), rel=5e-3)
    assert np.abs(record["housing_displacement"]).max() > 1e-6
    whole = 0.5 * 34.0 * (speed[0] ** 2 - speed[-1] ** 2)
    ledger = ledger_of(record)
    assert ledger.rotation.stored == pytest.approx(-whole, rel=1e-4)
    assert abs(ledger.rotation.gap) < 1e-4 * whole
    assert abs(ledger.relative_gap) < 5e-3
    held = record["foundation_force"].isel(time=0).values + record["static_force"].values
    assert np.abs(held).max() < 0.5 * np.abs(record["static_force"]).max()


def test_a_coast_down_goes_on_where_it_was_saved(fan, tmp_path):
    """To the bit, revolutions and ledger included, from a checkpoint between trip and end."""
    changes = {"end": 0.12, "ledger": True, "events": [
        {"wheel": "wheel", "unbalance": 0.05, "speed": 156.0},
        {"kind": "trip", "time": 0.02},
        {"kind": "change", "bearing": "fan-side", "parameter": "offset.y", "by": -1e-6, "time": 0.06},
    ]}  # fmt: skip
    scenario = load_scenario(FAN / "coast-down.toml", changes)
    saving = Execution(checkpoints=Checkpoints(tmp_path, 0.08, {}))
    whole = simulate(scenario, fan, execution=saving).record.load()
    saved = read(tmp_path)
    assert saved.time == pytest.approx(0.08)
    assert [event.kind for event in from_attributes(whole.attrs).events] == ["trip", "blade-loss", "change"]
    again = simulate(scenario, fan, execution=Execution(resume=saved)).record
    for name in whole.variables:
        np.testing.assert_array_equal(again[name].values, whole[name].values, err_msg=name)
    assert whole.sizes["revolution"] >= 2
    near = np.abs(whole["time"].values - 0.06) < 5e-4
    assert (
        whole["defect_max"].values[near].max() < 0.01 * whole["static_force"].max()
    )  # its law is new at once
