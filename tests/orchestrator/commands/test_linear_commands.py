"""The commands campbell, modes, harmonic and reductions on the small train."""

from __future__ import annotations

import csv
import math
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from rich.console import Console
from typer.testing import CliRunner

from fmus.port import Failure
from orchestrator.cli.main import app
from orchestrator.errors import EquilibriumError
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.folder import fmu_folder
from orchestrator.fmi.unit import Status, UnitError
from orchestrator.linear import campbell, response
from orchestrator.linear import case as linear_case
from orchestrator.master.assembly import assemble
from orchestrator.master.start.equilibrium import find_start
from orchestrator.outcome import INPUT_ERROR, Outcome
from orchestrator.results.figures.campbell import free_figure
from orchestrator.results.manifest import MANIFEST
from orchestrator.scenario.file import load_scenario, train_of
from rotor_fmu.train.file import load_train
from tests.faults import fault

COMMANDS = {
    "campbell": ("campbell", "small", "--count", "4"),
    "campbell-supported": ("campbell", "small", "--supported", "--count", "4"),
    "modes": ("modes", "small", "--count", "6"),
    "stability": ("stability", "small", "--depth", "v3", "--to", "60"),
    "harmonic": ("harmonic", "small", "--to", "60"),
    "reductions": ("reductions", "small"),
}


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Run a command once and return its folder, with results/ and what it printed.

    Diagrams have half their points.
    """
    folder = tmp_path_factory.mktemp("linear")

    def run(name):
        said = folder / f"{name}.said"
        if not said.exists():
            with pytest.MonkeyPatch.context() as patch:
                patch.chdir(folder)
                patch.setattr(response, "INTERVALS", 60)
                patch.setattr(campbell, "FREE_STEPS", 10)
                patch.setattr(campbell, "SUPPORTED_STEPS", 12)
                result = CliRunner().invoke(app, [*COMMANDS[name]], env={"COLUMNS": "100", "TERM": "dumb"})
            assert result.exit_code == 0, result.output
            said.write_text(result.output)
        return folder

    return run


@pytest.fixture(scope="module")
def folder(results):
    """The folder with the results of all commands."""
    return {results(name) for name in COMMANDS}.pop()


def data(folder, command, name=None):
    with xr.open_dataset(
        folder / f"results/small-{command}/{name or command}.nc", engine="h5netcdf"
    ) as found:
        return found.load()


@pytest.mark.parametrize("command", COMMANDS)
def test_every_file_is_written_and_named(results, command):
    folder = results(command)
    said = (folder / f"{command}.said").read_text()
    named = re.findall(r"^results/\S+$", said, flags=re.MULTILINE)
    written = sorted(
        path.relative_to(folder).as_posix()
        for path in (folder / f"results/small-{command}").iterdir()
        if path.name != MANIFEST
    )
    assert sorted(named) == written
    expected = {f"{command}.nc", f"{command}.csv", f"{command}.txt"}
    expected |= set() if command == "reductions" else {f"{command}.png"}
    assert expected <= {Path(path).name for path in written}
    for path in written:
        assert (folder / path).stat().st_size > 100


@pytest.mark.parametrize("command", COMMANDS)
def test_data_carry_units_and_what_they_are_of(folder, command):
    for path in (folder / f"results/small-{command}").glob("*.nc"):
        found = data(folder, command, path.stem)
        assert found.attrs["train"] == "small" and found.attrs["title"]
        assert 'train = "small"' in found.attrs["scenario"]
        for name, variable in found.data_vars.items():
            assert variable.attrs["units"], f"{path.name}: {name}"
        with path.with_suffix(".csv").open(newline="") as file:
            head, *lines = csv.reader(file)
        assert len(lines) == math.prod(found.sizes.values())
        for name, variable in found.data_vars.items():
            assert f"{name} [{variable.attrs['units']}]" in head


def test_free_campbell_errors_are_those_of_the_frequencies(folder):
    found = data(folder, "campbell")
    assert found["rotation"].values[[0, -1]] == pytest.approx([0.0, 100.0])  # twice the rated speed
    exact = found["frequency"].sel(shaft="unreduced")
    assert np.all(exact.sel(direction="forward")[1:] > exact.sel(direction="backward")[1:])
    expected = found["frequency"] / exact - 1.0
    assert found["error"].values == pytest.approx(expected.values, abs=1e-12)
    worst = abs(found["error"]).max(["rotation", "direction", "mode"])
    assert float(worst.sel(shaft="irs")) < 1e-4 < float(worst.sel(shaft="guyan"))
    assert data(folder, "campbell", "irs-iterations").sizes["iteration"] == 51


def test_unreduced_modes_are_the_same_in_both_commands(folder):
    modes, diagram = data(folder, "modes"), data(folder, "campbell-supported")
    here = diagram.sel(shaft="unreduced").sel(rotation=50.0, method="nearest")
    for name in ("frequency", "damping_ratio", "whirl_direction"):
        assert modes[name].values == pytest.approx(here[name].values[:6], rel=1e-6, abs=1e-8)


def test_mode_shapes_are_scaled_to_their_largest_orbit(folder):
    modes = data(folder, "modes")
    x, y = (modes[f"{axis}_real"] + 1j * modes[f"{axis}_imaginary"] for axis in "xy")
    major = (abs(x + 1j * y) + abs(x - 1j * y)) / 2.0
    assert major.max("node").values == pytest.approx(np.ones(6))


def test_response_at_rated_speed_is_the_orbit_that_a_run_starts_from(folder):
    """The rotor unit's 1X orbit on the affine laws, found by its own reduced solution."""
    scenario = load_scenario("small")
    train = train_of(scenario)
    with FmuStore() as store:
        system = assemble(scenario, train, fmu_folder(), store)
        try:
            start = find_start(system, train, train.speed)
        finally:
            system.close()
    x, y = (start.cosine[:, i] - 1j * start.sine[:, i] for i in range(2))
    expected = (np.abs(x + 1j * y) + np.abs(x - 1j * y)) / 2.0
    found = data(folder, "harmonic", "amplitudes")["amplitude"].sel(shaft="unreduced")
    found = found.sel(rotation=50.0, method="nearest")
    assert found.sel(place=[seat.name for seat in train.bearings]).values == pytest.approx(expected, rel=1e-6)


