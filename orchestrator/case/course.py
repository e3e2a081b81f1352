"""The macro steps of a scenario."""

from __future__ import annotations

import math

from orchestrator.master.coupling import SCHEMES, Multirate
from orchestrator.master.time_loop import Course
from orchestrator.scenario.events import Change, Switch
from orchestrator.scenario.scenario import Scenario
from orchestrator.scenario.schedule import schedule_of
from rotor_fmu.train.train import Train

LONGEST = 20
"""Macro steps to a revolution at least, where a scheme of many rates chooses them."""


def course_of(scenario: Scenario, train: Train) -> tuple[Course, int]:
    """Return the macro steps of a run, and how many there are from one record to the next.

    Steps end on events where they are controlled; else the rotor takes them inside a step, exactly.  With
    many rates the macro step, to the end of which the rotor comes, is as long as records and the
    revolution allow, and all bearings come together as often as the revolution asks; the scenario's step is
    that with which the rotor begins.
    """
    scheme, step, tolerance = SCHEMES[scenario.coupling], scenario.step, scenario.tolerance
    stride = max(1, round(scenario.record.interval / step))
    schedule, level, meeting = schedule_of(scenario, train), 0, 1
    if scheme.many_rates:
        fastest = max([abs(schedule.speed), *(abs(speed) for _, speed in schedule.course)])
        longest = 2.0 * math.pi / fastest / LONGEST
        whole = max(k for k in range(1, stride + 1) if stride % k == 0 and (k == 1 or k * step <= longest))
        step, stride, level = whole * step, stride // whole, math.ceil(math.log2(whole))
        meeting = max(1, math.floor(longest / step * (1.0 + 1e-9)))
        tolerance = Multirate.tolerance if tolerance is None else tolerance
    controlled = tolerance is not None or scheme.iterates
    switches = sorted({event.time for event in schedule.events if isinstance(event, (Switch, Change))})
    events = schedule.instants if controlled else tuple(switches)
    return Course(scenario.end, step, tolerance, events, level, meeting), stride
