"""What is kept of one run, and its file: small, and there whole or not at all."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from orchestrator.outcome import Outcome

DIED = "process-died"
"""Outcome of a run whose process ended without an answer."""
OVER_LIMIT = "over-limit"
"""Outcome of a run that took longer than was allowed."""
REFUSED = "refused"
"""Outcome of a run whose input was found to be wrong by a unit, or of a function that raised an error."""
NOT_REFINED = "not-refined"
"""In place of an outcome where the first stage did not ask for the second."""
TRIED_AGAIN = (DIED, OVER_LIMIT, Outcome.UNIT_HUNG.value)
"""Outcomes that may be of the machine: such runs are tried once more."""


@dataclass(frozen=True)
class Value:
    """A figure, or a series, with its dimensions and its unit."""

    dims: tuple[str, ...]
    data: Any
    units: str = ""


@dataclass(frozen=True)
class Row:
    """What is kept of one run.

    Attributes
    ----------
    outcome, message : str
        How it ended.
    values : dict of Value
        Figures and series by name.
    coords : dict of list
        Along their dimensions.
    timing : dict of float
        Wall time in s; in no dataset, so that equal studies give equal ones.
    """

    outcome: str
    message: str = ""
    values: Mapping[str, Value] = field(default_factory=dict)
    coords: Mapping[str, list[Any]] = field(default_factory=dict)
    timing: Mapping[str, float] = field(default_factory=dict)

    def to_json(self) -> str:
        """As text; floats survive the way there and back bit by bit."""
        return json.dumps(asdict(self), separators=(",", ":"))

    @classmethod
    def from_json(cls, text: str) -> Row:
        """Read what `to_json` wrote; ValueError, KeyError or TypeError where it is none."""
        data = json.loads(text)
        values = {k: Value(tuple(v["dims"]), v["data"], v["units"]) for k, v in data.pop("values").items()}
        return cls(values=values, **data)


def write_row(row: Row, path: Path) -> None:
    """Write the file of a run, whole or not at all."""
    part = path.with_name(f".{path.name}.part")
    part.write_text(row.to_json(), encoding="utf-8")
    part.replace(path)


def read_row(path: Path) -> Row | None:
    """Read the file of a run; None where there is none that can be read."""
    try:
        return Row.from_json(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None
