"""Checkpoints with something missing or out of place: each ends in one line, whichever field it is."""

import json

import numpy as np
import pytest
from rich.console import Console

from orchestrator.case.checkpoint_folder import checkpoint_folder, request_of
from orchestrator.case.prepare import prepare
from orchestrator.errors import OrchestratorError
from orchestrator.observers import checkpoint
from orchestrator.outcome import INPUT_ERROR
from tests.faults import fault
from tests.orchestrator.foreign import call

ABOUT = (
    *("source", "bearing", "formats", "every", "certify", "threads", "budget"),
    *("scenario", "scenario_folder"),
)
META = ("version", "step", "time", "level", "counts", "evaluations", "fmus", "about")
ALLOWED = {
    "source": ("word",),
    "bearing": (None,),
    "threads": (None, 10**9),
    "every": (10**9,),
    "budget": (10**9,),
    "scenario_folder": ("word",),
}
"""What may well stand there."""
WRONG = (None, "word", -1, 1e400, [1], {"a": []}, 10**9)


@pytest.fixture(scope="module")
def saved(small_fmus, tmp_path_factory):
    """What a run that did not finish left."""
    folder = tmp_path_factory.mktemp("saved")
    (folder / "s.toml").write_text('train = "small"\nend = 0.003\ndepth = "v3"\n[record]\ninterval = 1e-3\n')
    save = checkpoint.Checkpoints.save

    def only_early(self, instant, *rest, **more):
        if instant[1] < 0.0015:
            save(self, instant, *rest, **more)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("orchestrator.commands.run.discard", lambda _: None)
        patch.setattr(checkpoint.Checkpoints, "save", only_early)
        options = ("--fmus", small_fmus, "--out", folder / "out", "--no-figures", "--checkpoint", 0.001)
        result = call("run", folder / "s.toml", *options)
        assert result.exit_code == 0, result.output
    return checkpoint.read(checkpoint_folder(folder / "out"))


def resumed(saved, folder, meta, arrays, small_fmus):
    """The line in which resuming from a changed checkpoint ends; whatever it is, no traceback."""
    path = checkpoint_folder(folder / "out") / checkpoint.FILE
    checkpoint.write(path, meta, arrays)
    result = call("resume", folder / "out", "--fmus", small_fmus)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def refused(result, path):
    assert result.exit_code == INPUT_ERROR, result.output
    (line,) = result.stderr.strip().splitlines()
    assert str(path) in line
    return line


@fault(
    "process",
    "a checkpoint in which a field is missing or is not what a run writes",
    "exit 2, one line: the file, the field, its value",
    guard="orchestrator.case.checkpoint_folder:request_of",
)
@pytest.mark.parametrize("field", [*META, *(f"about.{name}" for name in ABOUT)])
def test_a_field_that_is_missing_or_wrong(field, saved, small_fmus, tmp_path):
    path = checkpoint_folder(tmp_path / "out")
    for value in ("missing", *WRONG):
        meta = json.loads(json.dumps(saved.meta))
        table, key = (meta["about"], field[6:]) if field.startswith("about.") else (meta, field)
        if value == "missing":
            del table[key]
        else:
            table[key] = value
        if value in (saved.meta.get(key), saved.about.get(key)):
            continue
        checkpoint.write(path / checkpoint.FILE, meta, saved.arrays)
        try:
            read = checkpoint.read(path)
        except checkpoint.CheckpointError as error:
            assert str(path) in str(error) and "\n" not in str(error)
            continue
        if field.startswith("about."):
            _about_is_refused(read, key, value, tmp_path, small_fmus)
        else:  # found out only by the run's own size
            refused(resumed(saved, tmp_path, meta, saved.arrays, small_fmus), path)


def _about_is_refused(read, key, value, folder, fmus):
    try:
        with prepare(request_of(read, folder / "out", fmus, trust=False), Console(quiet=True), read):
            assert value in ALLOWED.get(key, ()), (key, value)
    except OrchestratorError as error:
        assert str(read.path) in str(error) or str(value) in str(error), error


@pytest.mark.parametrize("name", ["unit1", "inputs", "start.static", "record.times", "record.peaks"])
def test_an_array_that_is_missing_or_of_another_shape(name, saved, small_fmus, tmp_path):
    for arrays in (
        {key: value for key, value in saved.arrays.items() if key != name},
        saved.arrays | {name: np.zeros((3, 7, 2))},
        saved.arrays | {name: np.array(["text"])},
    ):
        result = resumed(saved, tmp_path, saved.meta, arrays, small_fmus)
        assert result.exit_code != 0 and len(result.stderr.strip().splitlines()) == 1, result.output
