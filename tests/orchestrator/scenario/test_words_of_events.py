"""When an event happens, in words."""

import pytest

from orchestrator.scenario.events import Trip


@pytest.mark.parametrize(
    ("cause", "words"),
    [
        ({"time": 1.5}, "at 1.5 s"),
        ({"vibration": 350e-6, "lasting": 0.1}, "when a journal moves more than 350 µm for 0.1 s"),
        ({"least_gap": 20e-6}, "when a gap is below 20 µm"),
        ({"speed": 100.0}, "at 100 rad/s"),
    ],
)
def test_when_it_happens(cause, words):
    assert Trip(**cause).when == words
