"""Values of an SSP are input as those of a scenario are: named, with what is allowed."""

import pytest

from tests.faults import fault
from tests.orchestrator.foreign import refused, with_text


def value(name, number):
    return f'name="{name}">\n      <ssv:Real value="{number}" />'


def case(member, old, new, words, name, outcome, *, guard):
    return pytest.param(member, old, new, words, id=name, marks=fault("input", name, outcome, guard=guard))


@pytest.mark.parametrize(
    ("member", "old", "new", "words"),
    [
        case(
            "resources/rotor.ssv",
            value("wheel[2].unbalance_phase", "0.0"),
            value("wheel[2].unbalance_phase", "90.0"),
            "unbalance.at.wheel-2.phase = 90.0; allowed is a number of at most 6.3 rad; did you give deg",
            "an SSP with a phase in degrees",
            "exit 2; wheel, value, range, the likely slip",
            guard="orchestrator.scenario.fields:Angle",
        ),
        case(
            "resources/front.ssv",
            'name="viscosity"',
            'name="viscosty"',
            "front: viscosty is no variable of bearing_v3.fmu; did you mean 'viscosity'?",
            "an SSP with a misspelt parameter",
            "exit 2; component, parameter, FMU, the likely spelling",
            guard="orchestrator.ssp.contents:parameters",
        ),
        case(
            "resources/rear.ssv",
            value("clearance", "0.00022"),
            value("clearance", "0.22"),
            "rear: clearance = 0.22; allowed is a number of at most 0.1 m; did you give mm?",
            "an SSP with a clearance in mm",
            "exit 2; component, value, range, the likely slip",
            guard="orchestrator.ssp.scenario:as_scenario",
        ),
        case(
            "resources/rear.ssv",
            value("speed", "314.1592653589793"),
            value("speed", "157.1"),
            "rear: speed = 157.1; allowed is that of the rotor, 314.1592653589793 rad/s",
            "an SSP whose bearing turns at another speed than its rotor",
            "exit 2; component, both speeds",
            guard="orchestrator.ssp.scenario:_speed_problems",
        ),
    ],
)
def test_a_fault_in_an_ssp(member, old, new, words, small_ssp, small_fmus, room, tmp_path):
    path = with_text(small_ssp, tmp_path / "my.ssp", member, old, new)
    assert words in refused(path, room, small_fmus)
