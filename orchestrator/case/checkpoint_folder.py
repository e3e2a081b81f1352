"""Where a run's checkpoint lies, and what it keeps for the command that goes on from it."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

from orchestrator.case.case import Case
from orchestrator.case.request import RunRequest
from orchestrator.observers.checkpoint import Checkpoint, CheckpointError, Checkpoints

SUFFIX = "-checkpoint"


def checkpoint_folder(folder: Path) -> Path:
    """Where the checkpoint of a run lies whose results go to `folder`."""
    return folder.with_name(folder.name + SUFFIX)


def checkpoints(
    case: Case, request: RunRequest, folder: Path, warn: Callable[[str], None] = print
) -> Checkpoints | None:
    """What writes the checkpoints that a request asks for, with all that is needed to go on."""
    if request.checkpoint is None:
        return None
    about: dict[str, Any] = {
        **case.about,
        "source": str(Path(request.source).absolute()) if request.is_ssp else request.source,
        "fmus": str(request.fmus.absolute()),
        "bearing": request.bearing,
        "formats": list(request.formats),
        "every": request.checkpoint,
        "certify": request.certify,
        "threads": request.threads,
        "budget": request.budget,
    }
    return Checkpoints(checkpoint_folder(folder), request.checkpoint, about, warn)


def request_of(saved: Checkpoint, folder: Path, *, trust: bool) -> RunRequest:
    """Return the request of a saved run whose results go to `folder`.

    Raises
    ------
    CheckpointError
        When something is missing.
    """
    about = saved.about
    try:
        return RunRequest(
            about["source"],
            about.get("overrides", {}),
            out=folder,
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


def discard(folder: Path) -> None:
    """Remove the checkpoint of a run that is finished."""
    shutil.rmtree(checkpoint_folder(folder), ignore_errors=True)
