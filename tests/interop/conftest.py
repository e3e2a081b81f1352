"""FMUs of the small train and its system as SSP, built once."""

import pytest

from orchestrator.fmi.folder import build
from orchestrator.scenario.file import load_scenario, train_of
from orchestrator.ssp.export import export

FRACTURE = {"end": 0.2, "event": {"time": 0.1003}}


@pytest.fixture(scope="session")
def fmus(tmp_path_factory):
    """Folder with the rotor of the small train and a bearing of each depth."""
    folder = tmp_path_factory.mktemp("fmus")
    build(folder, [train_of(load_scenario("small"))])
    return folder


@pytest.fixture(scope="session")
def exported(fmus, tmp_path_factory):
    """The SSP of the small train with the affine law, and that with force only."""
    out = tmp_path_factory.mktemp("ssp") / "bladeloss.ssp"
    return export(load_scenario("small", FRACTURE), fmus, out, "small")
