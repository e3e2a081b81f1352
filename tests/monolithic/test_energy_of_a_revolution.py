"""Energy over a revolution of the steady unbalance response of the small train.

At constant speed the drive supplies the work of the unbalance on the shaft and the torque of the films.
The lateral motion passes what it gets from the unbalance to the films (F.v) and to the damping of the shaft;
the films lose what they get from the drive and from the lateral motion in shear, pressure flow and contact:

    lateral   W_unbalance + W_bearings - W_damping = 0,            W_bearings = integral of F.v dt
    films     integral of (T speed - F.v) dt = losses of the films and contacts
    together  drive:  W_unbalance + integral of T speed dt = W_damping + losses

The balance of a film alone, at prescribed motions, is proved in tests/bearing_fmu/films/test_film_energy.py.
"""

from dataclasses import dataclass

import numpy as np
import pytest

from bearing_fmu.film import make_film
from bearing_fmu.parameters import BearingParameters
from rotor_fmu.train.file import load_train
from rotor_fmu.vibration.rotor import Rotor
from rotor_fmu.vibration.work import Work
from tests.bearing_fmu.films.test_film_energy import reynolds_losses, short_losses

GRAVITY = 9.80665
UNBALANCE = 0.05  # kg m at the middle wheel: a sixth of what the lost blade leaves
SETTLING = 90  # revolutions until the whirl of the start has gone, in coarse steps
COARSE, FINE = 100, 400  # steps a revolution
AGAIN = 10  # revolutions in fine steps before the one that counts
SAMPLES = 8  # of the films' losses in a revolution
FRICTION = 49


def parameters(seat):
    values = (seat.diameter, seat.width, seat.clearance, seat.viscosity, seat.ambient_pressure)
    return BearingParameters(*values, seat.roughness, seat.contact_modulus, seat.friction)


class Coupled:
    """Rotor and films stepped together: the rotor under the laws of the films, then the films."""

    def __init__(self, depth):
        self.train = train = load_train("small")
        wheels = np.zeros(len(train.wheels))
        wheels[1] = UNBALANCE
        self.rotor = Rotor.of_train(train, gravity=GRAVITY, unbalance=wheels, track_work=True)
        self.bearings = [parameters(seat) for seat in train.bearings]
        self.films = [make_film(depth, bearing) for bearing in self.bearings]
        self.inputs = np.zeros((len(self.films), 17))
        self.inputs[:, 16] = train.speed
        self.out = np.zeros((len(self.films), 58))
        self.offsets = np.zeros((len(self.films), 4))
        self._find_start()

    def evaluate(self):
        self.inputs[:, :8] = self.rotor.kinematics()
        for inputs, offset, out, film in zip(self.inputs, self.offsets, self.out, self.films, strict=True):
            assert film.solve(inputs, offset, out) == 0

    @property
    def law(self):
        count = len(self.films)
        blocks = self.out[:, 8:24].reshape(count, 4, 4), self.out[:, 24:40].reshape(count, 4, 4)
        return self.out[:, 4:8].copy(), *(np.ascontiguousarray(block) for block in blocks)

    def _find_start(self):
        """Bearings in line with the bent shaft; static equilibrium by Newton's method; linear response."""
        count = len(self.films)
        support = np.tile(np.diag([1e9, 1e9, 0.0, 0.0]), (count, 1, 1))
        none = np.zeros((count, 4, 4))
        self.rotor.start_from_law(np.zeros((count, 4)), support, none, orbit=False)
        self.offsets[:] = self.rotor.kinematics()[:, :4]
        start = np.array([0.5, -0.6, 0.0, 0.0]) * self.bearings[0].clearance
        self.inputs[:, :4] = self.offsets + start
        for _ in range(30):
            for inputs, offset, out, film in zip(
                self.inputs, self.offsets, self.out, self.films, strict=True
            ):
                assert film.solve(inputs, offset, out) == 0
            before = self.inputs[:, :4].copy()
            self.rotor.start_from_law(*self.law, orbit=False)
            step = self.rotor.kinematics()[:, :4] - before
            largest = np.abs(step[:, :2]).max() / (0.05 * self.bearings[0].clearance)
            self.inputs[:, :4] = before + step / max(1.0, largest)
            self.inputs[:, 4:8] = 0.0
            if largest < 1e-9:
                break
        assert largest < 1e-9
        self.rotor.start_from_law(*self.law, orbit=True)
        self.evaluate()

    def step(self, time, length):
        self.rotor.step(time, length, *self.law, self.train.speed)
        self.evaluate()

    def march(self, time, revolutions, length, steps):
        for k in range(revolutions * steps):
            self.step(time + k * length, length)

    def powers(self):
        """Of the drive into the films, T speed, and of the films on the lateral motion, F.v, W."""
        return self.out[:, FRICTION].sum(), float(np.sum(self.out[:, :4] * self.inputs[:, 4:8]))

    def losses(self, depth):
        """Of the films, from pressures of a solution of its own, W."""
        total = 0.0
        for inputs, offset, bearing in zip(self.inputs, self.offsets, self.bearings, strict=True):
            q, v = inputs[:4] - offset, inputs[4:8].copy()
            if depth == "v2":
                q[2:], v[2:] = 0.0, 0.0
            compute = short_losses if depth == "v3" else reynolds_losses
            total += sum(compute(bearing, q, v, self.train.speed))
        return total


@dataclass
class Revolution:
    """Energies of one revolution, J."""

    stored: float
    work: Work
    drive: float
    lateral: float
    losses: float


@pytest.fixture(scope="module", params=["v1", "v3"])
def revolution(request):
    """Energies of one revolution long after the start."""
    coupled = Coupled(request.param)
    period = 2.0 * np.pi / coupled.train.speed
    coupled.march(0.0, SETTLING, period / COARSE, COARSE)
    coupled.march(SETTLING * period, AGAIN, period / FINE, FINE)
    energy, work = sum(coupled.rotor.energy()), coupled.rotor.work()
    powers, losses = [coupled.powers()], []
    for k in range(FINE):
        coupled.step((SETTLING + AGAIN) * period + k * period / FINE, period / FINE)
        powers.append(coupled.powers())
        if k % (FINE // SAMPLES) == 0:
            losses.append(coupled.losses(request.param))
    assert not coupled.out[:, 44].any()  # no solid contact: the films alone
    drive, lateral = np.trapezoid(powers, dx=period / FINE, axis=0)
    done = Work(*(a - b for a, b in zip(coupled.rotor.work(), work, strict=True)))
    stored = sum(coupled.rotor.energy()) - energy
    return Revolution(stored, done, drive, lateral, float(np.mean(losses)) * period)


def test_the_response_is_steady(revolution):
    assert abs(revolution.stored) < 5e-3 * revolution.work.unbalance


def test_lateral_motion_passes_on_what_the_unbalance_gives(revolution):
    work = revolution.work
    assert work.unbalance > 0.0 and work.damping > 0.0 and work.bearings < 0.0
    # To rounding, with the little that is stored; and with the forces that the films report.
    given = work.unbalance + work.bearings - work.damping
    assert given == pytest.approx(revolution.stored, abs=1e-9 * work.unbalance)
    assert work.bearings == pytest.approx(revolution.lateral, rel=2e-3)


def test_drive_and_unbalance_supply_what_films_and_shaft_lose(revolution):
    supplied = revolution.drive + revolution.work.unbalance
    lost = revolution.losses + revolution.work.damping
    assert supplied == pytest.approx(lost, rel=1e-3)
