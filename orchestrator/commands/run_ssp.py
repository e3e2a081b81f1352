"""``bladeloss run FILE.ssp``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from orchestrator.case.progress import show_progress
from orchestrator.case.simulate import Execution, Result, default_threads
from orchestrator.commands.run import at_half_the_step, check_bearing, conclude
from orchestrator.fmi.trust import require_trust
from orchestrator.fmi.watchdog import Watchdog, leave
from orchestrator.master.interrupt import interrupt_between_steps
from orchestrator.results.folder import check_folder, check_room
from orchestrator.results.folder_lock import claim
from orchestrator.scenario.problems import record_size
from orchestrator.ssp.simulate import SspRun
from orchestrator.ssp.structure import SspError

if TYPE_CHECKING:
    from orchestrator.commands.run import RunRequest

_ALLOWED = ("end", "step", "coupling", "tolerance", "ledger")


def run_ssp(request: RunRequest, console: Console, errors: Console) -> int:
    """Run an SSP as it stands, on the FMUs inside it.

    Parameters
    ----------
    request : RunRequest
        Of its overrides end, step, coupling, tolerance and ledger are allowed.
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
    for key in request.overrides:
        if key not in _ALLOWED:
            option = key.replace("_", "-")
            raise SspError(
                f"{request.source}: --{option} is for scenarios; an SSP holds its FMUs and parameters, "
                "allowed are --end, --step, --coupling, --tol, --ledger"
            )
    path = Path(request.source)
    folder = request.out or Path("results") / path.stem
    check_folder(folder)
    overrides = {**request.overrides, "ledger": True} if request.certify else request.overrides
    with claim(folder) as release, SspRun(path, overrides) as prepared:
        check_bearing(request, prepared.train)
        check_room(folder, record_size(prepared.scenario, prepared.train))
        require_trust(prepared.fmus, request.fmus, trust=request.trust)

        def finish(result: Result, half: Result | None = None) -> int:
            return conclude(result, prepared.scenario, prepared.train, request, folder, console, errors, half)

        def give_up(hung: Result) -> None:
            leave(lambda: finish(hung), release, console.show_cursor)

        with (
            Watchdog(request.budget, give_up) as watchdog,
            show_progress(prepared.scenario.end, console) as show,
            interrupt_between_steps(show) as progress,
        ):
            threads = request.threads or default_threads(prepared.scenario, prepared.train)
            execution = Execution(threads=threads, watchdog=watchdog)
            result = prepared.simulate(prepared.scenario, progress, execution)
        half = None
        if request.certify and result.outcome.ok:
            half = at_half_the_step(prepared.scenario, prepared.simulate, console, threads)
        return finish(result, half)
