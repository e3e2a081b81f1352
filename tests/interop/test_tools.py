"""The same SSP in other tools and in the orchestrator."""

import subprocess
import sys

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
from tests.interop.tools import LAG, TOOLS, forces, missing, start

H = 1e-4


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


@pytest.mark.parametrize("tool", TOOLS)
def test_small_train_through_the_fracture(tool, exported, small, tmp_path, record_property):
    found = forces(tool, exported[0], H, 0.2, tmp_path / "forces.npz")
    error = relative_error(tool, found, *small)
    record_property("rms_error", error)
    assert error < 0.01


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
    ("event", "step", "late"),
    [({}, 1e-4, 0.01), ({"time": 0.02003}, 1e-4, 0.04), ({"time": 0.02003}, 5e-5, 0.01)],
    ids=["calm", "fracture", "fracture, half the step"],
)
def test_turbine_train(event, step, late, turbine_fmus, tmp_path, record_property):
    """The first 50 ms of the reference scenario, also with the fracture and solid contact moved into them.

    Units that step all at once, each a step late, are allowed `late`.
    """
    scenario = load_scenario("paper", {"end": 0.05, "event": event} if event else {"end": 1.05})
    ssp, _ = export(scenario, turbine_fmus, tmp_path / "turbine.ssp", "turbine")
    expected = reference(ssp, 0.05)
    for tool in (tool for tool in TOOLS if not missing(tool)):
        found = forces(tool, ssp, step, 0.05, tmp_path / "forces.npz")
        error = relative_error(tool, found, *expected, step=step)
        record_property(f"rms_error_{tool}", error)
        assert error < (late if LAG[tool] else 0.01), tool


@pytest.fixture(scope="module")
def turbine_fmus(tmp_path_factory):
    folder = tmp_path_factory.mktemp("turbine")
    build(folder, [train_of(load_scenario("paper"))], names=("v1",))
    return folder


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


@pytest.mark.parametrize("tool", TOOLS)
def test_eleven_bearings_of_each_depth_in_one_process(tool, fmus, tmp_path):
    """Each with a clearance of its own; all tools give the orchestrator's own unit's forces to the bit."""
    clearances = {f"{depth}_{k}": 8e-4 + 1e-5 * k for depth in ("v1", "v2", "v3") for k in range(11)}
    ssp = alone(fmus, tmp_path, {n: (n[:2], {"clearance": c}) for n, c in clearances.items()})
    found = forces(tool, ssp, H, 5 * H, tmp_path / "forces.npz")
    assert set(found) == set(clearances)
    expected = forces("fmpy", ssp, H, 5 * H, tmp_path / "expected.npz")
    for name, series in found.items():
        np.testing.assert_array_equal(series, expected[name])
    for depth in ("v1", "v2", "v3"):  # aligned, V1 and V2 may agree to the last bit
        own = {series[-1, 1] for name, series in found.items() if name.startswith(depth)}
        assert len(own) == 11


@pytest.mark.parametrize("tool", TOOLS)
def test_a_wrong_parameter_is_refused_with_its_reason_in_the_log(tool, fmus, tmp_path):
    ssp = alone(fmus, tmp_path, {"bad": ("v3", {"clearance": -1.0})})
    done = start(tool, ssp, H, 5 * H, tmp_path / "forces.npz")
    if tool == "ecos":  # steps on over a discard, with the log of units switched off: NaN is all it tells
        assert done.returncode == 0, done.stderr
        with np.load(tmp_path / "forces.npz") as file:
            assert np.all(np.isnan(file["forces"]))
        return
    assert done.returncode > 0, done.returncode
    assert "clearance" in done.stdout + done.stderr


@pytest.mark.parametrize("name", ["rotor_small", "bearing_v1", "bearing_v2", "bearing_v3"])
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
