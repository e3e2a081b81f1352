"""Read a scenario: bundled or from a TOML file, every problem of the file reported at once."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from orchestrator.scenario import Scenario


def load_scenario(source: str | Path, overrides: Mapping[str, Any] | None = None) -> Scenario:
    """Read and check a scenario.

    Parameters
    ----------
    source : str or Path
        Name of a bundled scenario (see `bundled_scenarios`) or path of a TOML file.
    overrides : mapping, optional
        Values that replace those of the file, in the shape of the file: ``{"depth": "v2",
        "depth_at": {"LP1-rear": "v1"}, "end": 0.5}``. Tables are merged key by key.

    Returns
    -------
    Scenario

    Raises
    ------
    ScenarioError
        With one line for each problem of the file: file, key, value, what is allowed.
    """
    raise NotImplementedError


def bundled_scenarios() -> tuple[str, ...]:
    """Names of the scenarios that come with the package."""
    folder = Path(__file__).parent / "scenarios"
    return tuple(sorted(path.stem for path in folder.glob("*.toml")))


def scenario_toml(scenario: Scenario) -> str:
    """TOML text of a scenario with everything spelt out; reading it gives the scenario again."""
    raise NotImplementedError
