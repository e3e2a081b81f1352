"""Depth table: its splines, its tangent, and how near it is to the film that it stands for."""

from __future__ import annotations

import shutil
from dataclasses import replace
from time import perf_counter

import numpy as np
import pytest
from numba import njit

from bearing_fmu import depths
from bearing_fmu.film import make_film
from bearing_fmu.films.table import store
from bearing_fmu.films.table.build import build, looked_up, unit_bearing
from bearing_fmu.films.table.spline import coefficients
from bearing_fmu.films.table.store import table_of
from bearing_fmu.result import RESULTS
from fmus.port.bore import grooved, lobes, tilting, to_text
from tests.bearing_fmu.bearings import SPEED, TURBINE, lever, respond
from tests.bearing_fmu.bearings import table as reference
from tests.faults import fault

RATIO = (TURBINE.width / TURBINE.diameter) ** 2


def journals(count, most=3.0):
    """Rotating journals anywhere with gaps down to a thousandth of the clearance, moving in any direction."""
    random = np.random.default_rng(3)
    for _ in range(count):
        e, angle = 1.0 - 10.0 ** random.uniform(-most, 0.0), random.uniform(0.0, 2.0 * np.pi)
        yield [e * np.cos(angle), e * np.sin(angle), 0.0, 0.0], [*random.normal(scale=0.2, size=2), 0.0, 0.0]


def smooth(r, angle):
    """A function without symmetry that is smooth in x and y."""
    x, y = r * np.cos(angle), r * np.sin(angle)
    return np.exp(0.5 * x) * (1.0 + y) + x * y * y


def missed_by_splines(n, m):
    """Largest error at the points, and half way between them."""
    radii, angles = np.linspace(0.0, 1.0, n), 2.0 * np.pi / m * np.arange(m)
    values = smooth(radii[:, None], angles)
    found = coefficients(values[..., None], flat=False)[..., 0]
    at, between = np.array([0.0, 1.0, 4.0, 1.0]) / 6.0, np.array([1.0, 23.0, 23.0, 1.0]) / 48.0
    points, middle = (
        [[w @ found[i : i + 4, j : j + 4] @ w for j in range(m)] for i in range(n - 1)]
        for w in (at[[1, 2, 3, 0]], between)
    )
    expected = smooth(radii[:-1, None] + 0.5 * radii[1], angles + np.pi / m)
    return np.abs(np.array(points) - values[:-1]).max(), np.abs(np.array(middle) - expected).max()


def test_splines_over_a_disc_meet_what_is_smooth_there():
    """To rounding at the points, to fourth order between them, next to the middle of the disc as well."""
    (there, coarse), (_, fine) = missed_by_splines(12, 16), missed_by_splines(23, 32)
    assert there < 1e-13
    assert fine < 1e-4 and coarse > 12.0 * fine


def test_table_is_the_aligned_film_on_the_finest_grid():
    """Within 0.2 % of the force at any state, of what pressing journals' K and C are 1 %."""
    fine, table = make_film("v2", replace(TURBINE, columns=512)), make_film("table", TURBINE)
    errors, slopes = [], []
    for q, v in journals(150):
        here, there = (respond(film, q, v, SPEED) for film in (table, fine))
        errors.append(np.linalg.norm(here.wrench - there.wrench) / np.linalg.norm(there.wrench))
        slopes += [np.linalg.norm(a - b) / np.linalg.norm(b) for a, b in (
            (here.stiffness, there.stiffness), (here.damping, there.damping))]  # fmt: skip
        assert here.friction_power == pytest.approx(there.friction_power, rel=2e-3)
        assert here.p_max == pytest.approx(there.p_max, rel=0.02)
        assert (here.h_min, here.eccentricity) == (there.h_min, there.eccentricity)
    assert np.quantile(errors, 0.95) < 8e-4 and max(errors) < 2e-3
    assert np.median(slopes) < 2e-3 and np.quantile(slopes, 0.9) < 0.02


