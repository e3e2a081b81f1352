"""Ctrl-C is held back until a macro step is complete."""

import signal

import pytest

from orchestrator.case.progress import Stage
from orchestrator.errors import Terminated
from orchestrator.master import interrupt
from orchestrator.master.interrupt import interrupt_between_steps
from tests.faults import fault


@pytest.fixture(autouse=True)
def each_counts(monkeypatch):
    """However soon a signal follows another."""
    monkeypatch.setattr(interrupt, "TOGETHER", 0.0)


@fault(
    "process",
    "the same signal twice within a millisecond, from terminal and batch system",
    "it counts once",
    guard="orchestrator.master.interrupt:counts",
)
def test_signals_that_come_together_count_once(monkeypatch):
    monkeypatch.setattr(interrupt, "TOGETHER", 10.0)
    monkeypatch.setattr(interrupt._Last, "time", -1e9)
    with pytest.raises(Terminated), interrupt_between_steps(lambda stage, time: None) as report:
        signal.raise_signal(signal.SIGTERM)
        signal.raise_signal(signal.SIGTERM)
        report(Stage.RUN, 0.1)


@fault(
    "process",
    "SIGHUP, as when a terminal is closed",
    "as SIGTERM; ignored where the run was started to outlive its terminal",
    guard="orchestrator.master.interrupt:SIGNALS",
)
def test_a_closed_terminal_ends_a_run_between_steps():
    earlier = signal.signal(signal.SIGHUP, signal.SIG_DFL)  # the tests themselves may outlive their terminal
    try:
        _closed_terminal()
    finally:
        signal.signal(signal.SIGHUP, earlier)


def _closed_terminal():
    with pytest.raises(Terminated), interrupt_between_steps(lambda stage, time: None) as report:
        signal.raise_signal(signal.SIGHUP)
        report(Stage.RUN, 0.1)
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with interrupt_between_steps(lambda stage, time: None) as report:
            signal.raise_signal(signal.SIGHUP)
            report(Stage.RUN, 0.1)
    finally:
        signal.signal(signal.SIGHUP, before)


@fault(
    "unit",
    "a unit that puts a handler of its own in the place of ours",
    "ours is back before the next step",
    guard="orchestrator.master.interrupt:interrupt_between_steps",
)
def test_a_unit_that_takes_the_handlers():
    with pytest.raises(KeyboardInterrupt), interrupt_between_steps(lambda stage, time: None) as report:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        report(Stage.RUN, 0.1)
        signal.raise_signal(signal.SIGINT)
        report(Stage.RUN, 0.2)


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
