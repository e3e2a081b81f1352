"""Rotors of the literature, entered as printed, through the commands: on given stiffness and damping."""

from __future__ import annotations

import pytest
import xarray as xr
from typer.testing import CliRunner

from orchestrator.cli.main import app
from orchestrator.linear import case
from tests.rotor_fmu.published import DAMPED, FRISWELL, LALANNE, OVERHUNG


@pytest.fixture
def said(tmp_path, monkeypatch):
    """Run a command on a rotor in a folder of its own, but draw nothing; returns the results of that name."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(case, "save", lambda *_: None)

    def run(rotor, rpm, *arguments):
        name = "-".join([arguments[0], *(["supported"] if "--supported" in arguments else [])])
        train = tmp_path / rotor.name
        if not train.exists():
            rotor.write(train, rpm)
        result = CliRunner().invoke(app, [arguments[0], str(train), *arguments[1:]], env={"TERM": "dumb"})
        assert result.exit_code == 0, result.output
        with xr.open_dataset(tmp_path / f"results/{rotor.name}-{name}/{name}.nc", engine="h5netcdf") as found:
            return found.load()

    return run


@pytest.mark.parametrize(
    ("rotor", "rpm"), [(LALANNE, 25000), (FRISWELL, 4000), (DAMPED, 4000), (OVERHUNG, 4000)]
)
def test_modes_are_those_printed(said, rotor, rpm):
    count = len(rotor.frequency[rpm])
    found = said(rotor, rpm, "modes", "--count", str(count))
    assert found["frequency"].values == pytest.approx(rotor.frequency[rpm], rel=2e-5)
    if rotor.damping_ratio:
        assert found["damping_ratio"].values == pytest.approx(rotor.damping_ratio, abs=6e-5)


@pytest.mark.parametrize(("rotor", "rpm", "count"), [(LALANNE, 25000, 5), (FRISWELL, 4000, 4)])
def test_the_campbell_diagram_goes_through_the_printed_frequencies(said, rotor, rpm, count):
    found = said(rotor, rpm, "campbell", "--supported", "--count", str(count), "--to", repr(rpm / 60.0))
    found = found["frequency"].sel(shaft="unreduced")
    for rpm, expected in rotor.frequency.items():
        here = found.sel(rotation=rpm / 60.0, method="nearest").values
        assert sorted(here)[: len(expected)] == pytest.approx(expected, rel=2e-5)
