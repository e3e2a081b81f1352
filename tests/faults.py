"""How a test says which fault it guards against: one mark, from which the table in ``README.md`` is written.

    @fault(
        "input",
        "a bearing outside the shaft",
        "exit 2; file, key, value and the length of the shaft",
        guard="rotor_fmu.train.checks:position_problems",
    )
    def test_...

``guard`` names what keeps the fault from doing harm: module and function, class, constant or field.  With one
of the changes in it that `tests.guards` finds the test must fail (``python -m tests.mutation``).
"""

from __future__ import annotations

import pytest

AREAS = ("input", "archive", "film", "coupling", "unit", "machine", "process")
"""Where a fault comes from; the table has a section for each."""


def fault(area: str, case: str, outcome: str, *, guard: str) -> pytest.MarkDecorator:
    """Mark a test, or one set of its parameters, as the proof of what happens in a fault.

    Parameters
    ----------
    area : str
        One of `AREAS`.
    case : str
        The fault, as its victim would put it.
    outcome : str
        What happens: exit status or outcome, and the key words of the message.
    guard : str
        ``module:name`` of what stands against it, with a dotted name for what stands in a class.
    """
    if area not in AREAS:
        raise ValueError(f"area {area!r}; allowed are {', '.join(AREAS)}")
    return pytest.mark.fault(area=area, case=case, outcome=outcome, guard=guard)
