"""The rotor FMU gives what `Rotor` gives, to the bit, and hovers with its start values."""

import json
import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from fmus import port
from rotor_fmu.facade import RotorSlave
from rotor_fmu.recipe import rotor_recipe
from rotor_fmu.start_values import default_starts
from rotor_fmu.vibration.affine_step import NoFiniteResult
from rotor_fmu.vibration.rotor import Rotor

H = 1e-4


@pytest.fixture
def host(hosts):
    return hosts["rotor_small.fmu"]


@pytest.fixture
def unit(host):
    instance = host.open("rotor")
    yield instance
    instance.slave.freeInstance()


@pytest.fixture(scope="module")
def starts(small_train):
    return default_starts(small_train)


def names(train, quantities, prefix=""):
    return [port.at_bearing(i, prefix + q) for i, q in product(range(1, len(train.bearings) + 1), quantities)]


def journals(unit, train):
    return np.reshape(unit.get(*names(train, port.KINEMATICS, "journal.")), (len(train.bearings), 8))


def law_of(train):
    """A film-like law: stiff, damped, coupled, other at each bearing."""
    n = len(train.bearings)
    size = np.linspace(1.0, 1.5, n)[:, None, None]
    K = size * np.diag([3e8, 5e8, 2e6, 3e6]) + size * 1e7 * np.eye(4)[[1, 0, 3, 2]]
    C = 2e-3 * K
    F0 = np.tile([1e3, 6e4, 10.0, -20.0], (n, 1))
    return F0, K, C


def set_law(unit, train, law):
    F0, K, C = law
    values = np.concatenate((F0, K.reshape(-1, 16), C.reshape(-1, 16)), axis=1).ravel()
    unit.set(dict(zip(names(train, port.LAW), values.tolist(), strict=True)))


def test_loads_and_positions_follow_from_train_and_gravity(unit, small_train):
    unit.set({"gravity": 5.0})
    assert sum(unit.get(*names(small_train, ["load"]))) == pytest.approx(5.0 * small_train.mass, rel=1e-12)
    z = [small_train.z[seat.node] for seat in small_train.bearings]
    assert unit.get(*names(small_train, ["z"])) == z
    assert unit.get("node[3].z", "wheel[1].z") == [
        small_train.z[2],
        small_train.z[small_train.wheels[0].node],
    ]


def test_the_reduction_that_was_carried_out_is_told(unit, small_train):
    """Asked for before and after another choice, and after a return to a state of that choice."""
    size = 4 * small_train.nodes
    none = f"none; the shaft has {size} degrees of freedom, 220 may be kept"
    assert unit.get("reduction.used").decode() == none
    unit.start({"reduction": "none"})
    assert unit.get("reduction.used").decode() == "none"
    kept = unit.keep()
    unit.slave.reset()
    assert unit.get("reduction.used").decode() == none
    unit.go_back(kept)
    assert unit.get("reduction.used").decode() == "none"
    unit.serialise(kept)


def test_alone_the_rotor_hovers_with_its_start_values(unit, small_train, starts):
    """Constant forces balance the weight; the shaft whirls about its line, nothing else moves."""
    unit.start()
    static, cos, sin = (
        np.reshape(
            [starts[f"{name}{part}"] for name in names(small_train, port.POSITION, "start.")],
            (len(small_train.bearings), 4),
        )
        for part in ("", "_cos", "_sin")
    )
    steps = round(0.05 / H)
    for k in range(steps):
        assert unit.step(k * H, H), unit.said
    angle = small_train.speed * steps * H
    expected = static + cos * math.cos(angle) + sin * math.sin(angle)
    whirl = np.abs(cos).max() + np.abs(sin).max()
    np.testing.assert_allclose(journals(unit, small_train)[:, :4], expected, rtol=0.0, atol=1e-3 * whirl)
    weight = small_train.mass * 9.80665
    assert sum(unit.get(*names(small_train, ["F0.Fy"]))) == pytest.approx(weight, rel=1e-12)