def test_table_where_runs_through_a_fracture_are_hardest():
    """Nowhere there more than 0.05 % off the limit of V2, which its usual grid misses by up to 0.6 %."""
    films = [make_film("v2", replace(TURBINE, columns=n)) for n in (512, 48)] + [make_film("table", TURBINE)]
    errors = []
    for row in reference("leaving_states.csv"):
        q, v = ([float(row[name]) for name in names] + [0.0, 0.0] for names in (("x", "y"), ("vx", "vy")))
        limit, usual, looked_up = (respond(film, q, v, SPEED).wrench for film in films)
        errors.append([np.linalg.norm(f - limit) / np.linalg.norm(limit) for f in (usual, looked_up)])
    usual, looked_up = np.array(errors).T
    assert len(errors) > 20
    assert looked_up.max() < 5e-4
    assert usual.max() < 6e-3


@pytest.mark.slow
def test_table_with_reynolds_condition_is_v2_with_it():
    """Within 0.5 % of the force on the table's grid, and as told; the active set goes node by node."""
    bearing = replace(TURBINE, boundary="reynolds")
    fine, table, guembel = (
        make_film(depth, replace(bearing, **changes))
        for depth, changes in (("v2", {"columns": 144}), ("table", {}), ("table", {"boundary": "guembel"}))
    )
    errors, other = [], []
    for q, v in journals(150):
        here, there, half = (respond(film, q, v, SPEED).wrench for film in (table, fine, guembel))
        errors.append(np.linalg.norm(here - there) / np.linalg.norm(there))
        other.append(np.linalg.norm(half - there) / np.linalg.norm(there))
    assert max(errors) < 5e-3 and np.median(errors) < 5e-4 < 0.02 < np.median(other)
    assert table_of(bearing).typical < 5e-3


def test_bound_is_what_is_found():
    """The deviation that a user is told, against states of its own."""
    built = table_of(TURBINE)
    assert 0.0 < built.typical < built.largest < 2e-3


def test_tangent_is_exact():
    film, units = make_film("table", TURBINE), lever(TURBINE)
    still = ([0.0] * 4, [0.1, -0.2, 0.0, 0.0])
    for q, v in (*journals(40), still, ([0.0, -1.004, 0.0, 0.0], [0.1, 0.0, 0.0, 0.0])):
        q, v = np.array(q), np.array(v)
        bound = 2e-5 if q.any() else 2e-4  # in the very middle the slopes of two cubics nearly meet
        here, gap = respond(film, q, v, SPEED), 1.001 - np.hypot(*q[:2])
        for slope, move, rate in ((here.stiffness, abs(gap) + 1e-4, 0.0), (here.damping, 0.0, 1.0)):
            for k in range(2):
                step = 1e-6 * (move + rate) * np.eye(4)[k]
                ends = [
                    respond(film, q + s * step * (move > 0.0), v + s * rate * step, SPEED).wrench
                    for s in (-1.0, 1.0)
                ]
                length = 2.0 * step[k] * units[k] * (SPEED if rate else 1.0)
                np.testing.assert_allclose(
                    (ends[0] - ends[1]) / length, slope[:, k], atol=bound * np.linalg.norm(slope[:, k])
                )


def test_an_odd_number_of_angles_is_refused():
    """Lines through the middle of the disc would have nothing across to go on to."""
    with pytest.raises(ValueError, match="95 angles; allowed is an even number"):
        build(unit_bearing(TURBINE), 80, 95)


def test_turned_and_mirrored_journals():
    film, turn = make_film("table", TURBINE), np.array([[0.0, -1.0], [1.0, 0.0]])
    for q, v in journals(10):
        here = respond(film, q, v, SPEED).wrench[:2]
        turned = respond(film, [*turn @ q[:2], 0.0, 0.0], [*turn @ v[:2], 0.0, 0.0], SPEED).wrench[:2]
        np.testing.assert_allclose(turned, turn @ here, rtol=1e-9, atol=1e-9 * np.linalg.norm(here))
        mirrored = respond(film, [q[0], -q[1], 0, 0], [v[0], -v[1], 0, 0], -SPEED).wrench[:2]
        np.testing.assert_allclose(mirrored, here * [1.0, -1.0], rtol=1e-9, atol=1e-9 * np.linalg.norm(here))


