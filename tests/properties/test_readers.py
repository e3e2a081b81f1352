"""Readers on damaged files: what is read is whole, or the error is one of our own that names the file.

Nothing that a reader extracted is left behind.
"""

import tempfile
from pathlib import Path

import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from orchestrator.case.case import ssp_case
from orchestrator.case.progress import Stage
from orchestrator.case.simulate import Execution, simulate
from orchestrator.errors import FmuError, OrchestratorError, ScenarioError
from orchestrator.fmi.file import FmuStore
from orchestrator.observers import checkpoint
from orchestrator.observers.checkpoint import CheckpointError
from orchestrator.scenario.file import load_scenario
from orchestrator.scenario.scenario import Scenario
from orchestrator.ssp.export import export
from orchestrator.ssp.structure import SspError
from rotor_fmu.train.file import DATA, TrainFileError, load_train
from rotor_fmu.train.train import Train
from tests.faults import fault
from tests.orchestrator.toy_train import toy_fmu_folder, toy_scenario
from tests.properties.damage import bytes_of, lines_of, unzipped, zipped
from tests.properties.examples import examples

SMALL = DATA / "small"
SCENARIO = """\
title = "Damaged"
train = "small"
depth_at = {front = "v2"}
end = 0.3
step = 1e-4
[unbalance.at.wheel-1]
unbalance = 0.02
phase = 0.5
[event]
wheel = "wheel-2"
unbalance = 0.3
time = 0.15
[film]
columns = 32
[record]
interval = 1e-3
"""


def said(error: Exception, *names: str) -> None:
    """Check that an error names what it is about, in words."""
    text = str(error)
    event(type(error).__name__)
    assert text and any(name in text for name in names), text
    assert "Traceback" not in text and "object at 0x" not in text


@fault(
    "input",
    "a scenario damaged anywhere",
    "read, or ScenarioError naming the file and each problem",
    guard="rotor_fmu.train.toml_source:read_toml",
)
@given(st.one_of(lines_of(SCENARIO).map(str.encode), bytes_of(SCENARIO.encode())))
@examples(400)
def test_damaged_scenario(content):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "damaged.toml"
        path.write_bytes(content)
        try:
            assert isinstance(load_scenario(path), Scenario)
            event("read")
        except ScenarioError as error:
            said(error, str(path))
            assert all(error.problems)


@fault(
    "input",
    "train.toml or shaft.csv damaged anywhere",
    "read, or TrainFileError naming the file and each problem",
    guard="rotor_fmu.train.table:_text",
)
@given(st.data())
@examples(300)
def test_damaged_train(data):
    files = {name: (SMALL / name).read_text(encoding="utf-8") for name in ("train.toml", "shaft.csv")}
    harmed = data.draw(st.sampled_from(sorted(files)))
    way = st.one_of(lines_of(files[harmed]).map(str.encode), bytes_of(files[harmed].encode()))
    contents = {name: text.encode() for name, text in files.items()} | {harmed: data.draw(way)}
    with tempfile.TemporaryDirectory() as folder:
        for name, content in contents.items():
            (Path(folder) / name).write_bytes(content)
        try:
            assert isinstance(load_train(folder), Train)
            event("read")
        except TrainFileError as error:
            said(error, folder)
            assert all(error.problems)


@pytest.fixture(scope="module")
def ssp(train_fmus, tmp_path_factory):
    """Members of the SSP of the small train with the affine law."""
    short = load_scenario("small", {"end": 0.01, "event": None, "depth": "v3"})
    return unzipped(export(short, train_fmus, tmp_path_factory.mktemp("ssp") / "small.ssp", "small")[0])


TEXTS = ("SystemStructure.ssd", "resources/rotor.ssv", "resources/front.ssv")


