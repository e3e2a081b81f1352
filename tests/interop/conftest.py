"""FMUs of the small train and its system as SSP, built once."""

import pytest

from orchestrator.scenario.file import load_scenario
from orchestrator.ssp.export import export

FRACTURE = {"end": 0.2, "event": {"time": 0.1003}}


@pytest.fixture(scope="session")
def fmus(train_fmus):
    """Folder with the rotor of the small train and a bearing of each depth."""
    return train_fmus


@pytest.fixture(scope="session")
def exported(fmus, tmp_path_factory):
    """The SSP of the small train with the affine law, and that with force only."""
    out = tmp_path_factory.mktemp("ssp") / "bladeloss.ssp"
    return export(load_scenario("small", FRACTURE), fmus, out, "small")
