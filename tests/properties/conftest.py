"""How much hypothesis draws: always the same, or other and more examples with HYPOTHESIS_PROFILE=explore."""

import os

from hypothesis import HealthCheck, Phase, settings

from tests.orchestrator.conftest import room as room  # fixtures
from tests.orchestrator.conftest import toy_fmus as toy_fmus

_CHECKS = [HealthCheck.too_slow, HealthCheck.function_scoped_fixture]
_COMMON = {"deadline": None, "suppress_health_check": _CHECKS}
settings.register_profile("fixed", max_examples=60, derandomize=True, database=None, **_COMMON)
settings.register_profile(  # for the mutation run: to fail is enough
    "mutant",
    settings.get_profile("fixed"),
    phases=[Phase.explicit, Phase.generate],
    report_multiple_bugs=False,
)
settings.register_profile("explore", max_examples=2000, print_blob=True, **_COMMON)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "fixed"))