@pytest.mark.slow
def test_an_evaluation_takes_a_microsecond_at_most():
    table = table_of(TURBINE).table()
    ratio, sigma, result = RATIO, TURBINE.roughness / TURBINE.clearance, np.zeros(RESULTS)

    @njit
    def many(count, table, q, v, result):
        for i in range(count):
            q[0] = 0.3 + 0.05 * (i % 7)
            looked_up(table, q, v, 1.0, sigma, ratio, result)

    q, v = np.array([0.3, -0.5]), np.array([0.1, 0.2])
    many(1, table, q, v, result)
    taken = []
    for _ in range(20):
        start = perf_counter()
        many(2000, table, q, v, result)
        taken.append((perf_counter() - start) / 2000)
    assert min(taken) < 1e-6


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"ambient_pressure": 1e5}, "ambient_pressure = 100000.0: the table film knows 0 only"),
        (
            {"turbulence": "constantinescu"},
            "turbulence = 'constantinescu': the table film is laminar; use depth v2",
        ),
        (
            {"bore": to_text(grooved(lobes(2, 0.5), [(0.0, 0.3)]))},
            "the table film knows the plain bore only; use depth v2",
        ),
        ({"bore": to_text(tilting(4, 1.2, 0.0))}, "the table film knows the plain bore only; use depth v2"),
        (
            {"boundary": "jfo", "ambient_pressure": 1e5},
            "boundary = 'jfo': the table film has guembel and reynolds only; use depth v1",
        ),
        (
            {"layer_thickness": 5e-3},
            "layer_thickness = 0.005: the table film knows rigid bores only; use depth v2",
        ),
    ],
)
@fault(
    "film",
    "a bearing that the table cannot stand for: ambient pressure, turbulence, grooves, a layer, jfo",
    "ValueError with key and value; runs end before they begin",
    guard="bearing_fmu.films.table.depth:_parameters",
)
def test_what_a_table_does_not_know(changes, words):
    with pytest.raises(ValueError, match=words):
        make_film("table", replace(TURBINE, **changes))


@fault(
    "machine",
    "a kept table that is damaged, or no folder that takes one",
    "it is built anew; no error, no wrong number",
    guard="bearing_fmu.films.table.store:_read",
)
def test_a_kept_table_is_read_whole_or_not_at_all(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "of"))
    monkeypatch.setattr(store, "build", lambda unit: build(unit, 16, 16))
    unit = unit_bearing(TURBINE)
    fresh, was_built = store._of_unit.__wrapped__(unit)
    (path,) = store.folder().iterdir()
    kept, built_again = store._of_unit.__wrapped__(unit)
    assert was_built and not built_again
    np.testing.assert_array_equal(kept.coefficients, fresh.coefficients)
    told = ("last", "typical", "largest", "columns")
    assert [getattr(kept, name) for name in told] == [getattr(fresh, name) for name in told]
    whole = bytearray(path.read_bytes())
    whole[len(whole) // 2] ^= 1
    for damaged in (b"", bytes(len(whole)), whole):
        path.write_bytes(damaged)
        assert store._of_unit.__wrapped__(unit)[1]
    monkeypatch.setenv("XDG_CACHE_HOME", str(path))
    assert store._of_unit.__wrapped__(unit)[1]


@pytest.mark.parametrize(
    "source",
    [
        "films/corners.py",
        "films/turbulence.py",
        "films/tilted/rupture.py",
        "result.py",
        "parameters.py",
        "film.py",
    ],
)
def test_a_table_is_built_anew_when_what_it_follows_from_changes(source, tmp_path, monkeypatch):
    package = tmp_path / "bearing_fmu"
    shutil.copytree(store._PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(store, "_PACKAGE", package)
    before = store._sources.__wrapped__()
    path = package / source
    path.write_text(path.read_text(encoding="utf-8") + "# changed\n", encoding="utf-8")
    assert store._sources.__wrapped__() != before


def test_a_table_is_told_of_once(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(store, "build", lambda unit: build(unit, 16, 16))
    store._of_unit.cache_clear()
    try:
        depth = depths.find("table")
        assert depth.prepare(TURBINE.values()).startswith("bearing table b/d 0.8, roughness 0.0035 of the")
        assert depth.prepare(replace(TURBINE, viscosity=0.1).values()) == ""
        assert depths.find("v2").prepare(TURBINE.values()) == ""
    finally:
        store._of_unit.cache_clear()
