"""The linear commands and runs on shafts of few shoulders, of a fine mesh, and without a wheel."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from orchestrator.cli.main import app
from orchestrator.linear import campbell, case, response
from orchestrator.outcome import INPUT_ERROR
from orchestrator.results.record_files import read_record
from rotor_fmu.train import writer as train_writer
from rotor_fmu.train.file import load_train
from tests.marks import slow

COMMANDS = ("modes", "campbell", "campbell --supported", "harmonic", "reductions")
METHODS = ("irs", "irs-plain", "guyan", "craig-bampton", "none")
LARGEST_ERROR = {"irs": 1e-7, "craig-bampton": 1e-7, "irs-plain": 2e-5, "guyan": 5e-3}
"""Of the forces of a run, against the largest force."""
SCENARIO = """\
train = "train"
depth = "v3"
end = 0.02
[event]
wheel = "wheel-2"
unbalance = 0.05
time = 0.01
"""
ROWS = {
    "three": [(0.25, 0.22), (0.75, 0.22), (0.25, 0.22)],
    "four": [(0.25, 0.22), (0.75, 0.22), (0.75, 0.22), (0.25, 0.22)],
    "twelve": [(0.125, 0.22)] * 2 + [(0.1875, 0.22)] * 8 + [(0.125, 0.22)] * 2,
}
BEARING = """
[[bearing]]
name = "{}"
z = {}
diameter = 0.22
width = 0.11
clearance = 0.00022
viscosity = 0.012
"""
HEAD = """
name = "{}"
speed = 314.1592653589793
balance_grade = 0.0025
[damping]
alpha = 0.2
beta = 2e-05
[materials.steel]
youngs_modulus = 210000000000.0
poisson_ratio = 0.3
density = 7850.0
"""
WHEEL = """
[[wheel]]
name = "wheel-2"
z = {}
mass = 800.0
polar_inertia = 100.0
transverse_inertia = 55.0
mean_diameter = 1.0
"""


def write_train(folder, name, rows, *, wheels=True):
    """A shaft with a wheel, in the middle or, of three shoulders, on the front bearing."""
    length = sum(row[0] for row in rows)
    text = HEAD.format(name) + BEARING.format("front", 0.25) + BEARING.format("rear", length - 0.25)
    folder.mkdir()
    (folder / "train.toml").write_text(text + WHEEL.format(0.25 if len(rows) == 3 else length / 2.0) * wheels)
    lines = [f"{length},{diameter},0,steel\n" for length, diameter in rows]
    (folder / "shaft.csv").write_text("length,outer_diameter,inner_diameter,material\n" + "".join(lines))


def finer(train, name, parts):
    """A train with every shoulder in equal parts."""

    def moved(places):
        return tuple(replace(place, node=parts * place.node) for place in places)

    shoulders = tuple(replace(s, length=s.length / parts) for s in train.shoulders for _ in range(parts))
    places = {key: moved(getattr(train, key)) for key in ("wheels", "bearings", "couplings")}
    return replace(train, name=name, shoulders=shoulders, **places)


def call(*arguments):
    return CliRunner().invoke(app, [*arguments], env={"COLUMNS": "150", "TERM": "dumb"})


@pytest.fixture(scope="module")
def shafts(tmp_path_factory):
    folder = tmp_path_factory.mktemp("shafts")
    for name, rows in ROWS.items():
        (folder / name).mkdir()
        write_train(folder / name / "train", name, rows)
        (folder / name / "s.toml").write_text(SCENARIO)
    (folder / "fine").mkdir()
    train_writer.write_train(finer(load_train("small"), "fine", 4), folder / "fine" / "train")
    (folder / "fine" / "s.toml").write_text(SCENARIO)
    return folder


@pytest.fixture
def within(shafts, monkeypatch):
    """Enter the folder of a shaft, where diagrams over speed have few of their points."""
    monkeypatch.setattr(response, "INTERVALS", 30)
    monkeypatch.setattr(response, "TRACKED_INTERVALS", 15)
    monkeypatch.setattr(campbell, "FREE_STEPS", 10)
    monkeypatch.setattr(campbell, "SUPPORTED_STEPS", 12)

    def enter(name):
        monkeypatch.chdir(shafts / name)

    return enter


WALKS = ("campbell", "campbell --supported", "harmonic")
"""Which walk over speed; that any shaft goes through `modes` and `reductions` is told at once."""


@pytest.mark.parametrize(
    ("name", "command"),
    [
        slow(name, command) if name in ("four", "fine") and command in WALKS else (name, command)
        for name in (*ROWS, "fine")
        for command in COMMANDS
    ],
)
def test_every_linear_command_works_on_every_shaft(within, name, command, monkeypatch):
    within(name)
    if name in ("twelve", "fine"):  # whose figures look like those of any train
        monkeypatch.setattr(case, "save", lambda *_: None)
    first, *options = command.split()
    result = call(first, "s.toml", *options, "--out", "-".join(command.split()))
    assert result.exit_code == 0, result.output
    kept = "Reduction: none; the shaft has" in result.output
    assert kept == (name in ("three", "four") and first != "modes")
    assert ("The shaft has 6 bending modes in each direction, not 8." in result.output) == (
        name == "three" and command == "campbell"
    )
    file = "campbell-supported" if options else first
    with xr.open_dataset(f"{'-'.join(command.split())}/{file}.nc", engine="h5netcdf") as data:
        for variable in data.data_vars.values():
            found = np.isfinite(variable)
            if "rotation" in found.dims:  # a mode may be overdamped at some speeds, then it is none
                found = found.any("rotation")
            assert found.all()
        if kept and "error" in data:
            assert float(abs(data["error"]).max()) < 1e-8
        if name == "fine" and "error" in data:
            assert float(abs(data["error"].sel(shaft="irs")).max()) < 1e-5


def forces(source, method, out):
    """Forces of a run, after a look at what it says of its reduction."""
    result = call("run", source, "--reduction", method, "--out", out, "--no-figures")
    assert result.exit_code == 0, result.output
    record = read_record(Path(out))
    used = record.attrs["reduction_used"]
    assert record.attrs["reduction"] == method
    assert (f"Reduction: {used}" in result.output) == (used != method)
    return record["force"].values, used


@pytest.mark.parametrize("method", METHODS)
def test_a_run_of_few_shoulders_keeps_them_all(within, method):
    within("three")
    Path("brief.toml").write_text(SCENARIO.replace("0.02", "0.002").replace("0.01", "0.001"))
    _, used = forces("brief.toml", method, f"run-{method}")
    if method != "none":
        assert used == "none; the shaft has 16 degrees of freedom, 220 may be kept"


@pytest.mark.slow
def test_runs_of_a_fine_mesh_agree_under_all_reductions_and_with_the_coarse_mesh(within):
    within("fine")
    full, _ = forces("s.toml", "none", "full")
    largest = np.abs(full).max()
    for method, error in LARGEST_ERROR.items():
        reduced, used = forces("s.toml", method, method)
        assert used == method
        assert np.abs(reduced - full).max() < error * largest
    Path("coarse.toml").write_text(SCENARIO.replace('"train"', '"small"'))
    coarse, _ = forces("coarse.toml", "none", "coarse")
    assert np.abs(coarse - full).max() < 5e-4 * largest


def test_a_response_to_no_unbalance_is_refused_in_a_line(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_train(tmp_path / "train", "bare", ROWS["four"], wheels=False)
    (tmp_path / "s.toml").write_text('train = "train"\nend = 0.1\n')
    (tmp_path / "still.toml").write_text('train = "small"\nend = 0.1\n[unbalance]\ngrade = 0.0\n')
    for source, train in (("s.toml", "bare"), ("still.toml", "small")):
        result = call("harmonic", source)
        assert result.exit_code == INPUT_ERROR
        assert result.output.count("\n") == 1
        assert f"error: {source}: no wheel of train {train} has an unbalance" in result.output
    assert sorted(path.name for path in tmp_path.iterdir()) == ["s.toml", "still.toml", "train"]
