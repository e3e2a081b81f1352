"""``bladeloss resume``: go on with a run that was killed, from its last checkpoint."""

from __future__ import annotations

from pathlib import Path

from rich.console import Console

from orchestrator.case.checkpoint_folder import SUFFIX, checkpoint_folder
from orchestrator.commands.run import RunRequest, carry_out_request
from orchestrator.observers import checkpoint
from orchestrator.observers.checkpoint import CheckpointError
from orchestrator.scenario.file import parse_scenario


def resume(folder: Path, console: Console, errors: Console, *, trust: bool = False) -> int:
    """Go on with a run to its end, write its results, say what came out.

    Parameters
    ----------
    folder : Path
        Folder of the run's results, or that of its checkpoint.
    console, errors : rich.console.Console
        For output and for what went wrong.
    trust : bool
        Run FMUs of others without asking, also those to which the run's own start said nothing.

    Returns
    -------
    int
        Exit status, see `orchestrator.exit_status`.

    Raises
    ------
    CheckpointError
        When there is no checkpoint, or it belongs to other FMUs.
    """
    named = folder.name.endswith(SUFFIX)
    saved = checkpoint.read(folder if named else checkpoint_folder(folder))
    about = saved.about
    try:
        scenario = parse_scenario(about["scenario"], Path(about["scenario_folder"]), str(saved.path))
        request = RunRequest(
            about["source"],
            out=folder.with_name(folder.name.removesuffix(SUFFIX)),
            fmus=Path(about["fmus"]),
            bearing=about["bearing"],
            formats=tuple(about["formats"]),
            checkpoint=about["every"],
            certify=about["certify"],
            threads=about["threads"],
            trust=trust,
            budget=about["budget"],
        )
    except KeyError as error:
        raise CheckpointError(f"{saved.path}: {error} is missing") from None
    console.print(f"Going on from t = {saved.time:.6g} s of {scenario.end:.6g} s", highlight=False)
    return carry_out_request(request, scenario, console, errors, saved)
