"""The command bearing: data, tables and figures of one bearing at every depth."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.backends.backend_agg import FigureCanvasAgg
from rich.console import Console

from fmus.port.bore import grooved, lobes, pocketed
from orchestrator.commands.bearing import run
from orchestrator.errors import OrchestratorError
from orchestrator.linear.case import LinearRequest
from orchestrator.results.figures.bearing import coefficients_figure, pressure_figure
from rotor_fmu.linear.analysis import target_loads
from rotor_fmu.train.file import load_train
from tests.faults import fault

LEMON = "tests/examples/lemon"
ROOT = Path(__file__).parents[3]


def investigate(source, folder, console=None, **options):
    given = {"name": None, "depths": (), "hertz": None, "load": None, "formats": ()} | options
    request = LinearRequest("bearing", source, None, folder, folder, given.pop("formats"), False)
    return run(request, console or Console(quiet=True), **given)


def test_every_depth_of_a_bearing_side_by_side(tmp_path):
    folder = tmp_path / "out"
    assert investigate("small", folder, depths=("v2", "v3"), formats=("png",)) == 0
    names = (
        "curves.png",
        "coefficients.png",
        "pressure.png",
        "bearing.csv",
        "over-speed.csv",
        "pressure.csv",
    )
    assert all((folder / name).stat().st_size > 1000 for name in names)
    curves = xr.load_dataset(folder / "bearing.nc")
    assert list(curves["depth"].values) == ["v2", "v3"]
    assert np.all(np.diff(curves["eccentricity"].values, axis=1) > 0.0)
    train = load_train("small")
    running = xr.load_dataset(folder / "over-speed.nc").sel(depth="v2")
    rated = running.sel(rotation=50.0, method="nearest")
    load = float(target_loads(train)[0])
    assert float(rated["sommerfeld"]) == pytest.approx(train.bearings[0].sommerfeld(load, train.speed))
    text = (folder / "bearing.txt").read_text()
    assert "front of small" in text and "Kxx [GN/m]" in text


def test_the_legend_of_coefficients_lies_over_no_line(tmp_path):
    folder = tmp_path / "out"
    assert investigate("small", folder, depths=("v3",)) == 0
    curves, running = (xr.load_dataset(folder / f"{name}.nc") for name in ("bearing", "over-speed"))
    figure = coefficients_figure(curves, running, "small", 1.0)
    FigureCanvasAgg(figure).draw()
    for axes in (axes for axes in figure.axes if axes.get_legend() is not None):
        legend = axes.get_legend().get_window_extent()
        assert legend.y0 >= axes.get_window_extent().y1 - 1.0
    threshold = figure.axes[2].yaxis
    words = [text.get_text() for text in (*threshold.get_majorticklabels(), *threshold.get_minorticklabels())]
    assert any(words) and not any("10^" in word for word in words)


def test_a_terminal_of_eighty_columns_cuts_no_figure_off(tmp_path):
    said = io.StringIO()
    assert investigate("small", tmp_path / "out", Console(file=said, width=80), depths=("v2", "v3")) == 0
    assert "\u2026" not in said.getvalue()
    assert "friction" in said.getvalue()


def test_a_depth_without_the_bore_is_left_out_and_told(tmp_path):
    folder = tmp_path / "out"
    assert investigate(LEMON, folder, name="rear", depths=("v2", "v3"), hertz=40.0, load=1e4) == 0
    text = (folder / "bearing.txt").read_text()
    assert "v3 left out: bearing parameter bore: the short film knows the plain bore only" in text
    assert "rear of lemon" in text and "40 Hz, 10 kN" in text


@fault(
    "input",
    "a bearing that is not there, or that no depth asked for can have",
    "exit 2; the names that there are, or why each depth is left out",
    guard="orchestrator.commands.bearing:_seat",
)
def test_no_bearing(tmp_path):
    with pytest.raises(OrchestratorError, match="bearing middle: no such bearing; allowed are front, rear"):
        investigate("small", tmp_path / "out", name="middle")
    with pytest.raises(OrchestratorError, match="v3: bearing parameter bore: the short film"):
        investigate(LEMON, tmp_path / "out", depths=("v3",))
    assert not (tmp_path / "out").exists()


def test_the_pressure_map_shows_the_bore():
    """A groove across the angle at which the map ends, a pocket of half the width, two arcs that meet."""
    z, angle = np.linspace(-0.05, 0.05, 5), np.arange(-180.0, 180.0, 10.0)
    film = xr.Dataset({"pressure": (("angle", "z"), np.ones((angle.size, z.size)))}, {"angle": angle, "z": z})
    cut = grooved(lobes(2, 0.3), [(np.pi, np.radians(20.0))])
    bore = pocketed(cut, [(np.radians(90.0), np.radians(60.0), 0.5, 1.0, False)])
    axes = pressure_figure(film, "bearing", np.array([0.0, -1.0]), bore).axes[0]
    words = "dotted: direction of the load", "framed: pockets", "hatched: grooves", "dashed: ends of arcs"
    assert set(axes.get_title(loc="left").split("; ")) == set(words)
    frames = [patch.get_bbox().extents for patch in axes.patches if patch.get_hatch() is None]
    assert any(np.allclose(frame, (60.0, -25.0, 120.0, 25.0)) for frame in frames)
    grooves = [patch.get_bbox().intervalx for patch in axes.patches if patch.get_hatch()]
    assert any(np.allclose(span, (170.0, 190.0)) for span in grooves)
    assert any(np.allclose(span, (-190.0, -170.0)) for span in grooves)
    plain = pressure_figure(film, "bearing", np.array([0.0, -1.0])).axes[0]
    assert plain.get_title(loc="left") == words[0] and not plain.patches


def test_a_bearing_of_its_own_file(tmp_path):
    folder = tmp_path / "out"
    assert investigate("tests/examples/bearing/dam.toml", folder, depths=("v2",)) == 0
    text = (folder / "bearing.txt").read_text()
    assert "dam: d 0.2 m" in text and "50 Hz, 12 kN" in text
    assert "12 kN at -90 deg" in text
    film = xr.load_dataset(folder / "pressure.nc")
    dam = film["pressure"].sel(angle=slice(60.0, 170.0))
    assert float(dam.max()) > 2e5  # what builds up before its end presses down


def test_a_load_in_any_direction(tmp_path):
    """Turned by a quarter, load and pressure are the same: in the file and as an option."""
    path, found = tmp_path / "own.toml", []
    lines = (ROOT / "tests/examples/bearing/dam.toml").read_text().splitlines()
    text = "\n".join(line for line in lines if not line.startswith(("grooves", "pockets")))
    for name, key, option in (
        ("down", "", None),
        ("file", 'load_angle = "0 deg"\n', None),
        ("option", "", 0.0),
    ):
        path.write_text(key + text)
        assert investigate(str(path), tmp_path / name, depths=("v3",), load_angle=option) == 0
        over = xr.load_dataset(tmp_path / name / "over-speed.nc").sel(depth="v3")
        found.append(over.sel(rotation=50.0, method="nearest"))
    for one in found[1:]:
        for key in ("eccentricity", "attitude", "h_min"):
            assert float(one[key]) == pytest.approx(float(found[0][key]), rel=1e-6)
        assert "12 kN at 0 deg" in one.attrs["title"]


@fault(
    "input",
    "a bearing's file with a wrong setting of its film",
    "exit 2; file, key, value and what is allowed",
    guard="orchestrator.linear.lone:lone_case",
)
def test_no_such_film(tmp_path):
    path = tmp_path / "own.toml"
    text = (ROOT / "tests/examples/bearing/dam.toml").read_text()
    path.write_text(text.replace("columns = 72", "columns = 7"))
    with pytest.raises(OrchestratorError, match="film: columns = 7; allowed is a number of at least"):
        investigate(str(path), tmp_path / "out")
    path.write_text(text.replace('load = "12 kN"', 'load = "12 kN"\nload_angle = 90'))
    with pytest.raises(OrchestratorError, match="load_angle = 90; allowed is"):
        investigate(str(path), tmp_path / "out")
    path.write_text(text.replace("viscosity", "viscositee"))
    with pytest.raises(OrchestratorError, match="viscositee: unknown key; did you mean 'viscosity'"):
        investigate(str(path), tmp_path / "out")