def test_bearings_of_the_operating_point_are_written(folder):
    found = data(folder, "modes", "bearings")
    assert found["stiffness"].dims == ("rotation", "bearing", "wrench", "displacement")
    assert np.all(found["stiffness"].sel(wrench="Fy", displacement="y") > 0.0)
    assert np.all(found["damping"].sel(wrench="Fy", displacement="y") > 0.0)


def test_films_are_those_of_each_speed(folder):
    """Stiffness over speed is not that of rated speed: the film stiffens as the journal sinks."""
    found = data(folder, "campbell-supported", "bearings")["stiffness"].sel(wrench="Fy", displacement="y")
    over = found.sel(rotation=[20.0, 50.0, 100.0], method="nearest").isel(bearing=0).values
    assert over[0] > 1.5 * over[1] > 1.5 * 1.2 * over[2] > 0.0


def test_stability_is_that_of_the_modes_and_names_margins(folder):
    found = data(folder, "stability").sel(rotation=50.0, method="nearest")
    decrement = 2.0 * np.pi * found["damping_ratio"] / np.sqrt(1.0 - found["damping_ratio"] ** 2)
    assert found["log_decrement"].values == pytest.approx(decrement.values)
    said = re.sub(r"\s+", " ", (folder / "stability.said").read_text())
    assert "Stable at 50 Hz of rotation: least damped is the mode of" in said
    assert "No threshold between" in said and "API 684 SP6.8.2.10" in said and " kept" in said
    peaks = data(folder, "stability", "critical-speeds")
    chart = data(folder, "stability", "critical-speed-map")
    assert peaks.sizes["critical"] >= 1 and np.all(np.diff(chart["critical_speed"].values[:, 0]) > 0.0)


def test_probes_see_the_orbit_and_its_phase(folder):
    """A probe between x and y sees their phasors added; the peak is among the speeds."""
    probes = data(folder, "harmonic", "probes")
    phasor = probes["amplitude"] * np.exp(1j * probes["phase"])
    x, y, at = (phasor.sel(probe=name) for name in ("x", "y", "45 deg"))
    assert np.allclose(at, (x + y) / np.sqrt(2.0), rtol=1e-9)
    largest = data(folder, "harmonic")["amplitude"].sel(shaft="unreduced").values
    k = int(np.argmax(largest))
    assert largest[k] > largest[k - 1] and largest[k] > largest[k + 1]
    assert largest[k - 1] / largest[k] > 0.99  # no flank is jumped over


