"""The command stability where bearings stand on pedestals, and which modes it shows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from rich.console import Console

from orchestrator.commands.stability import run
from orchestrator.linear import response
from orchestrator.linear.case import LinearRequest
from orchestrator.linear.operating_point import OperatingPoint, bearing_data
from orchestrator.linear.stability import standing
from orchestrator.results.quantities import HERTZ
from rotor_fmu.linear.analysis import REACH, LinearBearings
from rotor_fmu.train.file import load_train
from rotor_fmu.train.seat import Pedestal

FAN = "tests/examples/fan"
FILM = 1e8  # N/m


def on_pedestals(train, speed):
    stiffness = np.tile(FILM * np.eye(4), (len(train.bearings), 1, 1))
    bearings = LinearBearings(stiffness, np.zeros_like(stiffness))
    point = OperatingPoint(bearings, np.zeros((len(train.bearings), 2)))
    return standing(bearing_data({speed: point}, train, "films"), train)


def test_film_and_pedestal_are_springs_in_series():
    train = load_train(FAN)
    pedestal = Pedestal(mass=(100.0, 100.0), stiffness=(5e7, 2e8))
    soft = replace(train.bearings[0], pedestal=pedestal)
    firm = replace(train.bearings[1], pedestal=None)
    speed = 200.0
    found = on_pedestals(replace(train, bearings=(soft, firm)), speed)["stiffness_on_pedestal"]
    for axis, spring in (("x", 5e7), ("y", 2e8)):
        below = spring - 100.0 * speed**2
        direct = found.sel(wrench=f"F{axis}", displacement=axis).values[0]
        assert direct == pytest.approx([FILM * below / (FILM + below), FILM])
    assert np.isnan(found.sel(wrench="Mx", displacement="tilt_x")).all()


def test_without_pedestals_there_is_nothing_to_add():
    train = load_train("small")
    assert "stiffness_on_pedestal" not in on_pedestals(train, 100.0)


def test_modes_shown_are_those_that_count(tmp_path, monkeypatch):
    monkeypatch.setattr(response, "INTERVALS", 30)
    request = LinearRequest("stability", f"{FAN}/loss.toml", "v3", tmp_path / "out", formats=("svg",))
    assert run(request, Console(quiet=True), highest=50.0) == 0
    modes = xr.load_dataset(tmp_path / "out" / "stability.nc")
    counts = (modes["frequency"] <= REACH * modes["rotation"]) | (modes["log_decrement"] < 0.0)
    assert counts.any("rotation").all()
    bearings = xr.load_dataset(tmp_path / "out" / "bearings.nc")
    rated = bearings.sel(rotation=load_train(FAN).speed / HERTZ, wrench="Fy", displacement="y")
    both, film = rated["stiffness_on_pedestal"].values, rated["stiffness"].values
    assert (both > 0.0).all() and both[1] < film[1] and (both < 1.2e8).all()  # softer than any pedestal
    assert "bearings on pedestals, Kyy over speed" in (tmp_path / "out" / "stability.svg").read_text()
