"""Small units with known answers, built once a session."""

import shutil
import tempfile
from pathlib import Path

import pytest
from pythonfmu.builder import FmuBuilder

from bearing_fmu.film import make_film
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.folder import build
from orchestrator.scenario.file import load_scenario
from orchestrator.ssp.export import export
from rotor_fmu.train.file import load_train
from rotor_fmu.vibration.rotor import Rotor
from tests.bearing_fmu.bearings import SPEED, TURBINE

UNITS = Path(__file__).parent / "units"
EXAMPLES = Path(__file__).parents[1] / "examples"


def units(folder, names, shared):
    """Build scripts of the folder of units, with what they share, as FMUs of their own name."""
    for name in names:
        script, files = UNITS / f"{name}.py", [UNITS / shared]
        built = FmuBuilder.build_FMU(script, folder, files, canGetAndSetFMUstate=True)
        (folder / built.name).rename(folder / f"{name}.fmu")


@pytest.fixture(scope="session")
def toy_fmus(once):
    """Folder with two_masses.fmu and spring_damper.fmu."""
    return once("toy", lambda folder: units(folder, ("two_masses", "spring_damper"), "port_unit.py"))


@pytest.fixture(scope="session")
def loop_fmus(once):
    """Folder with lag.fmu and gain.fmu, an unsymmetric loop with feedthrough."""
    return once("loop", lambda folder: units(folder, ("lag", "gain"), "loop_matrices.py"))


@pytest.fixture
def store():
    """Extracted FMUs, removed after the test."""
    with FmuStore() as store:
        yield store


@pytest.fixture(scope="session")
def small_fmus(once):
    """FMUs of the small train with short bearings, all compiled: no budget of a step need do."""
    fmus = once("small", lambda folder: build(folder, [load_train("small")], names=("v3",)))
    make_film("v3", TURBINE).respond([0.0] * 4, [0.0] * 4, SPEED)
    Rotor.of_train(load_train("small"))
    return fmus


@pytest.fixture(scope="session")
def small_ssp(small_fmus, tmp_path_factory):
    """The small train as an SSP, 0.01 s long."""
    scenario = load_scenario("small", {"depth": "v3", "end": 0.01, "event": None})
    return export(scenario, small_fmus, tmp_path_factory.mktemp("ssp") / "small.ssp", "small")[0]


@pytest.fixture
def room(tmp_path, monkeypatch):
    """Where archives are extracted to; empty."""
    folder = tmp_path / "room"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


@pytest.fixture(scope="session")
def faulty(tmp_path_factory):
    """A bearing of somebody else that fails as the environment variable FAULT says."""
    folder = tmp_path_factory.mktemp("faulty")
    for script in (UNITS / "faulty_bearing.py", EXAMPLES / "spring_bearing.py"):
        shutil.copy(script, folder)
    built = FmuBuilder.build_FMU(folder / "faulty_bearing.py", folder, [folder / "spring_bearing.py"])
    return folder / built.name
