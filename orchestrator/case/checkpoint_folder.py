"""Where a run's checkpoint lies, and what it keeps for the command that goes on from it."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestrator.observers.checkpoint import Checkpoints
from orchestrator.scenario.file import scenario_toml

if TYPE_CHECKING:
    from orchestrator.commands.run import RunRequest
    from orchestrator.scenario.scenario import Scenario

SUFFIX = "-checkpoint"


def checkpoint_folder(folder: Path) -> Path:
    """Where the checkpoint of a run lies whose results go to `folder`."""
    return folder.with_name(folder.name + SUFFIX)


def checkpoints(
    scenario: Scenario,
    request: RunRequest,
    folder: Path,
    trusted: Sequence[str] = (),
    warn: Callable[[str], None] = print,
) -> Checkpoints | None:
    """What writes the checkpoints that a request asks for, with all that is needed to go on.

    Digests of FMUs that the user has agreed to run are kept, so that a resumed run need not ask.
    """
    if request.checkpoint is None:
        return None
    about: dict[str, Any] = {
        "scenario": scenario_toml(scenario),
        "scenario_folder": str(scenario.folder.absolute()),
        "source": request.source,
        "folder": str(folder.absolute()),
        "fmus": str(request.fmus.absolute()),
        "bearing": request.bearing,
        "formats": list(request.formats),
        "every": request.checkpoint,
        "certify": request.certify,
        "threads": request.threads,
        "trusted": list(trusted),
        "budget": request.budget,
    }
    return Checkpoints(checkpoint_folder(folder), request.checkpoint, about, warn)


def discard(folder: Path) -> None:
    """Remove the checkpoint of a run that is finished."""
    shutil.rmtree(checkpoint_folder(folder), ignore_errors=True)
