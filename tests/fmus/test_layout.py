"""The order a port must have, and the refusal of another."""

import pytest
from spring_unit.facade import LAYOUT, VARIABLES

from fmus import port
from fmus.port.variable import Variable
from fmus.unit.layout import Layout


def test_blocks_of_the_bearing():
    layout = Layout(port.BEARING)
    assert (layout.inputs, layout.outputs) == (slice(0, 17), slice(17, 85))
    assert layout.parameters == slice(85, len(port.BEARING) - 1)
    assert layout[port.FAILURE.name] == len(port.BEARING) - 1
    assert layout.block("journal.x", "journal.tilt_rate_y") == slice(0, 8)


def test_blocks_of_a_rotor():
    variables = port.rotor(("front", "rear"), ("wheel",), 5)
    layout = Layout(variables)
    assert layout.inputs == slice(0, 1 + 2 * 36 + 3 + 2)
    assert layout.outputs == slice(78, 78 + 16 + 1)
    assert {variables[i].name for i in layout.lazy["extremes"]} == {
        "amplitude.max",
        "amplitude.max_z",
        "stress.max",
        "stress.max_z",
    }
    assert len(layout.lazy["fields"]) == 4 * 5


def test_start_values_of_a_train_are_taken():
    variables = port.rotor(("front",), (), 2, {"bearing[1].F0.Fy": 5e5})
    assert {v.name: v.start for v in variables}["bearing[1].F0.Fy"] == 5e5


@pytest.mark.parametrize("name", ["bearing[2].F0.Fy", "bearing[1].load"])
def test_a_start_value_for_what_takes_none_is_refused(name):
    with pytest.raises(ValueError, match="start value"):
        port.rotor(("front",), (), 2, {name: 1.0})


@pytest.mark.parametrize(
    "variables",
    [
        VARIABLES[::-1],
        VARIABLES + VARIABLES[:1],
        VARIABLES[:-1],
        (Variable("n", "input", kind="Integer", start=1),),
    ],
)
def test_another_order_is_refused(variables):
    with pytest.raises(ValueError, match="port"):
        Layout(variables)


def test_strings_and_numbers_start_as_declared():
    assert LAYOUT.strings == {LAYOUT["label"]: "plain"}
    assert LAYOUT.starts[LAYOUT["stiffness"]] == 1e6
