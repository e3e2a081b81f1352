"""Target loads by the catenary, and bending stress against beam theory."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotor_fmu.shaft.matrices import assemble
from rotor_fmu.shaft.statics import target_loads
from rotor_fmu.shaft.stress import bending_stress
from rotor_fmu.train.file import load_train
from rotor_fmu.train.train import Coupling, Material, Shoulder, Wheel
from tests.rotor_fmu.published_rotors import uniform_shaft, with_bearings

GRAVITY = 9.80665
STEEL = Material("steel", 2.1e11, 0.3, 7850.0)


def imbalance(train, loads):
    """Force and moment about the front end that loads and weight leave."""
    force = loads.sum() - GRAVITY * train.mass
    z = train.z
    moment = sum(load * z[b.node] for load, b in zip(loads, train.bearings, strict=True))
    moment -= GRAVITY * sum(s.mass * (z[k] + z[k + 1]) / 2 for k, s in enumerate(train.shoulders))
    moment -= GRAVITY * sum(w.mass * z[w.node] for w in train.wheels)
    return force, moment


def sagging(train, loads):
    """Full displacement under weight and these loads, rigid-body motion left at any value."""
    model = assemble(train)
    load = GRAVITY * model.gravity
    load[model.bearing_dofs[:, 1]] += loads
    held = np.concatenate([model.bearing_dofs[:2, 1], model.bearing_dofs[:2, 0]])
    free = np.setdiff1d(np.arange(model.size), held)
    u = np.zeros(model.size)
    u[free] = np.linalg.solve(model.K.toarray()[np.ix_(free, free)], load[free])
    return u


def given(train, **loads):
    return replace(train, bearings=tuple(replace(b, load=loads.get(b.name)) for b in train.bearings))


class TestTargetLoads:
    @pytest.mark.parametrize("name", ["small", "turbine"])
    def test_balance_with_the_weight(self, name):
        train = load_train(name)
        force, moment = imbalance(train, target_loads(train))
        assert force == pytest.approx(0.0, abs=1e-12 * GRAVITY * train.mass)
        assert moment == pytest.approx(0.0, abs=1e-12 * GRAVITY * train.mass * train.length)

    def test_lever_law(self):
        train = with_bearings(uniform_shaft(4.0, 0.3, 8, STEEL), 0, 4)
        train = replace(train, wheels=(Wheel("w", 6, 500.0, 1.0, 1.0),))
        # Bearings at 0 and 2 m, weight at 2 m, wheel at 3 m.
        shaft, wheel = GRAVITY * (train.mass - 500.0), GRAVITY * 500.0
        assert target_loads(train) == pytest.approx([-0.5 * wheel, shaft + 1.5 * wheel], rel=1e-12)

    def test_no_moment_and_least_shear_in_couplings(self):
        """Two rotors on two bearings each carry themselves; the coupling carries nothing."""
        train = with_bearings(uniform_shaft(8.0, 0.3, 16, STEEL), 1, 7, 9, 15)
        coupled = replace(train, couplings=(Coupling("c", 8),))
        assert target_loads(coupled) == pytest.approx([GRAVITY * train.mass / 4.0] * 4, rel=1e-12)

    def test_a_rotor_on_one_bearing_hangs_on_its_coupling(self):
        train = with_bearings(uniform_shaft(8.0, 0.3, 16, STEEL), 1, 7, 12)
        coupled = replace(train, couplings=(Coupling("c", 8),))
        rotor = GRAVITY * train.mass / 2.0
        # Second rotor, 4 to 8 m, on a bearing in its middle: no shear in the coupling.
        assert target_loads(coupled) == pytest.approx([rotor / 2.0, rotor / 2.0, rotor], rel=1e-12)
        rear = replace(coupled, bearings=(*coupled.bearings[:2], replace(coupled.bearings[2], node=16)))
        # On its rear end it hangs with half its weight on the coupling at 4 m; bearings at 0.5 and 3.5 m.
        shear = rotor / 2.0
        expected = [rotor / 2.0 - shear * 0.5 / 3.0, rotor / 2.0 + shear * 3.5 / 3.0, rotor / 2.0]
        assert target_loads(rear) == pytest.approx(expected, rel=1e-12)

    def test_couplings_of_the_turbine_are_free_of_moment(self):
        train = load_train("turbine")
        u = sagging(train, target_loads(train))
        moments = bending_stress(train).moments(u, GRAVITY).reshape(4, -1)
        couplings = [c.node for c in train.couplings]
        assert np.abs(moments[2:, couplings]).max() < 1e-7 * np.abs(moments).max()

    def test_a_given_load_is_kept_and_the_rest_balances(self):
        free = load_train("turbine")
        train = given(free, **{"LP1-rear": 1.9e6})
        loads = target_loads(train)
        assert loads[3] == 1.9e6
        assert imbalance(train, loads) == pytest.approx((0.0, 0.0), abs=1e-3)
        assert np.abs(loads - target_loads(free)).max() < 0.3e6

    def test_two_given_loads_need_moments_in_couplings(self):
        train = given(load_train("turbine"), **{"LP2-front": 1.9e6, "LP2-rear": 1.9e6})
        loads = target_loads(train)
        assert loads[4] == loads[5] == 1.9e6
        assert imbalance(train, loads) == pytest.approx((0.0, 0.0), abs=1e-3)

    def test_impossible_loads_are_refused(self):
        train = given(load_train("small"), front=1e3)
        with pytest.raises(ValueError, match=r"no static balance with 1 free bearing loads.*front 1000 N"):
            target_loads(train)


class TestBendingStress:
    def test_simply_supported_beam_with_steps(self):
        """Moments of a statically determinate beam do not depend on its diameters."""
        lengths, diameters = (0.7, 0.5, 0.8, 1.0), (0.3, 0.45, 0.4, 0.3)
        shoulders = tuple(Shoulder(a, d, 0.1, STEEL) for a, d in zip(lengths, diameters, strict=True))
        train = replace(
            with_bearings(uniform_shaft(3.0, 0.3, 4, STEEL), 0, 4),
            shoulders=shoulders,
            wheels=(Wheel("w", 2, 800.0, 1.0, 1.0),),
        )
        loads = target_loads(train)
        z = np.array(train.z)
        expected = loads[0] * z - GRAVITY * 800.0 * np.maximum(z - z[2], 0.0)
        for k, s in enumerate(shoulders):
            part = np.clip(z - z[k], 0.0, s.length)
            expected -= GRAVITY * s.mass / s.length * part * (z - z[k] - part / 2.0)
        bending = bending_stress(train)
        moments = bending.moments(sagging(train, loads), GRAVITY)
        front, behind = moments.reshape(4, -1)[2:]
        assert front[1:] == pytest.approx(expected[1:], abs=1e-6)
        assert behind[:-1] == pytest.approx(expected[:-1], abs=1e-6)

        modulus = np.array([s.section_moduli[0] for s in shoulders])
        weakest = np.minimum(np.append(modulus, np.inf), np.append(np.inf, modulus))
        assert bending.stress(moments) == pytest.approx(np.abs(expected) / weakest, abs=1e-3)

    def test_both_planes_combine(self):
        train = with_bearings(uniform_shaft(3.0, 0.3, 6, STEEL), 0, 6)
        model, bending = assemble(train), bending_stress(train)
        rng = np.random.default_rng(5)
        x, y = np.zeros((2, model.size))
        x[0::4], y[1::4] = rng.normal(size=(2, 7)) * 1e-4
        turned = np.zeros(model.size)
        turned[1::4] = x[0::4]
        along_x, along_y, both = (bending.stress(bending.moments(u, 0.0)) for u in (x, y, x + y))
        assert bending.stress(bending.moments(turned, 0.0)) == pytest.approx(along_x, rel=1e-12)
        assert np.all(both <= np.hypot(along_x, along_y) * (1.0 + 1e-12))
        assert both[0] == pytest.approx(np.hypot(along_x[0], along_y[0]), rel=1e-12)

    def test_pure_bending(self):
        """Circular bow of radius R: moment E I / R everywhere, stress E (d/2) / R."""
        train = uniform_shaft(2.0, 0.2, 4, STEEL)
        z, radius = np.array(train.z), 1e4
        u = np.zeros(4 * len(z))
        u[1::4], u[2::4] = z**2 / (2.0 * radius), -z / radius
        bending = bending_stress(train)
        assert bending.stress(bending.moments(u, 0.0)) == pytest.approx([2.1e11 * 0.1 / radius] * 5, rel=1e-9)

    def test_rigid_motion_strains_nothing(self):
        train = load_train("turbine")
        z = np.array(train.z)
        u = np.zeros(4 * len(z))
        u[0::4], u[3::4], u[1::4], u[2::4] = 1e-3 + 1e-4 * z, 1e-4, -2e-4 * z, 2e-4
        bending = bending_stress(train)
        assert bending.stress(bending.moments(u, 0.0)).max() < 10.0
