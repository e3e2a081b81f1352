"""The same SSP in other tools and in the orchestrator."""

import signal
import subprocess
import sys
from functools import cache

import numpy as np
import pytest

from fmus.build.archive import write_archive
from orchestrator.case.case import ssp_case
from orchestrator.case.simulate import execute
from orchestrator.fmi.folder import build
from orchestrator.scenario.file import load_scenario, train_of
from orchestrator.ssp.export import export
from orchestrator.ssp.structure import Component, Structure
from orchestrator.ssp.writer import documents
from tests.interop.tools import LAG, RARE, TOOLS, forces, missing, start
from tests.marks import slow

H = 1e-4
ENDS = {"calm": 0.02, "fracture": 0.05}


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def reference(ssp, end, step=2.5e-5):
    """Forces (records, 2) by bearing at multiples of H: the orchestrator's converged run."""
    with ssp_case(ssp, {"end": end, "step": step}) as case:
        result = execute(case)
    assert result.outcome.ok, result.message
    return result.record["time"].values, result.record["force"]


def relative_error(tool, found, time, force, step=H):
    """RMS error against the converged run, relative to the RMS of what moves, over all bearings."""
    instants = np.round(time / step).astype(int)
    late = LAG[tool]
    errors, scale = [], []
    for name in force["bearing"].values:
        expected = force.sel(bearing=name).values
        chosen = (instants >= 1) & (instants + late <= len(found[_component(name)]))
        series = found[_component(name)][instants[chosen] - 1 + late]
        errors.append(series - expected[chosen])
        scale.append(expected[chosen] - expected[0])
    return rms(errors) / rms(scale)


def _component(bearing):
    return str(bearing).replace("-", "_")


@pytest.fixture(scope="module")
def small(exported):
    return reference(exported[0], 0.2)


@pytest.mark.parametrize("tool", [*TOOLS, *RARE])
def test_small_train_through_the_fracture(tool, exported, small, tmp_path, record_property):
    found = forces(tool, exported[0], H, 0.2, tmp_path / "forces.npz")
    error = relative_error(tool, found, *small)
    record_property("rms_error", error)
    assert error < 0.01


@pytest.mark.slow
@pytest.mark.parametrize("tool", TOOLS)
def test_force_only_for_the_record(tool, exported, small, tmp_path, record_property):
    """Nobody promises anything here but that a run which fails is said to have failed."""
    done = start(tool, exported[1], H, 0.2, tmp_path / "forces.npz")
    assert done.returncode >= 0, f"{tool} crashed with signal {-done.returncode}"
    if done.returncode == 0:
        with np.load(tmp_path / "forces.npz") as file:
            found = {str(n): file["forces"][:, i] for i, n in enumerate(file["names"])}
        error = relative_error(tool, found, *small)
        record_property("rms_error", error)
        assert not error < 0.01


@pytest.mark.slow
@pytest.mark.parametrize(
    ("system", "step", "late"),
    [("calm", 1e-4, 0.01), ("fracture", 1e-4, 0.04), ("fracture", 5e-5, 0.01)],
    ids=["calm", "fracture", "fracture, half the step"],
)
def test_turbine_train(system, step, late, turbine, tmp_path, record_property):
    """A revolution of the turbine, and 50 ms with fracture and solid contact moved into them.

    Units that step all at once, each a step late, are allowed `late`; for them alone the step is halved.
    """
    ssp, expected = turbine(system)
    for tool in (tool for tool in TOOLS if not missing(tool) and (LAG[tool] or step == H)):
        found = forces(tool, ssp, step, ENDS[system], tmp_path / "forces.npz")
        error = relative_error(tool, found, *expected, step=step)
        record_property(f"rms_error_{tool}", error)
        assert error < (late if LAG[tool] else 0.01), tool


