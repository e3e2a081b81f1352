"""A comparison as data: rows, conclusions, how the runs went; as JSON and CSV."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from io import StringIO
from typing import Any

from orchestrator.study.paper.conclusions import Conclusion, conclude
from orchestrator.study.paper.criterion import Criterion, Row, Verdict
from orchestrator.study.paper.rows import rows
from orchestrator.study.paper.runs import Runs
from orchestrator.study.paper.worker import Ended


@dataclass(frozen=True)
class Settings:
    """Numerical settings of the runs.

    Attributes
    ----------
    macro_step : float
        [s].
    columns, film_rows : int
        Resolution of the films.
    end : float
        End time [s].
    """

    macro_step: float
    columns: int
    film_rows: int
    end: float

    def text(self) -> str:
        """In a few words."""
        return f"film {self.columns} x {self.film_rows}, macro step {self.macro_step * 1e3:.3g} ms"


@dataclass(frozen=True)
class Comparison:
    """One scenario at every depth against the paper.

    Attributes
    ----------
    title : str
        Of the scenario.
    settings : Settings
        Numerical settings.
    runs : Runs
        The observations.
    ended : mapping
        How each run ended, by depth.
    rows : tuple of Row
        The table.
    conclusions : tuple of Conclusion
        One a depth.
    """

    title: str
    settings: Settings
    runs: Runs
    ended: Mapping[str, Ended]
    rows: tuple[Row, ...]
    conclusions: tuple[Conclusion, ...]

    @property
    def complete(self) -> bool:
        """Whether every run finished."""
        return all(end.ok for end in self.ended.values())

    def count(self, verdict: Verdict) -> int:
        """Number of rows with a verdict."""
        return sum(row.verdict is verdict for row in self.rows)


def compare(title: str, settings: Settings, runs: Runs, ended: Mapping[str, Ended]) -> Comparison:
    """Evaluate the table and the conclusions."""
    return Comparison(title, settings, runs, ended, rows(runs), conclude(runs))


@dataclass(frozen=True)
class Change:
    """What a finer resolution changes in one row.

    Attributes
    ----------
    row : Row
        The row at the finer resolution.
    verdict_before : Verdict
        Its verdict at the resolution of the comparison.
    largest : float
        Largest relative change of a criterion's value; not a number when none can be compared.
    label : str
        Of that criterion.
    """

    row: Row
    verdict_before: Verdict
    largest: float
    label: str

    @property
    def flips(self) -> bool:
        """Whether the verdict changes."""
        return self.row.verdict is not self.verdict_before


def changes(coarse: Comparison, fine: Comparison) -> tuple[Change, ...]:
    """Changes from one comparison to a finer one, row by row."""
    return tuple(_change(row, other) for row, other in zip(coarse.rows, fine.rows, strict=True))


def _change(row: Row, fine: Row) -> Change:
    pairs = list(zip(row.criteria, fine.criteria, strict=False))
    shares = [(_relative(one, two), one.label) for one, two in pairs]
    found = [item for item in shares if math.isfinite(item[0])]
    largest, label = max(found, key=lambda item: abs(item[0]), default=(math.nan, ""))
    return Change(fine, row.verdict, largest, label)


def _relative(one: Criterion, two: Criterion) -> float:
    """Change as a share of the value; of the bound where the value itself is next to nothing against it."""
    bounds = [abs(bound) for bound in (one.low, one.high) if math.isfinite(bound)]
    scale = max(abs(one.value), *bounds) if bounds else abs(one.value)
    return (two.value - one.value) / scale if scale > 0 else 0.0 if two.value == one.value else math.nan


def to_json(comparison: Comparison, fine: Comparison | None) -> str:
    """Machine-readable form, SI units; a value that does not exist is null."""
    data = _data(comparison)
    if fine is not None:
        data["check"] = _data(fine)
        data["check"]["changes"] = [
            {"row": item.row.number, "largest": item.largest, "of": item.label, "verdict_changes": item.flips}
            for item in changes(comparison, fine)
        ]
    return json.dumps(_finite(data), indent=2, allow_nan=False, ensure_ascii=False) + "\n"


def _data(comparison: Comparison) -> dict[str, Any]:
    runs = comparison.runs
    return {
        "title": comparison.title,
        "train": runs.train,
        "analysed_bearing": runs.seat.name,
        "complete": comparison.complete,
        "settings": asdict(comparison.settings),
        "runs": {depth: asdict(end) for depth, end in comparison.ended.items()},
        "rows": [
            {**asdict(row), "verdict": row.verdict.value, "missed_by": row.missed_by}
            | {"criteria": [{**asdict(item), "met": item.met} for item in row.criteria]}
            for row in comparison.rows
        ],
        "conclusions": [{**asdict(item), "sentence": item.sentence()} for item in comparison.conclusions],
        "observations": {depth: asdict(seen) for depth, seen in runs.observed.items()},
    }


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _lines(comparison: Comparison, fine: Comparison | None) -> Iterator[list[str]]:
    heading = ["row", "quantity", "paper", "here", "verdict", "missed by", "reason"]
    if fine is None:
        yield heading
    else:
        yield [*heading, f"here ({fine.settings.text()})", "verdict there"]
    for index, row in enumerate(comparison.rows):
        line = [str(row.number), row.quantity, row.paper, row.here, row.verdict.value]
        line += [row.missed_by, row.reason or row.obstacle]
        if fine is not None:
            line += [fine.rows[index].here, fine.rows[index].verdict.value]
        yield line


def to_csv(comparison: Comparison, fine: Comparison | None) -> str:
    """The table as CSV."""
    buffer = StringIO()
    csv.writer(buffer, lineterminator="\n").writerows(_lines(comparison, fine))
    return buffer.getvalue()
