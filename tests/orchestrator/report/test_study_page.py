"""The page of a study: its probabilities, bounds, colours, what it links to, and that a browser draws it."""

import numpy as np
import pytest
import xarray as xr

from orchestrator.commands.report import ReportRequest, run
from orchestrator.errors import OrchestratorError
from orchestrator.report import document
from orchestrator.report.ensemble.bars import sensitivities
from orchestrator.report.ensemble.curves import fragility, groups
from orchestrator.report.ensemble.maps import maps
from orchestrator.report.ensemble.page import study_page, write_study_report
from orchestrator.report.ensemble.source import levels
from orchestrator.results.ensemble.probability import clopper_pearson
from orchestrator.results.figures.style import colour_of
from orchestrator.results.record_files import netcdf
from tests.orchestrator.report import browser
from tests.orchestrator.report.test_browser import SCROLL


def study(**attributes):
    """Forty samples at V2 and V1: contact from 3 kg m on at V1, one run without a result."""
    unbalance, draw = np.repeat([1.0, 2.0, 3.0, 4.0], 10), np.tile(np.linspace(0.1, 1.0, 10), 4)
    contact = np.stack([np.zeros(40), (unbalance >= 3.0) * 1.0], axis=1)
    outcome = np.full((40, 2), "finished", dtype="<U12")
    outcome[39, 1], contact[39, 1] = "process-died", np.nan
    gap = 1e-4 - 2e-5 * unbalance[:, None] + 1e-6 * draw[:, None] + np.array([[0.0, -1e-5]])
    dims = ("sample", "depth")
    return xr.Dataset(
        {
            "outcome": (dims, outcome),
            "message": (dims, np.where(outcome == "finished", "", "ended <by> SIGKILL")),
            "contact": (dims, contact, {"units": "1"}),
            "least_gap_min": (dims, gap, {"units": "m"}),
            "worst_share": (dims, 1.0 / gap / 1e5, {"units": "1"}),
            "worst_limit": (dims, np.full((40, 2), "least film (rear, after)")),
        },
        {
            "sample": np.arange(40),
            "depth": ["v2", "v1"],
            "unbalance": ("sample", unbalance, {"units": "kg m", "key": "event.unbalance"}),
            "phase": ("sample", draw, {"units": "rad", "key": "event.phase"}),
        },
        {
            "title": "A <study>",
            "parameters": "phase unbalance",
            "worst_runs": "00038-v1 00037-v1",
            **attributes,
        },
    )


def test_the_curve_says_how_often_and_how_sure():
    over_unbalance, over_phase = fragility(study())
    assert (over_unbalance.title, over_phase.title) == ("over unbalance", "over phase")
    v2, v1 = over_unbalance.traces
    assert v1["x"] == [1.0, 2.0, 3.0, 4.0] and v1["y"] == [0.0, 0.0, 100.0, 100.0] and v2["y"] == [0.0] * 4
    assert v1["line"]["color"] == colour_of("v1") and v2["line"]["color"] == colour_of("v2")
    low, high = clopper_pearson(9, 10, 1)  # of the ten at 4 kg m one is unknown
    assert v1["error_y"]["arrayminus"][3] == pytest.approx(100.0 - 100.0 * low)
    assert v1["error_y"]["array"][3] == pytest.approx(100.0 * high - 100.0) and high == 1.0
    assert "10 runs, 1 of them without a result" in v1["text"][3]


def test_a_second_stage_is_completed_by_the_first():
    data = study(first_stage="v2", refined_where="least_gap_min below 5e-05, or none")
    data["outcome"].values[:20, 1] = "not-refined"
    data["contact"].values[:20, 1] = np.nan
    data["contact"].values[0, 0] = 1.0
    v2, both = levels(data)
    assert both.contact[0] == 1.0 and both.contact[20] == 1.0 and np.isnan(both.contact[39])
    assert both.name.endswith("where the first stage asked for it; else V2") and both.colour == colour_of(
        "v1"
    )
    assert (v2.contact[1:] == 0.0).all()


def test_maps_and_bars_show_what_matters():
    (panel,) = maps(study())
    assert panel.title == "least gap min [µm] at V2: unbalance, phase" and len(panel.traces) == 1
    gap, share = sensitivities(study())
    assert gap.traces[0]["y"] == ["unbalance", "phase"]
    strong, weak = gap.traces[0]["x"]
    assert strong == pytest.approx(-1.0, abs=0.05) and 0.0 < weak < 0.4
    assert share.traces[0]["x"][0] > 0.9


