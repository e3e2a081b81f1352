"""Small units with known answers, built once a session."""

from pathlib import Path

import pytest
from pythonfmu.builder import FmuBuilder

from orchestrator.fmu_file import FmuStore

UNITS = Path(__file__).parent / "units"


@pytest.fixture(scope="session")
def toy_fmus(tmp_path_factory):
    """Folder with two_masses.fmu and spring_damper.fmu."""
    folder = tmp_path_factory.mktemp("fmus")
    for name in ("two_masses", "spring_damper"):
        built = FmuBuilder.build_FMU(
            UNITS / f"{name}.py", folder, [UNITS / "port_unit.py"], canGetAndSetFMUstate=True
        )
        (folder / built.name).rename(folder / f"{name}.fmu")
    return folder


@pytest.fixture(scope="session")
def loop_fmus(tmp_path_factory):
    """Folder with lag.fmu and gain.fmu, an unsymmetric loop with feedthrough."""
    folder = tmp_path_factory.mktemp("loop")
    for name in ("lag", "gain"):
        built = FmuBuilder.build_FMU(
            UNITS / f"{name}.py", folder, [UNITS / "loop_matrices.py"], canGetAndSetFMUstate=True
        )
        (folder / built.name).rename(folder / f"{name}.fmu")
    return folder


@pytest.fixture
def store():
    """Extracted FMUs, removed after the test."""
    with FmuStore() as store:
        yield store