@pytest.fixture(scope="module")
def turbine(tmp_path_factory):
    """Return a function that gives the SSP of a system, and the forces of its converged run."""
    folder = tmp_path_factory.mktemp("turbine")
    build(folder, [train_of(load_scenario("inertia"))], names=("v1",))
    changes = {"calm": {"end": 1.02}, "fracture": {"end": 0.05, "event": {"time": 0.02003}}}

    @cache
    def system(name):
        ssp, _ = export(load_scenario("inertia", changes[name]), folder, folder / f"{name}.ssp", "turbine")
        return ssp, reference(ssp, ENDS[name])

    return system


def alone(fmus, folder, parameters):
    """SSP of unconnected bearings: depth and parameters by name."""
    components = tuple(
        Component(name, f"resources/bearing_{depth}.fmu", parameters=values)
        for name, (depth, values) in parameters.items()
    )
    files = {c.source: (fmus / c.source.removeprefix("resources/")).read_bytes() for c in components}
    path = folder / "alone.ssp"
    write_archive(path, documents(Structure("alone", "", components, (), end=1e-3, step=H)) | files)
    return path


@pytest.fixture(scope="module")
def eleven(fmus, tmp_path_factory):
    """SSP of eleven bearings of each depth, and their forces in fmpy."""
    folder = tmp_path_factory.mktemp("eleven")
    clearances = {f"{depth}_{k}": 8e-4 + 1e-5 * k for depth in ("v1", "v2", "v3") for k in range(11)}
    ssp = alone(fmus, folder, {n: (n[:2], {"clearance": c}) for n, c in clearances.items()})
    return ssp, forces("fmpy", ssp, H, 5 * H, folder / "expected.npz")


@pytest.mark.slow
@pytest.mark.parametrize("tool", TOOLS)
def test_eleven_bearings_of_each_depth_in_one_process(tool, eleven, tmp_path):
    """Each with a clearance of its own; all tools give the orchestrator's own unit's forces to the bit."""
    ssp, expected = eleven
    found = forces(tool, ssp, H, 5 * H, tmp_path / "forces.npz")
    assert set(found) == {f"{depth}_{k}" for depth in ("v1", "v2", "v3") for k in range(11)}
    for name, series in found.items():
        np.testing.assert_array_equal(series, expected[name])
    for depth in ("v1", "v2", "v3"):  # aligned, V1 and V2 may agree to the last bit
        own = {series[-1, 1] for name, series in found.items() if name.startswith(depth)}
        assert len(own) == 11


@pytest.mark.parametrize("tool", TOOLS)
def test_a_wrong_parameter_is_refused_with_its_reason_in_the_log(tool, fmus, tmp_path):
    ssp = alone(fmus, tmp_path, {"bad": ("v3", {"clearance": -1.0})})
    done = start(tool, ssp, H, 5 * H, tmp_path / "forces.npz")
    if tool == "ecos":  # goes on over any status, with the log of units switched off: NaN is all it tells
        assert done.returncode == 0, done.stderr
        with np.load(tmp_path / "forces.npz") as file:
            assert np.all(np.isnan(file["forces"]))
        return
    # libcosim says it, and then ends its process: it throws where nobody catches
    assert done.returncode == -signal.SIGABRT if tool == "libcosim" else done.returncode > 0
    assert "ended without a start: bearing parameter clearance" in done.stdout + done.stderr


@pytest.mark.parametrize(
    "name",
    ["rotor_small", "bearing_v1", slow("bearing_v2"), slow("bearing_v3")],
)
def test_fmpy_simulates_each_fmu_as_it_comes(name, fmus, tmp_path):
    out = tmp_path / "out.csv"
    variables = ["amplitude.max", "bearing[1].journal.y"] if name == "rotor_small" else ["h_min", "wrench.Fy"]
    command = [sys.executable, "-m", "fmpy", "simulate", str(fmus / f"{name}.fmu"), "--stop-time", "0.02"]
    command += ["--step-size", "1e-4", "--output-interval", "1e-3", "--output-file", str(out)]
    command += ["--output-variables", *variables]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    values = np.genfromtxt(out, delimiter=",", names=True, deletechars="")
    assert len(values) == 21
    for variable in variables:
        assert np.all(np.isfinite(values[variable])) and np.all(values[variable] != 0.0)
