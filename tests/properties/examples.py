"""How many examples a property is shown on: in the fast suite a third, all with HYPOTHESIS_EXAMPLES=all."""

import os

from hypothesis import settings

_ALL = os.environ.get("HYPOTHESIS_EXAMPLES") == "all"


def examples(count: int) -> settings:
    """Settings for so many examples, or a third of them but no less than 12."""
    return settings(max_examples=count if _ALL else max(count // 3, min(count, 12)))
