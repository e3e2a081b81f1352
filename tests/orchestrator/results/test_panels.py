"""Names of events beside their marks."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

from orchestrator.results.figures import panels
from orchestrator.results.figures.event_marks import draw_events
from orchestrator.scenario.events import BladeLoss
from orchestrator.scenario.schedule import Schedule


@pytest.mark.parametrize(
    ("times", "angle"),
    [((0.75,), 0.0), ((0.05,), 90.0), ((0.5, 0.55), 90.0), ((0.4, 0.8), 0.0)],
    ids=["alone", "early", "close together", "far apart"],
)
def test_names_that_would_lie_over_an_axis_or_one_another_stand_upright(times, angle):
    schedule = Schedule(157.0, tuple(BladeLoss(wheel="fan", unbalance=1.0, time=time) for time in times))
    record = xr.Dataset(coords={"time": np.linspace(0.0, 1.5, 4)}, attrs=schedule.attributes())
    axes = Figure((8.0, 3.0)).add_subplot()
    draw_events(axes, panels.View(0.0, 1.5, 0.0, 1.0, "time [s]"), record)
    assert [text.get_rotation() for text in axes.texts] == [angle] * len(times)


def test_names_of_events_next_to_one_another_are_joined():
    schedule = Schedule(157.0, tuple(BladeLoss(wheel="fan", unbalance=1.0, time=t) for t in (0.5, 0.51, 1.0)))
    record = xr.Dataset(coords={"time": np.linspace(0.0, 1.5, 4)}, attrs=schedule.attributes())
    axes = Figure((8.0, 3.0)).add_subplot()
    draw_events(axes, panels.View(0.0, 1.5, 0.0, 1.0, "time [s]"), record)
    assert [text.get_text() for text in axes.texts] == ["blade fracture, blade fracture", "blade fracture"]
    assert len(axes.lines) == 3
