"""A film that remembers: its state goes with that of its unit, and with the checkpoint of a run.

In a process of its own, so that no other test knows of the depth.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
BEGIN = """
import math, sys
from pathlib import Path
import numpy as np
from tests.relaxing_film import ADDED, RELAXATION, STIFFNESS
from orchestrator.fmi.folder import build
from orchestrator.scenario.file import load_scenario, train_of
scenario = load_scenario("small", {"depth": "relaxing", "end": 6e-3, "event": {"time": 2.03e-3}})
"""
UNIT = """
from tests.fmus.host import Host
(path,) = build(Path("."), [], ["relaxing"])
host = Host(path, Path("unit").absolute())
x, h, moved = "journal.x", 1e-4, 2e-5

def forces(unit, first, last):
    for k in range(first, last):
        unit.set({x: moved})
        assert unit.step(k * h, h), unit.said
        yield unit.get("wrench.Fx")

unit = host.open()
unit.start({x: 0.0, "journal.y": 0.0})
found = list(forces(unit, 0, 5))
at_five = unit.state()
on = list(forces(unit, 5, 20))
# moved evenly along the first step, held from then on
a = h / RELAXATION
element = ADDED * moved * -math.expm1(-a) / a * np.exp(-a * np.arange(20))
np.testing.assert_allclose(found + on, -STIFFNESS * moved - element, rtol=1e-12)
unit.restore(at_five)
assert list(forces(unit, 5, 20)) == on
kept = host.open()
kept.start({x: 0.0, "journal.y": 0.0})
kept.restore(at_five)  # in another instance, too
assert list(forces(kept, 5, 20)) == on
handle = kept.keep()
list(forces(kept, 20, 30))
kept.go_back(handle)
(after,) = forces(kept, 20, 21)
np.testing.assert_allclose(after, -STIFFNESS * moved - element[0] * math.exp(-20 * a), rtol=1e-12)
kept.serialise(handle)
unit.close()
kept.close()
"""
RUN = """
from orchestrator.case.progress import Stage
from orchestrator.case.simulate import Execution, simulate
from orchestrator.observers import checkpoint
from orchestrator.observers.checkpoint import Checkpoints

class Killed(BaseException):
    pass

def killed(stage, simulated):
    if stage is Stage.RUN and simulated > 3.5e-3:
        raise Killed

build(Path("."), [train_of(scenario)], ["relaxing"])
whole = simulate(scenario, Path("."))
assert whole.outcome.ok, whole.message
try:
    simulate(scenario, Path("."), killed, Execution(Checkpoints(Path("saved"), 1e-3, {})))
    sys.exit("not killed")
except Killed:
    saved = checkpoint.read(Path("saved"))
assert abs(saved.time - 3e-3) < 1e-12
again = simulate(scenario, Path("."), None, Execution(None, saved))
assert again.record.identical(whole.record)
# what the films remember is no trifle: the element holds a share of the force
force, q = (whole.record[name].values for name in ("force", "displacement"))
assert np.abs(np.ptp(force, axis=0)).max() > 1.01 * STIFFNESS * np.abs(np.ptp(q, axis=0)).max()
"""


@pytest.mark.parametrize("code", [UNIT, RUN], ids=["a state of the unit", "a checkpoint of the run"])
def test_what_a_film_remembers_is_kept(code, tmp_path):
    """Against the closed form of Maxwell's element, and bit by bit against a run that nothing stops."""
    done = subprocess.run(
        [sys.executable, "-c", BEGIN + code],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={
            "PYTHONPATH": str(ROOT),
            "PATH": "",
            "XDG_CACHE_HOME": str(tmp_path),
            "OPENBLAS_NUM_THREADS": "1",
        },
    )
    assert done.returncode == 0, done.stdout + done.stderr
