"""Verdicts: figures of a record with known statistics against limits."""

import math
from dataclasses import replace

import numpy as np
import pytest

from orchestrator.results.verdicts.conclusion import Action, conclude
from orchestrator.results.verdicts.judge import judge, own_limits
from orchestrator.results.verdicts.limits import (
    LimitsError,
    ShaftVibration,
    limits_of,
    load_limits,
    own_file,
    to_text,
)
from orchestrator.results.verdicts.verdict import Grade, worst
from orchestrator.scenario.file import load_scenario
from tests.orchestrator.results import synthetic_record

DIAMETER, WIDTH = 0.8, 0.64


@pytest.fixture(scope="module")
def record():
    return synthetic_record.record("v1", end=1.8).isel(bearing=[4, 8])


@pytest.fixture(scope="module")
def verdicts(record):
    return judge(record, load_limits())


def one(verdicts, limit, phase, bearing):
    return next(v for v in verdicts if (v.limit, v.phase, v.bearing) == (limit, phase, bearing))


def test_least_film_by_size_and_speed(verdicts, record):
    found = one(verdicts, "least film", "after", "LP2-front")
    assert found.bound == 16e-6  # 0.4 to 1 m, 62.8 m/s
    inside = record.sel(bearing="LP2-front", time=slice(1.0005, None))["least_gap_min"]
    assert found.value == pytest.approx(float(inside.min()), rel=1e-12)
    assert found.instant == float(inside["time"][int(np.argmin(inside.values))])
    assert found.share == pytest.approx(16e-6 / found.value)
    assert found.grade is Grade.BEYOND


@pytest.mark.parametrize(
    ("diameter", "sliding", "least"),
    [
        (0.05, 0.5, 3e-6),
        (0.16, 1.0, 4e-6),
        (0.2, 2.9, 7e-6),
        (0.4, 29.0, 11e-6),
        (1.2, 31.0, 18e-6),
        (9.0, 31.0, 18e-6),
    ],
)
def test_the_table_of_least_films(diameter, sliding, least):
    assert load_limits().least_film.at(diameter, sliding) == least


def test_specific_load_is_force_over_projected_area(verdicts):
    found = one(verdicts, "specific load, lasting", "before", "GEN-front")
    assert found.value == pytest.approx(1.6e6 / (DIAMETER * WIDTH), rel=1e-3)
    assert (found.bound, found.grade) == (5e6, Grade.WITHIN)
    assert found.share_text() == "63 %"
    assert found.value_text() == "3.13 MPa"


def test_contact_has_no_allowance_and_trips(verdicts):
    found = one(verdicts, "solid contact", "after", "LP2-front")
    assert (found.bound_text(), found.share_text(), found.trips) == ("none", "-", True)
    assert found.grade is Grade.BEYOND
    assert not [v for v in verdicts if v.limit == "solid contact" and v.phase == "before"]
    found = conclude(verdicts)
    assert found.action is Action.TRIP and found.grounds.startswith("solid contact")
    assert found.grounds.count("shaft vibration") == 1


def test_a_conclusion_names_each_limit_once_with_the_phase_of_its_worst(verdicts):
    found = one(verdicts, "solid contact", "after", "LP2-front")
    both = (replace(found, phase="after 1", value=1e6), replace(found, phase="after 2", value=3e6))
    assert conclude(both).grounds == f"solid contact 3.00 MN at LP2-front, after 2 ({found.note})"


def test_vibration_is_the_largest_peak_to_peak_at_a_probe_in_its_zone(verdicts, record):
    before = one(verdicts, "shaft vibration, peak to peak", "before", "LP2-front")
    # a circle of 0.05 x 0.45 C: every probe reads twice its radius
    assert before.value == pytest.approx(2 * 0.05 * 0.45 * synthetic_record.CLEARANCE, rel=2e-3)
    assert before.note.startswith("zone A of 100/200/320 µm, probe at ")
    after = one(verdicts, "shaft vibration, peak to peak", "after", "LP2-front")
    motion = record["displacement"].sel(bearing="LP2-front", time=slice(1.0, None)).values
    assert after.value <= np.ptp(motion @ np.full(2, math.sqrt(0.5))) * 1.5
    assert "zone D" in after.note
    assert (after.grade, after.bound) == (Grade.BEYOND, pytest.approx(320e-6))


def test_a_vibration_is_held_against_the_bounds_at_its_own_speed(record):
    """The speed falls: the largest share of the bound, not the largest motion; of far records revolutions."""
    speed = np.linspace(314.0, 105.0, record.sizes["time"])
    of_phases = {**record.attrs, "course": f"[[0.0, 314.0], [{float(record['time'][-1])!r}, 105.0]]"}
    falling = record.assign(rotation_speed=("time", speed)).assign_attrs(of_phases)
    limit = load_limits().shaft_vibration
    found = one(judge(falling, load_limits()), "shaft vibration, peak to peak", "after", "LP2-front")
    there = float(np.interp(found.instant, record["time"], speed))
    assert found.bound == pytest.approx(limit.at(there)[2], rel=1e-9)
    assert found.bound != pytest.approx(limit.at(float(speed.mean()))[2], rel=1e-3)
    swings = np.zeros((3, 2, 2))
    swings[1, :, 1], swings[2, :, 0] = 200e-6, 210e-6
    kept = {
        "revolution": [1.2, 1.4, 1.6],
        "revolution_overall": (("revolution", "bearing", "axis"), swings),
        "revolution_speed": ("revolution", [290.0, 310.0, 105.0]),
    }
    far = falling.isel(time=slice(None, None, 200)).assign(kept)
    found = one(judge(far, load_limits()), "shaft vibration, peak to peak", "after", "LP2-front")
    assert (found.value, found.instant, found.bound) == (200e-6, 1.4, pytest.approx(limit.at(310.0)[2]))


