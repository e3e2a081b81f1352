"""What an unreduced shaft costs is said before it is paid."""

from orchestrator.case.prepare import size_note


def test_a_large_unreduced_shaft_is_named_with_its_cost():
    assert "6404 degrees of freedom, whose modes take some 22 min" in size_note("none", 6404)
    assert size_note("none", 1116) == size_note("irs", 6404) == ""
