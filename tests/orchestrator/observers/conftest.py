"""What these tests share."""

import pytest

from tests.orchestrator.toy_train import toy_fmu_folder


@pytest.fixture(scope="module")
def toy(toy_fmus, tmp_path_factory):
    return toy_fmu_folder(toy_fmus, tmp_path_factory.mktemp("named"))
