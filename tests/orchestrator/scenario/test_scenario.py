"""Scenarios: what is bundled, what is refused and in which words, overrides, round trip."""

import tomllib
from dataclasses import replace

import pytest

from orchestrator.errors import ScenarioError
from orchestrator.scenario.file import (
    bundled_scenarios,
    load_scenario,
    scenario_toml,
    train_of,
    with_overrides,
)
from orchestrator.scenario.parameters import rotor_parameters

GOOD = """
title = "test"
train = "small"
end = 0.2
step = 1e-4
"""


@pytest.fixture
def scenario_file(tmp_path):
    def write(text):
        path = tmp_path / "mine.toml"
        path.write_text(text)
        return path

    return write


def problems(path, **overrides):
    with pytest.raises(ScenarioError) as info:
        load_scenario(path, overrides)
    assert all(line.startswith(f"{path}: ") for line in str(info.value).splitlines())
    return info.value.problems


@pytest.mark.parametrize("name", bundled_scenarios())
def test_bundled_scenarios_are_valid_and_survive_a_round_trip(name, scenario_file):
    scenario = load_scenario(name)
    again = load_scenario(scenario_file(scenario_toml(scenario)))
    assert again.model_dump() == scenario.model_dump()


def test_the_paper_scenario_is_the_blade_fracture_on_the_turbine_train():
    scenario = load_scenario("paper")
    train = train_of(scenario)
    assert (len(train.shoulders), len(train.bearings), train.length) == (278, 11, pytest.approx(68.0))
    assert (scenario.end, scenario.event.time, scenario.depth) == (2.0, 1.0, "v1")


def test_defaults(scenario_file):
    scenario = load_scenario(scenario_file(GOOD))
    assert scenario.coupling == "linear-implicit"
    assert scenario.reduction == "irs"
    assert scenario.event is None
    assert scenario.depth_of("front") == "v1"


def test_every_problem_is_reported_at_once(scenario_file):
    text = """
        train = "small"
        end = -1.0
        stepp = 1e-4
        depth = "v4"
        reduction = "irz"
        coupling = "linear implicit"
        [depth_at]
        frnt = "v2"
        rear = "V3"
        [unbalance.at]
        wheel-7 = { unbalance = -0.1 }
        [event]
        wheel = "Wheel-2"
        unbalance = "much"
        when = 0.1
        [film]
        columns = 8
    """
    found = problems(scenario_file(text))
    expected = [
        "line 3: end = -1.0; allowed is a number of at least 1e-09 s",
        "line 4: stepp: unknown key; did you mean 'step'? allowed are title, train, reduction",
        "line 5: depth = 'v4'; allowed are v1, v2, v3",
        "line 6: reduction = 'irz'; did you mean 'irs'? allowed are irs, irs-plain, guyan",
        "line 7: coupling = 'linear implicit'; did you mean 'linear-implicit'? allowed are lin",
        "line 10: depth_at.rear = 'V3'; did you mean 'v3'? allowed are v1, v2, v3",
        "line 12: unbalance.at.wheel-7.unbalance = -0.1; allowed is a number of at least 0",
        "line 15: event.unbalance = 'much'; allowed is a number",
        "line 13: event.time: missing; it must be given",
        "line 16: event.when: unknown key; did you mean 'wheel'? allowed are wheel, unbalance, phase",
        "line 18: film.columns = 8; allowed is a number of at least 16",
        "line 9: depth_at.frnt: no such bearing; did you mean 'front'? allowed are front, rear",
        "line 12: unbalance.at.wheel-7: no such wheel; did you mean 'wheel-",
        "line 14: event.wheel = 'Wheel-2': no such wheel; did you mean 'wheel-2'? allowed are wheel-1",
    ]
    assert len(found) == len(expected)
    for start in expected:
        assert any(line.startswith(start) for line in found), (start, found)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"step": 2.1e-3}, "step = 0.0021; allowed is at most a tenth of a rev"),
        ({"event": {"wheel": "wheel-1", "unbalance": 1.0, "time": 0.2}}, "event.time = 0.2; allowed"),
        ({"train": "smal"}, "train = 'smal': "),
        ({"end": float("nan")}, "end = nan; allowed is a finite number"),
        ({"folder": "x"}, "folder: unknown key"),
    ],
)
def test_contradictions_are_refused(scenario_file, change, words):
    assert problems(scenario_file(GOOD), **change)[0].startswith(words)


