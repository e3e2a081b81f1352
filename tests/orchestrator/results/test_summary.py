"""The summary of a run: the same numbers as table, text and JSON."""

import json

import numpy as np
import pytest
import xarray as xr

from orchestrator.outcome import Outcome
from orchestrator.results.quantities import AMPLITUDE, FORCE, GAP, MOMENT
from orchestrator.results.result import Result, Timing
from orchestrator.results.summary import summarise
from orchestrator.results.summary_table import to_text
from tests.orchestrator.results import synthetic_record

TIMING = Timing(2.0, 3.0, 60.0, 12.0, 5.0, 3.0, 4.0)


def result(record, outcome=Outcome.FINISHED, message=""):
    return Result(record, outcome, message, TIMING, 20000, 220000)


@pytest.fixture(scope="module")
def summary():
    return summarise(result(synthetic_record.record()))


def test_one_row_a_phase_and_bearing(summary):
    assert [row.phase for row in summary.bearings[:2]] == ["before", "after"]
    assert [row.bearing for row in summary.of_phase(summary.phases[0])] == list(synthetic_record.NAMES)
    assert summary.analysed == "LP2-front"
    assert summary.simulated == 2.0
    assert summary.peak_memory > 1e7


def test_json_holds_what_the_summary_holds(summary):
    data = json.loads(summary.to_json())
    assert data["finished"] is True
    assert data["timing"]["loop"] == TIMING.loop == 84.0
    assert data["bearings"][0]["force_mean"] == summary.bearings[0].force_mean
    assert data["phases"][1]["mean"] == {"start": 1.4, "end": 2.0}
    assert data["units"]["force"] == "N"


def test_text_names_bearings_units_windows_and_contact(summary):
    text = to_text(summary)
    for name in synthetic_record.NAMES:
        assert text.count(f"\n {name} ") == 2
    assert "before  (means 0.920 to 1.000 s)" in text
    assert "after  (means 1.400 to 2.000 s, maxima 1.000 to 2.000 s)" in text
    row = next(r for r in summary.bearings if r.bearing == "LP2-front" and r.phase == "after")
    line = [line for line in text.splitlines() if line.startswith(" LP2-front")][1]
    assert line.split()[1:5] == [
        FORCE.number(row.force_mean),
        FORCE.number(row.force_max),
        MOMENT.number(row.moment_mean),
        MOMENT.number(row.moment_max),
    ]
    assert f"{GAP.number(row.least_gap_mean)}" in line
    assert f"solid contact at LP2-front from {row.contact_first:.3f} s" in text
    assert max(map(len, text.splitlines())) <= 110


def test_no_contact_is_said(summary):
    assert "no solid contact at any bearing" in to_text(summarise(result(synthetic_record.record("v3"))))


def test_mixed_depths_are_named():
    record = synthetic_record.record()
    record["depth"][4] = "v2"
    found = summarise(result(record))
    assert found.depth_text() == "v1; v2 at LP2-front"
    assert " LP2-front v2 " in to_text(found)


def test_a_failed_run_says_why_and_what_helps():
    found = summarise(
        result(synthetic_record.record(end=1.1), Outcome.STEP_REFUSED, "LP2-front: gap below zero")
    )
    text = to_text(found)
    assert "step-refused" in text and "LP2-front: gap below zero" in text
    assert Outcome.STEP_REFUSED.advice.split(";")[0] in " ".join(text.split())
    assert json.loads(found.to_json())["finished"] is False


def test_a_run_that_never_began_has_a_summary_without_statistics():
    found = summarise(result(xr.Dataset(), Outcome.NO_EQUILIBRIUM, "HP-front: residual 3 N"))
    assert found.phases == () and found.analysed is None
    assert "no-equilibrium" in to_text(found)
    assert json.loads(found.to_json())["macro_step"] is None


def test_units_fit_small_machines():
    assert FORCE.fitting(6e6).unit == "MN"
    assert FORCE.fitting(6e4).unit == "kN"
    assert FORCE.fitting(60.0).text(60.0) == "60.00 N"
    assert MOMENT.fitting(600.0).text(600.0) == "0.60 kN m"
    assert AMPLITUDE.fitting(3.4e-6).text(3.4e-6) == "3.4 µm"
    assert AMPLITUDE.fitting(3.4e-4).text(3.4e-4) == "0.340 mm"


def test_a_small_moment_is_not_zero():
    record = synthetic_record.record()
    for name in ("moment", "moment_magnitude_max", "moment_magnitude_min"):
        if name in record:
            record[name] = record[name] * (150.0 / float(np.abs(record["moment"]).max()))
    row = next(line for line in to_text(summarise(result(record))).splitlines() if " LP2-front " in line)
    assert not any(cell == "0.00" for cell in row.split()[3:5])


def test_events_are_said_with_instant_and_speed():
    record = synthetic_record.record()
    assert summarise(result(record)).events == ("blade fracture at LP1-2 at 1 s, 265 kg m",)
    course = "[[0.0, 100.0], [2.0, 300.0]]"
    changing = record.assign_attrs(course=course)
    (said,) = summarise(result(changing)).events
    assert said.endswith(", at 1910 rev/min")
    assert "events" in to_text(summarise(result(record)))


def test_a_film_that_carries_nothing_is_said():
    record = synthetic_record.record()
    assert not any(film.unloaded for film in summarise(result(record)).films)
    static = np.array(record["force"].values[0])
    static[3] = 0.0
    record["static_force"] = (("bearing", "axis"), static)
    found = summarise(result(record))
    assert [film.bearing for film in found.films if film.unloaded] == [synthetic_record.NAMES[3]]
    assert f"{synthetic_record.NAMES[3]}: next to no static load" in " ".join(to_text(found).split())
