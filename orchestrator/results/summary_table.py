"""The summary of a run for people: rich tables on a terminal, the same as plain text in a file."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from io import StringIO

from rich import box
from rich.console import Console, ConsoleOptions, RenderResult
from rich.table import Table
from rich.text import Text

from orchestrator.outcome import Outcome
from orchestrator.results.certificate import CERTIFIED, Certificate
from orchestrator.results.film_regime import regime_text
from orchestrator.results.ledger import LedgerSummary
from orchestrator.results.missing_values import missing_text
from orchestrator.results.quantities import (
    AMPLITUDE,
    CONTACT_PRESSURE,
    FORCE,
    GAP,
    MOMENT,
    STRESS,
    Quantity,
)
from orchestrator.results.statistics import CONTACT_SHARE, BearingStatistics
from orchestrator.results.summary import RunSummary
from orchestrator.results.validity import ALLOWED, PROMISED, ErrorEstimate
from orchestrator.results.windows import Phase

TEXT_WIDTH = 110
WIDE = 98
"""Columns of a terminal from which the tables are complete."""


def _window_text(phase: Phase) -> str:
    text = f"means {phase.mean.start:.3f} to {phase.mean.end:.3f} s"
    if phase.peak != phase.mean:
        text += f", maxima {phase.peak.start:.3f} to {phase.peak.end:.3f} s"
    return f"{text}; {phase.note}" if phase.note else text


def _contact_text(summary: RunSummary) -> str:
    """Where and when surfaces touch, in one sentence."""
    touching = [row for row in summary.bearings if row.contact_first is not None]
    if not summary.bearings:
        return "unknown"
    if not touching:
        return "no solid contact at any bearing"
    first: dict[str, float] = {}
    for row in touching:
        assert row.contact_first is not None
        first[row.bearing] = min(first.get(row.bearing, row.contact_first), row.contact_first)
    ordered = sorted(first.items(), key=lambda item: item[1])
    text = "solid contact at " + ", ".join(f"{name} from {time:.3f} s" for name, time in ordered)
    worst = max(touching, key=lambda row: row.contact_pressure_max)
    if worst.contact_pressure_max > 0.0:
        text += f"; up to {CONTACT_PRESSURE.text(worst.contact_pressure_max)} at {worst.bearing}, "
        text += f"overlap {GAP.text(max(-worst.least_gap_min, 0.0))}"
    wiped = max(touching, key=lambda row: row.wiped_max)
    if wiped.wiped_max > 0.0:
        text += f"; wiped: {100 * wiped.wiped_max:.2g} % of the bore of {wiped.bearing} yields"
    return text


def _shaft_text(summary: RunSummary) -> Iterable[tuple[str, str]]:
    amplitude = AMPLITUDE.fitting(max((row.amplitude_max for row in summary.shaft), default=0.0))
    for row in summary.shaft:
        yield (
            f"shaft {row.phase}",
            f"largest amplitude {amplitude.text(row.amplitude_max)} at z = {row.amplitude_position:.1f} m, "
            f"largest stress {STRESS.text(row.stress_max)} at z = {row.stress_position:.1f} m",
        )


def _force_text(value: float) -> str:
    return FORCE.fitting(value).fitting(value).text(value)


def _steps_text(summary: RunSummary) -> str:
    """Simulated time and steps, and what the step control did if it did anything."""
    counts, evenly = summary.stepping, summary.tolerance is None and not summary.stepping.taken_back
    text = f"{summary.simulated:.4g} s in {summary.steps} steps of "
    if evenly:
        text += f"{summary.macro_step * 1e3:.3g} ms"
    else:
        shortest = counts.shortest if counts.accepted else summary.macro_step
        text += f"{shortest * 1e3:.3g} to {summary.macro_step * 1e3:.3g} ms, {counts.rejected} rejected"
        text += f", {counts.discarded} discarded by a unit" if counts.discarded else ""
    if counts.iterations > counts.accepted:
        text += f", {counts.iterations / counts.accepted:.2f} iterations a step"
    if counts.jumps:
        text += f", {counts.jumps} of them over a jump of a force, which no shorter step meets"
    return text


def _error_text(error: ErrorEstimate) -> str:
    """The estimate in one sentence, with what is allowed and what that promises."""
    return (
        f"estimated {100 * error.largest:.2g} % of the largest force at {error.bearing}, "
        f"{error.time:.4f} s; {100 * error.rms:.2g} % RMS; up to {100 * ALLOWED:g} % no force is off by "
        f"more than {100 * PROMISED:g} %"
    )


def _ledger_text(ledger: LedgerSummary) -> str:
    """The balance in one sentence, and the bearing where the coupling misses most."""
    film, contact = (sum(getattr(row, name) for row in ledger.bearings) for name in ("film", "contact"))
    worst = max(ledger.bearings, key=lambda row: abs(row.residue))
    return (
        f"stored {ledger.stored:.4g} J = films {film:.4g} (contact {contact:.4g}) + unbalance "
        f"{ledger.unbalance:.4g} - damping {ledger.damping:.4g} + coupling {ledger.gap:.2g} J: "
        f"{100 * ledger.relative_gap:.2g} % of the work exchanged; "
        f"most at {worst.bearing}, {worst.residue:.2g} J{_rotation_text(ledger)}"
    )


def _rotation_text(ledger: LedgerSummary) -> str:
    """The balance of the rotation; nothing where its speed is one."""
    of = ledger.rotation
    if of is None:
        return ""
    return (
        f"; rotation {of.stored:.4g} J = drive {of.drive:.4g} - friction {of.friction:.4g} - windage "
        f"{of.windage:.4g} - unbalance {ledger.unbalance:.4g} + {of.gap:.2g} J not accounted for"
    )


def _certificate_text(certificate: Certificate) -> str:
    """The largest changes at half the step, of the quantities that count."""
    text = f"at half the step, {certificate.step * 1e3:.3g} ms: "
    if certificate.outcome != Outcome.FINISHED.value:
        return f"{text}not finished, {certificate.outcome}"
    parts = []
    for quantity in CERTIFIED:
        found = certificate.largest(quantity)
        if found is not None and found.relative is not None:
            where = " ".join(part for part in (found.bearing, found.phase) if part)
            parts.append(f"{quantity.replace('_', ' ')} {100 * found.relative:.2g} % ({where})")
    return text + "largest changes " + ", ".join(parts)


def _stability_row(summary: RunSummary) -> list[tuple[str, str | Text]]:
    """The least damped mode, red where it grows."""
    mode = summary.least_damped
    if mode is None:
        return []
    word = "stable, least damped" if mode.stable else "UNSTABLE, grows"
    return [("before event", Text(f"{word}: {mode.text}", style="" if mode.stable else "bold red"))]


def _facts(summary: RunSummary) -> Table:
    timing = summary.timing
    rate = f", {summary.simulated / timing.loop:.3g} s a second" if timing.loop > 0 else ""
    facts = Table.grid(padding=(0, 2))
    facts.add_column(style="dim", no_wrap=True)
    facts.add_column()
    outcome = summary.outcome + ("" if summary.finished else f" (exit status {summary.exit_status})")
    rows: list[tuple[str, str | Text]] = [
        ("outcome", Text(outcome, style="green" if summary.finished else "bold red")),
        *_stability_row(summary),
        ("simulated", _steps_text(summary)),
        *([("events", "; ".join(summary.events))] if summary.events else []),
        ("depth", summary.depth_text()),
        ("coupling", summary.coupling),
        (
            "wall time",
            f"time loop {timing.loop:.1f} s{rate}: film {timing.film:.1f}, rotor {timing.rotor:.1f}, "
            f"FMI {timing.fmi:.1f}, record {timing.record:.1f}, master {timing.master:.1f}; "
            f"before it: loading {timing.load:.1f}, equilibrium {timing.equilibrium:.1f}",
        ),
    ]
    if summary.defect is not None:
        largest = max((row.force_max for row in summary.bearings), default=0.0)
        share = (
            f" ({100 * summary.defect.largest / largest:.2g} % of the largest force)" if largest > 0 else ""
        )
        rows.append(
            (
                "defect",
                f"median {_force_text(summary.defect.median)}, largest {_force_text(summary.defect.largest)}"
                f"{share} at {summary.defect.bearing}, {summary.defect.time:.4f} s",
            )
        )
    if summary.error is not None:
        rows.append(("error", _error_text(summary.error)))
    if summary.ledger is not None:
        rows.append(("energy", _ledger_text(summary.ledger)))
    if summary.certificate is not None:
        rows.append(("certificate", _certificate_text(summary.certificate)))
    if summary.peak_memory:
        rows.append(("peak memory", f"{summary.peak_memory / 1e9:.2f} GB"))
    rows += _shaft_text(summary)
    rows.append(("contact", _contact_text(summary)))
    if summary.films:
        rows.append(("films", regime_text(summary.films)))
    if summary.missing:
        rows.append(("missing", Text(missing_text(summary.missing), style="bold red")))
    for name, text in rows:
        facts.add_row(name, text)
    return facts


@dataclass(frozen=True)
class _Column:
    """One column of the bearings' table; the narrow table keeps only the columns that are `kept`."""

    heading: str
    cell: Callable[[BearingStatistics], str]
    kept: bool = True