def test_steps_give_the_numbers_of_the_rotor(unit, small_train):
    wheels = len(small_train.wheels)
    blade = np.linspace(0.0, 1.0, wheels)
    law = law_of(small_train)
    speed = small_train.speed
    settings = {f"wheel[{j}].blade_unbalance": x for j, x in enumerate(blade.tolist(), 1)}
    set_law(unit, small_train, law)
    unit.start(settings | {"start.from_law": 1, "fracture.time": 10.5 * H, "gravity": 9.0})
    rotor = Rotor.of_train(
        small_train,
        gravity=9.0,
        speed=speed,
        blade_unbalance=blade,
        blade_phase=np.zeros(wheels),
        fracture_time=10.5 * H,
    )
    rotor.start_from_law(*law, orbit=True)
    assert np.array_equal(journals(unit, small_train), rotor.kinematics())
    for k in range(20):
        scaled = tuple(part * (1.0 + 0.01 * k) for part in law)
        set_law(unit, small_train, scaled)
        assert unit.step(k * H, H), unit.said
        rotor.step(k * H, H, *scaled, speed)
        assert np.array_equal(journals(unit, small_train), rotor.kinematics())
    extremes = ["amplitude.max", "amplitude.max_z", "stress.max", "stress.max_z"]
    assert unit.get(*extremes) == list(rotor.extremes())
    fields = rotor.fields()
    for key in ("x", "y", "amplitude", "stress"):
        block = [f"node[{k}].{key}" for k in range(1, small_train.nodes + 1)]
        assert unit.get(*block) == getattr(fields, key).tolist()


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"fracture.time": 3.5 * H, "wheel[1].blade_unbalance": 0.1},
        {port.COURSE: "[[0.0, 100.0], [1e-3, 101.0]]"},
        {port.TORQUE: "[[0.0, 1e6]]", "drive.inertia": 1e3},
        {"track_work": 1},
    ],
    ids=["laws", "blade", "course", "torque", "works"],
)
def test_a_step_in_parts_is_as_many_steps(host, small_train, settings):
    law = law_of(small_train)
    whole, each = host.open("whole"), host.open("each")
    for unit in (whole, each):
        set_law(unit, small_train, law)
    settings = {"start.from_law": 1, "speed": 100.0, **settings}
    whole.start(settings | {port.PARTS: 3})
    each.start(settings)
    for k in range(6):
        assert whole.step(k * H, H), whole.said
        for part in range(3):
            assert each.step((k + part / 3) * H, H / 3), each.said
        one, other = (journals(unit, small_train) for unit in (whole, each))
        assert np.abs(one - other).max() <= 1e-11 * np.abs(other).max()
        told = port.ROTATION, "work.bearings", "stress.max"
        assert whole.get(*told) == pytest.approx(each.get(*told), rel=1e-9)
    assert (whole.get(port.ROTATION) == 100.0) == (not {port.COURSE, port.TORQUE} & settings.keys())
    whole.close(), each.close()


def test_the_speed_at_the_input_is_reached_in_equal_parts(host, small_train):
    whole, each = host.open("whole"), host.open("each")
    for unit, parts in ((whole, 2), (each, 1)):
        set_law(unit, small_train, law_of(small_train))
        unit.start({"start.from_law": 1, "speed": 100.0, port.PARTS: parts})
    whole.set({"speed": 101.0})
    assert whole.step(0.0, H), whole.said
    for k, speed in enumerate((100.5, 101.0)):
        each.set({"speed": speed})
        assert each.step(k * H / 2, H / 2), each.said
    assert whole.get(port.ROTATION) == each.get(port.ROTATION) == 101.0
    assert np.array_equal(journals(whole, small_train), journals(each, small_train))
    whole.close(), each.close()


def test_a_step_of_which_a_part_fails_is_not_taken(host, small_train, monkeypatch):
    slave = RotorSlave(instance_name="rotor", resources=str(host.folder / "resources"))
    slave.set_integer([slave.layout[port.PARTS]], [3])
    slave.set_real([slave.layout["fracture.time"]], [1.5 * H])  # takes parts one by one
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    assert slave.do_step(0.0, H)
    before, taken = slave.model_state(), []
    rotor, step = slave._rotor, slave._rotor.step

    def fails_the_third(*given):
        taken.append(given[0])
        if len(taken) == 3:
            raise NoFiniteResult("the third part")
        step(*given)

    monkeypatch.setattr(rotor, "step", fails_the_third)
    assert not slave.do_step(H, H)
    assert taken == pytest.approx([H, 4 / 3 * H, 5 / 3 * H])
    assert slave.model_state().to_bytes() == before.to_bytes()
    monkeypatch.undo()
    assert slave.do_step(H, H)


