"""States of the facade base on a spring-damper, kept and restored through the FMU's C interface."""

import math

import pytest

from tests.fmus.test_slave import fails


def trajectory(instance, start, steps):
    found = []
    for k in range(start, start + steps):
        instance.set({"x": 1e-3 * math.sin(0.1 * k), "v": 0.1 * math.cos(0.1 * k)})
        assert instance.step(k * 1e-3, 1e-3)
        found.append(instance.get("F", "work", "energy"))
    return found


def test_steps_repeat_to_the_bit_from_a_state(spring):
    spring.start()
    trajectory(spring, 0, 20)
    state = spring.state()
    first = trajectory(spring, 20, 20)
    spring.restore(state)
    assert spring.state() == state
    assert trajectory(spring, 20, 20) == first


def test_a_kept_state_does_not_change_with_the_unit(spring):
    spring.start()
    trajectory(spring, 0, 20)
    kept, state = spring.keep(), spring.state()
    first = trajectory(spring, 20, 20)
    for _ in range(2):
        spring.go_back(kept)
        assert trajectory(spring, 20, 20) == first
    assert spring.serialise(kept) == state


def test_a_state_of_a_unit_that_never_started_leaves_no_model_behind(spring):
    fails(spring.start, {"stiffness": -1.0})
    failed = spring.state()
    spring.slave.reset()
    spring.start()
    spring.restore(failed)
    assert spring.state() == failed


def test_a_state_moves_to_another_instance_with_parameters_strings_and_mode(spring, spring_host):
    spring.start({"springs": 2, "label": "first"})
    trajectory(spring, 0, 5)
    state = spring.state()
    other = spring_host.open("other")
    other.restore(state)
    assert other.get("springs", "label", "compliance") == [2, b"first", 1.0 / 4e6]
    assert trajectory(other, 5, 10) == trajectory(spring, 5, 10)
    other.close()


def test_a_state_before_initialization_can_be_kept(spring):
    spring.set({"stiffness": 4e6})
    state = spring.state()
    fails(spring.start, {"stiffness": -4.0})
    assert not spring.step(0.0, 1e-3)
    spring.restore(state)
    assert spring.get("stiffness") == 4e6
    assert spring.start().step(0.0, 1e-3)


def test_a_state_holds_the_failure_too(spring):
    fails(spring.start, {"stiffness": -1.0})
    state = spring.state()
    spring.slave.reset()
    spring.start()
    good = spring.state()
    spring.restore(state)
    assert not spring.step(0.0, 1e-3) and "stiffness" in spring.said
    spring.restore(good)
    assert spring.step(0.0, 1e-3)


@pytest.mark.parametrize("damage", [lambda s: s[:-1], lambda s: bytes(16) + s[16:], lambda s: b"short"])
def test_a_foreign_or_damaged_state_is_refused_and_a_good_one_heals(spring, damage):
    spring.start()
    state = spring.state()
    spring.restore(damage(state))
    assert not spring.step(0.0, 1e-3)
    assert "FMU state" in spring.said
    spring.restore(state)
    assert spring.step(0.0, 1e-3)
