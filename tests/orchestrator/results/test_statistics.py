"""Windows and statistics of records with known answers."""

import json

import numpy as np
import pytest
import xarray as xr

from orchestrator.results import statistics, windows
from orchestrator.scenario.events import BladeLoss, to_json
from tests.orchestrator.results import synthetic_record

MEAN, SWING = 1.8e6, 0.3e6


def one_bearing(time, force, *, gap=None, contact=None, fracture=None, hertz=25.0, **more):
    """A record of one bearing with the force in y; `fracture` may be one instant or several."""
    time = np.asarray(time, dtype=float)
    zero = np.zeros_like(time)
    gap = zero + 1e-4 if gap is None else gap
    vector = ("time", "bearing", "axis")
    scalar = ("time", "bearing")
    variables = {
        "force": (vector, np.stack([zero, force], axis=1)[:, None, :]),
        "moment": (vector, np.zeros((time.size, 1, 2))),
        "least_gap": (scalar, gap[:, None]),
        "centre_line_gap": (scalar, 2 * gap[:, None]),
        "contact_force": (scalar, (zero if contact is None else contact)[:, None]),
        "sommerfeld": (scalar, (force / MEAN * 4.3)[:, None]),
        **{name: (scalar, values[:, None]) for name, values in more.items()},
    }
    instants = () if fracture is None else np.atleast_1d(fracture).tolist()
    losses = [BladeLoss(wheel="wheel", unbalance=1.0, time=at) for at in instants]
    attributes = {"speed": 2.0 * np.pi * hertz, "events": to_json(losses)}
    coordinates = {"time": time, "bearing": ["A"], "axis": ["x", "y"]}
    return xr.Dataset(variables, coords=coordinates, attrs=attributes)


def test_windows_of_a_full_run():
    time = np.arange(20001) * 1e-4
    before, after = windows.phases(one_bearing(time, time, fracture=1.0))
    assert (before.name, after.name) == ("before", "after")
    assert (before.mean.start, before.mean.end) == pytest.approx((0.92, 1.0))
    assert before.peak == before.mean
    assert (before.span.start, before.span.end) == (0.0, 1.0)
    assert (after.mean.start, after.mean.end) == pytest.approx((1.4, 2.0))
    assert (after.peak.start, after.peak.end) == pytest.approx((1.0, 2.0))
    assert not before.note and not after.note


@pytest.mark.parametrize("hertz", [25.0, 37.0, 50.0])
def test_means_are_over_whole_revolutions_at_any_speed(hertz):
    """A mean over the fixed 80 ms and 0.6 s of 25 Hz, or between samples only, is off at 37 Hz."""
    time = np.arange(4001) * 5e-4
    wave = np.sin(2 * np.pi * hertz * time + 1.2)
    record = one_bearing(time, MEAN + SWING * wave, fracture=1.0, hertz=hertz)
    before, after = windows.phases(record)
    assert before.mean.length * hertz == pytest.approx(2.0, abs=1e-9)
    assert after.mean.length * hertz == pytest.approx(np.floor(hertz - 10.0 + 1e-6), abs=1e-9)
    assert after.mean.start >= 1.0 + 10.0 / hertz - 1e-9
    for phase in (before, after):
        found = statistics.bearing_statistics(record, "A", phase, contact_from=1.0)
        assert found.force_mean == pytest.approx(MEAN, abs=3e-4 * SWING)
    fixed = windows.Window(0.92, 1.0)
    off = statistics.window_mean(fixed, time, MEAN + SWING * wave) - MEAN
    assert (abs(off) > 1e-2 * SWING) == (hertz == 37.0)


def test_windows_at_25_hertz_are_the_decimal_numbers_to_the_bit():
    time = np.arange(4001) * 5e-4
    before, after = windows.phases(one_bearing(time, time, fracture=1.0))
    assert (before.mean.start, after.mean.start) == (1.0 - 0.08, 1.0 + 0.4)


def test_there_is_a_phase_between_any_two_events():
    time = np.arange(4001) * 5e-4
    before, first, second = windows.phases(one_bearing(time, time, fracture=[0.4, 0.9]))
    assert [phase.name for phase in (before, first, second)] == ["before", "after 1", "after 2"]
    assert [phase.span for phase in (before, first)] == [windows.Window(0.0, 0.4), windows.Window(0.4, 0.9)]
    assert second.span == windows.Window(0.9, 2.0)
    assert "the next event comes 0.5 s after" in first.note and not second.note
    assert first.mean.length * 25.0 == pytest.approx(6.0)


@pytest.mark.parametrize("fracture", [None, 5.0, 2.0])
def test_a_run_without_event_has_one_steady_phase(fracture):
    time = np.arange(2001) * 1e-3
    (steady,) = windows.phases(one_bearing(time, time, fracture=fracture))
    assert steady.name == "steady"
    assert (steady.mean.start, steady.mean.end) == pytest.approx((1.92, 2.0))
    assert steady.peak == windows.Window(0.0, 2.0)


def test_a_short_run_says_so():
    time = np.arange(301) * 1e-4
    before, after = windows.phases(one_bearing(time, time, fracture=0.01))
    assert before.mean == windows.Window(0.0, 0.01)
    assert "recorded" in before.note
    assert after.mean.start == pytest.approx(0.02)
    assert "transient" in after.note


def test_an_event_at_the_start_leaves_only_after():
    time = np.arange(1001) * 1e-3
    (after,) = windows.phases(one_bearing(time, time, fracture=0.0))
    assert after.name == "after"


