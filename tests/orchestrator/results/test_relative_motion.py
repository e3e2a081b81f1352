"""Journals are seen from their bores: on housings that move, in bores that sink, with oil that changes."""

import json

import numpy as np
import pytest

from fmus.port.bore import lobes, tilting, to_text
from orchestrator.results.geometry import in_housing
from orchestrator.results.relative_motion import film_states, journal_motion, parameters_at, room_of
from orchestrator.scenario.events import Change, to_json
from tests.orchestrator.results import synthetic_record

BEARING = "LP2-front"
SINKS = Change(bearing=BEARING, parameter="offset.y", by=-1e-4, time=0.5)
THICKER = Change(bearing=BEARING, parameter="viscosity", value=0.05, time=0.6)


@pytest.fixture(scope="module")
def record():
    """Of housings that swing, behind a bore that sinks and oil that thickens."""
    found = synthetic_record.record(end=0.8, fracture=None)
    swing = 1e-5 * np.sin(20.0 * found["time"].values)[:, None, None] * np.ones((1, 11, 2))
    dims = ("time", "bearing", "axis")
    rate = 2e-4 * np.cos(20.0 * found["time"].values)[:, None, None] * np.ones((1, 11, 2))
    housing = {"housing_displacement": (dims, swing), "housing_tilt": (dims, 0.0 * swing)}
    found = found.assign(housing | {"housing_velocity": (dims, rate)})
    return found.assign_attrs(events=to_json([SINKS, THICKER]))


def test_a_journal_is_seen_from_its_bore(record):
    seen = in_housing(record).sel(bearing=BEARING).transpose("axis", "time").values.copy()
    seen[1, record["time"].values >= 0.5] += 1e-4
    np.testing.assert_allclose(journal_motion(record, BEARING), seen, rtol=0.0, atol=1e-15)
    other = in_housing(record).sel(bearing="HP-front").transpose("axis", "time").values
    np.testing.assert_allclose(journal_motion(record, "HP-front"), other, rtol=0.0, atol=1e-15)


def test_a_film_sees_the_motion_in_its_bore(record):
    position, velocity, speed = film_states(record, BEARING, 100, 110)
    np.testing.assert_allclose(position[:, :2].T, journal_motion(record, BEARING)[:, 100:111], atol=1e-15)
    plain = record["velocity"] - record["housing_velocity"]
    np.testing.assert_allclose(velocity[:, :2], plain.sel(bearing=BEARING).values[100:111], atol=1e-15)
    assert (speed == synthetic_record.SPEED).all() and position.shape == (11, 4)


def test_parameters_are_those_of_their_instant(record):
    assert parameters_at(record, BEARING, 0.55)["viscosity"] == synthetic_record.FILM.viscosity
    assert parameters_at(record, BEARING, 0.6)["viscosity"] == 0.05
    assert parameters_at(record, "HP-front", 0.7)["viscosity"] == synthetic_record.FILM.viscosity
    assert parameters_at(record.drop_vars("bearing_parameters"), BEARING, 0.1) == {}


@pytest.mark.parametrize(
    ("bore", "least", "largest"),
    [((), 1.0, 1.0), (lobes(2, 0.5), 0.5, np.sqrt(0.75)), (tilting(4, 1.2, 0.2), 0.8, 0.8 * np.sqrt(2.0))],
)
def test_the_room_of_a_journal_is_that_of_its_bore(record, bore, least, largest):
    values = json.dumps(synthetic_record.FILM.values() | {"bore": to_text(bore)})
    reach = np.hypot(*room_of(record.assign(bearing_parameters=("bearing", [values] * 11)), BEARING, 721))
    assert reach.min() == pytest.approx(least * synthetic_record.CLEARANCE, rel=1e-4)
    assert reach.max() == pytest.approx(largest * synthetic_record.CLEARANCE, rel=1e-2)
