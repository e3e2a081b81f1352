"""What an unreduced shaft costs is said before it is paid, and refused where it cannot be had."""

import pytest

from orchestrator.case.prepare import size_note
from orchestrator.errors import OrchestratorError


def test_a_large_unreduced_shaft_is_named_with_its_cost():
    assert "6404 degrees of freedom, whose modes take some 22 min" in size_note("none", 6404, 0.0)
    assert size_note("none", 1116, 60.0) == size_note("irs", 6404, 60.0) == ""


def test_an_unreduced_shaft_that_takes_longer_than_a_call_may_is_refused():
    with pytest.raises(OrchestratorError, match=r"reduction none: .*--budget 60, in s.* or --budget 2700"):
        size_note("none", 6404, 60.0)
    assert size_note("none", 6404, 2700.0)
