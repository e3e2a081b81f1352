"""Wrong studies are refused before anything runs: file, line, key, value, what is allowed."""

import re
from pathlib import Path

import pytest

from orchestrator.study.ensemble.conduct import Means, plan_of
from orchestrator.study.ensemble.running.subject import ScenarioSubject
from orchestrator.study.ensemble.sampling.file import StudyError, read_study_file
from orchestrator.study.ensemble.sampling.samples import samples_of

ENSEMBLE = Path(__file__).parents[4] / "orchestrator" / "study" / "ensemble"
RIGHT = """\
scenario = "small"
depths = ["v3"]
[set]
end = 0.02
[set.event]
time = 0.01
[sampling]
method = "latin-hypercube"
count = 4
[parameters.unbalance]
key = "event.unbalance"
grid = [0.1, 0.2]
[parameters.clearance]
key = "train.bearing.*.clearance"
factor = true
distribution = "uniform"
arguments = { loc = 0.9, scale = 0.2 }
"""


def refusals(folder, text):
    """What is said of a study."""
    path = folder / "study.toml"
    path.write_text(text)
    with pytest.raises(StudyError) as caught:
        file = read_study_file(path)
        plan_of(file, Means(folder / "out", folder / "fmus"))
    assert sorted(p.name for p in folder.iterdir()) == ["study.toml"]
    return str(caught.value).replace(f"{path}: ", "")


def test_a_right_study_has_its_samples(tmp_path):
    (tmp_path / "study.toml").write_text(RIGHT)
    plan = plan_of(read_study_file(tmp_path / "study.toml"), Means(tmp_path / "out", tmp_path / "fmus"))
    assert len(plan.first()) == 8
    scenario, train = plan.subject.inputs(plan.samples[5], "v3")
    assert (scenario.depth, scenario.end, scenario.events[0].unbalance) == ("v3", 0.02, 0.2)
    factor = plan.samples[5]["clearance"]
    assert [seat.clearance for seat in train.bearings] == [2.2e-4 * factor] * 2
    assert plan.subject.work(plan.samples[5], "v3").rotor is plan.subject.train, (
        "its rotor is that of the base"
    )


def replaced(old, new):
    assert old in RIGHT
    return RIGHT.replace(old, new)


UNBALANCE, CLEARANCE = "parameters.unbalance", "parameters.clearance"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (RIGHT + "more = 1\n", "line 18: parameters: clearance: more: unknown key; allowed are key, unit"),
        (
            replaced("count = 4", "count = 0"),
            "line 9: sampling: count = 0; allowed is a number of at least 1",
        ),
        (replaced("[0.1, 0.2]", "[]"), f"line 12: {UNBALANCE}.grid = []; allowed is at least one value"),
        (
            replaced("[0.1, 0.2]", "{ start = 1.0, stop = 1.0, count = 3 }"),
            "line 12: parameters.unbalance.grid = {'start': 1.0, 'stop': 1.0, 'count': 3}; "
            "allowed is a range that is not empty",
        ),
        (
            replaced("[0.1, 0.2]", "{ start = 1.0, until = 2.0, count = 3 }"),
            f"line 12: {UNBALANCE}.grid: until: unknown key; did you mean 'count'? allowed are start, stop",
        ),
        (
            replaced("scale = 0.2", "scale = 0.0"),
            f"line 17: {CLEARANCE}.arguments: {{'loc': 0.9, 'scale': 0.0}}; allowed are those of a range",
        ),
        (
            replaced('"uniform"', '"uniformly"'),
            f"line 16: {CLEARANCE}.distribution = 'uniformly'; did you mean 'uniform'?",
        ),
        (
            replaced("scale = 0.2", "skale = 0.2"),
            f"line 17: {CLEARANCE}.arguments: skale; allowed are loc, scale",
        ),
        (
            replaced("grid = [0.1, 0.2]\n", ""),
            f"line 10: {UNBALANCE}: nothing given; allowed is one of values, grid, distribution",
        ),
        (replaced('["v3"]', '["v9"]'), "line 2: depths: 'v9'; allowed are v1, v2"),
        (replaced('"small"', '"smal"'), "line 1: scenario = 'smal': no such scenario; did you mean 'small'?"),
        (
            replaced("end = 0.02", "ende = 0.02"),
            "line 1: scenario = 'small': ende: unknown key; did you mean",
        ),
        (
            replaced("event.unbalance", "event.unbalanced"),
            f"line 10: {UNBALANCE} = 0.1 (sample 0, and 7 more): events.0.unbalanced: unknown key; did you",
        ),
        (
            replaced("0.1, 0.2]", "0.1, -0.2]"),
            f"line 10: {UNBALANCE} = -0.2 (sample 4, and 3 more): events.0.unbalance = -0.2; allowed is",
        ),
        (replaced("loc = 0.9", "loc = 900.0"), "bearing 'front': clearance = "),
        (replaced(".*.clear", ".middle.clear"), "middle: allowed are front, rear, *"),
        (replaced(".*.clearance", ".*.clearing"), "is None there; allowed is a number, for factor is true"),
        (RIGHT + '[keep]\nfigures = ["least_gap"]\n', "line 19: keep.figures: 'least_gap'; did you mean"),
        (RIGHT + '[keep]\ntraces = ["gap"]\n', "line 19: keep.traces: 'gap'; allowed are force, moment"),
        (RIGHT + '[keep]\nbearings = ["mid"]\n', "line 19: keep.bearings: 'mid'; allowed are front, rear"),
        (
            RIGHT + '[refine]\ndepths = ["v1"]\nfigure = "least_gap_min"\n',
            "line 18: refine: allowed is one of below and above",
        ),
        (
            RIGHT + '[refine]\ndepths = ["v3"]\nfigure = "least_gap_min"\nbelow = 1e-5\n',
            "line 19: refine.depths: 'v3'; allowed are depths that are not run for all samples",
        ),
        (
            replaced('"latin-hypercube"', '"sobol"').replace("count = 4", "count = 5"),
            "line 9: sampling.count = 5; allowed is a power of two with method sobol",
        ),
        (
            replaced('"latin-hypercube"', '"sensitivity-morris"'),
            f"line 10: {UNBALANCE}: allowed is a distribution with sensitivity-morris",
        ),
        (RIGHT.replace("[sampling]", "[sampled]"), "line 7: sampled: unknown key; did you mean 'sampling'?"),
        ("depths = [\n", "not TOML: "),
    ],
)
def test_wrong_studies_are_said_with_their_line(text, said, tmp_path):
    assert said in refusals(tmp_path, text)


def test_every_problem_is_said_at_once(tmp_path):
    text = replaced("[0.1, 0.2]", "[]").replace('"uniform"', '"uniformly"').replace('["v3"]', '["v9"]')
    assert len(refusals(tmp_path, text).splitlines()) == 3


def test_the_examples_are_right(tmp_path):
    """That of the page with a draw in place of twenty; of the turbine's, the file and its first sample."""
    page = (ENSEMBLE / "README.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```toml\n(.*?)```", page, re.DOTALL)
    (tmp_path / "contact.toml").write_text(example.replace("count = 20", "count = 1"))
    plan = plan_of(read_study_file(tmp_path / "contact.toml"), Means(tmp_path / "out", tmp_path / "fmus"))
    assert len(plan.first()) == 10 and plan.depths == ["v2", "v1"]
    file = read_study_file(ENSEMBLE / "turbine.toml")
    subject = ScenarioSubject.of(file, tmp_path / "fmus", 60.0)
    samples = samples_of(file.study)
    assert len(samples) == 80 and subject.problems(samples[0], "v1") == []