def test_initialization_follows_the_laws(unit, small_train):
    """A master may search for the equilibrium in Initialization Mode."""
    F0, K, C = law_of(small_train)
    unit.set({"start.from_law": 1, "start.orbit": 0})
    unit.slave.setupExperiment(startTime=0.0)
    unit.slave.enterInitializationMode()
    rotor = Rotor.of_train(small_train, blade_phase=np.zeros(len(small_train.wheels)))
    for factor in (1.0, 1.5):
        set_law(unit, small_train, (F0, factor * K, C))
        rotor.start_from_law(F0, factor * K, C, orbit=False)
        assert np.array_equal(journals(unit, small_train), rotor.kinematics())


def test_a_state_moves_to_another_instance(unit, host, small_train):
    law = law_of(small_train)
    set_law(unit, small_train, law)
    unit.start({"start.from_law": 1, "reduction": "guyan", "gravity": 3.0})
    for k in range(5):
        assert unit.step(k * H, H)
    state = unit.state()
    other = host.open("other")
    other.restore(state)
    assert other.state() == state
    for k in range(5, 10):
        assert unit.step(k * H, H) and other.step(k * H, H)
    assert np.array_equal(journals(unit, small_train), journals(other, small_train))
    assert unit.get("stress.max", "node[2].y") == other.get("stress.max", "node[2].y")
    unit.restore(state)
    for k in range(5, 10):
        assert unit.step(k * H, H)
    assert np.array_equal(journals(unit, small_train), journals(other, small_train))
    other.close()


def test_a_later_start_goes_on_with_the_angle(host, small_train):
    """Unbalance angles count from t = 0, whenever the run starts."""
    period = 2.0 * math.pi / small_train.speed
    found = []
    for start in (0.0, period):
        unit = host.open(f"at_{start}").start(time=start)
        for k in range(3):
            assert unit.step(start + k * H, H)
        found.append(journals(unit, small_train))
        unit.close()
    np.testing.assert_allclose(found[1], found[0], rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"reduction": "magic"}, "reduction 'magic' is unknown; allowed are irs"),
        ({"gravity": -9.8}, "gravity = -9.8"),
        ({"parts": 0}, "parts = 0, allowed is >= 1"),
        ({"wheel[1].unbalance": math.nan}, "wheel[1].unbalance is not a number"),
        ({"start.from_law": 1}, "rigid-body"),
    ],
)
def test_a_bad_start_is_an_error_with_the_reason(unit, values, said):
    with pytest.raises(FMICallException, match="fmi2ExitInitializationMode"):
        unit.start(values)
    assert not unit.step(0.0, H)
    assert said in unit.said


def test_an_infinite_law_is_a_discard_and_the_step_may_be_repeated(unit, small_train):
    unit.start()
    before = journals(unit, small_train)
    unit.set({"bearing[1].K[1,1]": math.inf})
    assert not unit.step(0.0, H)
    assert "bearing[1].K[1,1] is not a finite number" in unit.said
    assert np.array_equal(journals(unit, small_train), before)
    unit.set({"bearing[1].K[1,1]": 0.0})
    assert unit.step(0.0, H)


def test_start_values_of_the_train_stand_in_the_description(host, starts):
    described = {v.name: v.start for v in host.description.modelVariables if v.start is not None}
    for name, value in starts.items():
        assert float(described[name]) == value
    held = json.loads((host.folder / "resources" / "starts.json").read_text())
    assert {name: held[name] for name in starts} == starts


def test_file_names_and_digests_tell_trains_apart(small_train):
    assert rotor_recipe(small_train).file_name == "rotor_small.fmu"
    assert rotor_recipe(replace(small_train, name="turbine")).file_name == "rotor.fmu"
    faster = rotor_recipe(replace(small_train, speed=1.01 * small_train.speed))
    assert faster.guid != rotor_recipe(small_train).guid
    assert rotor_recipe(replace(small_train, name="../x")).file_name == "rotor____x.fmu"  # no path
