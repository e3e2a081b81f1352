"""The facade base on a spring-damper, through the FMU's C interface."""

import gc
import math

import pytest
from fmpy.fmi1 import FMICallException

from fmus.port.failure import Failure

FATAL = 4


def force(x, v, stiffness=2e6, damping=1e3):
    return -stiffness * x - damping * v


def test_outputs_follow_sets_until_the_end_of_initialization(spring):
    assert spring.get("F") == force(0.001, 0.0)
    spring.slave.setupExperiment(startTime=0.0)
    spring.slave.enterInitializationMode()
    spring.set({"x": 0.002, "v": 0.5, "stiffness": 3e6})
    assert spring.get("F") == force(0.002, 0.5, 6e6)
    assert spring.get("compliance") == 1.0 / 6e6
    spring.set({"x": 0.003})
    spring.slave.exitInitializationMode()
    assert spring.get("F") == force(0.003, 0.5, 6e6)


def test_in_step_mode_outputs_change_in_steps_only(spring):
    spring.start()
    before = spring.get("F", "work")
    spring.set({"x": 0.002, "v": 1.0})
    assert spring.get("F", "work") == before
    assert spring.step(0.0, 1e-3)
    assert spring.get("F") == force(0.002, 1.0)
    assert spring.get("work") == -force(0.002, 1.0) * 1e-3


def test_every_type_has_its_start_value_and_can_be_set(spring):
    assert spring.get("springs", "rigid", "label") == [1, 0, b"plain"]
    spring.set({"springs": 3, "label": "three at 100 %"})
    assert spring.get("springs", "label") == [3, b"three at 100 %"]
    assert spring.start().get("F") == force(0.001, 0.0, 6e6)


def test_references_in_any_order_and_repeated(spring):
    spring.start({"x": 0.004, "v": 0.25})
    assert spring.slave.getReal([1, 0, 4, 0]) == [0.25, 0.004, 1e6, 0.004]
    spring.slave.setReal([1, 0], [0.5, 0.002])
    assert spring.slave.getReal([0, 1]) == [0.002, 0.5]


def test_lazy_variables_belong_to_the_last_step(spring):
    spring.start()
    assert spring.get("energy") == 0.5 * 2e6 * 0.001**2
    spring.set({"x": 0.002})
    spring.step(0.0, 1e-3)
    assert spring.get("energy") == 0.5 * 2e6 * 0.002**2


def fails(call, *arguments):
    """Make a call that must not return fmi2OK; what pythonfmu's library can return for it is fmi2Fatal."""
    with pytest.raises(FMICallException) as caught:
        call(*arguments)
    assert caught.value.status == FATAL


def test_a_bad_parameter_is_a_discard_with_the_reason_in_the_log(spring):
    fails(spring.start, {"stiffness": -1.0})
    assert math.isnan(spring.get("F")) and math.isnan(spring.get("compliance"))
    assert not spring.step(0.0, 1e-3)
    assert "stiffness = -1.0 N/m, allowed is > 0 (100 %% sure)" in spring.said
    assert not spring.step(0.0, 1e-3)


def test_initialization_that_ends_without_a_start_is_an_error_with_the_reason(spring):
    fails(spring.start, {"stiffness": -1.0})
    (said,) = [text for status, text in spring.log if status == FATAL]
    assert "ended without a start" in said and "allowed is > 0 (100 %% sure)" in said


def test_a_refused_call_leaves_the_unit_alive(spring_host):
    """The library gives up its references at each, and once more at the end: as often is the unit held."""
    for _ in range(5):
        instance = spring_host.open()
        fails(instance.start, {"stiffness": -1.0})
        for _ in range(20):
            fails(instance.slave.getReal, [99])
            fails(instance.set, {"F": 1.0})
            assert not instance.step(0.0, 1e-3)
        instance.slave.reset()
        assert instance.start().step(0.0, 1e-3)
        instance.close()
        gc.collect()


def test_a_bad_parameter_may_be_corrected_before_the_end_of_initialization(spring):
    spring.set({"stiffness": -1.0})
    assert math.isnan(spring.get("F")) and "no start: stiffness = -1.0" in spring.said
    spring.start({"stiffness": 1e6})
    assert spring.step(0.0, 1e-3) and len(spring.log) == 1


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_value_that_is_no_number_is_a_discard_and_the_step_may_be_repeated(spring, value):
    spring.start()
    spring.set({"v": value})
    before = spring.get("F", "work")
    assert not spring.step(0.0, 1e-3)
    assert "input v is not a finite number" in spring.said
    assert spring.get("F", "work") == before
    spring.set({"v": 1.0})
    assert spring.step(0.0, 1e-3)


