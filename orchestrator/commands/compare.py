"""``bladeloss compare``: one scenario at several depths, beside one another or against the paper."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rich.console import Console

from bearing_fmu import depths as registry
from orchestrator.errors import NotWrittenError
from orchestrator.fmi.folder import ensure_fmus, fmu_folder
from orchestrator.fmi.watchdog import BUDGET
from orchestrator.outcome import Outcome
from orchestrator.results.files import add_figures, data_then_figures, room_for
from orchestrator.results.folder import (
    FIGURES,
    PARTIAL,
    check_folder,
    check_room,
    named,
    partial_folder,
    temporary_prefix,
)
from orchestrator.results.folder_lock import lock_folder
from orchestrator.scenario.file import load_scenario, train_of
from orchestrator.scenario.problems import record_size
from orchestrator.study.children import COMMAND
from orchestrator.study.compare import COMPARED, Means, fitting, refine, run_depths
from orchestrator.study.comparison import Comparison, settings_of
from orchestrator.study.paper.report import PaperReport, speaks_of
from orchestrator.study.report import Report

CHECK = "check"
"""Folder of the runs at finer resolutions."""
SIGN = "comparison.json"
"""File by which an earlier comparison is known."""
_OURS = ("comparison.txt", SIGN, "comparison.csv", COMPARED, *registry.names(), CHECK, FIGURES, PARTIAL)


@dataclass(frozen=True)
class CompareRequest:
    """What the command line asks for.

    Attributes
    ----------
    source : str
        Name of a bundled scenario or path of a TOML file.
    overrides : mapping
        Values in place of the scenario's, in the shape of the file.
    out : Path or None
        Folder of the results; None: ``results/<scenario>-compare``.
    fmus : Path
        Folder of the FMUs.
    depths : sequence of str
        To be compared; empty: all that solve a film.
    jobs : int or None
        Runs at the same time; None: one a core.
    doublings : int
        How often everything is repeated, each time with twice the film resolution, as far as films can have
        it, and half the macro step.
    formats : sequence of str
        File types of the figures; none for no figures.
    budget : float
        Wall time in s that a call to a unit may take; 0 for any.
    """

    source: str
    overrides: Mapping[str, Any] = field(default_factory=dict)
    out: Path | None = None
    fmus: Path = field(default_factory=fmu_folder)
    depths: Sequence[str] = ()
    jobs: int | None = None
    doublings: int = 0
    formats: Sequence[str] = ("png",)
    budget: float = BUDGET


def run(
    request: CompareRequest, console: Console, errors: Console, *, command: Sequence[str] = COMMAND
) -> int:
    """Run a scenario at several depths, write figures, tables and conclusions, say what came out.

    Parameters
    ----------
    request : CompareRequest
        What to compare.
    console, errors : rich.console.Console
        For output and for what went wrong.
    command : sequence of str
        What runs a scenario in a process of its own.

    Returns
    -------
    int
        Exit status: 0 when every run finished, whatever the verdicts; otherwise that of the
        first run that did not, see `orchestrator.outcome`.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input; nothing is written then.
    """
    scenario = load_scenario(request.source, {**request.overrides, "depth_at": None})
    refined = refine(scenario, request.doublings)
    train = train_of(scenario)
    asked = request.depths or fitting(scenario, train, console)
    depths = [depth for depth in registry.names() if depth in asked]
    folder = named(request.out) if request.out else Path("results") / f"{Path(request.source).stem}-compare"
    for place in (folder, partial_folder(folder)):
        check_folder(place, SIGN, _OURS)
    check_room(folder, sum(record_size(one, train) for one in (scenario, *refined)) * len(depths))
    ensure_fmus(request.fmus, train, depths, console)
    means = Means(request.fmus, request.jobs, request.budget, command)
    with (
        lock_folder(folder),
        tempfile.TemporaryDirectory(prefix=temporary_prefix(folder), dir=folder.parent) as made,
    ):
        runs = Path(made)
        found, records = run_depths(scenario, train, depths, runs, means, console)
        fine: list[Comparison] = []
        for one in refined:
            if all(done.complete for done in (found, *fine)):
                text = settings_of(one).text()
                console.print(f"Check with {text}", highlight=False)
                place = runs / CHECK / f"{one.film.columns}x{one.film.rows}-{1e3 * one.step:g}ms"
                fine.append(run_depths(one, train, depths, place, means, console)[0])
        report = (PaperReport if speaks_of(scenario, depths) else Report)(found, fine)
        failed = [item for one in (found, *fine) for item in one.ended.items() if not item[1].ok]
        status = failed[0][1].status if failed else 0
        target = partial_folder(folder) if failed else folder

        def draw(fresh: Path) -> None:
            add_figures(records, fresh, train, found.seat.name, request.formats)

        def write(fresh: Path) -> None:
            for name, text in (
                ("txt", report.to_text()),
                ("csv", report.to_csv()),
                ("json", report.to_json()),
            ):
                (fresh / f"comparison.{name}").write_text(text, encoding="utf-8")
            if failed:
                reasons = (f"{name} {end.text()}\n{end.advice}\n" for name, end in failed)
                (fresh / PARTIAL).write_text("".join(reasons), encoding="utf-8")
            for path in runs.glob("[!.]*"):
                path.rename(fresh / path.name)

        said = f"\n{'Partial results' if failed else 'Results'} in {target}"
        if records:
            try:
                with room_for(records, target):
                    data_then_figures(target, write, draw if request.formats else None)
            except NotWrittenError as error:
                status = Outcome.NOT_WRITTEN.status
                errors.print(f"[red]error:[/red] {error}", highlight=False, soft_wrap=True)
                said = ""
        console.print(report)
        if records and said:
            console.print(said, highlight=False, soft_wrap=True)
    for name, end in failed:
        errors.print(f"[red]error:[/red] {name} not finished: {end.text()}", highlight=False, soft_wrap=True)
    return status