def test_a_run_that_did_not_finish_is_a_cross_on_the_map():
    data = study()
    data["outcome"].values[5, 0] = "unresolved"
    (panel,) = maps(data.assign_coords(phase=("sample", np.linspace(0.1, 1.0, 40), {"units": "rad"})))
    (cross,) = [trace for trace in panel.traces if trace["marker"].get("symbol") == "x"]
    assert cross["x"] == [1.0] and cross["y"] == [pytest.approx(0.1 + 5 * 0.9 / 39)]


def test_the_page_links_the_worst_runs_and_says_what_failed(tmp_path, monkeypatch):
    monkeypatch.setattr(document, "require_library", lambda: lambda: "library")
    (tmp_path / "worst" / "00038-v1").mkdir(parents=True)
    (tmp_path / "worst" / "00038-v1" / "report.html").touch()
    page = study_page(study(), tmp_path)
    assert 'href="worst/00038-v1/report.html">38 v1</a>' in page and "37 v1" in page
    assert 'href="../worst/00038-v1/report.html"' in study_page(study(), tmp_path, tmp_path / "elsewhere")
    assert "A &lt;study&gt;" in page and "ended &lt;by&gt; SIGKILL" in page
    assert "1 runs ended otherwise than finished" in page and "Contact in 19 of 39 runs with a result" in page


def test_the_command_knows_a_study_and_what_it_does_not_show(tmp_path, capsys):
    pytest.importorskip("plotly")
    from rich.console import Console

    (tmp_path / "runs").mkdir()
    (tmp_path / "study.nc").write_bytes(netcdf(study()))
    assert run(ReportRequest([tmp_path]), Console(quiet=True)) == 0
    assert (tmp_path / "report.html").stat().st_size > 1e6
    with pytest.raises(OrchestratorError, match="a study, of which --bearing is not shown"):
        run(ReportRequest([tmp_path], bearing="rear"), Console(quiet=True))
    with pytest.raises(OrchestratorError, match="a study, of which several are not shown"):
        run(ReportRequest([tmp_path, tmp_path]), Console(quiet=True))


@pytest.mark.skipif(browser.path() is None, reason=f"no browser: none of {', '.join(browser.NAMES)}")
def test_a_browser_draws_it(tmp_path):
    pytest.importorskip("plotly")
    file = write_study_report(study(), tmp_path, tmp_path / "report.html")
    with browser.Page() as page:
        page.resize(390, 900)
        page.open(file)
        page.value(SCROLL)
        drawn = page.value("[...document.querySelectorAll('.panel')].map((p) => p.dataset.drawn)")
        assert drawn == ["yes"] * 5 and page.complaints == []
        assert page.value("document.documentElement.scrollWidth") == 390


def test_drawn_values_are_taken_together_and_those_of_a_grid_are_not():
    grid = np.repeat(np.linspace(0.1, 2.0, 20), 4)
    assert [values.size for values in groups(grid)] == [4] * 20
    drawn = np.repeat(np.random.default_rng(1).uniform(size=20), 4)
    parts = groups(drawn)
    assert len(parts) == 10 and {part.size for part in parts} == {8}
    assert sorted(np.concatenate(parts).tolist()) == list(range(80))


def test_a_value_without_any_result_has_bounds_and_no_point():
    """Nothing is known there: between nothing and everything."""
    data = study()
    unknown = data["unbalance"].values == data["unbalance"].values.max()
    contact = data["contact"].where(~xr.DataArray(unknown, dims="sample"))
    panel = next(p for p in fragility(data.assign(contact=contact)) if p.title == "over unbalance")
    shown = [t for t in panel.traces if t.get("showlegend", True)]
    bare = [t for t in panel.traces if not t.get("showlegend", True)]
    largest = float(data["unbalance"].max())
    assert bare and all(t["x"] == [largest] for t in bare) and all(largest not in t["x"] for t in shown)
    assert all(t["y"][0] - t["error_y"]["arrayminus"][0] == 0.0 for t in bare)
    assert all(t["y"][0] + t["error_y"]["array"][0] == 100.0 for t in bare)
