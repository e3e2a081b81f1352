"""Figures show the record: data, labels and units of the axes, not pixels."""

import itertools

import numpy as np
import pytest
import xarray as xr
from matplotlib.collections import PolyCollection

from orchestrator.results import quantities, statistics
from orchestrator.results.figures import panels, style
from orchestrator.results.figures.deformation import dynamic_deflection, worst_instant
from orchestrator.results.figures.deformed_train import deformed_train
from orchestrator.results.figures.film import film_maps, steps
from orchestrator.results.figures.forces_and_moments import forces_and_moments
from orchestrator.results.figures.least_gap import least_gap
from orchestrator.results.figures.orbits import orbits
from orchestrator.results.figures.overview import overview
from orchestrator.results.figures.shaft_maxima import normal_stress, vibration_amplitude
from orchestrator.results.figures.spectra import spectra, waterfall
from orchestrator.results.figures.spread import spread
from orchestrator.results.figures.write import write_figures
from orchestrator.results.verdicts.judge import worst_bearing
from tests.orchestrator.results import synthetic_record

BEARING = "LP2-front"
DEPTHS = ("v1", "v2", "v3")


@pytest.fixture(scope="module")
def train():
    return synthetic_record.train()


@pytest.fixture(scope="module")
def records():
    return [synthetic_record.record(depth) for depth in DEPTHS]


@pytest.fixture(scope="module")
def record(records):
    return records[0]


def line(axes, label):
    return next(found for found in axes.lines if found.get_label() == label)


def panel_axes(figure):
    return [axes for axes in figure.axes if axes.get_label() != "<colorbar>"]


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


def test_overview_has_a_row_for_each_bearing(record):
    grid = panel_axes(overview([record]))
    assert [axes.get_ylabel() for axes in grid[::2]] == list(synthetic_record.NAMES)
    assert [axes.get_title(loc="left") for axes in grid[:2]] == ["bearing force [MN]", "least gap [µm]"]
    for row, name in enumerate(synthetic_record.NAMES):
        drawn = line(grid[2 * row + 1], style.depth_name("v1")).get_ydata()
        np.testing.assert_allclose(drawn, statistics.series(record, "least_gap", name) * 1e6)


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


def test_legends_lie_outside_the_panels(record):
    figure = forces_and_moments([record])
    figure.canvas.draw()
    (legend,) = figure.legends
    box = legend.get_window_extent()
    for axes in panel_axes(figure):
        assert not axes.get_window_extent().overlaps(box)
        assert axes.get_legend() is None


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


def test_close_up_follows_the_speed(record):
    faster = record.assign_attrs(speed=2 * record.attrs["speed"])
    view = panels.close_up([faster])
    assert (view.start, view.end) == pytest.approx((0.96, 1.12))


def test_mixed_depths_are_named(record):
    mixed = record.copy()
    mixed["depth"] = record["depth"].copy(data=np.where(record["bearing"] == "HP-front", "v3", "v1"))
    assert style.run_name(mixed, "HP-front") == f"mixed depths, here {style.depth_name('v3')}"
    assert style.colour_of(style.depth_at(mixed)) == style.OTHER_COLOUR


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
    loudest = mesh.get_array().argmax() % mesh.get_array().shape[1]
    assert loudest == pytest.approx(25.0 * 0.32 - 1, abs=0.1)  # lines 3.125 Hz apart from the first on


def test_film_maps_show_the_worst_instants_in_one_scale(records):
    figure = film_maps(records[:2], BEARING)
    titles = [axes.get_title(loc="left") for axes in panel_axes(figure)]
    gap = statistics.series(records[0], "least_gap", BEARING)
    assert f"V1:  least gap: {gap.min() * 1e6:.1f} µm" in titles[0]
    assert any("largest force" in title for title in titles)
    assert film_maps([records[0].drop_vars("bearing_parameters")], BEARING) is None
    foreign = records[0].assign(depth=("bearing", ["of-another-maker"] * 11))
    assert film_maps([foreign], BEARING) is None


@pytest.mark.parametrize("largest", [0.0, 3e5, 4.8e8])
def test_steps_of_colours_cover_the_values(largest):
    found = steps(largest, 0.004 * largest, 1e-6)
    assert found[0] == 0.0 and found[-1] >= largest * 1e-6 and found == sorted(set(found))
    assert len(found) <= 12


def test_what_is_cut_off_is_marked(record):
    leaping = record.copy()
    leaping["least_gap"] = record["least_gap"] * xr.where(record["time"] > 1.0, 5.0, 1.0)
    near = panel_axes(least_gap([leaping]))[1]
    assert any(text.get_text().startswith("▲ cut off, up to") for text in near.texts)
    assert not [text for text in panel_axes(least_gap([leaping]))[0].texts if "cut off" in text.get_text()]


def test_depths_differ_in_grey_print():
    assert len({style.dash_of(depth) for depth in DEPTHS}) == 3


def test_the_worst_bearing_is_shown_unless_one_is_named(record):
    assert worst_bearing([record]) == "LP2-front"
    assert worst_bearing([record.assign_attrs(analysed_bearing="HP-front")]) == "HP-front"


def test_writing_gives_every_figure_in_every_format(record, train, tmp_path):
    short = record.isel(time=slice(900, 1100))
    files = write_figures([short], tmp_path / "figures", train=train, formats=("png",))
    assert len(files) == 10
    assert all(path.stat().st_size > 1000 for path in files)
    assert quantities.FORCE.unit == "MN"
