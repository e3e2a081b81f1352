"""What is drawn over time shows the record: data, labels and units of the axes, not pixels."""

import numpy as np
import pytest

from orchestrator.results import statistics
from orchestrator.results.figures import style
from orchestrator.results.figures.forces_and_moments import forces_and_moments
from orchestrator.results.figures.least_gap import least_gap
from orchestrator.results.figures.overview import overview
from orchestrator.results.figures.shaft_maxima import normal_stress, vibration_amplitude
from tests.orchestrator.results import synthetic_record
from tests.orchestrator.results.figures.axes import line, panel_axes

BEARING = "LP2-front"


DEPTHS = ("v1", "v2", "v3")


def test_forces_and_moments_equal_the_record(record):
    grid = panel_axes(forces_and_moments([record]))
    assert [axes.get_ylabel() for axes in grid] == ["bearing force [MN]", "", "bearing moment [MN m]", ""]
    assert [axes.get_xlabel() for axes in grid] == ["", "", "time [s]", "time after the fracture [ms]"]
    for axes, name in ((grid[0], "force"), (grid[2], "moment")):
        drawn = line(axes, style.depth_name("v1"))
        np.testing.assert_array_equal(drawn.get_xdata(), record["time"].values)
        expected = statistics.magnitude(record, name, BEARING) * 1e-6
        np.testing.assert_allclose(drawn.get_ydata(), expected, rtol=1e-15)
    near = line(grid[1], style.depth_name("v1"))
    np.testing.assert_allclose(near.get_xdata(), (record["time"].values - 1.0) * 1e3, atol=1e-9)


def test_an_axis_without_moments_has_the_unit_of_the_forces(record):
    small = record.copy()
    for name in record.data_vars:
        if str(name).startswith("moment"):
            small[name] = 0.0 * record[name]
        if str(name).startswith("force"):
            small[name] = 1e-4 * record[name]
    grid = panel_axes(forces_and_moments([small]))
    force, moment = grid[0].get_ylabel(), grid[2].get_ylabel()
    assert (force, moment) == ("bearing force [kN]", "bearing moment [kN m]")


def test_peaks_between_samples_are_drawn_and_marked(record):
    axes = panel_axes(forces_and_moments([record]))[0]
    extremes = statistics.series(record, "force_magnitude_max", BEARING) * 1e-6
    band = next(c for c in axes.collections if c.get_label() == "up to the extreme between samples")
    assert band.get_datalim(axes.transData).ymax == pytest.approx(extremes.max())
    marks = [found for found in axes.lines if found.get_marker() == "v"]
    assert [float(m.get_ydata()[0]) for m in marks] == [pytest.approx(extremes.max())]
    assert axes.get_ylim()[1] > extremes.max()


def test_a_named_bearing_is_shown(record):
    figure = forces_and_moments([record], "HP-front")
    assert "HP-front" in figure.get_suptitle()
    drawn = line(panel_axes(figure)[0], style.depth_name("v1")).get_ydata()
    np.testing.assert_allclose(drawn, statistics.magnitude(record, "force", "HP-front") * 1e-6)


def test_least_gap_shows_film_and_centre_line_in_micrometres(record):
    left, right = panel_axes(least_gap([record]))
    assert left.get_ylabel() == "least gap [µm]"
    film = line(left, f"whole film, {style.depth_name('v1')}")
    centre = line(left, "centre line")
    np.testing.assert_allclose(film.get_ydata(), statistics.series(record, "least_gap", BEARING) * 1e6)
    np.testing.assert_allclose(
        centre.get_ydata(), statistics.series(record, "centre_line_gap", BEARING) * 1e6
    )
    assert any(c.get_label() == "solid contact" for c in left.collections)
    assert right.get_xlim() == pytest.approx((-80.0, 240.0))


def test_an_aligned_film_has_one_gap_and_no_contact_here(records):
    axes = panel_axes(least_gap([records[2]]))[0]
    labels = axes.get_legend_handles_labels()[1]
    assert "centre line" not in labels and "solid contact" not in labels


@pytest.mark.parametrize(
    ("draw", "name", "label", "factor"),
    [
        (vibration_amplitude, "vibration_amplitude_max", "vibration amplitude [mm]", 1e3),
        (normal_stress, "normal_stress_max", "normal stress [N/mm²]", 1e-6),
    ],
)
def test_shaft_maxima_equal_the_record(record, draw, name, label, factor):
    left, right = panel_axes(draw([record]))
    assert left.get_ylabel() == label
    for axes in (left, right):
        drawn = line(axes, style.depth_name("v1")).get_ydata()
        np.testing.assert_allclose(drawn, record[name].values * factor)


def test_several_runs_share_scales_and_keep_their_colours(records):
    grid = panel_axes(vibration_amplitude(records))
    assert len(grid) == 6
    assert len({axes.get_ylim() for axes in grid}) == 1
    for axes, depth in zip(grid[::2], DEPTHS, strict=True):
        assert line(axes, style.depth_name(depth)).get_color() == style.colour_of(depth)
        assert axes.get_title(loc="left").startswith(f"{depth.upper()}: ")
    forces = panel_axes(forces_and_moments(records))
    assert len(forces) == 8
    assert len({axes.get_ylim() for axes in forces[:4]}) == 1
    near = [line(forces[3], style.depth_name(depth)).get_color() for depth in DEPTHS]
    assert near == [style.colour_of(depth) for depth in DEPTHS]


def test_all_data_are_inside_the_axes(records):
    full = (forces_and_moments(records), normal_stress(records), vibration_amplitude(records))
    grids = [panel_axes(figure) for figure in full]
    # The close-ups of gaps are cut off on purpose.
    for grid in [*grids, panel_axes(least_gap(records))[::2], panel_axes(overview(records))[::2]]:
        for axes in grid:
            low, high = axes.get_ylim()
            for drawn in axes.lines:
                values = np.asarray(drawn.get_ydata(), dtype=float)
                if drawn.get_transform() == axes.transData:
                    assert low <= values.min() and values.max() <= high


def test_overview_has_a_row_for_each_bearing(record):
    grid = panel_axes(overview([record]))
    assert [axes.get_ylabel() for axes in grid[::2]] == list(synthetic_record.NAMES)
    assert [axes.get_title(loc="left") for axes in grid[:2]] == ["bearing force [MN]", "least gap [µm]"]
    for row, name in enumerate(synthetic_record.NAMES):
        drawn = line(grid[2 * row + 1], style.depth_name("v1")).get_ydata()
        np.testing.assert_allclose(drawn, statistics.series(record, "least_gap", name) * 1e6)


def test_legends_lie_outside_the_panels(record):
    figure = forces_and_moments([record])
    figure.canvas.draw()
    (legend,) = figure.legends
    box = legend.get_window_extent()
    for axes in panel_axes(figure):
        assert not axes.get_window_extent().overlaps(box)
        assert axes.get_legend() is None
