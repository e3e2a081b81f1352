"""A small study of real runs: the same numbers as single runs, to the last bit."""

import numpy as np
import pytest

pytest.importorskip("distributed", reason="studies run on Dask, which is not installed")

import bladeloss
from rich.console import Console

from orchestrator.case.prepare import prepare
from orchestrator.case.request import RunRequest
from orchestrator.case.simulate import Execution, execute
from orchestrator.results.ensemble.files import read_study
from orchestrator.results.summary import summarise
from orchestrator.scenario.file import load_with_train
from orchestrator.study.ensemble.conduct import Means, plan_of
from orchestrator.study.ensemble.gathering.worst import worst_runs, write_inputs
from orchestrator.study.ensemble.running.bench import Bench
from orchestrator.study.ensemble.sampling.file import read_study_file

STUDY = {
    "scenario": "small",
    "depths": ["v3"],
    "set": {"end": 0.02, "event": {"time": 0.01}, "record": {"interval": 1e-3}},
    "parameters": {
        "unbalance": {"key": "event.unbalance", "values": [0.2, 40.0]},
        "clearance": {"key": "train.bearing.*.clearance", "factor": True, "values": [1.0, 0.9]},
        "phase": {"key": "event.phase", "values": [0.0, 1.0]},
    },
    "keep": {"traces": ["least_gap", "force"], "worst": 0},
}


@pytest.fixture(scope="module")
def study(small_fmus, tmp_path_factory):
    folder = tmp_path_factory.mktemp("study") / "small"
    return bladeloss.study(STUDY, out=folder, fmus=small_fmus, jobs=2), folder


def test_the_numbers_are_those_of_single_runs(study, small_fmus, tmp_path):
    """Also of a train that was changed: written as a folder, and run from there."""
    data, folder = study
    file = read_study_file(STUDY)
    plan = plan_of(file, Means(folder, small_fmus))
    for sample in (0, 1):
        path = write_inputs(plan.subject, plan.samples[sample], "v3", tmp_path / str(sample))
        with prepare(RunRequest(str(path), fmus=small_fmus), Console(quiet=True), writes=False) as case:
            result = execute(case, None, Execution())
        at = data.isel(sample=sample, depth=0)
        assert at["outcome"] == result.outcome.value
        np.testing.assert_array_equal(at["force"].values, result.record["force"].values)
        np.testing.assert_array_equal(at["time"].values, result.record["time"].values)
        for row in summarise(result).bearings:
            for name in ("force_max", "least_gap_min", "sommerfeld_mean", "contact_share"):
                assert at[name].sel(period=row.phase, bearing=row.bearing) == getattr(row, name)


def test_what_is_written_of_a_sample_is_the_sample(study, small_fmus, tmp_path):
    plan = plan_of(read_study_file(STUDY), Means(study[1], small_fmus))
    scenario, train = plan.subject.inputs(plan.samples[1], "v3")
    read, its_train = load_with_train(str(write_inputs(plan.subject, plan.samples[1], "v3", tmp_path)))
    assert its_train == train and its_train.bearings[0].clearance == 0.9 * 2.2e-4
    assert read.events == scenario.events and read.end == scenario.end


def test_its_folder_holds_dataset_and_table(study):
    data, folder = study
    assert read_study(folder).identical(data.load())
    assert data["unbalance"].attrs == {"long_name": "unbalance", "key": "event.unbalance"}
    assert data["least_gap_min"].dims == ("sample", "depth", "period", "bearing")
    lines = (folder / "study.csv").read_text().splitlines()
    assert len(lines) == 3 and lines[0].startswith(
        "sample,depth,unbalance,clearance,phase,outcome,contact [1]"
    )


def test_the_worst_come_first(study):
    assert worst_runs(study[0], "force_max", 2) == [(1, "v3"), (0, "v3")]
    assert worst_runs(study[0], "least_gap_min", 1) == [(1, "v3")]


def test_runs_that_begin_alike_share_their_equilibrium(small_fmus, tmp_path):
    """Another blade in the same bearings starts where the first did; with other clearances it does not."""
    blades = {"key": "event.unbalance", "values": [0.2, 40.0, 40.0]}
    clearance = {"key": "train.bearing.*.clearance", "factor": True, "values": [1.0, 1.0, 0.9]}
    phase = {"key": "event.phase", "values": [0.0, 1.0, 1.0]}
    changes = {"parameters": {"unbalance": blades, "clearance": clearance, "phase": phase}}
    plan = plan_of(read_study_file(STUDY | changes), Means(tmp_path, small_fmus))
    one, other, elsewhere = (plan.subject.work(plan.samples[i], "v3") for i in range(3))
    shared, own = Bench(pytest.fail), Bench(pytest.fail)
    one.carry_out(shared)
    (known,) = shared.shared["starts"].all
    offsets = known.start.offsets
    row = other.carry_out(shared)
    assert [k.start.offsets is offsets for k in shared.shared["starts"].all] == [True]
    alone = other.carry_out(own)
    for name, value in alone.values.items():
        np.testing.assert_array_equal(row.values[name].data, value.data)
    elsewhere.carry_out(shared)
    assert len(shared.shared["starts"].all) == 2
    for bench in (shared, own):
        bench.shared["extracted"].close()
