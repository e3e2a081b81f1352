"""How a test says which fault it guards against: one mark, from which the table in ``README.md`` is written.

    @fault(
        "input",
        "a bearing outside the shaft",
        "exit 2; file, key, value and the length of the shaft",
        broken=("rotor_fmu/train/schema.py", "if z > length:", "if False:"),
    )
    def test_...

``broken`` is a change of one place in the code that takes the guard away: with it the test must fail
(``python -m tests.mutation``).
"""

from __future__ import annotations

import pytest

AREAS = ("input", "archive", "film", "coupling", "unit", "machine", "process")
"""Where a fault comes from; the table has a section for each."""


def fault(area: str, case: str, outcome: str, *, broken: tuple[str, str, str]) -> pytest.MarkDecorator:
    """Mark a test, or one set of its parameters, as the proof of what happens in a fault.

    Parameters
    ----------
    area : str
        One of `AREAS`.
    case : str
        The fault, as its victim would put it.
    outcome : str
        What happens: exit status or outcome, and the key words of the message.
    broken : tuple of str
        File, text in it that occurs exactly once, and what to put in its place so that the guard is gone.
    """
    if area not in AREAS:
        raise ValueError(f"area {area!r}; allowed are {', '.join(AREAS)}")
    return pytest.mark.fault(area=area, case=case, outcome=outcome, broken=broken)
