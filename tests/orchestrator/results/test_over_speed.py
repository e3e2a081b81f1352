"""What is drawn of runs whose speed changes, and of records that are far apart."""

import numpy as np
import pytest
import xarray as xr

from orchestrator.results.figures.over_speed import has_speeds, over_speed
from orchestrator.results.journals import probe_spectrum, probe_waterfall
from orchestrator.results.windows import Window, changing_speed, speed_in
from tests.orchestrator.results import synthetic_record

TIME = np.arange(0.0, 2.0, 1e-3)


def with_speed(values):
    return xr.Dataset({"rotation_speed": ("time", values)}, {"time": TIME})


def test_a_speed_changes_or_stays():
    assert changing_speed(xr.Dataset()) is None
    assert changing_speed(with_speed(np.full(TIME.size, 157.0))) is None
    falling = with_speed(-157.0 + 20.0 * TIME)
    np.testing.assert_array_equal(changing_speed(falling), np.abs(falling["rotation_speed"].values))
    assert not has_speeds([falling])  # without its revolutions
    steady = xr.Dataset(coords={"time": TIME}, attrs={"speed": -157.0})
    assert speed_in(steady, Window(0.0, 1.0)) == 157.0
    assert speed_in(falling.assign_attrs(speed=-157.0), Window(1.0, 1.5)) == pytest.approx(132.0, abs=0.02)


@pytest.mark.parametrize("turns", [0, 1, 5])
def test_orders_are_drawn_once_there_are_some(turns):
    """A run that is interrupted in its first turns has none."""
    record = synthetic_record.record("v1").isel(time=slice(0, 200))
    count, names = record.sizes["time"], list(record["bearing"].values)
    amplitudes = np.full((turns, 3, len(names), 2, 2), 1e-5)
    amplitudes[:1] = np.nan
    ends, places = 0.04 * np.arange(1, turns + 1), ("revolution", "bearing")
    of_turns = {
        "rotation_speed": ("time", np.linspace(157.0, 140.0, count)),
        "revolution_amplitude": (("revolution", "order", "bearing", "axis", "part"), amplitudes),
        "revolution_speed": ("revolution", np.linspace(157.0, 140.0, turns)),
        "revolution_least_gap": (places, np.full((turns, len(names)), 1e-4)),
        "revolution_contact_force": (places, np.zeros((turns, len(names)))),
    }
    coordinates = {"revolution": ends, "order": [0.5, 1.0, 2.0], "part": ["real", "imaginary"]}
    figure = over_speed([record.assign(of_turns).assign_coords(coordinates)], names[0])
    sizes, _, _, contacts = figure.axes
    assert np.isfinite(sizes.get_ylim()).all()
    assert [text.get_text() for text in contacts.texts] == ["no contact"]


@pytest.mark.parametrize(("stride", "drawn"), [(1, True), (30, False)])
def test_records_further_apart_than_a_quarter_of_a_turn_have_no_spectrum(stride, drawn):
    """At 25 Hz, and records every 1 or 30 ms."""
    time, turn = TIME[::stride], 0.04
    motion = np.vstack([np.cos(2.0 * np.pi * time / turn)] * 2)
    found = probe_spectrum(time, motion, 0.0, Window(0.0, 2.0), turn)
    fall = probe_waterfall(time, motion, 0.0, turn)
    assert (found is not None) == (fall is not None) == drawn
    if drawn:
        assert found.frequency[np.argmax(found.amplitude)] == pytest.approx(25.0, rel=1e-2)
