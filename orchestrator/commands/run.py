"""``bladeloss run``: from a scenario's name to a folder of results and an exit status."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.text import Text

from orchestrator import exit_status
from orchestrator.case.checkpoint_folder import checkpoint_folder, checkpoints, discard
from orchestrator.case.progress import show_progress
from orchestrator.case.simulate import Execution, Progress, Result, default_threads, simulate
from orchestrator.errors import NotWrittenError, OrchestratorError
from orchestrator.fmi.folder import ensure_fmus
from orchestrator.fmi.trust import own_bearings, require_trust
from orchestrator.fmi.watchdog import BUDGET, Watchdog, leave
from orchestrator.master.interrupt import interrupt_between_steps
from orchestrator.outcome import Outcome
from orchestrator.results.certificate import at_half_step, certify
from orchestrator.results.files import write_all
from orchestrator.results.folder import (
    FIGURES,
    check_folder,
    check_room,
    check_writable,
    partial_folder,
)
from orchestrator.results.folder_lock import claim
from orchestrator.results.summary import summarise
from orchestrator.results.summary_table import SummaryTable
from orchestrator.scenario.file import load_scenario, train_of, with_overrides
from orchestrator.scenario.problems import record_size
from rotor_fmu.train.wording import choice

if TYPE_CHECKING:
    from orchestrator.observers.checkpoint import Checkpoint
    from orchestrator.scenario.scenario import Scenario
    from rotor_fmu.train.train import Train


@dataclass(frozen=True)
class RunRequest:
    """What the command line asks for.

    Attributes
    ----------
    source : str
        Name of a bundled scenario, path of a TOML file or of an SSP.
    overrides : mapping
        Values in place of the scenario's, in the shape of the file.
    out : Path or None
        Folder of the results; None: ``results/<scenario>-<depth>``.
    fmus : Path
        Folder of the FMUs.
    bearing : str or None
        The analysed bearing; None: the most loaded one.
    formats : sequence of str
        File types of the figures; none for no figures.
    checkpoint : float or None
        Simulated time from one checkpoint to the next in s; None: no checkpoints.
    certify : bool
        Run once more at half the step, with the energy ledger in both, and say what changes.
    threads : int or None
        On which the bearings step; None: as many as pay.
    trust : bool
        Run FMUs of others without asking.
    budget : float
        Wall time in s that a call to a unit may take; 0 for any.
    """

    source: str
    overrides: Mapping[str, Any] = field(default_factory=dict)
    out: Path | None = None
    fmus: Path = Path("fmus")
    bearing: str | None = None
    formats: Sequence[str] = ("png",)
    checkpoint: float | None = None
    certify: bool = False
    threads: int | None = None
    trust: bool = False
    budget: float = BUDGET


def default_folder(source: str, scenario: Scenario) -> Path:
    """``results/<scenario>-<depth>``, with ``-mixed`` where bearings differ."""
    depths = {scenario.depth, *scenario.depth_at.values()}
    mixed = "-mixed" if len(depths) > 1 else ""
    return Path("results") / f"{Path(source).stem}-{scenario.depth}{mixed}"


def run(request: RunRequest, console: Console, errors: Console) -> int:
    """Run a scenario or an SSP, write its results, say what came out.

    Parameters
    ----------
    request : RunRequest
        What to run.
    console, errors : rich.console.Console
        For output and for what went wrong.

    Returns
    -------
    int
        Exit status, see `orchestrator.exit_status`.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input; nothing is written then.
    """
    if request.source.endswith(".ssp"):
        if request.checkpoint is not None:
            raise OrchestratorError("--checkpoint: a run of an SSP cannot be resumed")
        from orchestrator.commands.run_ssp import run_ssp

        return run_ssp(request, console, errors)
    return carry_out_request(request, load_scenario(request.source, request.overrides), console, errors)


def carry_out_request(
    request: RunRequest,
    scenario: Scenario,
    console: Console,
    errors: Console,
    saved: Checkpoint | None = None,
) -> int:
    """Run a scenario from its start or from a checkpoint; otherwise see `run`."""
    if request.certify and not scenario.ledger:
        scenario = with_overrides(scenario, {"ledger": True})
    train = train_of(scenario)
    check_bearing(request, train)
    folder = request.out or default_folder(request.source, scenario)
    check_folder(folder)
    check_room(folder, record_size(scenario, train))
    if request.checkpoint is not None:
        check_writable(checkpoint_folder(folder))
    known = saved.about.get("trusted", ()) if saved is not None else ()
    trusted = require_trust(own_bearings(scenario), request.fmus, trust=request.trust, known=known)
    threads = request.threads or default_threads(scenario, train)
    depths = {scenario.depth_of(seat.name) for seat in train.bearings}
    ensure_fmus(request.fmus, train, depths, console)

    def finish(result: Result, half: Result | None = None) -> int:
        return conclude(result, scenario, train, request, folder, console, errors, half)

    def run_scenario(what: Scenario, progress: Progress, execution: Execution) -> Result:
        return simulate(what, request.fmus, progress, execution)

    def warn(text: str) -> None:
        errors.print(f"[yellow]warning:[/yellow] {text}", highlight=False, soft_wrap=True)

    with claim(folder) as release:

        def give_up(hung: Result) -> None:
            leave(lambda: finish(hung), release, console.show_cursor)

        saving = checkpoints(scenario, request, folder, trusted, warn)
        with (
            Watchdog(request.budget, give_up) as watchdog,
            show_progress(scenario.end, console) as show,
            interrupt_between_steps(show) as progress,
        ):
            result = run_scenario(scenario, progress, Execution(saving, saved, threads, watchdog))
        half = None
        if request.certify and result.outcome.ok:
            half = at_half_the_step(scenario, run_scenario, console, threads)
        status = finish(result, half)
        if status == 0 and request.checkpoint is not None:
            discard(folder)
    return status


def at_half_the_step(
    scenario: Scenario,
    carry_out: Callable[[Scenario, Progress, Execution], Result],
    console: Console,
    threads: int,
) -> Result:
    """Carry out a run once more at half the step, for its certificate."""
    console.print("Certificate: the same run at half the step", highlight=False)
    finer = at_half_step(scenario)
    with show_progress(finer.end, console) as show, interrupt_between_steps(show) as progress:
        return carry_out(finer, progress, Execution(threads=threads))


def check_bearing(request: RunRequest, train: Train) -> None:
    """Raise OrchestratorError when the train lacks the bearing that is asked for."""
    names = [seat.name for seat in train.bearings]
    if request.bearing is not None and request.bearing not in names:
        raise OrchestratorError(
            f"--bearing {request.bearing}: no such bearing; {choice(request.bearing, names)}"
        )


def conclude(
    result: Result,
    scenario: Scenario,
    train: Train,
    request: RunRequest,
    folder: Path,
    console: Console,
    errors: Console,
    half: Result | None = None,
) -> int:
    """Write what a run gave, say what came out, and return the exit status.

    With the result of the same run at `half` the step, a certificate goes into summary and record; a
    certificate that was asked for and failed is the run's exit status.
    """
    summary = summarise(result, analysed=request.bearing)
    if half is not None:
        certificate = certify(summary, summarise(half, analysed=request.bearing))
        summary = replace(summary, certificate=certificate)
        result = replace(result, record=result.record.assign_attrs(certificate.attributes()))
    console.print(SummaryTable(summary))
    outcome, message = result.outcome, f"{summary.message}. {summary.advice}"
    if not outcome.ok:
        folder = partial_folder(folder)
    if outcome.ok or summary.phases:
        try:
            write_all(result, summary, scenario, train, request.formats, folder)
        except NotWrittenError as error:
            outcome = Outcome.NOT_WRITTEN
            message = f"{error} {outcome.advice}"
            if request.checkpoint is not None:
                message += " The checkpoint is kept: bladeloss resume goes on from there."
        else:
            kind = "Results" if outcome.ok else "Partial results"
            console.print(f"\n{kind} in {folder}", highlight=False, soft_wrap=True)
            if request.formats and summary.phases:
                console.print(f"Figures in {folder / FIGURES}", highlight=False, soft_wrap=True)
    if outcome.ok and half is not None and not half.outcome.ok:
        outcome, message = half.outcome, f"the certificate's run at half the step: {half.message}"
    status = exit_status.of_outcome(outcome)
    if not outcome.ok:
        errors.print(
            Text.assemble(("error:", "red"), f" {outcome.value} (exit status {status}): {message}"),
            soft_wrap=True,
        )
    return status
