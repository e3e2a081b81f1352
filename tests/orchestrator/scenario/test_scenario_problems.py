"""What a scenario may not ask for: each fault with line, key, value, what is allowed, the likely spelling."""

import pytest

from orchestrator.errors import ScenarioError
from orchestrator.scenario.file import load_scenario, parse_scenario
from orchestrator.scenario.problems import record_size
from rotor_fmu.train.file import load_train
from tests.faults import fault

TEXT = """\
train = "small"
end = 0.2
step = 1e-4
depth = "v1"
coupling = "linear-implicit"

[event]
wheel = "wheel-2"
unbalance = 0.5
time = 0.1
phase = 0.0

[film]
rows = 8

[record]
interval = 5e-4
"""


def case(old, new, line, words, name, outcome, *, guard):
    return pytest.param(old, new, line, words, id=name, marks=fault("input", name, outcome, guard=guard))


CASES = [
    case(
        'wheel = "wheel-2"', 'wheel = "front"', 8,
        "event.wheel = 'front': no such wheel ('front' is a bearing); allowed are wheel-1, wheel-2, wheel-3",
        "a blade lost from what is no wheel", "exit 2; line, what it is instead, all wheels",
        guard="orchestrator.scenario.problems:name_problems",
    ),
    case(
        "[film]", "[unbalance.at.front]\nunbalance = 0.1\n[film]", 13,
        "unbalance.at.front: no such wheel ('front' is a bearing); allowed are wheel-1, wheel-2, wheel-3",
        "an unbalance on a node that is no wheel", "exit 2; line, what it is instead, all wheels",
        guard="orchestrator.scenario.problems:name_problems",
    ),
    case(
        "[film]", '[depth_at]\nfrnt = "v2"\n[film]', 14,
        "depth_at.frnt: no such bearing; did you mean 'front'? allowed are front, rear",
        "a misspelt bearing", "exit 2; line, the likely spelling, all bearings",
        guard="orchestrator.scenario.problems:name_problems",
    ),
    case(
        "[film]", '[depth_at]\nfront = "own.fmu"\n[film]', 14, "depth_at.front = 'own.fmu': no such file",
        "a bearing's FMU that is not there", "exit 2; line, key, path",
        guard="orchestrator.scenario.problems:file_problems",
    ),
    case(
        "step = 1e-4", "step = 2.1e-3", 3,
        "step = 0.0021; allowed is at most a tenth of a revolution of train 'small', 0.002 s",
        "a step longer than a tenth of a revolution", "exit 2; line, value, the longest step",
        guard="orchestrator.scenario.problems:time_problems",
    ),
    case(
        "end = 0.2", "end = 5e-5", 3, "step = 0.0001; allowed is at most the end time, 5e-05 s",
        "a step longer than the run", "exit 2; line, value, the end time",
        guard="orchestrator.scenario.problems:time_problems",
    ),
    case(
        "end = 0.2", "end = 0.1", 10, "event.time = 0.1; allowed is a time before the end, 0.1 s",
        "an end before the event", "exit 2; line, both times, how to run without the event",
        guard="orchestrator.scenario.problems:time_problems",
    ),
    case(
        "unbalance = 0.5", "unbalance = 1000.0", 9,
        "event.unbalance = 1000.0; allowed is at most 900 kg m, all of wheel 'wheel-2' at its mean radius;",
        "a blade heavier than its wheel", "exit 2; line, value, the wheel's mass times its radius, the slip",
        guard="orchestrator.scenario.problems:unbalance_problems",
    ),
    case(
        "phase = 0.0", "phase = -45", 11,
        "event.phase = -45; allowed is a number of at least -6.3 rad; did you give degrees?",
        "the phase of the blade in degrees", "exit 2; line, value, range, the likely slip",
        guard="orchestrator.scenario.fields:Angle",
    ),
    case(
        "[film]", "[unbalance]\ngrade = 2.5\n[film]", 14,
        "unbalance.grade = 2.5; allowed is a number of at most 0.1 m/s; G2.5 is 2.5e-3",
        "a scenario's balance grade in mm/s", "exit 2; line, value, range, what G2.5 is",
        guard="orchestrator.scenario.fields:Grade",
    ),
    case(
        "rows = 8", "rows = 31", 14, "film.rows = 31; allowed is a number of at most 30",
        "a film resolution that the bearings refuse", "exit 2; line, value, range",
        guard="orchestrator.scenario.scenario:FilmSettings.rows",
    ),
    case(
        "unbalance = 0.5", "unbalance = inf", 9, "event.unbalance = inf; allowed is a finite number",
        "a number that is infinite", "exit 2; line, key, value",
        guard="orchestrator.scenario.fields:Positive",
    ),
    case(
        "step = 1e-4", "step = true", 3, "step = True; allowed is a number",
        "true in place of a number", "exit 2; line, key, value; not taken for 1",
        guard="orchestrator.scenario.fields:Model.model_config",
    ),
    case(
        "end = 0.2\nstep = 1e-4", "end = 200.0\nstep = 1e-9", 3,
        "step = 1e-09; allowed is at least 2e-07 s, a billionth",
        "a run of so many steps that it would never end", "exit 2; line, value, the shortest step",
        guard="orchestrator.scenario.problems:time_problems",
    ),
    case(
        'coupling = "linear-implicit"', 'coupling = "linear"', 5,
        "coupling = 'linear'; did you mean 'linear-implicit'?",
        "a misspelt coupling", "exit 2; line, the likely spelling, all couplings",
        guard="orchestrator.scenario.problems:shape_problems",
    ),
    case(
        "[film]", "[flim]", 13, "flim: unknown key; did you mean 'film'? allowed are title, train,",
        "a misspelt table", "exit 2; line, the likely spelling, all keys",
        guard="orchestrator.scenario.fields:Model.model_config",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "line", "words"), CASES)
