"""The start of a run on the oscillators, whose equilibrium and orbit are known in closed form."""

from dataclasses import replace

import numpy as np
import pytest

from orchestrator.errors import EquilibriumError
from orchestrator.fmi.unit import Unit
from orchestrator.master.start.equilibrium import apply_start, find_start
from orchestrator.master.start.journal_position import aligned_positions, tilted_positions
from orchestrator.master.system import System
from rotor_fmu.train.train import BearingSeat, Material, Shoulder, Train
from tests.orchestrator.toy_train import (
    CLEARANCE,
    DAMPING,
    INNER_MASS,
    JOURNAL_MASS,
    SHAFT_DAMPING,
    SHAFT_STIFFNESS,
    SPEED,
    STIFFNESS,
    WEIGHT,
)

UNBALANCE, PHASE = 0.02, 0.7
SEATS = tuple(
    BearingSeat(name, 1, 0.8, 0.4, CLEARANCE, 0.02, residual_tilt_x=tilt)
    for name, tilt in (("front", 1e-5), ("rear", -2e-5))
)
STEEL = Material("steel", 2.1e11, 0.3, 7850.0)
TRAIN = Train("toy", SPEED, 0.0, 0.0, 0.0, 3 * (Shoulder(1.0, 0.8, 0.0, STEEL),), (), SEATS)


@pytest.fixture
def system(store, toy_fmus):
    rotor = Unit(store.open(toy_fmus / "two_masses.fmu"), "rotor")
    bearings = [Unit(store.open(toy_fmus / "spring_damper.fmu"), seat.name) for seat in SEATS]
    system = System(rotor, bearings)
    rotor.set_parameters({"wheel[1].unbalance": UNBALANCE, "wheel[1].unbalance_phase": PHASE})
    for unit in bearings:
        unit.set_parameters({"clearance": CLEARANCE})
    for unit in system.units:
        unit.enter_initialization()
    yield system
    system.close()


def orbit_of_the_front_journal():
    """Phasor of x of the journal mass, by the 2x2 complex stiffness of the oscillator."""
    link = SHAFT_STIFFNESS + 1j * SPEED * SHAFT_DAMPING
    film = STIFFNESS + 1j * SPEED * DAMPING
    matrix = np.array(
        [
            [link + film - SPEED**2 * JOURNAL_MASS, -link],
            [-link, link - SPEED**2 * INNER_MASS],
        ]
    )
    return np.linalg.solve(matrix, [0.0, UNBALANCE * SPEED**2 * np.exp(1j * PHASE)])[0]


def test_start_in_closed_form(system):
    start = find_start(system, TRAIN, SPEED)
    relative = start.static - start.offsets
    np.testing.assert_allclose(start.loads[:, 1], WEIGHT, rtol=1e-9)
    np.testing.assert_allclose(relative[:, 1], -WEIGHT / STIFFNESS, rtol=1e-9)
    np.testing.assert_allclose(relative[:, 0], 0.0, atol=1e-12)
    np.testing.assert_allclose(relative[:, 2], [-1e-5, 2e-5], rtol=1e-9)
    phasor = orbit_of_the_front_journal()
    np.testing.assert_allclose(start.cosine[0, :2], [phasor.real, phasor.imag], rtol=1e-9)
    np.testing.assert_allclose(start.sine[0, :2], [-phasor.imag, phasor.real], rtol=1e-9)
    np.testing.assert_allclose([start.cosine[1], start.sine[1]], 0.0, atol=1e-15)
    sag = start.static_line[1::2, 1] - start.static_line[0::2, 1]
    np.testing.assert_allclose(sag, -INNER_MASS * 9.80665 / SHAFT_STIFFNESS, rtol=1e-9)


def test_a_run_from_this_start_has_no_transient(system):
    start = find_start(system, TRAIN, SPEED)
    apply_start(system, start)
    for unit in system.units:
        unit.exit_initialization()
    for group in system.groups:
        group.fetch()
    step, times, path = 1e-4, [], []
    for k in range(1, 1001):
        for group in system.groups:
            group.feed()
            group.step((k - 1) * step, step)
            group.fetch()
        times.append(k * step)
        path.append(system.journals[0, :2].copy())
    angle = SPEED * np.array(times)[:, None]
    expected = start.static[0, :2] + start.cosine[0, :2] * np.cos(angle) + start.sine[0, :2] * np.sin(angle)
    size = np.hypot(*start.cosine[0, :2])
    np.testing.assert_allclose(path, expected, atol=2e-4 * size)


def test_newton_finds_the_root_of_a_nonlinear_film(system):
    cubic = 3.0 * STIFFNESS / CLEARANCE**2
    for unit in system.bearings:
        unit.set_parameters({"spring.cubic": cubic})
    loads = np.array([WEIGHT, 3.0 * WEIGHT])
    clearances = np.full(2, CLEARANCE)
    forces = np.column_stack([np.zeros(2), loads])
    positions = aligned_positions(system, forces, clearances)
    tilts = np.array([[1e-4, 0.0], [0.0, 1e-4]])
    positions = tilted_positions(system, forces, positions, tilts, np.zeros(2))
    y = positions[:, 1]
    np.testing.assert_allclose(-STIFFNESS * y - cubic * y**3, loads, rtol=1e-9)
    np.testing.assert_array_equal(positions[:, 2:], [[1e-4, 0.0], [0.0, 1e-4]])


def test_a_film_too_weak_for_its_load_is_named(system):
    system.bearings[1].set_parameters({"spring.stiffness": 0.5 * WEIGHT / CLEARANCE})
    with pytest.raises(EquilibriumError, match=r"rear: the film carries 24\d\d N of the load 4903 N at most"):
        find_start(system, TRAIN, SPEED)


@pytest.mark.parametrize("direction", [(0.0, -1.0), (1.0, 0.0), (-0.6, 0.8), (0.0, 1.0)])
def test_loads_in_any_direction(system, direction):
    """Journals go where their loads push them: against gravity, too."""
    forces = np.outer([WEIGHT, 0.5 * WEIGHT], direction)
    positions = aligned_positions(system, forces, np.full(2, CLEARANCE))
    np.testing.assert_allclose(positions[:, :2], -forces / STIFFNESS, rtol=1e-9, atol=1e-15)


def test_without_weight_journals_hover_in_the_middle(system):
    system.rotor.set_parameters({"gravity": 0.0})
    start = find_start(system, TRAIN, SPEED)
    np.testing.assert_allclose(start.loads, 0.0, atol=1e-9 * WEIGHT)
    np.testing.assert_allclose((start.static - start.offsets)[:, :2], 0.0, atol=1e-12)
    phasor = orbit_of_the_front_journal()
    np.testing.assert_allclose(start.cosine[0, :2], [phasor.real, phasor.imag], rtol=1e-9)


def test_bearings_stand_at_the_heights_given(system):
    """The oscillators do not hold each other: a height lifts its journal, and the load stays."""
    heights = 3e-4, -1e-4
    seats = tuple(replace(seat, height=h) for seat, h in zip(SEATS, heights, strict=True))
    start = find_start(system, replace(TRAIN, bearings=seats), SPEED)
    np.testing.assert_allclose(start.offsets[:, :2], [(0.0, h) for h in heights], atol=1e-15)
    np.testing.assert_allclose(start.static[:, 1], np.array(heights) - WEIGHT / STIFFNESS, rtol=1e-9)
    np.testing.assert_allclose(start.loads[:, 1], WEIGHT, rtol=1e-9)