def _readable(quantity: Quantity, largest: float) -> Quantity:
    """In the unit that suits the largest value of a table, and with three digits of it."""
    found = quantity.fitting(largest)
    return replace(found, digits=".3f") if abs(largest) * found.factor < 1.0 else found


def _columns(summary: RunSummary) -> list[_Column]:
    force = _readable(FORCE, max(row.force_max for row in summary.bearings))
    largest = max(row.moment_max for row in summary.bearings)
    moment = _readable(MOMENT, largest) if largest else MOMENT.fitting(1.0 / force.factor)

    def contact(shown: Callable[[BearingStatistics], str]) -> Callable[[BearingStatistics], str]:
        return lambda row: "-" if row.contact_first is None else shown(row)

    return [
        _Column(f"force\nmean\n{force.unit}", lambda row: force.number(row.force_mean)),
        _Column(f"\nmax\n{force.unit}", lambda row: force.number(row.force_max)),
        _Column(f"moment\nmean\n{moment.unit}", lambda row: moment.number(row.moment_mean)),
        _Column(f"\nmax\n{moment.unit}", lambda row: moment.number(row.moment_max)),
        _Column("So\nmean\n", lambda row: f"{row.sommerfeld_mean:.2f}", kept=False),
        _Column(f"gap\nmean\n{GAP.unit}", lambda row: GAP.number(row.least_gap_mean)),
        _Column(f"\nharm.\n{GAP.unit}", lambda row: GAP.number(row.least_gap_harmonic)),
        _Column(f"\nleast\n{GAP.unit}", lambda row: GAP.number(row.least_gap_min)),
        _Column(f"centre\nleast\n{GAP.unit}", lambda row: GAP.number(row.centre_line_gap_min), kept=False),
        _Column("contact\nfirst\ns", contact(lambda row: f"{row.contact_first:.3f}")),
        _Column("\nshare\n%", contact(lambda row: f"{100 * row.contact_share:.1f}")),
        _Column(f"\nmax\n{force.unit}", contact(lambda row: force.number(row.contact_max)), kept=False),
    ]