def test_a_fault_in_the_scenario(tmp_path, old, new, line, words):
    assert old in TEXT
    with pytest.raises(ScenarioError) as info:
        parse_scenario(TEXT.replace(old, new, 1), tmp_path, "my.toml")
    assert any(found.startswith(f"line {line}: {words}") for found in info.value.problems), (
        info.value.problems
    )
    assert (
        "no such train; did you mean 'small'? allowed are small, turbine" in str(info.value)
        or "smal'" not in new
    )


@fault(
    "input",
    "a record larger than the memory of the machine",
    "exit 2; both sizes, an earlier end or the interval that fits",
    guard="orchestrator.scenario.problems:time_problems",
)
def test_a_record_larger_than_the_machine(tmp_path, monkeypatch):
    scenario = parse_scenario(TEXT, tmp_path, "my.toml")
    train = load_train("small")
    size = record_size(scenario, train)
    assert size == pytest.approx(400 * (2 * 248 + train.nodes * 16))
    monkeypatch.setattr("orchestrator.scenario.problems._memory", lambda: size / 3)
    with pytest.raises(ScenarioError) as info:
        parse_scenario(TEXT, tmp_path, "my.toml")
    (problem,) = info.value.problems
    assert problem.startswith("line 2: end = 0.2; its record takes ") and "from 0.0015 s on" in problem


@fault(
    "input",
    "a train that does not exist",
    "exit 2; line, the likely name, all bundled trains",
    guard="rotor_fmu.train.file:train_file",
)
def test_a_train_that_does_not_exist(tmp_path):
    words = r"^my.toml: line 1: train = 'smal': .*smal: no such train; did you mean 'small'\? allowed are"
    with pytest.raises(ScenarioError, match=words):
        parse_scenario(TEXT.replace('"small"', '"smal"'), tmp_path, "my.toml")


@fault(
    "input",
    "a scenario that does not exist",
    "exit 2; the likely name, all bundled scenarios",
    guard="orchestrator.scenario.file:load_scenario",
)
def test_a_scenario_that_does_not_exist():
    with pytest.raises(
        ScenarioError, match=r"papr: no such scenario; did you mean 'paper'\? allowed are coast-down, "
    ):
        load_scenario("papr")


@fault(
    "coupling",
    "jacobi with a tolerance, which no step could meet: what it neglects does not fall with the step",
    "exit 2; line, value, the coupling that can",
    guard="orchestrator.scenario.problems:time_problems",
)
def test_jacobi_takes_no_tolerance(tmp_path):
    text = TEXT.replace('coupling = "linear-implicit"', 'coupling = "jacobi"\ntolerance = 0.1')
    with pytest.raises(ScenarioError, match=r"^my.toml: line 6: tolerance = 0.1; allowed is none .*jacobi"):
        parse_scenario(text, tmp_path, "my.toml")
    parse_scenario(text.replace("jacobi", "gauss-seidel"), tmp_path, "my.toml")


def test_a_value_given_as_an_option_has_no_line(tmp_path):
    """It stands in no line of the file; the others keep theirs."""
    (tmp_path / "my.toml").write_text(TEXT.replace("rows = 8", "rows = 1"))
    with pytest.raises(ScenarioError) as info:
        load_scenario(
            tmp_path / "my.toml", {"end": -1.0, "event": {"phase": 90.0}, "depth_at": {"frnt": "v2"}}
        )
    starts = ("end = -1.0", "event.phase = 90.0", "line 14: film.rows = 1", "depth_at.frnt: no such bearing")
    assert len(info.value.problems) == len(starts)
    for start in starts:
        assert any(found.startswith(start) for found in info.value.problems)
