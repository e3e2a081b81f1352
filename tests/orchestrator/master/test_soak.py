"""Memory of a long run; see `tests.soak` for a million steps."""

import sys

import pytest

from orchestrator.fmi.folder import build
from orchestrator.scenario.file import load_scenario, train_of
from tests.soak import GROWTH, growth, soak


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_memory_stays_flat_over_many_steps(tmp_path):
    """Over 10 000 steps; an object of a hundred bytes that a step leaves behind would be a mebibyte."""
    build(tmp_path, [train_of(load_scenario("small"))])
    tenths = soak(tmp_path, 10_000, depth="v3")
    assert [tenth.step for tenth in tenths] == list(range(1000, 10_001, 1000))
    assert growth(tenths) < GROWTH / 8
