"""What the page says, and that its figures hold the record; how it looks in a browser: `test_browser`."""

import base64
import gzip
import json
from html.parser import HTMLParser
from io import BytesIO
from itertools import islice

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pypdf import PdfReader
from typer.testing import CliRunner

from orchestrator.cli.main import app
from orchestrator.report import library, write
from orchestrator.report.encode import packed, to_json, unpacked
from orchestrator.report.panels.bode import bode
from orchestrator.report.source import ReportError, load_results, results_of, shown_bearing
from orchestrator.report.write import report_text, write_print, write_report
from orchestrator.results.figures.write import figures_of
from orchestrator.results.record_files import write_record
from orchestrator.results.worst_film import worst_films
from tests.faults import fault
from tests.orchestrator.results import synthetic_record

LARGEST = 6e6
NAMES = synthetic_record.NAMES[3:7]


class Reader(HTMLParser):
    """Text of the page, and of its scripts by their id."""

    def __init__(self):
        super().__init__()
        self.text, self.scripts, self.tags, self._script = [], {}, [], None

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        if tag in ("script", "style"):
            self._script = dict(attributes).get("id", tag)

    def handle_endtag(self, tag):
        self._script = None if tag in ("script", "style") else self._script

    def handle_data(self, data):
        if self._script is None:
            self.text.append(data)
        else:
            self.scripts[self._script] = self.scripts.get(self._script, "") + data


def read(text):
    page = Reader()
    page.feed(text)
    data = json.loads(gzip.decompress(base64.b64decode(page.scripts["data"])))
    return " ".join(" ".join(page.text).split()), data, page


@pytest.fixture(scope="module")
def records():
    """Of four bearings, the second of which is the worst."""
    return [synthetic_record.record(depth, end=1.4).isel(bearing=slice(3, 7)) for depth in ("v1", "v2")]


