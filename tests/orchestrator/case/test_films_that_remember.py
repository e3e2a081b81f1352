"""Films with memory through a run: resumed, on two threads and in every coupling, the same record."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from orchestrator.case.progress import Stage
from orchestrator.case.simulate import Execution, simulate
from orchestrator.fmi.folder import build
from orchestrator.observers import checkpoint
from orchestrator.observers.checkpoint import Checkpoints
from orchestrator.scenario.file import load_scenario, train_of

pytestmark = pytest.mark.slow  # five runs each, on kernels that only few tests need
EXAMPLES = Path(__file__).parents[2] / "examples"
SHORT = {
    "end": 8e-3,
    "event": {"time": 2.03e-3},
    "record": {"interval": 1e-4},
    "film": {"columns": 32, "rows": 4},
}
FILMS = [
    pytest.param("tilting", {"depth": "v2"}, id="tilting pads"),
    pytest.param("lemon", {"depth": "v1", "boundary": "jfo"}, id="jfo"),
    pytest.param("oil", {"depth": "v3", "temperature": "followed"}, id="oil that warms"),
    pytest.param("small", {"depth": "v1"}, id="soft layer, in contact"),
]


class Killed(BaseException):
    """Ends a run as a signal would."""


def killed(stage, simulated):
    if stage is Stage.RUN and simulated > 5.5e-3:
        raise Killed


def lined(folder):
    """The small train with white metal on its shells, which it touches when a heavy blade breaks off."""
    base = files("rotor_fmu") / "data" / "small" / "train.toml"
    layer = 'layer_thickness = "1 mm"\nlayer_modulus = 53e9\n'
    path = folder / "lined.toml"
    path.write_text(f"base = '{base}'\nname = \"lined\"\n\n[every_bearing]\n{layer}")
    return {"train": str(path), "event": SHORT["event"] | {"unbalance": 13.0}, "end": 8.8e-3}


def scenario_of(example, film, **changes):
    own = {key: film[key] for key in ("boundary", "temperature") if key in film}
    given, settings = {key: film[key] for key in film if key not in own}, SHORT["film"] | own
    source = example if example == "small" else str(EXAMPLES / example / "loss.toml")
    return load_scenario(source, SHORT | given | {"film": settings} | changes)


@pytest.mark.parametrize(("example", "film"), FILMS)
def test_the_record_is_the_same_however_it_came_about(example, film, tmp_path):
    if example == "small":
        film = film | lined(tmp_path)
    scenario = scenario_of(example, film, tolerance=1e-3)  # so steps are taken back
    build(tmp_path, [train_of(scenario)], [film["depth"]])
    whole = simulate(scenario, tmp_path, None, Execution(threads=1))
    assert whole.outcome.ok, whole.message
    assert np.ptp(whole.record["force"].values) > 1e3
    if example == "small":
        assert whole.record["contact_force"].values.max() > 5e4
        assert whole.record.attrs["rejected_steps"] > 0
    if film.get("boundary") == "jfo":
        full, fed = whole.record["full_film"].values, whole.record["oil_fed"].values
        assert 0.3 < full.min() < full.max() < 1.0 and np.ptp(full) > 1e-3
        assert np.all(fed > 0.0)
    two = simulate(scenario, tmp_path, None, Execution(threads=2))
    assert two.record.identical(whole.record)
    saves = Execution(Checkpoints(tmp_path / "saved", 2e-3, {}))
    with pytest.raises(Killed):
        simulate(scenario, tmp_path, killed, saves)
    again = simulate(scenario, tmp_path, None, Execution(None, checkpoint.read(tmp_path / "saved")))
    assert again.record.identical(whole.record)
    scale = np.abs(whole.record["force"].values).max()
    for coupling in ("newton", "multirate"):
        other = simulate(scenario_of(example, film, coupling=coupling, tolerance=1e-3), tmp_path)
        assert other.outcome.ok, other.message
        assert np.abs(other.record["force"].values - whole.record["force"].values).max() < 0.02 * scale
