"""On how many threads the bearings of a run step."""

from __future__ import annotations

import os

from bearing_fmu import depths
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.train.train import Train

WORTH_A_THREAD = 4
"""Bearings with a slow film from which a second thread gains more than its handing over costs."""


def default_threads(scenario: Scenario, train: Train) -> int:
    """Two threads where the films take long enough for it to pay, and there are processors; else one."""
    quick = {depth.name for depth in depths.depths() if depth.quick}
    slow = sum(scenario.depth_of(seat.name) not in quick for seat in train.bearings)
    return 2 if slow >= WORTH_A_THREAD and (os.cpu_count() or 1) > 1 else 1
