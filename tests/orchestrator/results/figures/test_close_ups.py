"""Where a figure looks closer, what it marks there and what it cuts off."""

import pytest
import xarray as xr

from orchestrator.results.figures import panels, style
from orchestrator.results.figures.least_gap import least_gap
from orchestrator.results.figures.overview import overview
from tests.orchestrator.results import synthetic_record
from tests.orchestrator.results.figures.axes import panel_axes

BEARING = "LP2-front"


DEPTHS = ("v1", "v2", "v3")


def test_close_ups_of_gaps_show_what_happens_near_the_surfaces(record):
    leaping = record.copy()
    for name in ("least_gap", "centre_line_gap"):
        leaping[name] = record[name] * xr.where(record["time"] > 1.0, 5.0, 1.0)
    before = leaping.sel(time=slice(0.92, 1.0))
    for figure, name, at in (
        (least_gap([leaping]), "centre_line_gap", [BEARING]),
        (overview([leaping]), "least_gap", list(synthetic_record.NAMES)),
    ):
        low, high = panel_axes(figure)[1].get_ylim()
        assert low < 0.0
        assert high == pytest.approx(1.5e6 * float(before[name].sel(bearing=at).max()))


def test_the_event_is_marked_where_it_is(record):
    for figure, scale in ((least_gap([record]), 1.0), (overview([record]), 1.0)):
        event = [found for found in panel_axes(figure)[0].lines if found.get_color() == style.EVENT]
        assert list(event[0].get_xdata()) == [scale, scale]


def test_a_run_without_event_has_no_mark_and_shows_its_end():
    record = synthetic_record.record(end=0.5, fracture=None)
    left, right = panel_axes(least_gap([record]))
    assert not [found for found in left.lines if found.get_color() == style.EVENT]
    assert right.get_xlabel() == "time before the end [ms]"
    assert right.get_xlim() == pytest.approx((-240.0, 0.0))


def test_close_up_follows_the_speed(record):
    faster = record.assign_attrs(speed=2 * record.attrs["speed"])
    view = panels.close_up([faster])
    assert (view.start, view.end) == pytest.approx((0.96, 1.12))


def test_what_is_cut_off_is_marked(record):
    leaping = record.copy()
    leaping["least_gap"] = record["least_gap"] * xr.where(record["time"] > 1.0, 5.0, 1.0)
    near = panel_axes(least_gap([leaping]))[1]
    assert any(text.get_text().startswith("▲ cut off, up to") for text in near.texts)
    assert not [text for text in panel_axes(least_gap([leaping]))[0].texts if "cut off" in text.get_text()]
