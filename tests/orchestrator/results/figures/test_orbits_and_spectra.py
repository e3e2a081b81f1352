"""Orbits and spectra of the journals show the record."""

import numpy as np
import pytest

from orchestrator.results.figures.orbits import orbits
from orchestrator.results.figures.spectra import spectra, waterfall
from tests.orchestrator.results import synthetic_record
from tests.orchestrator.results.figures.axes import line, panel_axes

BEARING = "LP2-front"


DEPTHS = ("v1", "v2", "v3")


def test_orbits_of_all_bearings_lie_in_their_clearance(record):
    grid = panel_axes(orbits([record]))
    assert [axes.get_title().partition("\n")[0] for axes in grid[:11]] == list(synthetic_record.NAMES)
    axes = grid[synthetic_record.NAMES.index(BEARING)]
    motion = (record["displacement"] - record["offset"]).sel(bearing=BEARING).values * 1e6
    before = line(axes, "before")
    span = (record["time"].values >= 0.92 - 1e-9) & (record["time"].values < 1.0 + 1e-9)
    drawn = np.column_stack(before.get_data())
    assert abs(len(drawn) - span.sum()) <= 1
    assert {tuple(p) for p in drawn.round(6)} <= {tuple(p) for p in motion.round(6)}
    circle = np.hypot(*line(axes, "clearance").get_data())
    np.testing.assert_allclose(circle, synthetic_record.CLEARANCE * 1e6)
    styles = {found.get_label(): (found.get_color(), found.get_linestyle()) for found in axes.lines}
    assert len(set(styles.values())) == len(styles)  # also in grey print


def test_orbits_of_several_runs_have_one_scale(records):
    grid = panel_axes(orbits(records, BEARING))
    assert len({axes.get_xlim() for axes in grid[:3]}) == 1
    assert [axes.get_title()[:4] for axes in grid[:3]] == ["V1: ", "V2: ", "V3: "]


def test_spectra_and_waterfall_read_the_unbalance(record):
    axes = panel_axes(spectra([record], BEARING))[0]
    before = line(axes, "before")
    x = (record["displacement"] - record["offset"]).sel(bearing=BEARING).isel(time=slice(200, 1000))
    signal = (x.values @ [np.sqrt(0.5), np.sqrt(0.5)]) * 1e6
    at = int(np.argmin(abs(before.get_xdata() - 25.0)))
    assert before.get_ydata()[at] == pytest.approx(np.ptp(signal) / 2, rel=1e-3)
    assert {found.get_linestyle() for found in axes.lines if found.get_label() in ("before", "after")} == {
        "--", "-",
    }  # fmt: skip
    (mesh,) = panel_axes(waterfall([record], BEARING))[0].collections
    both = [[record, record.isel(time=slice(0, 700))], [record.isel(time=slice(0, 700)), record]]
    limits = {axes.get_ylim() for pair in both for axes in panel_axes(waterfall(pair, BEARING))[:2]}
    assert limits == {panel_axes(waterfall([record], BEARING))[0].get_ylim()}  # of the longer one
    loudest = mesh.get_array().argmax() % mesh.get_array().shape[1]
    assert loudest == pytest.approx(25.0 * 0.32 - 1, abs=0.1)  # lines 3.125 Hz apart from the first on
