"""A kind of event that one file adds is everywhere: scenario, FMU, master, record.

In a process of its own, so that no other test knows of it.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
RUN = """
from pathlib import Path
import numpy as np
from fmus import port
from tests.brake_event import BRAKED, TORQUE
from orchestrator.case.simulate import simulate
from orchestrator.fmi.folder import build
from orchestrator.scenario.file import load_scenario, train_of
from orchestrator.scenario.schedule import from_attributes
from rotor_fmu.train.file import load_train

INERTIA, AT, END, FMUS = 40.0, 0.004, 0.012, Path("fmus")
build(FMUS, [load_train("small")], names=("v3",))
trip = {"kind": "trip", "time": 0.001}
def speed(*events):
    rotation = {"inertia": INERTIA, "windage": 0.0}
    changes = {"event": None, "events": [trip, *events], "rotation": rotation, "end": END, "depth": "v3"}
    result = simulate(load_scenario("small", changes), FMUS)
    assert result.outcome.ok, result.message
    return result.record["rotation_speed"].values[-1], result.record
free, _ = speed()
braked, record = speed({"kind": "brake", "time": AT})
np.testing.assert_allclose(free - braked, TORQUE * (END - AT) / INERTIA, rtol=0.02)
assert [event.label for event in from_attributes(record.attrs).events] == ["trip", "brake"]
assert BRAKED in {v.name for v in port.rotor(["a"], ["b"], 2)}
"""


def test_a_kind_of_event_with_an_input_of_the_rotor(tmp_path):
    """The brake takes its torque over the inertia off the speed, beside what friction does."""
    done = subprocess.run(
        [sys.executable, "-c", RUN],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={"PYTHONPATH": str(ROOT), "PATH": "", "XDG_CACHE_HOME": str(tmp_path)},
    )
    assert done.returncode == 0, done.stdout + done.stderr
