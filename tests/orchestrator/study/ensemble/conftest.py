"""Processes of runs that stay for all tests of a file, which else each start some."""

import pytest

from orchestrator.study.ensemble.running import attendant, crowd


@pytest.fixture(scope="module", autouse=True)
def processes_that_stay():
    """Only the last test ends them."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(crowd, "close_all", lambda: None)
        yield
    attendant.close_all()