@fault(
    "archive",
    "an SSP with damaged texts",
    "read, or an error naming the SSP; nothing extracted is left",
    guard="orchestrator.ssp.reader:read_ssp",
)
@given(st.data())
@examples(60)
def test_damaged_ssp(ssp, room, tmp_path_factory, data):
    """Its texts, line by line; the FMUs inside are whole."""
    name = data.draw(st.sampled_from(TEXTS))
    text = data.draw(lines_of(ssp[name].decode()))
    path = tmp_path_factory.getbasetemp() / "damaged.ssp"
    zipped(ssp | {name: text.encode("utf-8", "replace")}, path)
    try:
        with ssp_case(path):
            event("read")
    except OrchestratorError as error:
        said(error, str(path))
    assert not list(room.iterdir())


@given(st.data())
@examples(60)
def test_damaged_archive_of_an_ssp(ssp, room, tmp_path_factory, data):
    """The bytes of the archive, with its texts alone."""
    path = tmp_path_factory.getbasetemp() / "damaged.ssp"
    zipped({name: ssp[name] for name in TEXTS}, path)
    path.write_bytes(data.draw(bytes_of(path.read_bytes())))
    with pytest.raises((SspError, FmuError)) as info, ssp_case(path):
        pass
    said(info.value, str(path), "damaged.ssp")
    assert not list(room.iterdir())


@fault(
    "archive",
    "an FMU damaged in its description or as an archive",
    "read, or FmuError naming the FMU; nothing extracted is left",
    guard="orchestrator.fmi.file:FmuFile.__init__",
)
@given(st.data())
@examples(150)
def test_damaged_fmu(toy_fmus, room, tmp_path_factory, data):
    """Its description line by line, or the bytes of the archive."""
    members = unzipped(toy_fmus / "spring_damper.fmu")
    path = tmp_path_factory.getbasetemp() / "damaged.fmu"
    if data.draw(st.sampled_from([True, True, True, False])):
        text = data.draw(lines_of(members["modelDescription.xml"].decode()))
        zipped(members | {"modelDescription.xml": text.encode("utf-8", "replace")}, path)
    else:
        zipped({"modelDescription.xml": members["modelDescription.xml"]}, path)
        path.write_bytes(data.draw(bytes_of(path.read_bytes())))
    try:
        with FmuStore() as store:
            assert store.open(path).variables
            event("read")
    except FmuError as error:
        said(error, str(path))
    assert not list(room.iterdir())


class Killed(BaseException):
    """What no code of the run handles."""


@pytest.fixture(scope="module")
def interrupted(toy_fmus, tmp_path_factory):
    """Scenario and FMUs of the toy train, and the files of a checkpoint of a run of them."""
    folder = tmp_path_factory.mktemp("interrupted")
    toy = toy_fmu_folder(toy_fmus, folder / "named")
    scenario = toy_scenario(folder)

    def kill(stage, simulated):
        if stage is Stage.RUN and simulated > 0.01:
            raise Killed

    with pytest.raises(Killed):
        simulate(scenario, toy, kill, Execution(checkpoint.Checkpoints(folder / "saved", 4e-3, {})))
    return scenario, toy, {path.name: path.read_bytes() for path in (folder / "saved").iterdir()}


@fault(
    "process",
    "a checkpoint damaged anywhere",
    "CheckpointError naming the file",
    guard="orchestrator.observers.checkpoint:read",
)
@given(st.data())
@examples(60)
def test_damaged_checkpoint(interrupted, room, data):
    """It is refused, or the run goes on: zip archives tell of every other byte."""
    scenario, toy, files = interrupted
    with tempfile.TemporaryDirectory() as folder:
        for name, content in files.items():
            (Path(folder) / name).write_bytes(content)
        path = Path(folder) / checkpoint.FILE
        path.write_bytes(data.draw(bytes_of(files[checkpoint.FILE])))
        try:
            saved = checkpoint.read(Path(folder))
        except CheckpointError as error:
            said(error, str(path))
            return
        result = simulate(scenario, toy, None, Execution(None, saved))
    event(f"resumed: {result.outcome.value}")
