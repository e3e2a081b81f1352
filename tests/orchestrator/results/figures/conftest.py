"""Records that figures are drawn of."""

import pytest

from tests.orchestrator.results import synthetic_record


@pytest.fixture(scope="session")
def train():
    return synthetic_record.train()


@pytest.fixture(scope="session")
def records():
    return [synthetic_record.record(depth) for depth in ("v1", "v2", "v3")]


@pytest.fixture(scope="session")
def record(records):
    return records[0]
