"""Speed that changes, and events that switch, in a scenario; the schedule that follows."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from orchestrator.errors import ScenarioError
from orchestrator.scenario.events import Trip
from orchestrator.scenario.file import load_with_train, parse_scenario, scenario_toml
from orchestrator.scenario.parameters import rotor_parameters
from orchestrator.scenario.schedule import Schedule, from_attributes, schedule_of, turned

FAN = Path(__file__).parents[2] / "examples" / "fan"


def test_a_course_and_several_losses_become_parameters():
    scenario, train = load_with_train(FAN / "run-up.toml")
    values = rotor_parameters(scenario, train)
    assert json.loads(values["speed.course"]) == [[0.0, 20.0], [2.0, 160.0]]
    assert (values["fracture.time"], values["wheel[1].blade_unbalance"]) == (0.5, 0.01)
    assert json.loads(values["losses"]) == [[1.25003, 1, 0.01, 1.0]]
    assert scenario.start_speed(train.speed) == 20.0
    assert parse_scenario(scenario_toml(scenario), FAN, "again") == scenario


def test_a_condition_has_no_instant_beforehand():
    scenario, train = load_with_train(FAN / "coast-down.toml")
    assert [event.kind for event in schedule_of(scenario, train).events] == ["blade-loss"]
    assert scenario.start_speed(train.speed) == train.speed
    assert rotor_parameters(scenario, train)["drive.inertia"] == 34.0
    driven, _ = load_with_train(FAN / "coast-down.toml", {"rotation": {"torque": 250.0}})
    assert rotor_parameters(driven, train)["drive.torque"] == "[[0.0, 250.0]]"
    assert parse_scenario(scenario_toml(scenario), FAN, "again") == scenario


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("inertia = 34.0", "torque = 5.0\ncourse = [[0.0, 7.0]]", "torque beside course"),
        ("inertia = 34.0", "torque = [[2.0, 1.0], [1.0, 1.0]]", "speeds ascending from 0 on"),
        ("vibration = 20e-6", "vibration = 20e-6\ntime = 1.0", "one of time, vibration, least_gap and speed"),
        ("inertia = 34.0", "inertia = 34.0\ncourse = [[1.0, 2.0], [0.0, 3.0]]", "instants ascending"),
        ("inertia = 34.0", "inertia = 34.0\ncourse = [[0.0, 7000.0]]", "a tenth of a revolution"),
        ("windage = 0.045", "windage = 0.045\nwindage_broken = 0.01", "windage_broken is below windage"),
    ],
)
def test_what_does_not_turn_is_said(old, new, message):
    text = (FAN / "coast-down.toml").read_text().replace("record = { interval = 2e-3 }\n", "")
    assert old in text
    with pytest.raises(ScenarioError) as info:
        parse_scenario(text.replace(old, new, 1), FAN, "fan")
    assert message in str(info.value)


def test_revolutions_of_a_changing_speed():
    """From 10 to 30 rad/s in 2 s, then constant: 40 rad, and 30 rad a second."""
    schedule = Schedule(10.0, (), ((0.0, 10.0), (2.0, 30.0)))
    assert schedule.revolutions(0.0, 3.0) == pytest.approx(70.0 / (2.0 * math.pi), rel=1e-12)
    assert schedule.revolutions(1.0, 2.0) == pytest.approx(25.0 / (2.0 * math.pi), rel=1e-12)
    assert schedule.speed_at(1.0) == 20.0
    for start, turns in ((0.5, 3.0), (3.0, -9.0), (2.0, 4.0)):
        end = schedule.later(start, turns)
        assert schedule.revolutions(start, end) == pytest.approx(turns, rel=1e-9)


def test_a_record_knows_how_it_turned():
    times = np.linspace(0.0, 10.0, 5001)
    ran = turned(Schedule(50.0), times, 50.0 - 4.0 * times, [Trip(kind="trip", time=3.0)])
    again = from_attributes(ran.attributes())
    assert again == ran
    assert again.instants == (3.0,)
    assert len(again.course) < 600
    assert again.speed_at(10.0) == pytest.approx(10.0)
