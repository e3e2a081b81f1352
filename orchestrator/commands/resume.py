"""``bladeloss resume``: go on with a run that was killed, from its last checkpoint."""

from __future__ import annotations

from pathlib import Path

from rich.console import Console

from orchestrator.case.checkpoint_folder import SUFFIX, checkpoint_folder, request_of
from orchestrator.case.prepare import prepare
from orchestrator.commands.run import run_case
from orchestrator.observers import checkpoint


def resume(folder: Path, fmus: Path, console: Console, errors: Console, *, trust: bool = False) -> int:
    """Go on with a run to its end, write its results, say what came out.

    Parameters
    ----------
    folder : Path
        Folder of the run's results, or that of its checkpoint.
    fmus : Path
        Folder of the FMUs.
    console, errors : rich.console.Console
        For output and for what went wrong.
    trust : bool
        Run FMUs of others without asking, also those to which the run's own start said nothing.

    Returns
    -------
    int
        Exit status, see `orchestrator.outcome`.

    Raises
    ------
    OrchestratorError
        When there is no checkpoint, or it belongs to other FMUs or to another SSP.
    """
    results = folder.with_name(folder.name.removesuffix(SUFFIX))
    saved = checkpoint.read(checkpoint_folder(results))
    request = request_of(saved, results, fmus, trust=trust)
    with prepare(request, console, saved) as case:
        end = f"{case.scenario.end:.6g}"
        console.print(f"Going on from t = {saved.time:.6g} s of {end} s", highlight=False)
        return run_case(case, request, console, errors, saved)
