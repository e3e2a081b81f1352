"""Ctrl-C is held back until a macro step is complete."""

import signal

import pytest

from orchestrator.case.progress import Stage
from orchestrator.master.interrupt import interrupt_between_steps
from tests.faults import fault


@fault(
    "process",
    "Ctrl-C while a unit is in a call",
    "it waits for the end of the step: a unit that is interrupted is lost",
    guard="orchestrator.master.interrupt:interrupt_between_steps",
)
def test_the_next_report_raises_and_the_handler_is_restored():
    before, seen = signal.getsignal(signal.SIGINT), []
    with interrupt_between_steps(lambda stage, time: seen.append(time)) as report:
        report(Stage.RUN, 0.1)
        try:
            signal.raise_signal(signal.SIGINT)  # as inside a call of a unit: nothing happens yet
            seen.append("in a call")
        except KeyboardInterrupt:
            seen.append("cut off")
        with pytest.raises(KeyboardInterrupt):
            report(Stage.RUN, 0.2)
    assert seen == [0.1, "in a call", 0.2]
    assert signal.getsignal(signal.SIGINT) is before


@fault(
    "process",
    "Ctrl-C twice",
    "the second is not held back",
    guard="orchestrator.master.interrupt:interrupt_between_steps",
)
def test_a_second_interrupt_is_not_held_back():
    with interrupt_between_steps(lambda stage, time: None), pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)