def test_a_file_that_is_no_toml_is_named(scenario_file):
    assert "not TOML: Invalid value (at line 1" in problems(scenario_file("end = = 1"))[0]


def test_a_missing_file_lists_the_bundled_scenarios():
    assert "allowed are paper, small, or the path" in problems("papper")[0]


def test_overrides_merge_key_by_key_and_take_out(scenario_file):
    text = GOOD + '[depth_at]\nfront = "v2"\n[event]\nwheel = "wheel-1"\nunbalance = 1.0\ntime = 0.1\n'
    path = scenario_file(text)
    scenario = load_scenario(path, {"depth": "v3", "depth_at": {"rear": "v1"}, "event": {"time": 0.15}})
    assert scenario.depth_at == {"front": "v2", "rear": "v1"}
    assert (scenario.depth, scenario.event.time, scenario.event.unbalance) == ("v3", 0.15, 1.0)
    calm = with_overrides(scenario, {"event": None, "end": 0.1})
    assert calm.event is None
    assert calm.depth_at == scenario.depth_at
    assert calm.folder == scenario.folder
    with pytest.raises(ScenarioError, match="end = 0; allowed"):
        with_overrides(scenario, {"end": 0})


def test_a_tolerance_belongs_to_the_step_and_coupling_beside_it():
    assert load_scenario("paper").tolerance == load_scenario("paper", {"end": 1.5}).tolerance == 0.02
    for change in ({"step": 5e-5}, {"coupling": "gauss-seidel"}):
        assert load_scenario("paper", change).tolerance is None
        assert with_overrides(load_scenario("paper"), change).tolerance is None
        assert load_scenario("paper", {**change, "tolerance": 1e-3}).tolerance == 1e-3


def test_a_train_is_found_beside_the_scenario(tmp_path, scenario_file):
    from rotor_fmu.train.file import DATA

    (tmp_path / "mine").mkdir()
    for file in (DATA / "small").glob("*.*"):
        (tmp_path / "mine" / file.name).write_bytes(file.read_bytes())
    scenario = load_scenario(scenario_file(GOOD.replace('"small"', '"mine"')))
    assert train_of(scenario).name == "small"


def test_the_toml_text_quotes_what_needs_quoting(scenario_file):
    odd = 'a "quoted" \\ title\twith\nlines'
    scenario = with_overrides(load_scenario(scenario_file(GOOD)), {"title": odd})
    assert tomllib.loads(scenario_toml(scenario))["title"] == odd


def test_the_analysed_bearing_is_one_of_the_train(scenario_file):
    path = scenario_file(GOOD + 'analysed_bearing = "rear"\n')
    assert load_scenario(path).analysed_bearing == "rear"
    assert 'analysed_bearing = "rear"' in scenario_toml(load_scenario(path))
    (problem,) = problems(path, analysed_bearing="raer")
    assert problem.startswith("analysed_bearing = 'raer': no such bearing; did you mean 'rear'?")


def test_a_balance_grade_replaces_that_of_the_train_also_where_it_is_zero(scenario_file):
    """The unbalance follows from the grade alone, not from its ratio to the train's."""
    scenario = load_scenario(scenario_file(GOOD + "[unbalance]\ngrade = 5e-3\n"))
    train = train_of(scenario)
    expected = replace(train, balance_grade=5e-3).nominal_unbalance
    for own in (train, replace(train, balance_grade=0.0)):
        values = rotor_parameters(scenario, own)
        assert [values[f"wheel[{j}].unbalance"] for j in (1, 2, 3)] == list(expected)