@pytest.fixture(scope="module")
def pages(records):
    """One result and two side by side; the library, which is large, in a word."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("orchestrator.report.document.require_library", lambda: lambda: "library")
        return [report_text(results_of(records[:count])) for count in (1, 2)]


def test_the_page_says_what_was_run_what_follows_and_how_far_to_trust_it(pages):
    text, _, _ = read(pages[0])
    assert text.startswith("synthetic - bladeloss synthetic Train")
    assert "Trip - shut the train down at once" in text
    for word in ("outcome finished", "coupling defect median", "certificate none", "film regime 4 of 4"):
        assert word in text
    for name in NAMES:
        assert name in text
    assert "(recalled)" in text


def test_nothing_is_fetched(pages):
    for page in pages:
        _, _, found = read(page)
        assert not [
            a for tag, a in found.tags if {"src", "href"} & a.keys() and not a.get("href", "").startswith("#")
        ]


def test_every_bearing_has_its_orbit_and_its_figures(pages, records):
    for page, results in zip(pages, (1, 2), strict=True):
        _, data, found = read(page)
        boxes = [a for tag, a in found.tags if tag == "div" and a.get("class") == "panel"]
        assert set(data) == {a["id"] for a in boxes}
        chosen = [a["data-bearing"] for a in boxes if "data-bearing" in a]
        films = sum(len(list(worst_films(r, name))) for r in records[:results] for name in NAMES)
        # series and spectra of all results in one figure, a waterfall of each, its film at the worst instants
        assert len(chosen) == len(NAMES) * (2 + results) + films and set(chosen) == set(NAMES)
        assert films >= 2 * results * len(NAMES)
        assert len(boxes) - len(chosen) == results * len(NAMES) + 1 + results  # orbits, shaft, shaft in space


def test_a_bode_plot_appears_where_the_speed_changes(records):
    """1X of a journal whose amplitude grows with the speed, and lags by what it lags."""
    record = records[0].isel(bearing=[0]).copy()
    time = record["time"].values
    speed = 100.0 + 60.0 * time
    theta = 100.0 * time + 30.0 * time**2
    wave = 1e-6 * speed[:, None] * np.column_stack([np.cos(theta - 0.5), np.sin(theta - 0.5)])
    record["displacement"] = (("time", "bearing", "axis"), wave[:, None])
    (result,) = results_of([record.assign(rotation_speed=("time", speed))])
    (panel,) = bode([result])
    amplitude, phase = (unpacked(trace["y"]) for trace in panel.traces)
    minute = unpacked(panel.traces[0]["x"])
    np.testing.assert_allclose(amplitude, minute * np.pi / 30.0, rtol=1e-4)
    np.testing.assert_allclose(phase, np.degrees(-0.5 - np.pi / 4), atol=0.02)
    assert not list(bode(results_of([records[0]])))


def test_the_same_can_be_printed(records, tmp_path, monkeypatch):
    """Words of each run, then the figures, of which two are enough here."""
    few = islice(figures_of([record.isel(time=slice(900, 1200)) for record in records[:1]]), 2)
    monkeypatch.setattr("orchestrator.report.print.figures_of", lambda *_, **__: few)
    short = [record.isel(bearing=[0, 1], time=slice(900, 1200)) for record in records]
    content = write_print(results_of(short), tmp_path / "report.pdf").read_bytes()
    pages = [page.extract_text() for page in PdfReader(BytesIO(content)).pages]
    assert len(pages) == 2  # words of both runs on one sheet, two figures on another
    assert pages[0].count("How far to trust it") == 2
    assert "Deformed train" in pages[1] and "Bearing force and moment" in pages[1]
    assert b"CreationDate" not in content  # the same results give the same bytes
    (tmp_path / "report.pdf").write_bytes(content + b"mine")
    with pytest.raises(ReportError, match="was changed since"):
        write_print(results_of(short), tmp_path / "report.pdf")


def test_orbits_of_a_bearing_have_the_same_axes_in_all_results(pages):
    _, data, _ = read(pages[1])
    orbits = [item for item in data.values() if "scaleanchor" in item["layout"].get("yaxis", {})]
    assert len(orbits) == 8
    for one, other in zip(orbits[::2], orbits[1::2], strict=True):
        assert one["layout"]["xaxis"]["range"] == other["layout"]["xaxis"]["range"]


def test_no_extreme_is_lost_in_the_lines(pages, records):
    _, data, _ = read(pages[0])
    series = [
        item
        for item in data.values()
        if item["layout"].get("yaxis2", {}).get("title", {}).get("text", "") == "least gap [µm]"
    ]
    assert len(series) == 4
    record = records[0].sel(bearing="LP2-front")
    figure = series[NAMES.index("LP2-front")]
    force, gap = (unpacked(trace["y"]) for trace in figure["data"][:2])
    assert force.size <= 1200
    assert force.max() == pytest.approx(float(record["force_magnitude_max"].max()) * 1e-6, rel=1e-4)
    assert gap.min() == pytest.approx(float(record["least_gap_min"].min()) * 1e6, abs=0.01)


def test_the_circle_is_the_clearance_and_marks_are_where_surfaces_touch(pages, records):
    _, data, _ = read(pages[0])
    orbits = [item for item in data.values() if "scaleanchor" in item["layout"].get("yaxis", {})]
    traces = {trace["name"]: trace for trace in orbits[NAMES.index("LP2-front")]["data"]}
    circle = traces["clearance"]
    radius = np.hypot(unpacked(circle["x"]), unpacked(circle["y"]))
    np.testing.assert_allclose(radius, synthetic_record.CLEARANCE * 1e6, atol=0.2)
    touching = records[0].sel(bearing="LP2-front")["contact_force"].values > 0.0
    assert unpacked(traces["solid contact"]["x"]).size == np.count_nonzero(touching) > 0
    before = np.column_stack([unpacked(traces["before"][axis]) for axis in "xy"])
    record = records[0].sel(bearing="LP2-front", time=slice(0.92 - 1e-9, 1.0 + 1e-9))
    np.testing.assert_allclose(before, record["displacement"] * 1e6, atol=0.03)


def test_the_worst_bearing_opens_the_page_unless_one_is_named(records):
    results = results_of(records)
    assert shown_bearing(results) == "LP2-front"
    assert shown_bearing(results, "LP3-front") == "LP3-front"
    with pytest.raises(ReportError, match="--bearing LP9: no such bearing; allowed are LP1-rear, LP2-front"):
        shown_bearing(results, "LP9")


def test_a_title_cannot_become_markup(records):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("orchestrator.report.document.require_library", lambda: lambda: "library")
        nasty = records[0].isel(bearing=[1]).assign_attrs(title="<script>alert(1)</script> & 'more'")
        text, _, page = read(report_text(results_of([nasty])))
    assert "<script>alert(1)</script> & 'more'" in text
    assert "script" not in page.scripts or "alert" not in page.scripts["script"]


@pytest.mark.slow
def test_three_long_runs_of_a_whole_train_fit():
    pytest.importorskip("plotly")
    longer = [synthetic_record.record(depth, interval=5e-4) for depth in ("v1", "v2", "v3")]
    assert len(report_text(results_of(longer)).encode()) < LARGEST


@given(st.lists(st.floats(-1e9, 1e9) | st.just(float("nan")), max_size=30))
def test_packed_numbers_come_back_to_a_small_share_of_their_span(values):
    found, values = unpacked(packed(values)), np.array(values)
    np.testing.assert_array_equal(np.isnan(found), np.isnan(values))
    span = np.ptp(values[np.isfinite(values)]) if np.isfinite(values).any() else 0.0
    np.testing.assert_allclose(
        found, values, atol=span / 65534 + 1e-9 * (1 + np.nanmax(np.abs(values), initial=0))
    )


def test_json_cannot_end_its_script():
    assert "</" not in to_json({"a": "</script>"})


@pytest.fixture
def folder(tmp_path, records):
    write_record(records[0], tmp_path / "run")
    return tmp_path / "run"


def test_the_command_writes_the_page_into_the_folder_of_the_run(folder):
    pytest.importorskip("plotly")
    done = CliRunner().invoke(app, ["report", str(folder)])
    assert done.exit_code == 0, done.output
    assert done.output.startswith("V1 - trip: shut the train down at once: solid contact")
    assert (folder / "report.html").read_text().startswith("<!doctype html>")
    assert sorted(p.name for p in folder.iterdir()) == ["record.csv", "record.nc", "report.html"]


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["{tmp}/none"], "{tmp}/none: no record; allowed is the folder of a run, or its record.nc"),
        (["{tmp}/run/record.csv"], "{tmp}/run/record.csv: no record: "),
        (["{tmp}/run", "--bearing", "X"], "--bearing X: no such bearing; allowed are LP1-rear, "),
        (["{tmp}/run", "--out", "{tmp}"], "{tmp}: is a folder; --out takes the file of the page"),
        (["{tmp}/run", "--out", "{tmp}/a.pdf"], "{tmp}/a.pdf: --out takes the file of the page, such as rep"),
        (
            ["{tmp}/run", "--limits", "{tmp}/no.toml"],
            "{tmp}/no.toml: not readable: No such file or directory",
        ),
    ],
)
def test_wrong_input_is_said_in_a_line_and_nothing_is_written(folder, tmp_path, monkeypatch, arguments, text):
    monkeypatch.setattr("orchestrator.commands.report.require_library", lambda: None)
    monkeypatch.setattr("orchestrator.report.document.require_library", lambda: lambda: "library")
    before = sorted(folder.iterdir())
    done = CliRunner().invoke(app, ["report", *(part.format(tmp=tmp_path) for part in arguments)])
    assert done.exit_code == 2
    assert done.output.startswith(f"error: {text.format(tmp=tmp_path)}")
    assert "Traceback" not in done.output
    assert sorted(folder.iterdir()) == before


def test_a_record_of_another_kind_is_refused(tmp_path, records):
    write_record(records[0].drop_vars("displacement"), tmp_path)
    with pytest.raises(ReportError, match="holds no displacement; allowed is one of a run of this version"):
        load_results([tmp_path])


def test_without_the_plotting_library_one_line_says_what_to_install(folder, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "plotly.offline", None)
    done = CliRunner().invoke(app, ["report", str(folder)])
    assert (done.exit_code, done.output.count("\n")) == (1, 1)
    assert "pip install 'bladeloss[report]'" in done.output
    with pytest.raises(library.LibraryMissingError):
        library.require_library()


@fault(
    "machine",
    "bladeloss report --out on a file of the user's own, a link, or a page that was changed",
    "exit 2; the file, which is left as it is",
    guard="orchestrator.report.write:_as_written",
)
def test_a_page_replaces_pages_only(records, tmp_path, monkeypatch):
    monkeypatch.setattr(write, "report_text", lambda *_: "<html></html>\n")
    page = write_report([], tmp_path / "page.html")
    first = page.read_bytes()
    assert write_report([], page).read_bytes() == first
    (tmp_path / "link.html").symlink_to(page)
    (tmp_path / "mine.html").write_text("precious")
    page.write_bytes(first.replace(b"html", b"HTML", 1))
    for name in ("page.html", "link.html", "mine.html"):
        with pytest.raises(ReportError, match=f"{name}: is no report, or was changed since"):
            write_report([], tmp_path / name)
    assert (tmp_path / "mine.html").read_text() == "precious"
