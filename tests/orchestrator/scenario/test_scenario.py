"""Scenarios: what is bundled, what is refused and in which words, overrides, round trip."""

import tomllib
from dataclasses import replace
from typing import ClassVar, Literal

import pytest

from bearing_fmu import depths
from orchestrator.errors import ScenarioError
from orchestrator.scenario.events import KINDS, Event
from orchestrator.scenario.file import (
    bundled_scenarios,
    load_scenario,
    scenario_toml,
    train_of,
    with_overrides,
)
from orchestrator.scenario.parameters import rotor_parameters
from orchestrator.scenario.schedule import from_attributes, schedule_of

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
    assert (scenario.end, scenario.events[0].time, scenario.depth) == (2.0, 1.0, "v1")


def test_defaults(scenario_file):
    scenario = load_scenario(scenario_file(GOOD))
    assert scenario.coupling == "linear-implicit"
    assert scenario.reduction == "irs"
    assert not scenario.events
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
        f"line 5: depth = 'v4'; allowed are {', '.join(depths.names())}",
        "line 6: reduction = 'irz'; did you mean 'irs'? allowed are irs, irs-plain, guyan",
        "line 7: coupling = 'linear implicit'; did you mean 'linear-implicit'? allowed are lin",
        f"line 10: depth_at.rear = 'V3'; did you mean 'v3'? allowed are {', '.join(depths.names())}",
        "line 12: unbalance.at.wheel-7.unbalance = -0.1; allowed is a number of at least 0",
        "line 15: event.unbalance = 'much'; allowed is a number",
        "line 13: event.time: missing; it must be given",
        "line 16: event.when: unknown key; did you mean 'wheel'? allowed are kind, time, vibration",
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
    known = "coast-down, coast-down-slow, inertia, lemon, lined, paper, small, tilting, turbulent"
    assert f"allowed are {known}" in problems("papper")[0]


def test_overrides_merge_key_by_key_and_take_out(scenario_file):
    text = GOOD + '[depth_at]\nfront = "v2"\n[event]\nwheel = "wheel-1"\nunbalance = 1.0\ntime = 0.1\n'
    path = scenario_file(text)
    scenario = load_scenario(path, {"depth": "v3", "depth_at": {"rear": "v1"}, "event": {"time": 0.15}})
    assert scenario.depth_at == {"front": "v2", "rear": "v1"}
    assert (scenario.depth, scenario.events[0].time, scenario.events[0].unbalance) == ("v3", 0.15, 1.0)
    calm = with_overrides(scenario, {"event": None, "end": 0.1})
    assert not calm.events
    assert calm.depth_at == scenario.depth_at
    assert calm.folder == scenario.folder
    with pytest.raises(ScenarioError, match="end = 0; allowed"):
        with_overrides(scenario, {"end": 0})


def test_a_tolerance_belongs_to_the_step_and_coupling_beside_it():
    for name, tolerance in (("paper", 0.01), ("tilting", 0.02)):
        assert load_scenario(name).tolerance == load_scenario(name, {"end": 1.5}).tolerance == tolerance
        for change in ({"step": 5e-5}, {"coupling": "gauss-seidel"}):
            assert load_scenario(name, change).tolerance is None
            assert with_overrides(load_scenario(name), change).tolerance is None
            assert load_scenario(name, {**change, "tolerance": 1e-3}).tolerance == 1e-3


def test_a_step_alone_is_fixed_where_a_coupling_of_many_rates_would_have_none():
    assert load_scenario("paper").coupling == "multirate"
    for change in ({"step": 5e-5}, {"step": 5e-5, "end": 1.5}):
        for scenario in (load_scenario("paper", change), with_overrides(load_scenario("paper"), change)):
            assert (scenario.coupling, scenario.tolerance) == ("linear-implicit", None)
    controlled = load_scenario("paper", {"step": 5e-5, "tolerance": 5e-3})
    assert (controlled.coupling, controlled.tolerance) == ("multirate", 5e-3)
    asked_for = load_scenario("paper", {"step": 5e-5, "coupling": "multirate"})
    assert (asked_for.coupling, asked_for.tolerance) == ("multirate", None)


