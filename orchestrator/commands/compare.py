"""``bladeloss compare``: one scenario at every depth, against the paper's figures and table."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.console import Console

from orchestrator import exit_status
from orchestrator.errors import NotWrittenError
from orchestrator.fmi.folder import ensure_fmus
from orchestrator.fmi.watchdog import BUDGET
from orchestrator.outcome import Outcome
from orchestrator.results.certificate import at_half_step
from orchestrator.results.files import add_figures, data_then_figures, room_for
from orchestrator.results.folder import (
    FIGURES,
    PARTIAL,
    check_folder,
    check_room,
    partial_folder,
    temporary_prefix,
)
from orchestrator.results.folder_lock import claim
from orchestrator.results.record_files import RECORD_FILE, read_record
from orchestrator.results.statistics import analysed_bearing
from orchestrator.scenario.file import load_scenario, train_of, with_overrides
from orchestrator.scenario.problems import record_size
from orchestrator.scenario.scenario import DEPTHS
from orchestrator.study.paper.processes import DIED, cores, run_all
from orchestrator.study.paper.progress import show_runs
from orchestrator.study.paper.report import Comparison, Settings, compare, to_csv, to_json
from orchestrator.study.paper.runs import gather
from orchestrator.study.paper.table import ComparisonTable, to_text
from orchestrator.study.paper.worker import Ended, Task, Work, simulate_task

if TYPE_CHECKING:
    import xarray as xr

    from orchestrator.scenario.scenario import Scenario
    from rotor_fmu.train.train import Train

CHECK = "check"
"""Folder of the runs at the finer resolution."""
SIGN = "comparison.json"
"""File by which an earlier comparison is known."""
_OURS = ("comparison.txt", SIGN, "comparison.csv", *DEPTHS, CHECK, FIGURES, PARTIAL)


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
    jobs : int or None
        Runs at the same time; None: one a core.
    check : bool
        Repeat with twice the film resolution and half the macro step.
    formats : sequence of str
        File types of the figures; none for no figures.
    budget : float
        Wall time in s that a call to a unit may take; 0 for any.
    """

    source: str
    overrides: Mapping[str, Any] = field(default_factory=dict)
    out: Path | None = None
    fmus: Path = Path("fmus")
    jobs: int | None = None
    check: bool = False
    formats: Sequence[str] = ("png",)
    budget: float = BUDGET


@dataclass(frozen=True)
class _Compared:
    """A comparison and the records it was made from, the finished and the partial ones."""

    comparison: Comparison
    records: Sequence[xr.Dataset]


def run(request: CompareRequest, console: Console, errors: Console, *, work: Work = simulate_task) -> int:
    """Run a scenario at every depth, write figures, table and conclusions, say what came out.

    Parameters
    ----------
    request : CompareRequest
        What to compare.
    console, errors : rich.console.Console
        For output and for what went wrong.
    work : callable
        What the process of a run does, see `orchestrator.study.paper.worker`.

    Returns
    -------
    int
        Exit status: 0 when every run finished, whatever the verdicts; otherwise that of the
        first run that did not, see `orchestrator.exit_status`.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input; nothing is written then.
    """
    scenario = load_scenario(request.source, {**request.overrides, "depth_at": None})
    refined = refine(scenario) if request.check else None
    train = train_of(scenario)
    folder = request.out or Path("results") / f"{Path(request.source).stem}-compare"
    check_folder(folder, SIGN)
    check_room(folder, sum(record_size(one, train) for one in (scenario, refined) if one) * len(DEPTHS))
    ensure_fmus(request.fmus, train, set(DEPTHS), console)
    prefix, place = temporary_prefix(folder), folder.parent
    with claim(folder), tempfile.TemporaryDirectory(prefix=prefix, dir=place) as temporary:
        runs = Path(temporary)
        found = _compare(scenario, train, request, runs, console, work)
        fine = None
        if refined is not None and found.comparison.complete:
            console.print(f"Check with {_settings(refined).text()}", highlight=False)
            fine = _compare(refined, train, request, runs / CHECK, console, work)
        pair = found.comparison, fine.comparison if fine else None
        console.print(ComparisonTable(*pair))
        failed = [(name, end) for one in pair if one for name, end in one.ended.items() if not end.ok]
        status = status_of(failed[0][1]) if failed else 0
        target = partial_folder(folder) if failed else folder
        if found.records:
            try:
                with room_for(found.records, target):
                    _write_all(pair, found.records, runs, target, train, request.formats)
            except NotWrittenError as error:
                status = exit_status.of_outcome(Outcome.NOT_WRITTEN)
                errors.print(f"[red]error:[/red] {error}", highlight=False, soft_wrap=True)
            else:
                kind = "Partial results" if failed else "Results"
                console.print(f"\n{kind} in {target}", highlight=False, soft_wrap=True)
    for name, end in failed:
        errors.print(f"[red]error:[/red] {name} not finished: {end.text()}", highlight=False, soft_wrap=True)
    return status


