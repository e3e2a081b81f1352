"""``bladeloss stability``: damping over speed, threshold, critical speeds and their margins."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from rich.table import Table

from orchestrator.fmi.blas import one_blas_thread
from orchestrator.linear.case import HERTZ, LinearCase, linear_case, write_results
from orchestrator.linear.stability import Stability, stability
from orchestrator.linear.tables import table_of, warning
from orchestrator.results.figures.stability import stability_figure
from rotor_fmu.linear.analysis import LEAST_DECREMENT

if TYPE_CHECKING:
    from rich.console import Console

    from orchestrator.linear.case import LinearRequest

ROWS = 12
"""Speeds in the table of damping, about."""


@one_blas_thread()
def run(request: LinearRequest, console: Console, *, highest: float | None) -> int:
    """Compute, print and write; returns the exit status.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input; `EquilibriumError` when there is no operating point.
    """
    case = linear_case(request, console)
    with case.over_speed() as films:
        found = stability(case, films, case.highest(highest))
    data = [found.modes, found.chart, found.bearings]
    if found.response is not None:
        data += [found.response, found.peaks]
    tables = [damping_table(case, found)]
    if found.critical:
        tables.append(critical_table(case, found))
    figure = stability_figure(found.modes, found.chart, found.bearings, found.response, case.train)
    write_results(case, data, tables, figure, first=verdict(case, found))
    return 0


def verdict(case: LinearCase, found: Stability) -> str:
    """What the train is at its rated speed, and where that changes."""
    rotation, rated = found.modes["rotation"].values, case.train.speed / HERTZ
    here = int(np.argmin(np.abs(rotation - rated)))
    worst = found.worst[here]
    enough = "above" if worst.log_decrement > LEAST_DECREMENT else "below"
    lines = [
        warning(worst, HERTZ * rotation[here])
        or f"Stable at {rotation[here]:.4g} Hz of rotation: least damped is the mode of {worst} ({enough} "
        f"{LEAST_DECREMENT:g}, API 617)."
    ]
    for speed, above in found.thresholds:
        lines.append(
            f"Threshold of instability: {'unstable above' if above else 'stable above'} {speed:.5g} Hz of "
            f"rotation ({100.0 * speed / rated:.4g} % of rated speed)."
        )
    if not found.thresholds:
        low, high = (float(found.modes["rotation"][k]) for k in (0, -1))
        lines.append(f"No threshold between {low:.4g} and {high:.4g} Hz of rotation.")
    if found.response is not None and not found.critical:
        lines.append("No critical speed there: the unbalance response at the bearings has no peak.")
    if found.response is None:
        lines.append("Without unbalance there is no response, and no list of critical speeds.")
    if found.missing:
        lines.append(f"Left out: {found.missing}.")
    return "\n".join(lines)


def damping_table(case: LinearCase, found: Stability) -> Table:
    """The least damped mode at some speeds."""
    table = table_of(f"{case.train.name} on {case.films_over_speed}: the least damped mode")
    for name in ("speed\nHz", "mode\nHz", "damping\nratio", "log.\ndecrement"):
        table.add_column(name, justify="right")
    rotation = found.modes["rotation"].values
    rated = int(np.argmin(np.abs(rotation - case.train.speed / HERTZ)))
    for k in range(len(rotation)):
        if k != rated and k % max(1, len(rotation) // ROWS) != 0:
            continue
        worst = found.worst[k]
        ratio = f"{worst.damping_ratio:.4f}"
        table.add_row(
            f"{rotation[k]:.2f}",
            f"{worst.frequency / HERTZ:.3f}",
            ratio if worst.stable else f"[bold red]{ratio}[/bold red]",
            f"{worst.log_decrement:.3f}",
        )
    table.caption = (
        "Of modes up to twice the speed of rotation, and of those that grow; where there are none, of the "
        "lowest two."
    )
    return table


def critical_table(case: LinearCase, found: Stability) -> Table:
    """Critical speeds with amplification factor and separation margin."""
    running = case.train.speed
    table = table_of(f"{case.train.name}: critical speeds, at a running speed of {running / HERTZ:.4g} Hz")
    names = ("Hz", "largest at", "µm", "amplification\nfactor", "margin\n%", "asked for\n%", "")
    for name in names:
        table.add_column(name, justify="left" if name in ("largest at", "") else "right")
    for peak in found.critical:
        margin, asked = peak.margin(running), peak.required_margin(running)
        table.add_row(
            f"{peak.speed / HERTZ:.3f}",
            case.train.bearings[peak.probe].name,
            f"{1e6 * peak.amplitude:.4g}",
            f"{peak.amplification:.2f}",
            f"{margin:.1f}",
            f"{asked:.1f}" if asked else "none",
            "kept" if margin >= asked else "[bold red]missed[/bold red]",
        )
    table.caption = (
        "Peaks of the amplitude at the bearings. Amplification factor N_c/(N_2 - N_1) at 0.707 of the peak "
        "(API 684 SP6.8.2.1); margin as of API 684 SP6.8.2.10: none below a factor of 2.5, else at most 16 % "
        "from a critical speed below, 26 % from one above. Confirm the standard's edition that binds you."
    )
    return table
