"""What a run says at its end: outcome, cost, statistics; as data and as JSON.

`orchestrator.results.summary_table` renders it for people.
"""

from __future__ import annotations

import json
import math
import sys
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from orchestrator.master.stepping import StepCounts
from orchestrator.results.certificate import Certificate
from orchestrator.results.film_regime import FilmRegime, regimes
from orchestrator.results.least_damped import least_damped_of
from orchestrator.results.ledger import LedgerSummary, ledger_of
from orchestrator.results.missing_values import MissingValues, missing_values
from orchestrator.results.quantities import HERTZ
from orchestrator.results.result import Result, Timing
from orchestrator.results.statistics import (
    BearingStatistics,
    DefectStatistics,
    ShaftStatistics,
    analysed_bearing,
    bearing_statistics,
    contact_threshold,
    defect_statistics,
    shaft_statistics,
)
from orchestrator.results.validity import ErrorEstimate, error_estimate
from orchestrator.results.verdicts.judge import worst_bearing
from orchestrator.results.windows import Phase, events_in_words, instants, phases

if TYPE_CHECKING:
    import xarray as xr

UNITS = {
    "force": "N",
    "moment": "N m",
    "gap": "m",
    "amplitude": "m",
    "stress": "Pa",
    "position": "m",
    "time": "s",
    "memory": "B",
    "contact_share": "1",
    "pressure": "Pa",
    "wiped": "1",
    "sommerfeld": "1",
}


@dataclass(frozen=True)
class Stability:
    """The least damped mode of a train in equilibrium: frequency [Hz], damping, in words."""

    frequency: float
    damping_ratio: float
    log_decrement: float
    stable: bool
    text: str


@dataclass(frozen=True)
class RunSummary:
    """A run in numbers; SI units.

    Attributes
    ----------
    title : str
        Of the scenario.
    outcome, advice, message : str
        How the run ended, what helps, what failed.
    exit_status : int
        Of the command.
    finished : bool
        Whether the run is complete and valid.
    simulated : float
        Simulated time [s].
    steps, evaluations : int
        Macro steps, and steps of bearing units over all bearings.
    macro_step : float
        [s]; the longest step where steps are controlled.
    tolerance : float or None
        Of the relative defect of a step.
    stepping : StepCounts
        Accepted and rejected steps, iterations, largest relative defect.
    coupling : str
        Name of the coupling.
    depth : dict of str
        Modelling depth by bearing.
    fracture_time : float or None
        Instant of the first event [s].
    timing : Timing
        Wall time by part [s].
    peak_memory : int
        Largest resident memory of the process so far [B].
    defect : DefectStatistics or None
        What the law of the bearings missed at the ends of steps.
    error : ErrorEstimate or None
        Estimated error of the bearing forces, from defect and length of the steps.
    ledger : LedgerSummary or None
        Energy ledger, if it was kept.
    analysed : str or None
        The analysed bearing.
    least_damped : Stability or None
        The least damped mode of the train in its static equilibrium before the event.
    phases : tuple of Phase
        With the windows of the statistics.
    shaft : tuple of ShaftStatistics
        One a phase.
    bearings : tuple of BearingStatistics
        One a phase and bearing.
    films : tuple of FilmRegime
        Whether the films are laminar, by bearing.
    certificate : Certificate or None
        What halving the step changes, if that was asked for.
    events : tuple of str
        What happened and when, in words; where the speed changes, at what speed.
    missing : tuple of MissingValues
        What bearings did not give as a number at some instants; statistics leave it out.
    """

    title: str
    outcome: str
    advice: str
    message: str
    exit_status: int
    finished: bool
    simulated: float
    steps: int
    evaluations: int
    macro_step: float
    tolerance: float | None
    stepping: StepCounts
    coupling: str
    depth: dict[str, str]
    fracture_time: float | None
    timing: Timing
    peak_memory: int
    defect: DefectStatistics | None
    error: ErrorEstimate | None
    ledger: LedgerSummary | None
    analysed: str | None
    phases: tuple[Phase, ...]
    shaft: tuple[ShaftStatistics, ...]
    bearings: tuple[BearingStatistics, ...]
    films: tuple[FilmRegime, ...] = ()
    certificate: Certificate | None = None
    least_damped: Stability | None = None
    missing: tuple[MissingValues, ...] = ()
    events: tuple[str, ...] = ()

    def of_phase(self, phase: Phase) -> tuple[BearingStatistics, ...]:
        """Statistics of all bearings in one phase."""
        return tuple(row for row in self.bearings if row.phase == phase.name)

    def depth_text(self) -> str:
        """Depth of all bearings in a few words: ``v1``, or ``v1; v2 at LP2-front, LP2-rear``."""
        groups: dict[str, list[str]] = {}
        for bearing, depth in self.depth.items():
            groups.setdefault(depth, []).append(bearing)
        ordered = sorted(groups.items(), key=lambda item: (-len(item[1]), item[0]))
        first = [ordered[0][0]] if ordered else []
        return "; ".join(first + [f"{depth} at {', '.join(names)}" for depth, names in ordered[1:]])

    def to_json(self) -> str:
        """Machine-readable form; a value that does not exist is null."""
        data: dict[str, Any] = {"units": UNITS, **asdict(self)}
        data["timing"]["loop"] = self.timing.loop
        return json.dumps(without_infinities(data), indent=2, allow_nan=False, ensure_ascii=False) + "\n"


