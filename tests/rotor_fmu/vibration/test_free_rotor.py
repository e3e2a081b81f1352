"""Rotors that run freely, under torques and friction alone, against closed forms and an integration."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from bearing_fmu.film import make_film
from fmus.port import RELEASED, VACUUM_BROKEN
from rotor_fmu.vibration.drive import Braking, Drive, torque_of
from rotor_fmu.vibration.spin import Spin
from tests.bearing_fmu.bearings import plain, respond
from tests.rotor_fmu.small_shafts import (
    OMEGA,
    jeffcott,
    unbalance,
)


def freely(drive, speed, friction, broken, steps, step=1e-3):
    """Speed of a balanced rotor at rest in its bearings after steps of its own."""
    spin = Spin(unbalance([0.0], [0.0]), drive.inertia)
    on = {VACUUM_BROKEN} if broken else set()
    on |= set() if drive.torque else {RELEASED}
    for _ in range(steps):
        now = drive.braking(speed, friction, on)
        speed = spin.speed_after((0.0, speed), step, (0j, 0j), now, 0.0)
    return speed


def test_a_free_rotor_obeys_its_torques():
    """Windage alone: W0 / (1 + c W0 t / I); friction of constant power: the root of the rest; a torque."""
    speed, friction, inertia, windage = 300.0, 2e4, 50.0, 0.2
    airy, dry = Drive(inertia=inertia, windage_broken=windage), Drive(inertia=inertia)
    slowed = speed / (1.0 + windage * speed * 5.0 / inertia)
    assert freely(airy, speed, 0.0, True, 5000) == pytest.approx(slowed, rel=1e-3)
    rubbed = math.sqrt(speed**2 - 2.0 * friction * 5.0 / inertia)
    assert freely(dry, speed, friction, True, 5000) == pytest.approx(rubbed, rel=1e-12)
    assert freely(dry, 1.0, friction, False, 1, 1.0) == 0.0
    driven = Drive(inertia=inertia, torque=torque_of("[[0, 400]]"))
    assert freely(driven, 0.0, 0.0, False, 5000) == pytest.approx(400.0 * 5.0 / inertia, rel=1e-12)
    falling = Drive(inertia=inertia, torque=torque_of("[[0, 400], [100, 0]]"))
    rise = 100.0 * (1.0 - math.exp(-400.0 / 100.0 / inertia * 5.0))
    assert freely(falling, 0.0, 0.0, False, 5000) == pytest.approx(rise, rel=1e-4)
    with pytest.raises(ValueError, match="allowed for a free rotor"):
        Drive().is_free({RELEASED})
    with pytest.raises(ValueError, match="a torque in N m"):
        torque_of("[[1]]")


def test_a_free_rotor_in_centred_journals_slows_down_after_petroff():
    """W0 exp(-c t / I) with c = 2 pi eta R^3 b / C, first order in the step; what it loses is friction."""
    p, speed, inertia, still = plain(0.8), 150.0, 20.0, (0j, 0j)
    film = make_film("v3", p)
    torque = 2.0 * np.pi * p.viscosity * p.radius**3 * p.width / p.clearance
    total, spin, errors = 0.5 * inertia / torque, Spin(unbalance([0.0], [0.0]), inertia), []
    for steps in (400, 800):
        now, lost, step = speed, 0.0, total / steps
        for _ in range(steps):
            power = respond(film, [0, 0, 0, 0], speed=now).friction_power
            now = spin.speed_after((0.0, now), step, still, Braking(0.0, power, 0.0), 0.0)
            lost += power * step
        errors.append(now / (speed * math.exp(-0.5)) - 1.0)
        assert lost == pytest.approx(0.5 * inertia * (speed**2 - now**2), rel=1e-12)
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=5e-3)
    assert 2.0 * errors[1] - errors[0] == pytest.approx(0.0, abs=1e-6)


def test_a_free_unbalanced_rotor_against_its_equations_of_motion():
    """An inertia so small that vibration counts, against Runge and Kutta; the energy is accounted for.

    The angle is a coordinate: I phi'' = T - P / phi' + x'' sin phi - y'' cos phi.
    """
    zeta, inertia, start, total, step, torque, power = 0.05, 400.0, 150.0, 0.6, 2e-4, 900.0, 2e5
    rotor, law = jeffcott(zeta, start, inertia=inertia, track_work=True)
    rotor.start_from_law(*law, orbit=True)
    first = rotor.kinematics()[0]

    def stored():
        return np.array([sum(rotor.energy()), rotor.energy_of_rotation()])

    before = stored()
    for k in range(round(total / step)):
        rotor.freely(k * step, step, *law, Braking(torque, power, 0.0))

    def motion(t, s):
        x, y, u, v, angle, speed = s
        c, n = math.cos(angle), math.sin(angle)
        inertias = np.array([[1.0, 0.0, -n], [0.0, 1.0, c], [-n, c, inertia]])
        right = np.array([
            speed**2 * c - OMEGA**2 * x - 2.0 * zeta * OMEGA * u,
            speed**2 * n - OMEGA**2 * y - 2.0 * zeta * OMEGA * v,
            torque - power / speed,
        ])  # fmt: skip
        found = np.linalg.solve(inertias, right)
        return np.concatenate([[u, v], found[:2], [speed, found[2]]])

    states = [*first[:2], *first[4:6], 0.0, start]
    exact = solve_ivp(motion, (0.0, total), states, method="DOP853", rtol=1e-10, atol=1e-12).y[:, -1]
    bare = start + (torque - 1e3) / inertia * total
    assert abs(exact[5] - bare) > 0.02 * start  # what the vibration takes is seen
    assert rotor.speed == pytest.approx(exact[5], rel=1e-4)
    np.testing.assert_allclose(rotor.kinematics()[0, :2], exact[:2], atol=0.02 * np.hypot(*exact[:2]))
    work, (vibration, rotation) = rotor.work(), stored() - before
    assert vibration == pytest.approx(
        work.bearings + work.unbalance - work.damping, abs=2e-3 * work.unbalance
    )
    given = work.drive - work.friction - work.windage - work.unbalance
    assert rotation == pytest.approx(given, abs=1e-4 * work.friction)
    assert work.friction == pytest.approx(power * total, rel=1e-12)
