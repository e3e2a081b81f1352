"""Scenarios as they come survive their file or are refused in words, and runs end with numbers or a name."""

import numpy as np
import pytest
from hypothesis import assume, event, given
from hypothesis import strategies as st

from bearing_fmu import depths
from orchestrator.case.simulate import simulate
from orchestrator.errors import OrchestratorError, ScenarioError
from orchestrator.outcome import Outcome
from orchestrator.scenario.file import load_scenario, parse_scenario, scenario_toml
from orchestrator.scenario.scenario import COUPLINGS, REDUCTIONS, Scenario
from tests.faults import fault
from tests.properties.examples import examples
from tests.properties.journals import logarithmic

BEARINGS, WHEELS = ("front", "rear"), ("wheel-1", "wheel-2", "wheel-3")
_SPECIAL = "\x00\t\n\r\x1f\"\\'#\x7f\x85\u2028\ufeff"
TITLES = st.text(st.sampled_from(_SPECIAL), max_size=4) | st.text(
    st.characters(exclude_categories=["Cs"]), max_size=30
)


@st.composite
def settings_of_small(draw, longest: float = 2.0) -> dict:
    """Values of a scenario on the small train, in the shape of its file; most of them fit together."""
    end = draw(logarithmic(1e-3, longest))
    raw = {
        "title": draw(TITLES),
        "train": "small",
        "reduction": draw(st.sampled_from(REDUCTIONS)),
        "depth": draw(st.sampled_from(depths.names())),
        "depth_at": draw(st.dictionaries(st.sampled_from(BEARINGS), st.sampled_from(depths.names()))),
        "unbalance": {
            "at": draw(
                st.dictionaries(
                    st.sampled_from(WHEELS),
                    st.fixed_dictionaries({"unbalance": st.floats(0.0, 0.1), "phase": st.floats(-4.0, 4.0)}),
                )
            )
        },
        "end": end,
        "step": min(end, draw(logarithmic(2e-5, 2e-3))),
        "coupling": draw(st.sampled_from(COUPLINGS)),
        "film": {"columns": draw(st.integers(16, 64)), "rows": draw(st.integers(3, 10))},
        "record": {"interval": draw(logarithmic(1e-5, 1e-1))},
        "analysed_bearing": draw(st.sampled_from([None, *BEARINGS])),
    }
    if draw(st.booleans()):
        raw["event"] = {
            "wheel": draw(st.sampled_from(WHEELS)),
            "unbalance": draw(logarithmic(1e-3, 3.0)),
            "phase": draw(st.floats(-4.0, 4.0)),
            "time": end * draw(st.floats(0.0, 0.99)),
        }
    else:
        raw["event"] = None
    return raw


def loaded(raw: dict) -> Scenario:
    """The scenario of these values; those that do not fit together are passed over."""
    try:
        return load_scenario("small", raw)
    except ScenarioError as error:
        event("refused: " + error.problems[0].partition(" = ")[0])
        assume(False)
        raise


@fault(
    "input",
    "characters in a title that TOML does not take as they are",
    "escaped: the scenario in record and checkpoint reads as it was",
    guard="orchestrator.scenario.file:scenario_toml",
)
@given(settings_of_small())
@examples(200)
def test_a_scenario_survives_its_file(raw):
    scenario = loaded(raw)
    text = scenario_toml(scenario)
    assert parse_scenario(text, scenario.folder, "again") == scenario
    assert scenario_toml(parse_scenario(text, scenario.folder, "again")) == text


KEYS = st.sampled_from([*Scenario.model_fields, "wheel", "time", "interval", "colums", "Depth", ""])
LEAVES = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=6),
    st.sampled_from(["v1", "small", "front"]),
)
ANYTHING = st.recursive(
    LEAVES, lambda inner: st.lists(inner, max_size=2) | st.dictionaries(KEYS, inner, max_size=3)
)


@given(st.dictionaries(KEYS, ANYTHING, min_size=1, max_size=4))
@examples(300)
def test_any_values_make_a_scenario_or_are_refused_with_their_keys(changes):
    try:
        assert isinstance(load_scenario("small", changes), Scenario)
    except ScenarioError as error:
        event("refused")
        assert error.problems and all(problem.strip() for problem in error.problems)
        keys = [*changes, "event", "end", "step", "train", "record"]  # and what they contradict
        assert all(any(key in problem for key in keys) for problem in error.problems), error.problems


@given(settings_of_small(longest=0.01))
@examples(15)
def test_a_run_ends_with_numbers_or_the_name_of_what_failed(train_fmus, raw):
    """Steps up to a tenth of a revolution, every coupling: what is recorded is finite."""
    scenario = loaded(raw)
    assume(scenario.end / scenario.step <= 100.0)
    try:
        result = simulate(scenario, train_fmus)
    except OrchestratorError as error:
        event(f"refused: {type(error).__name__}")
        assert str(error)
        return
    event(result.outcome.value)
    record = result.record
    assert record.attrs["status"] == result.outcome.value
    assert result.outcome.advice and (result.outcome is Outcome.FINISHED or result.message)
    if result.outcome is Outcome.FINISHED:
        assert record["time"].values[-1] == pytest.approx(scenario.end, rel=1e-9)
    for name in ("force", "displacement", "velocity", "least_gap", "amplitude", "stress"):
        assert np.all(np.isfinite(record[name].values)), name
