"""Tilting pads through a run: resumed, on two threads and in every coupling, the same record."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from orchestrator.case.progress import Stage
from orchestrator.case.simulate import Execution, simulate
from orchestrator.fmi.folder import build
from orchestrator.observers import checkpoint
from orchestrator.observers.checkpoint import Checkpoints
from orchestrator.scenario.file import load_scenario, train_of

pytestmark = pytest.mark.slow  # five runs
EXAMPLE = Path(__file__).parents[2] / "examples" / "tilting" / "loss.toml"
SHORT = {
    "depth": "v2",
    "tolerance": 1e-3,  # so steps are taken back
    "end": 8e-3,
    "event": {"time": 2.03e-3},
    "record": {"interval": 1e-4},
    "film": {"columns": 32, "rows": 4},
}


class Killed(BaseException):
    """Ends a run as a signal would."""


def killed(stage, simulated):
    if stage is Stage.RUN and simulated > 5.5e-3:
        raise Killed


def scenario_of(**changes):
    return load_scenario(str(EXAMPLE), SHORT | changes)


def test_the_record_is_the_same_however_it_came_about(tmp_path):
    scenario = scenario_of()
    build(tmp_path, [train_of(scenario)], ["v2"])
    whole = simulate(scenario, tmp_path, None, Execution(threads=1))
    assert whole.outcome.ok, whole.message
    assert np.ptp(whole.record["force"].values) > 1e3
    two = simulate(scenario, tmp_path, None, Execution(threads=2))
    assert two.record.identical(whole.record)
    saves = Execution(Checkpoints(tmp_path / "saved", 2e-3, {}))
    with pytest.raises(Killed):
        simulate(scenario, tmp_path, killed, saves)
    again = simulate(scenario, tmp_path, None, Execution(None, checkpoint.read(tmp_path / "saved")))
    assert again.record.identical(whole.record)
    scale = np.abs(whole.record["force"].values).max()
    for coupling in ("newton", "multirate"):
        other = simulate(scenario_of(coupling=coupling), tmp_path)
        assert other.outcome.ok, other.message
        assert np.abs(other.record["force"].values - whole.record["force"].values).max() < 0.02 * scale
