"""Films with a memory in other tools: mass-conserving in lemon bores with grooves, and on tilting pads.

The small train through a loss; a tool gives the orchestrator's forces as with films that remember nothing,
and the same bits when it runs again.
"""

from pathlib import Path

import fmpy
import numpy as np
import pytest

from orchestrator.fmi.folder import build
from orchestrator.scenario.file import load_scenario, train_of
from orchestrator.ssp.export import export
from tests.fmus.orbit import INPUTS, STEP, Orbit
from tests.interop.test_tools import reference, relative_error
from tests.interop.tools import LAG, TOOLS, forces, missing

pytestmark = pytest.mark.slow  # four systems in three tools, twice, on kernels that only few tests need
EXAMPLES = Path(__file__).parents[1] / "examples"
END = 0.03
FILM = {"columns": 32, "rows": 4}
SYSTEMS = {
    "lemon": ("lemon", FILM, 1e-4, (0.001, 0.003)),
    "jfo": ("lemon", FILM | {"boundary": "jfo"}, 1e-4, (0.003, 0.006)),
    "tilting": ("tilting", FILM, 5e-5, (0.01, 0.04)),
}
"""Example, film, step, and RMS errors allowed without a lag and with it; pads with a law that is a step
old need the shorter step."""


@pytest.fixture(scope="module")
def system(once):
    """Return a function that gives the SSP of a system, and the forces of its converged run."""
    known = {}

    def made(name):
        if name not in known:
            example, film, *_ = SYSTEMS[name]
            source = EXAMPLES / example / "loss.toml"
            scenario = load_scenario(str(source), {"end": END, "event": {"time": 0.01003}, "film": film})
            folder = once(f"remember-{name}", lambda f: _export(scenario, f))
            known[name] = folder / "system.ssp", reference(folder / "system.ssp", END)
        return known[name]

    return made


def _export(scenario, folder):
    build(folder, [train_of(scenario)], [scenario.depth])
    export(scenario, folder, folder / "system.ssp", "system")


@pytest.mark.parametrize("tool", TOOLS)
@pytest.mark.parametrize("name", SYSTEMS)
def test_the_forces_are_those_of_the_orchestrator_each_time(name, tool, system, tmp_path, record_property):
    if missing(tool):
        pytest.skip(f"{tool}: {missing(tool)}")
    ssp, expected = system(name)
    *_, step, allowed = SYSTEMS[name]
    once, again = (forces(tool, ssp, step, END, tmp_path / f"{k}.npz") for k in range(2))
    for bearing, series in once.items():
        np.testing.assert_array_equal(again[bearing], series)
    error = relative_error(tool, once, *expected, step=step)
    record_property("rms_error", error)
    assert error < allowed[LAG[tool]]


def test_fmpy_alone_simulates_a_unit_with_a_mass_conserving_film(train_fmus):
    """On an orbit, so that the film ruptures and closes; twice the same bits."""
    orbit = Orbit((2e-4, -4e-4), ())
    rows = [(STEP * k, *orbit.place(k).values()) for k in range(101)]
    moved = np.array(rows, dtype=[(name, float) for name in ("time", *INPUTS)])
    start = {"film.boundary": "jfo", "ambient_pressure": 1e5, "film.columns": 24, "film.rows": 4}
    once, again = (
        fmpy.simulate_fmu(
            str(train_fmus / "bearing_v1.fmu"),
            stop_time=0.01,
            step_size=STEP,
            output_interval=STEP,
            start_values=start,
            input=moved,
            output=["wrench.Fx", "wrench.Fy", "full_film"],
        )
        for _ in range(2)
    )
    np.testing.assert_array_equal(once, again)
    assert 0.0 < once["full_film"].min() < once["full_film"].max() - 1e-2 < 1.0