def refine(scenario: Scenario) -> Scenario:
    """The scenario with twice the film resolution and half the macro step."""
    film = {"columns": 2 * scenario.film.columns, "rows": 2 * scenario.film.rows}
    return with_overrides(at_half_step(scenario), {"film": film})


def status_of(end: Ended) -> int:
    """Exit status of a run that has ended."""
    if end.outcome == DIED:
        return exit_status.PROCESS_DIED
    return exit_status.of_outcome(next(outcome for outcome in Outcome if outcome.value == end.outcome))


def _settings(scenario: Scenario) -> Settings:
    return Settings(scenario.step, scenario.film.columns, scenario.film.rows, scenario.end)


def _compare(
    scenario: Scenario, train: Train, request: CompareRequest, folder: Path, console: Console, work: Work
) -> _Compared:
    tasks = [
        Task(
            depth,
            with_overrides(scenario, {"depth": depth}),
            request.fmus.absolute(),
            folder / depth,
            request.budget,
        )
        for depth in DEPTHS
    ]
    with show_runs(DEPTHS, scenario.end, console) as show:
        ended = run_all(tasks, min(request.jobs or cores(), len(tasks)), show, work=work)
    records = {
        task.name: read_record(task.folder) if (task.folder / RECORD_FILE).is_file() else None
        for task in tasks
    }
    left = [record for record in records.values() if record is not None]
    unfinished = {depth: "" if end.ok else end.text() for depth, end in ended.items()}
    bearing = scenario.analysed_bearing or (analysed_bearing(left[0]) if left else train.bearings[0].name)
    runs = gather(records, unfinished, bearing, scenario, train)
    return _Compared(compare(scenario.title or scenario.train, _settings(scenario), runs, ended), left)


def _write_all(
    pair: tuple[Comparison, Comparison | None],
    records: Sequence[xr.Dataset],
    runs: Path,
    folder: Path,
    train: Train,
    formats: Sequence[str],
) -> None:
    """Write data and figures of the comparison."""

    def draw() -> None:
        add_figures(records, folder, train, pair[0].runs.seat.name, formats)

    data_then_figures(folder, lambda fresh: _write(pair, runs, fresh), draw if formats else None, _OURS)


def _write(pair: tuple[Comparison, Comparison | None], runs: Path, fresh: Path) -> None:
    """Fill the folder of the results; the folders of the runs move there."""
    comparison, fine = pair
    (fresh / "comparison.txt").write_text(to_text(comparison, fine), encoding="utf-8")
    (fresh / "comparison.csv").write_text(to_csv(comparison, fine), encoding="utf-8")
    (fresh / SIGN).write_text(to_json(comparison, fine), encoding="utf-8")
    failed = [
        f"{name} {end.text()}\n{end.advice}\n"
        for one in pair
        if one is not None
        for name, end in one.ended.items()
        if not end.ok
    ]
    if failed:
        (fresh / PARTIAL).write_text("".join(failed), encoding="utf-8")
    for path in runs.iterdir():
        path.rename(fresh / path.name)
