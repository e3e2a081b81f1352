"""What a report is made of: results of runs, read back from their folders."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from bearing_fmu import depths
from orchestrator.errors import OrchestratorError
from orchestrator.results.figures import style
from orchestrator.results.growing_record import is_growing
from orchestrator.results.record_files import RECORD_FILE, read_record
from orchestrator.results.relative_motion import journal_motion
from orchestrator.results.statistics import analysed_bearing, contact_threshold
from orchestrator.results.verdicts.judge import judge, own_limits
from orchestrator.results.verdicts.limits import Limits
from orchestrator.results.verdicts.verdict import Grade, Verdict, worst
from orchestrator.results.windows import Phase, changing_speed, phases

SUMMARY_FILE = "summary.json"
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")
_DASHES = ("solid", "dash", "dashdot", "dot", "longdashdot", "longdash")
"""Of the depths in their order, as in the figures of matplotlib."""


class ReportError(OrchestratorError):
    """Results that no report can be made of."""


@dataclass(frozen=True, eq=False)
class Result:
    """One run in a report.

    Attributes
    ----------
    name : str
        What tells it from the others.
    record : xarray.Dataset
        Its record.
    summary : dict
        Of ``summary.json``; empty where there is none.
    verdicts : tuple of Verdict
        Held against its limits.
    colour, dash : str
        Of its lines.
    """

    name: str
    record: xr.Dataset
    summary: dict[str, Any] = field(default_factory=dict)
    verdicts: tuple[Verdict, ...] = ()
    colour: str = _COLOURS[0]
    dash: str = _DASHES[0]
    _kept: dict[str, NDArray[np.float64]] = field(default_factory=dict, repr=False)
    _thresholds: dict[str, float] = field(default_factory=dict, repr=False)
    _journals: dict[str, NDArray[np.float64]] = field(default_factory=dict, repr=False)

    @property
    def time(self) -> NDArray[np.float64]:
        """Instants of the record in s."""
        return np.asarray(self.record["time"].values, dtype=float)

    @property
    def speed(self) -> float:
        """Speed of rotation in rad/s."""
        return float(self.record.attrs["speed"])

    @property
    def turn(self) -> float:
        """Length of a revolution in s."""
        return 2.0 * math.pi / abs(self.speed)

    @cached_property
    def changing_speed(self) -> NDArray[np.float64] | None:
        """Speed at each instant in rad/s, None where it stays."""
        return changing_speed(self.record)

    @cached_property
    def bearings(self) -> tuple[str, ...]:
        """Names of the bearings from front to rear."""
        return tuple(str(name) for name in self.record["bearing"].values)

    @cached_property
    def phases(self) -> tuple[Phase, ...]:
        """Phases of the run."""
        return phases(self.record)

    def of(self, name: str, bearing: str) -> NDArray[np.float64]:
        """A quantity of a bearing; time is its last axis, x and y the one before."""
        if name not in self._kept:
            values = self.record[name]
            order = [d for d in ("bearing", "axis", "time") if d in values.dims]
            self._kept[name] = np.asarray(values.transpose(*order).values, dtype=float)
        return self._kept[name][self.bearings.index(bearing)]

    def journal(self, bearing: str) -> NDArray[np.float64]:
        """Journal from the centre of its bearing, shape (2, time), in m."""
        if bearing not in self._journals:
            self._journals[bearing] = journal_motion(self.record, bearing)
        return self._journals[bearing]

    def touching(self, bearing: str) -> NDArray[np.bool_]:
        """When surfaces touch."""
        if bearing not in self._thresholds:
            self._thresholds[bearing] = contact_threshold(self.record, bearing, self.phases)
        return self.of("contact_force", bearing) > self._thresholds[bearing]


def load_results(paths: Sequence[Path], limits: Limits | None = None) -> tuple[Result, ...]:
    """Read the results of runs.

    Parameters
    ----------
    paths : sequence of Path
        Folders of results, or files ``record.nc``.
    limits : Limits, optional
        In place of those in the records.

    Raises
    ------
    ReportError
        A path without a record, or a record that holds no motion; names what is allowed.
    """
    pairs = [(path, _read(path)) for path in paths]
    return results_of([record for _, record in pairs], [_summary(path) for path, _ in pairs], paths, limits)


def results_of(
    records: Sequence[xr.Dataset],
    summaries: Sequence[dict[str, Any]] = (),
    paths: Sequence[Path] = (),
    limits: Limits | None = None,
) -> tuple[Result, ...]:
    """Results from records that are at hand; otherwise as `load_results`."""
    names, looks = _names(records, paths), _looks(records)
    found = []
    for k, (name, record) in enumerate(zip(names, records, strict=True)):
        _require_motion(record, name)
        summary = summaries[k] if k < len(summaries) else {}
        verdicts = judge(record, limits or own_limits(record))
        found.append(Result(name, record, summary, verdicts, *looks[k]))
    return tuple(found)


def _looks(records: Sequence[xr.Dataset]) -> list[tuple[str, str]]:
    """Colour and dash of each: those of their depths, as in every figure, or by number where depths recur."""
    if len(records) == 1:
        return [(style.colour_of(style.depth_at(records[0])), _DASHES[0])]
    own, known = [style.depth_at(record) for record in records], list(depths.names())
    if len(set(own)) < len(own) or not set(own) <= set(known):
        return [(_COLOURS[k % len(_COLOURS)], _DASHES[k % len(_DASHES)]) for k in range(len(own))]
    return [(style.colour_of(depth), _DASHES[known.index(depth) % len(_DASHES)]) for depth in own]


def shown_bearing(results: Sequence[Result], named: str | None = None) -> str:
    """The bearing that a report opens with: the named one, or the one with the worst verdict.

    Raises
    ------
    ReportError
        When no result has a bearing of this name.
    """
    known = list(dict.fromkeys(name for result in results for name in result.bearings))
    if named is not None:
        if named not in known:
            raise ReportError(f"--bearing {named}: no such bearing; allowed are {', '.join(known)}")
        return named
    verdicts = worst(verdict for result in results for verdict in result.verdicts if verdict.bearing)
    if verdicts and verdicts[0].grade is Grade.BEYOND:
        return verdicts[0].bearing
    return analysed_bearing(results[0].record)


def _read(path: Path) -> xr.Dataset:
    file = path / RECORD_FILE if path.is_dir() and not is_growing(path) else path
    if not file.is_file() and not is_growing(file):
        raise ReportError(f"{path}: no record; allowed is the folder of a run, or its {RECORD_FILE}")
    try:
        return read_record(file)
    except (OSError, ValueError, KeyError) as error:
        raise ReportError(f"{file}: no record: {error}") from None


def _summary(path: Path) -> dict[str, Any]:
    file = (path if path.is_dir() else path.parent) / SUMMARY_FILE
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}


def _require_motion(record: xr.Dataset, name: str) -> None:
    needed = ("force", "displacement", "offset", "least_gap", "contact_force", "bearing_clearance")
    missing = [key for key in needed if key not in record]
    if missing:
        raise ReportError(
            f"{name}: the record holds no {', '.join(missing)}; allowed is one of a run of this version"
        )
    if record.sizes["time"] < 2:
        raise ReportError(f"{name}: the record holds {record.sizes['time']} instants; allowed are 2 or more")


def _names(records: Sequence[xr.Dataset], paths: Sequence[Path]) -> list[str]:
    """The depth of each run where that tells them apart; else the names of their folders; else numbers."""
    depths = [style.run_name(record).partition(":")[0] for record in records]
    if len(set(depths)) == len(records):
        return depths
    folders = [path.absolute().name if path.is_dir() else path.absolute().parent.name for path in paths]
    if len(set(folders)) == len(records):
        return folders
    return [f"{k} {name}" for k, name in enumerate(folders or depths, 1)]