def test_reductions_report_where_each_is_exact(folder):
    error = data(folder, "reductions")["error"].max("rotation")
    static = error.sel(quantity="static bearing loads")
    assert float(static.sel(shaft="irs")) < 1e-9 < float(static.sel(shaft="irs-plain"))
    said = (folder / "reductions.said").read_text()
    assert "Iterated IRS" in said and "bearing forces from unbalance" in said


def test_figure_axes_are_labelled_and_legends_lie_beside_the_data(folder):
    figure = free_figure(
        data(folder, "campbell"), data(folder, "campbell", "irs-iterations"), load_train("small")
    )
    figure.canvas.draw()
    assert all(axes.get_xlabel() and axes.get_ylabel() for axes in figure.axes)
    diagram = figure.axes[0]
    assert (diagram.get_xlabel(), diagram.get_ylabel()) == ("speed of rotation [Hz]", "frequency [Hz]")
    for axes in figure.axes:
        inside = axes.get_window_extent().shrunk(0.999, 0.999)
        assert not inside.overlaps(axes.get_legend().get_window_extent())


@pytest.mark.parametrize("command", ["campbell", "modes", "stability", "harmonic", "reductions"])
def test_help_teaches(command):
    text = CliRunner().invoke(app, [command, "--help"], env={"COLUMNS": "120", "TERM": "dumb"}).output
    assert f"bladeloss {command}" in text and "Exit status" in text and "--depth" in text


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (("campbell", "nothing"), ("nothing", "turbine")),
        (("modes", "nowhere.toml"), ("nowhere.toml", "paper")),
        (("harmonic", "small", "--to", "-3"), ("--to", "1")),
        (("campbell", "small", "--count", "20"), ("--count 20", "ask for fewer")),
        (("modes", "small", "--depth", "v9"), ("--depth", "v9", "v1")),
    ],
)
def test_wrong_input_is_named_and_leaves_nothing(tmp_path, monkeypatch, arguments, named):
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(app, [*arguments], env={"COLUMNS": "200", "TERM": "dumb"})
    assert result.exit_code == INPUT_ERROR, result.output
    text = re.sub(r"\s+", " ", result.output)
    assert all(word in text for word in named)
    assert list(tmp_path.iterdir()) == []


FAILURES = [
    pytest.param(
        EquilibriumError("front: no film at the trial position"),
        Outcome.NO_EQUILIBRIUM,
        marks=fault(
            "film",
            "a linear analysis without an equilibrium to linearise at",
            "exit 3; bearing, advice; nothing is written",
            guard="orchestrator.cli.options:guarded",
        ),
    ),
    pytest.param(
        UnitError("front", "fmi2GetReal", Status.DISCARD, "NO_SOLUTION", Failure.FILM),
        Outcome.FILM_FAILED,
        marks=fault(
            "film",
            "a film that fails in a linear analysis",
            "exit 11; bearing, reason, advice; nothing is written",
            guard="orchestrator.cli.options:guarded",
        ),
    ),
]


@pytest.mark.parametrize(("error", "outcome"), FAILURES)
def test_a_start_that_fails_has_its_own_exit_status(folder, tmp_path, monkeypatch, error, outcome):
    def fail(*_):
        raise error

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(linear_case, "operating_point", fail)
    result = CliRunner().invoke(app, ["modes", "small"])
    assert result.exit_code == outcome.status
    assert f"error: {error}. {outcome.advice}" in result.output
    assert list(tmp_path.iterdir()) == []


def test_depth_and_unbalance_come_from_the_scenario(tmp_path):
    text = 'train = "small"\nend = 0.1\ndepth = "v3"\n[unbalance]\ngrade = 5e-3\n[unbalance.at.wheel-2]\n'
    (tmp_path / "mine.toml").write_text(text + "unbalance = 0.01\nphase = 1.5\n")
    request = linear_case.LinearRequest("modes", str(tmp_path / "mine.toml"), out=tmp_path / "out")
    case = linear_case.linear_case(request, Console(quiet=True))
    train = case.train
    expected = np.array(train.nominal_unbalance, complex) * 5e-3 / train.balance_grade
    expected *= np.exp(1j * np.array([wheel.unbalance_phase for wheel in train.wheels]))
    expected[[wheel.name for wheel in train.wheels].index("wheel-2")] = 0.01 * np.exp(1.5j)
    assert case.unbalance == pytest.approx(expected)
    assert "V3" in case.films