def without_infinities(value: Any) -> Any:
    """The same with None in place of what is not finite, which JSON cannot say."""
    if isinstance(value, dict):
        return {key: without_infinities(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [without_infinities(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def peak_memory() -> int:
    """Largest resident memory of this process so far [B]; 0 where the system does not tell."""
    try:
        import resource
    except ImportError:
        return 0
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return int(peak if sys.platform == "darwin" else peak * 1024)


def summarise(result: Result, *, analysed: str | None = None) -> RunSummary:
    """Summary of a run.

    Parameters
    ----------
    result : Result
        Also of a run that failed on its way.
    analysed : str, optional
        Name of the analysed bearing; by default chosen by `statistics.analysed_bearing`.

    Returns
    -------
    RunSummary
        Without statistics when the record holds fewer than two samples.
    """
    record = result.record
    samples = record.sizes.get("time", 0)
    found = phases(record) if samples > 1 else ()
    names = [str(name) for name in record["bearing"].values] if "bearing" in record.coords else []
    depths = record["depth"].values if "depth" in record.coords else [""] * len(names)
    bearings = []
    if found:
        for name in names:
            threshold = contact_threshold(record, name, found)
            bearings += [bearing_statistics(record, name, phase, contact_from=threshold) for phase in found]
    return RunSummary(
        title=str(record.attrs.get("title", "")),
        outcome=str(result.outcome.value),
        advice=result.outcome.advice,
        message=result.message,
        exit_status=result.outcome.status,
        finished=result.outcome.ok,
        simulated=float(record["time"].values[-1]) if samples else 0.0,
        steps=result.steps,
        evaluations=result.evaluations,
        macro_step=float(record.attrs.get("macro_step", math.nan)),
        tolerance=record.attrs.get("tolerance"),
        stepping=result.counts,
        coupling=str(record.attrs.get("coupling", "")),
        depth={name: str(depth) for name, depth in zip(names, depths, strict=True)},
        fracture_time=next(iter(instants(record)), None) if samples else None,
        timing=result.timing,
        peak_memory=peak_memory(),
        defect=defect_statistics(record),
        error=error_estimate(record),
        ledger=ledger_of(record),
        analysed=analysed_bearing(record, analysed or worst_bearing([record])) if found else None,
        phases=found,
        shaft=tuple(shaft_statistics(record, phase) for phase in found),
        bearings=tuple(bearings),
        films=regimes(record),
        least_damped=_stability(record),
        missing=missing_values(record) if samples else (),
        events=events_in_words(record) if samples else (),
    )


def _stability(record: xr.Dataset) -> Stability | None:
    mode = least_damped_of(record)
    if mode is None:
        return None
    hertz = mode.frequency / HERTZ
    return Stability(hertz, mode.damping_ratio, mode.log_decrement, mode.stable, str(mode))
