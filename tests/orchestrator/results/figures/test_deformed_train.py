"""The picture of the deformed train: its scale, its stresses, the names of its bearings."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.collections import PolyCollection

from orchestrator.results.figures.deformation import dynamic_deflection, worst_instant
from orchestrator.results.figures.deformed_train import deformed_train
from orchestrator.results.figures.spread import spread
from tests.orchestrator.results import synthetic_record
from tests.orchestrator.results.figures.axes import panel_axes

BEARING = "LP2-front"


DEPTHS = ("v1", "v2", "v3")


def test_deformed_train_is_drawn_at_its_scale(record, train):
    figure = deformed_train([record], train)
    index = worst_instant(record)
    force = record["force"].isel(time=index)
    assert float(np.hypot(force[..., 0], force[..., 1]).max()) == pytest.approx(
        float(np.hypot(record["force"][..., 0], record["force"][..., 1]).max())
    )
    vertical, horizontal = panel_axes(figure)
    assert (vertical.get_ylabel(), horizontal.get_ylabel()) == ("y [mm]", "x [mm]")
    assert horizontal.get_xlabel() == "z [m]"
    assert figure.axes[-1].get_ylabel() == "normal stress [N/mm²]"
    shaft = next(
        c for c in vertical.collections if isinstance(c, PolyCollection) and c.get_array() is not None
    )
    assert len(shaft.get_paths()) == len(train.shoulders)
    deflection = dynamic_deflection(record, index)[:, 1] * 1e3
    scale = float(vertical.get_title(loc="left").rsplit("× ", 1)[1])
    for k in (0, 100, 277):
        corners = shaft.get_paths()[k].vertices
        radius = train.shoulders[k].outer_diameter / 2 * 1e3 / scale
        assert corners[0] == pytest.approx((train.z[k], deflection[k] - radius), abs=1e-9)
        assert corners[2] == pytest.approx((train.z[k + 1], deflection[k + 1] + radius), abs=1e-9)
    assert vertical.get_aspect() == pytest.approx(scale * 1e-3)


def test_names_of_bearings_do_not_overlap(record, train):
    figure = deformed_train([record], train)
    figure.canvas.draw()
    names = [text for text in figure.axes[0].texts if text.get_text().startswith(synthetic_record.NAMES)]
    assert len(names) == len(synthetic_record.NAMES)
    for text in names:
        text.arrowprops = text.arrow_patch = None  # the extent would include the leader
    extents = sorted((text.get_window_extent() for text in names), key=lambda box: box.x0)
    for left, right in itertools.pairwise(extents):
        assert left.x1 < right.x0


def test_a_short_train_with_wide_wheels_stays_on_its_page(record, train):
    length = float(record["z"].values[-1])
    wide = replace(train, wheels=tuple(replace(w, mean_diameter=1.4 * length) for w in train.wheels))
    figure = deformed_train([record], wide)
    width, height = figure.get_size_inches()
    assert height < 1.1 * width
    figure.canvas.draw()
    vertical, _ = panel_axes(figure)
    left, right = vertical.get_xlim()
    assert left < -0.2 * length and right > 1.2 * length  # room on either side in place of height
    box = vertical.get_position()
    assert box.width * width > 0.7 * width  # the panel is as wide as others
    assert max(abs(y) for y in vertical.get_ylim()) * vertical.get_aspect() > 0.7 * length


def test_deformed_train_without_train_or_positions(record):
    assert deformed_train([record]) is not None
    with pytest.raises(ValueError, match="positions of the bearings"):
        deformed_train([record.drop_vars("bearing_z")])


def test_spread_moves_as_little_as_needed():
    assert spread([0.0, 10.0], 3.0) == [0.0, 10.0]
    assert spread([0.0, 1.0], 3.0) == [-1.0, 2.0]
    found = spread([0.0, 0.0, 0.0, 9.0], 2.0)
    assert found == pytest.approx([-2.0, 0.0, 2.0, 9.0])
    assert spread([], 1.0) == []