def test_zones_lie_straight_between_speeds_and_end_at_the_nearest():
    limit = load_limits().shaft_vibration
    rpm = 2 * math.pi / 60
    assert limit.at(3000 * rpm) == pytest.approx((90e-6, 165e-6, 240e-6))
    assert limit.at(-3300 * rpm)[0] == pytest.approx(85e-6, rel=1e-4)
    assert limit.at(12000 * rpm) == pytest.approx((80e-6, 150e-6, 220e-6))


def test_a_film_beyond_laminar_theory_is_the_models_limit_not_the_machines(verdicts):
    found = one(verdicts, "laminar film, Re", "all", "GEN-front")
    assert found.value == pytest.approx(1950.0)
    assert found.bound == pytest.approx(888.0)
    assert (found.grade, found.note) == (Grade.CLOSE, "beyond laminar theory")


def test_the_least_damped_mode_is_held_against_the_least_decrement(record):
    growth, frequency = -0.5, 20.0
    told = record.assign_attrs(least_damped_frequency=frequency, least_damped_growth=growth)
    found = one(judge(told, load_limits()), "log decrement", "all", "")
    assert found.value == pytest.approx(-growth / frequency, rel=1e-3)  # 2 pi zeta of a lightly damped mode
    assert (found.place, found.grade, found.share) == ("shaft", Grade.BEYOND, pytest.approx(4.0, rel=1e-3))
    shaky = record.assign_attrs(least_damped_frequency=frequency, least_damped_growth=0.1)
    unstable = one(judge(shaky, load_limits()), "log decrement", "all", "")
    assert unstable.note == "20.00 Hz, unstable"
    assert conclude([unstable]).grounds.endswith(" at shaft against 0.1 (20.00 Hz, unstable)")
    assert "Hz" not in conclude([found]).grounds


def test_the_worst_of_each_limit_comes_first(verdicts):
    found = worst(verdicts)
    assert len({(v.limit, v.phase) for v in found}) == len(found)
    assert [v.grade.rank for v in found] == sorted((v.grade.rank for v in found), reverse=True)
    assert found[0].limit == "solid contact"


def test_a_calm_machine_is_tolerable():
    calm = synthetic_record.record("v3", fracture=None, end=0.4).isel(bearing=[8])
    found = judge(calm, load_limits())
    assert {v.phase for v in found} == {"steady", "all"}
    assert conclude(found).action is Action.TOLERABLE
    assert conclude(found).grounds == "every figure is within its limit"


def test_values_of_the_machine_come_first_and_travel_with_the_record(tmp_path, record):
    own = tmp_path / "limits.toml"
    own.write_text(
        '[stress]\nlargest = 20e6\nsource = "maker"\n[specific_load]\nsteady = 2e6\nsource = "maker"\n'
    )
    limits = load_limits(own)
    assert (limits.specific_load.short, limits.specific_load.read) == (15e6, True)
    assert limits_of(to_text(limits)) == limits
    found = judge(record, own_limits(record.assign_attrs(limits=to_text(limits))))
    stress = one(found, "normal stress", "before", "")
    assert (stress.place, stress.bound, stress.source_text()) == ("shaft", 20e6, "maker")
    assert stress.value == pytest.approx(float(record["normal_stress_max"][:1000].max()), rel=1e-3)
    assert one(found, "specific load, lasting", "before", "GEN-front").grade is Grade.BEYOND
    assert not [v for v in judge(record, load_limits()) if v.limit == "normal stress"]


def test_the_bundled_train_has_a_limit_of_its_own():
    assert load_limits(own_file(load_scenario("paper"))).stress.largest == 150e6
    assert own_file(load_scenario("small")) is None


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("[stress]\nlargest = -1.0\nsource='x'", "stress.largest = -1.0: Input should be greater than 0"),
        ("[stres]\nlargest = 1.0", "stres: unknown; did you mean 'stress'?"),
        ("[log_decrement]\nleats = 0.1", "log_decrement.leats: unknown; did you mean 'least'?"),
        ("[shaft_vibration]\nzone_ab = [1e-4]", "shaft_vibration: allowed are ascending speeds"),
        ("[least_film]\ndiameter = [1.0]", "least_film: allowed are a row for each diameter"),
        ("stress = ", "not TOML: "),
    ],
)
def test_wrong_limits_are_refused_in_a_line(tmp_path, text, line):
    path = tmp_path / "limits.toml"
    path.write_text(text)
    with pytest.raises(LimitsError) as caught:
        load_limits(path)
    assert f"{path}: {line}" in str(caught.value)


def test_every_limit_names_a_source():
    for limit in load_limits().model_dump(exclude_none=True).values():
        assert limit["source"]
    assert ShaftVibration.model_fields.keys() >= {"source", "read"}


def test_contact_in_the_first_sample_of_a_phase_has_its_instant(record):
    touched = record.isel(bearing=[0]).copy()
    at_once = 1e6 * (abs(touched["time"] - 1.0) < 1e-9) + 0.0 * touched["contact_force"]
    for name in ("contact_force", "contact_force_max"):
        touched[name] = at_once
    found = one(judge(touched, load_limits()), "solid contact", "after", "LP2-front")
    assert found.note == "0 % of the time, first at 1.0000 s"
