"""Values in another unit: a speed in rev/min, a length in um."""

from __future__ import annotations

import pytest

from orchestrator.errors import ScenarioError
from orchestrator.scenario.file import load_scenario

RUN_UP = "tests/examples/fan/run-up.toml"
COAST_DOWN = "tests/examples/fan/coast-down.toml"


def trip(**condition):
    return {"events": [{"kind": "trip", **condition}]}


@pytest.mark.parametrize(
    ("source", "overrides", "words"),
    [
        (RUN_UP, {"rotation": {"course": [[0.0, 200.0], [2.0, 1500.0]]}},
         r"rotation.course: 1500.0; allowed is at most 5 times the train's, 785.4 rad/s; did you give rev"),
        (COAST_DOWN, trip(speed=1500.0), r"events.0.speed = 1500.0; .* did you give rev/min"),
        (COAST_DOWN, trip(vibration=20.0),
         r"events.0.vibration = 20.0; allowed is at most 10 times the largest clearance, 0.0009 m; did you"),
        (COAST_DOWN, trip(least_gap=5.0), r"events.0.least_gap = 5.0; .* did you give um"),
    ],
)  # fmt: skip
def test_a_value_in_another_unit(source, overrides, words):
    with pytest.raises(ScenarioError, match=words):
        load_scenario(source, overrides)


def test_values_of_the_train_pass():
    load_scenario(RUN_UP, {"rotation": {"course": [[0.0, 20.0], [2.0, 200.0]]}})
    load_scenario(COAST_DOWN, trip(vibration=90e-6))
