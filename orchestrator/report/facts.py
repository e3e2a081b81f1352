"""What a report says of each run in words: how far to trust it, its verdicts, its bearings."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from orchestrator.outcome import Outcome
from orchestrator.report.source import Result
from orchestrator.results.journals import probes_of
from orchestrator.results.least_damped import least_damped_of
from orchestrator.results.ledger import ledger_of
from orchestrator.results.quantities import FORCE, GAP, VIBRATION, shown, small
from orchestrator.results.signals.orders import order_amplitudes, probe_signals, turned_angle
from orchestrator.results.statistics import bearing_statistics, contact_threshold, defect_statistics
from orchestrator.results.verdicts.conclusion import Conclusion, conclude
from orchestrator.results.verdicts.verdict import Grade, Verdict
from orchestrator.results.windows import Phase, events_in_words
from rotor_fmu.linear.analysis import DEFAULT_SIZE

_CHANGING = 4.0
"""Revolutions over which amplitudes are taken where the speed changes."""
DEFECT_FINE, DEFECT_COARSE = 0.02, 0.1
"""Share of the largest force up to which a defect is small, and from which it is large."""


class Level(StrEnum):
    """How a fact counts for the trust in a run."""

    GOOD = "good"
    MIND = "mind"
    BAD = "bad"
    PLAIN = "plain"


@dataclass(frozen=True)
class Fact:
    """A line of the table of trust."""

    label: str
    text: str
    level: Level = Level.PLAIN


def finished(result: Result) -> bool:
    """Whether the run reached its end and can be believed."""
    return str(result.record.attrs.get("status", "finished")) == Outcome.FINISHED.value


def conclusion(result: Result) -> Conclusion:
    """What follows from a run, and from which figures."""
    attributes = result.record.attrs
    obstacle = "" if finished(result) else str(attributes.get("message", "")) or str(attributes["status"])
    return conclude(result.verdicts, obstacle)


def trust(result: Result) -> Iterator[Fact]:
    """How far to trust a run."""
    attributes = result.record.attrs
    status, message = str(attributes.get("status", "finished")), str(attributes.get("message", ""))
    good = finished(result)
    yield Fact("run", _course(result))
    yield Fact("outcome", status + (f": {message}" if message else ""), Level.GOOD if good else Level.BAD)
    yield from _defect(result)
    yield from _certificate(result)
    ledger = ledger_of(result.record)
    if ledger is not None:
        share = abs(ledger.relative_gap)
        level = Level.GOOD if share < 0.01 else Level.MIND
        text = f"the coupling made or lost {100 * share:.2g} % of the work exchanged"
        yield Fact("energy", text, level)
    turbulent = [v for v in result.verdicts if v.limit.startswith("laminar") and v.share > 1.0]
    films = [v for v in result.verdicts if v.limit.startswith("laminar")]
    if turbulent:
        most = max(turbulent, key=lambda v: v.share)
        text = (
            f"{len(turbulent)} of {len(films)} films are beyond laminar theory where the gap is wide; most "
            f"{most.bearing}, Re {most.value:.0f} against {most.bound:.0f}"
        )
        yield Fact("film regime", text, Level.MIND)
    elif films:
        most = max(films, key=lambda v: v.share)
        yield Fact(
            "film regime", f"laminar; largest Re {most.value:.0f} against {most.bound:.0f}", Level.GOOD
        )
    mode = least_damped_of(result.record)
    if mode is not None:
        yield Fact("stability", str(mode), Level.GOOD if mode.stable else Level.BAD)
    notes = [f"{phase.name}: {phase.note}" for phase in result.phases if phase.note]
    if notes:
        yield Fact("windows", "; ".join(notes), Level.MIND)
    yield Fact("model", _model(result))


def _course(result: Result) -> str:
    """What happens in a run, and when."""
    start, end = result.time[0], result.time[-1]
    happened = events_in_words(result.record) or ("nothing happens",)
    return "; ".join([f"{start:.4g} to {end:.4g} s", *happened])


def _defect(result: Result) -> Iterator[Fact]:
    defect = defect_statistics(result.record)
    if defect is None:
        return
    largest = float(np.nanmax(result.record["force_magnitude_max"].values))
    share = defect.largest / largest if largest > 0.0 else 0.0
    level = Level.GOOD if share <= DEFECT_FINE else Level.MIND if share <= DEFECT_COARSE else Level.BAD
    text = (
        f"median {shown(defect.median, FORCE)}, largest {shown(defect.largest, FORCE)}, {100 * share:.2g} % "
        f"of the largest force, at {defect.bearing}, {defect.time:.4f} s"
    )
    yield Fact("coupling defect", text, level)


def _certificate(result: Result) -> Iterator[Fact]:
    attributes = result.record.attrs
    if "half_step" not in attributes:
        yield Fact(
            "certificate", "none: bladeloss run --certify repeats the run at half the step", Level.MIND
        )
        return
    changes = {
        key.removeprefix("half_step_").replace("_", " "): float(value)
        for key, value in attributes.items()
        if key.startswith("half_step_") and key != "half_step_outcome"
    }
    parts = ", ".join(f"{name} {100 * change:.2g} %" for name, change in changes.items())
    largest = max(map(abs, changes.values()), default=math.inf)
    level = Level.GOOD if largest < 0.02 else Level.MIND if largest < 0.1 else Level.BAD
    yield Fact("certificate", f"at half the step the largest changes are: {parts}", level)


def _model(result: Result) -> str:
    attributes = result.record.attrs
    try:
        film = tomllib.loads(str(attributes.get("scenario", ""))).get("film", {})
    except tomllib.TOMLDecodeError:
        film = {}
    parts = [
        f"coupling {attributes.get('coupling', '?')}",
        f"macro step {float(attributes['macro_step']) * 1e3:.3g} ms",
    ]
    if "columns" in film:
        parts.append(f"film {film['columns']} × {film['rows']}")
    if "reduction" in attributes:
        size = 4 * int(result.record.sizes.get("node", DEFAULT_SIZE))
        reduced = attributes["reduction"] != "none" and size > DEFAULT_SIZE
        parts.append(
            f"shaft reduced by {attributes['reduction']}"
            if reduced
            else f"shaft of {size} degrees of freedom, not reduced"
        )
    speeds = [result.speed] if result.changing_speed is None else result.changing_speed[[0, -1]]
    parts.append(" to ".join(f"{abs(speed) / (2 * math.pi) * 60:.0f}" for speed in speeds) + " rev/min")
    return ", ".join(parts)


VERDICT_HEADS = ("limit", "where", "phase", "value", "allowed", "used", "instant", "", "source")


def verdict_cells(v: Verdict) -> tuple[str, ...]:
    """A verdict in words, in the order of `VERDICT_HEADS`."""
    when = "" if v.instant is None or not math.isfinite(v.instant) else f"{v.instant:.4f} s"
    figures = v.value_text(), v.bound_text(), v.share_text()
    return (v.limit, v.place, v.phase, *figures, when, v.note, v.source_text())


@dataclass(frozen=True)
class BearingLine:
    """A bearing at a glance: cells of a table, and its worst grade."""

    bearing: str
    cells: tuple[str, ...]
    grade: Grade


BEARING_HEADS = (
    "bearing", "depth", "mean force before", "largest after", "least gap before", "after",
    "time in contact", "vibration p\u2011p", "½X", "1X before", "1X after", "2X",
)  # fmt: skip
"""½X and 2X are those of the last phase; all at the first probe, zero to peak."""


def bearing_lines(result: Result) -> Iterator[BearingLine]:
    """Every bearing of a run, from front to rear."""
    first, last = result.phases[0], result.phases[-1]
    for bearing in result.bearings:
        threshold = contact_threshold(result.record, bearing, result.phases)
        start, end = (
            bearing_statistics(result.record, bearing, phase, contact_from=threshold)
            for phase in (first, last)
        )
        own = [v for v in result.verdicts if v.bearing == bearing and not v.limit.startswith("laminar")]
        swing = max((v.value for v in own if v.quantity is VIBRATION), default=math.nan)
        once_before, orders = _orders(result, bearing, first), _orders(result, bearing, last)
        cells = (
            bearing,
            str(result.record["depth"].sel(bearing=bearing).values).upper(),
            shown(start.force_mean, FORCE),
            shown(end.force_max, FORCE),
            GAP.text(start.least_gap_min),
            GAP.text(end.least_gap_min),
            "-" if end.contact_first is None else f"{100.0 * end.contact_share:.0f} %",
            VIBRATION.text(swing) if not swing < 1e-5 else small(swing),
            *(small(a) for a in (orders[0], once_before[1], orders[1], orders[2])),
        )
        grade = max((v.grade for v in own), key=lambda g: g.rank, default=Grade.WITHIN)
        yield BearingLine(bearing, cells, grade)


def _orders(result: Result, bearing: str, phase: Phase) -> tuple[float, ...]:
    """Amplitudes of ½X, 1X and 2X in the means' window of a phase [m]."""
    inside, speed = phase.mean.mask(result.time), result.changing_speed
    if speed is not None:  # along which amplitudes change: of the last revolutions
        turns = turned_angle(result.time, speed) / (2.0 * math.pi)
        inside &= turns >= np.interp(phase.mean.end, result.time, turns) - _CHANGING
    if np.count_nonzero(inside) < 8:
        return (math.nan,) * 3
    signal = probe_signals(result.journal(bearing)[:, inside], probes_of(result.record)[:1])[0]
    at = result.speed if speed is None else speed[inside]
    found = order_amplitudes(result.time[inside], signal, at, (0.5, 1.0, 2.0))
    return tuple(float(a) for a in np.abs(found))
