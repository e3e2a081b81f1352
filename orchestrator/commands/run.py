"""``bladeloss run``: from a scenario's name to a folder of results and an exit status."""

from __future__ import annotations

from dataclasses import replace

from rich.console import Console

from orchestrator.case.carry_out import carry_out
from orchestrator.case.case import Case
from orchestrator.case.certify import at_half_step
from orchestrator.case.checkpoint_folder import checkpoints, discard, remove, running_folder
from orchestrator.case.conclude import completed, conclude
from orchestrator.case.prepare import prepare, result_folder_of
from orchestrator.case.request import RunRequest
from orchestrator.case.simulate import Execution
from orchestrator.case.threads import default_threads
from orchestrator.fmi.watchdog import Watchdog, leave
from orchestrator.observers.checkpoint import Checkpoint
from orchestrator.report.library import require_library
from orchestrator.results.folder import partial_folder
from orchestrator.results.folder_lock import lock_folder
from orchestrator.results.record_files import is_newer
from orchestrator.results.result import Result


def run(request: RunRequest, console: Console, errors: Console, saved: Checkpoint | None = None) -> int:
    """Run a scenario or an SSP, write its results, say what came out.

    Parameters
    ----------
    request : RunRequest
        What to run.
    console, errors : rich.console.Console
        For output and for what went wrong.
    saved : Checkpoint, optional
        To go on from.

    Returns
    -------
    int
        Exit status, see `orchestrator.outcome`.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input; nothing is written then.
    """
    if request.report:
        require_library()
    with prepare(request, console, saved) as case:
        return run_case(case, request, console, errors, saved)


def run_case(
    case: Case, request: RunRequest, console: Console, errors: Console, saved: Checkpoint | None = None
) -> int:
    """Execute a case and conclude it; otherwise see `run`."""
    folder = result_folder_of(request, case.scenario)
    threads = request.threads or default_threads(case.scenario, case.train)
    running = running_folder(folder.absolute())
    halved = running.with_name(f"{running.name}-half")

    def finish(result: Result, half: Result | None = None) -> int:
        status = conclude(case, request, folder, (completed(case, result), half), console, errors)
        if all(is_newer(running, place) for place in (folder, partial_folder(folder))):
            text = (
                f"The record is kept in {running} until the next run to {folder}; what found no room at the "
                "end is not in it. bladeloss report, bladeloss.load read it."
            )
            errors.print(text, highlight=False, soft_wrap=True)
        else:
            remove(running)
        remove(halved)
        return status

    def warn(text: str) -> None:
        errors.print(f"[yellow]warning:[/yellow] {text}", highlight=False, soft_wrap=True)

    with lock_folder(folder) as release:

        def give_up(hung: Result) -> None:
            leave(lambda: finish(hung), release, console.show_cursor)

        with Watchdog(request.budget, give_up) as watchdog:
            saving = checkpoints(case, request, folder, warn)
            result = carry_out(case, console, Execution(saving, saved, threads, watchdog, running, warn))
        half = None
        if request.certify and result.outcome.ok:
            console.print("Certificate: the same run at half the step", highlight=False)
            finer = replace(case, scenario=at_half_step(case.scenario))
            half = carry_out(finer, console, Execution(threads=threads, record=halved, warn=warn))
        status = finish(result, half)
        if status == 0 and request.checkpoint is not None:
            discard(folder)
    return status