def _phase_table(summary: RunSummary, phase: Phase, *, wide: bool) -> Table:
    table = Table(
        title=f"{phase.name}  ({_window_text(phase)})",
        title_justify="left",
        title_style="bold",
        header_style="",
        box=box.SIMPLE_HEAD,
        pad_edge=False,
        collapse_padding=True,
    )
    mixed = len(set(summary.depth.values())) > 1
    table.add_column("bearing", no_wrap=True, vertical="bottom")
    columns = [column for column in _columns(summary) if wide or column.kept]
    for column in columns:
        table.add_column(column.heading, justify="right", no_wrap=True)
    for row in summary.of_phase(phase):
        styles = ["bold"] * (row.bearing == summary.analysed) + ["red"] * (row.contact_first is not None)
        name = f"{row.bearing} {summary.depth[row.bearing]}" if mixed else row.bearing
        table.add_row(name, *(column.cell(row) for column in columns), style=" ".join(styles) or None)
    return table


@dataclass(frozen=True)
class SummaryTable:
    """Everything that a run says at its end, to be printed on a rich console."""

    summary: RunSummary

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Heading, facts, and a table a phase; a narrow console gets fewer columns."""
        summary = self.summary
        yield Text(summary.title or "run", style="bold")
        yield _facts(summary)
        if not summary.finished:
            yield Text(f"\n{summary.message}\n{summary.advice}", style="red")
        for phase in summary.phases:
            yield Text("")
            yield _phase_table(summary, phase, wide=options.max_width >= WIDE)
        if summary.analysed is not None:
            yield Text(
                f"Analysed bearing: {summary.analysed}. Harmonic part: half peak-to-peak. Contact counts "
                f"from {100 * CONTACT_SHARE:g} % of the force before the event; its share of time covers "
                "the whole phase.",
                style="dim",
            )


def to_text(summary: RunSummary) -> str:
    """The same without colours, for ``summary.txt``."""
    buffer = StringIO()
    Console(file=buffer, width=TEXT_WIDTH, color_system=None, force_terminal=False).print(
        SummaryTable(summary)
    )
    return "\n".join(line.rstrip() for line in buffer.getvalue().splitlines()) + "\n"