def test_without_a_coupling_it_is_that_of_many_rates_unless_a_step_is_given(scenario_file):
    def coupling(**overrides):
        scenario = load_scenario(scenario_file('train = "small"\nend = 0.4\n'), overrides)
        again = with_overrides(scenario, {"title": "again"})
        assert (again.coupling, again.step, again.tolerance) == (
            scenario.coupling, scenario.step, scenario.tolerance,
        )  # fmt: skip
        return scenario.coupling

    assert coupling() == coupling(tolerance=1e-3) == "multirate"
    assert coupling(step=1e-4) == coupling(step=1e-4, tolerance=1e-3) == "linear-implicit"
    assert coupling(step=1e-4, coupling="multirate") == "multirate"


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


LOSSES = """
[[events]]
wheel = "wheel-1"
unbalance = 0.1
time = 0.1
[[events]]
kind = "blade-loss"
wheel = "wheel-3"
unbalance = 0.2
phase = 1.0
time = 0.1
"""


def test_events_are_a_list_and_one_may_stand_alone(scenario_file):
    several = load_scenario(scenario_file(GOOD + LOSSES))
    assert [(event.kind, event.wheel) for event in several.events] == [
        ("blade-loss", "wheel-1"),
        ("blade-loss", "wheel-3"),
    ]
    assert load_scenario(scenario_file(scenario_toml(several))).events == several.events
    values = rotor_parameters(several, train_of(several))
    assert values["fracture.time"] == 0.1
    assert [values[f"wheel[{j}].blade_unbalance"] for j in (1, 2, 3)] == [0.1, 0.0, 0.2]
    assert values["wheel[3].blade_phase"] == 1.0
    alone = load_scenario(scenario_file(GOOD + '[event]\nwheel = "wheel-1"\nunbalance = 0.1\ntime = 0.1\n'))
    assert alone.events == several.events[:1]
    assert "[[events]]" in scenario_toml(alone)
    assert with_overrides(alone, {"event": {"time": 0.15}}).events[0].time == 0.15
    for scenario in (alone, several):
        assert with_overrides(scenario, {"event": None}).events == ()
        assert with_overrides(scenario, {"events": None}).events == ()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("", '[event]\nwheel = "wheel-1"\n'), "line 17: event: given beside events; allowed is one of them"),
        (("blade-loss", "blade-los"), "line 12: events.1.kind = 'blade-los'; did you mean 'blade-loss'?"),
        (("phase", "phse"), "line 15: events.1.phse: unknown key; did you mean 'phase'?"),
        (
            ("phase = 1.0", "phase = 90.0"),
            "line 15: events.1.phase = 90.0; allowed is a number of at most 6.3 rad",
        ),
        (("wheel-3", "wheel-4"), "line 13: events.1.wheel = 'wheel-4': no such wheel"),
    ],
)
def test_events_that_do_not_fit_are_refused_at_their_line(scenario_file, change, words):
    text = LOSSES + change[1] if not change[0] else LOSSES.replace(*change)
    found = problems(scenario_file(GOOD + text))
    assert any(line.startswith(words) for line in found), found


def test_a_kind_of_event_is_one_class(scenario_file, monkeypatch):
    """Read, written, met by steps, told by the record, parting phases and named in figures."""

    class Whistle(Event):
        label: ClassVar[str] = "whistle"
        noun: ClassVar[str] = "whistle"
        kind: Literal["whistle"]
        tone: float

    monkeypatch.setitem(KINDS, "whistle", Whistle)
    text = GOOD + LOSSES + '[[events]]\nkind = "whistle"\ntone = 440.0\ntime = 0.05\n'
    scenario = load_scenario(scenario_file(text))
    assert load_scenario(scenario_file(scenario_toml(scenario))).events == scenario.events
    assert with_overrides(scenario, {"end": 0.3}).events == scenario.events
    schedule = schedule_of(scenario, train_of(scenario))
    assert schedule.instants == (0.05, 0.1)
    assert from_attributes(schedule.attributes()) == schedule
    assert rotor_parameters(scenario, train_of(scenario))["fracture.time"] == 0.1
    (problem,) = problems(scenario_file(text.replace("tone", "tune")))[1:]
    assert "events.2.tune: unknown key; did you mean 'time'?" in problem or "tone" in problem
