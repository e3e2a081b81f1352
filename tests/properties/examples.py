"""How many examples a property is shown on: in the fast suite a fifth, all with HYPOTHESIS_EXAMPLES=all."""

import os

from hypothesis import settings

_ALL = os.environ.get("HYPOTHESIS_EXAMPLES") == "all"


def examples(count: int) -> settings:
    """Settings for so many examples, or a fifth of them but no less than 10."""
    return settings(max_examples=count if _ALL else max(count // 5, min(count, 10)))