def test_a_record_without_samples_is_refused():
    with pytest.raises(ValueError, match="no sample"):
        windows.phases(one_bearing([], np.empty(0)))


def test_mean_and_harmonic_part_of_a_sine():
    time = np.arange(20001) * 1e-4
    wave = np.sin(2 * np.pi * 25 * time)
    record = one_bearing(time, MEAN + SWING * wave, gap=100e-6 + 5e-6 * wave, fracture=1.0)
    before = windows.phases(record)[0]
    found = statistics.bearing_statistics(record, "A", before, contact_from=1.0)
    assert found.force_mean == pytest.approx(MEAN, rel=1e-12)
    assert found.force_max == pytest.approx(MEAN + SWING, rel=1e-12)
    assert found.least_gap_mean == pytest.approx(100e-6, rel=1e-12)
    assert found.least_gap_harmonic == pytest.approx(5e-6, rel=1e-9)
    assert found.least_gap_min == pytest.approx(95e-6, rel=1e-9)
    assert found.centre_line_gap_mean == pytest.approx(200e-6, rel=1e-12)
    assert found.sommerfeld_mean == pytest.approx(4.3, rel=1e-12)
    assert found.moment_max == 0.0


def test_mean_over_uneven_samples_weighs_with_time():
    time = np.array([0.0, 0.5, 0.6, 0.7, 1.0])
    assert statistics.time_mean(time, 3.0 + 2.0 * time) == pytest.approx(4.0, rel=1e-15)


def test_interval_extremes_beat_samples_but_only_inside_the_window():
    time = np.arange(2001) * 1e-3
    force = np.full(time.size, MEAN)
    peaks = force.copy()
    peaks[1500] = 5e6
    peaks[1000] = 9e6  # closes the last interval before the event
    record = one_bearing(time, force, fracture=1.0, force_magnitude_max=peaks)
    before, after = windows.phases(record)
    of_before = statistics.bearing_statistics(record, "A", before, contact_from=1.0)
    of_after = statistics.bearing_statistics(record, "A", after, contact_from=1.0)
    assert (of_before.force_max, of_after.force_max) == (9e6, 5e6)


def test_contact_first_instant_share_and_maximum():
    time = np.arange(2001) * 1e-3
    contact = np.zeros(time.size)
    contact[(time > 1.5495) & (time < 1.8505)] = 4e5
    contact[1200] = 7e5  # a short touch before the steady window
    record = one_bearing(time, np.full(time.size, MEAN), contact=contact, fracture=1.0)
    before, after = windows.phases(record)
    threshold = statistics.contact_threshold(record, "A", (before, after))
    assert threshold == pytest.approx(1e-3 * MEAN)
    assert statistics.bearing_statistics(record, "A", before, contact_from=threshold).contact_first is None
    found = statistics.bearing_statistics(record, "A", after, contact_from=threshold)
    assert found.contact_first == pytest.approx(1.2)
    assert found.contact_share == pytest.approx(0.302, rel=1e-6)  # 301 ms and 1 ms of 1 s
    assert found.contact_max == 7e5


def test_newtons_in_the_tail_of_the_asperity_law_are_no_contact():
    time = np.arange(2001) * 1e-3
    record = one_bearing(time, np.full(time.size, MEAN), contact=np.full(time.size, 20.0), fracture=1.0)
    found = windows.phases(record)
    threshold = statistics.contact_threshold(record, "A", found)
    rows = [statistics.bearing_statistics(record, "A", phase, contact_from=threshold) for phase in found]
    assert [row.contact_first for row in rows] == [None, None]


def test_the_analysed_bearing_is_the_most_loaded_or_the_named_one():
    record = synthetic_record.record()
    assert statistics.analysed_bearing(record) == "LP2-front"
    assert statistics.analysed_bearing(record, "HP-rear") == "HP-rear"
    record.attrs["analysed_bearing"] = "GEN-front"
    assert statistics.analysed_bearing(record) == "GEN-front"
    with pytest.raises(ValueError, match=r"LP9.*HP-front, HP-rear"):
        statistics.analysed_bearing(record, "LP9")


def test_shaft_statistics_take_the_position_of_the_worst():
    record = synthetic_record.record()
    after = windows.phases(record)[-1]
    found = statistics.shaft_statistics(record, after)
    inside = record.sel(time=slice(1.0, 2.0))
    assert found.amplitude_max == float(inside["amplitude"].max())
    worst = inside["amplitude"].max("time").argmax("node")
    assert found.amplitude_position == float(record["z"][worst])


def test_defect_statistics():
    record = synthetic_record.record()
    found = statistics.defect_statistics(record)
    assert found.largest == float(record["defect_max"].max())
    assert found.bearing == "LP2-front"
    assert float(record["defect_max"].sel(bearing="LP2-front", time=found.time)) == found.largest
    assert statistics.defect_statistics(record.drop_vars("defect_max")) is None


def test_records_rarer_than_windows_and_events():
    record = synthetic_record.record()
    rare = record.isel(time=[0, 700, 2000])  # at 0, 0.7 and 2 s; the event comes at 1 s
    before, after = windows.phases(rare)
    assert before.mean.mask(rare["time"].values).any() and after.mean.mask(rare["time"].values).any()
    first = json.loads(record.attrs["events"])[0]
    two = rare.assign_attrs(events=json.dumps([first, {**first, "time": 1.2}]))
    _, last = windows.phases(two)
    assert last.name == "after 2" and "no instant was recorded in after 1" in last.note
    found = statistics.bearing_statistics(two, "LP2-front", before, contact_from=np.inf)
    assert np.isfinite(found.force_max)