def test_a_failed_step_leaves_the_unit_as_it_was(spring):
    spring.start()
    spring.set({"x": 1.0, "v": 1.0})
    before = spring.get("F", "work")
    assert not spring.step(0.0, 1e-3)
    assert "torn" in spring.said and spring.get("F", "work") == before


@pytest.mark.parametrize("step", [0.0, -1e-3, math.nan, math.inf])
def test_a_step_that_does_not_advance_is_refused(spring, step):
    spring.start()
    assert not spring.step(0.0, step)
    assert "positive" in spring.said


@pytest.mark.parametrize(
    ("inputs", "step", "code"),
    [
        ({"v": math.nan}, 1e-3, Failure.INPUT),
        ({"x": 1.0}, 1e-3, Failure.STEP),
        ({}, -1e-3, Failure.CALL),
        ({"stiffness": 1.0}, 1e-3, Failure.CALL),
    ],
)
def test_a_refused_step_says_its_kind_until_the_next_that_is_not(spring, inputs, step, code):
    spring.start()
    good = spring.state()
    assert spring.get("failure") == Failure.NONE
    if "stiffness" in inputs:
        fails(spring.set, inputs)
    else:
        spring.set(inputs)
    assert not spring.step(0.0, step) and spring.get("failure") == code
    refused = spring.state()
    spring.restore(good)
    assert spring.get("failure") == Failure.NONE
    assert spring.step(0.0, 1e-3) and spring.get("failure") == Failure.NONE
    spring.restore(refused)
    assert spring.get("failure") == code


@pytest.mark.parametrize(
    ("start", "code"), [({"stiffness": -1.0}, Failure.PARAMETER), ({"x": math.inf}, Failure.INPUT)]
)
def test_a_failed_start_says_its_kind_at_every_step(spring, start, code):
    spring.set(start)
    assert math.isnan(spring.get("F")) and spring.get("failure") == code
    fails(spring.start)
    for _ in range(2):
        assert not spring.step(0.0, 1e-3) and spring.get("failure") == code


def test_the_step_may_vary(spring):
    spring.start()
    spring.set({"v": 1.0})
    assert spring.step(0.0, 1e-3) and spring.step(1e-3, 5e-4) and spring.step(1.5e-3, 1e-4)
    assert spring.get("work") == pytest.approx(-force(0.001, 1.0) * 1.6e-3, rel=1e-15)


def test_a_step_before_initialization_is_refused(spring):
    assert not spring.step(0.0, 1e-3)
    assert "initialization" in spring.said


@pytest.mark.parametrize("name", ["stiffness", "F", "label", "rigid"])
def test_in_step_mode_inputs_alone_may_be_set(spring, name):
    spring.start()
    fails(spring.set, {name: "other" if name == "label" else 1})
    assert not spring.step(0.0, 1e-3)
    assert f"{name} cannot be set" in spring.said


@pytest.mark.parametrize("kind", ["Real", "Integer", "Boolean", "String"])
def test_an_unknown_reference_is_an_error(spring, kind):
    spring.start()
    fails(getattr(spring.slave, f"get{kind}"), [99])
    assert any(status == FATAL and "unknown" in text for status, text in spring.log)
    assert not spring.step(0.0, 1e-3) and "unknown" in spring.said


def test_reset_brings_back_the_start_values(spring):
    fails(spring.start, {"stiffness": -1.0})
    assert not spring.step(0.0, 1e-3)
    spring.slave.reset()
    assert spring.get("stiffness", "x", "label") == [1e6, 0.001, b"plain"]
    assert spring.start().step(0.0, 1e-3)


def test_after_termination_no_step_follows(spring):
    spring.start()
    spring.slave.terminate()
    assert spring.get("F") == force(0.001, 0.0)
    assert not spring.step(0.0, 1e-3)


def test_many_instances_side_by_side_do_not_mix(spring_host):
    instances = [spring_host.open(f"s{k}").start({"stiffness": 1e6 * (k + 1)}) for k in range(11)]
    for k, instance in enumerate(instances):
        instance.set({"x": 1e-3 * k})
    for instance in reversed(instances):
        assert instance.step(0.0, 1e-3)
    for k, instance in enumerate(instances):
        assert instance.get("F") == force(1e-3 * k, 0.0, 2e6 * (k + 1))
    for instance in instances:
        instance.close()


def test_twenty_cycles_of_load_and_free(spring_host):
    for cycle in range(20):
        instance = spring_host.open(f"cycle{cycle}").start()
        assert instance.step(0.0, 1e-3)
        instance.close()
        if cycle % 5 == 0:
            gc.collect()
