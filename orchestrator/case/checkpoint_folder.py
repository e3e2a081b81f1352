"""Where a run's checkpoint lies, and what it keeps for the command that goes on from it."""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from orchestrator.case.case import Case
from orchestrator.case.request import RunRequest
from orchestrator.observers.checkpoint import (
    FILE,
    Checkpoint,
    CheckpointError,
    Checkpoints,
    read,
)
from orchestrator.observers.checkpoint_meta import problem_of
from orchestrator.results.folder import ResultFolderError, check_writable
from orchestrator.results.growing_record import HEAD_FILE, files_of

SUFFIX = "-checkpoint"
_RUNNING = "-running"


def checkpoint_folder(folder: Path) -> Path:
    """Where the checkpoint of a run lies whose results go to `folder`."""
    return folder.with_name(folder.name + SUFFIX)


def running_folder(folder: Path) -> Path:
    """Where the record of a long run without checkpoints grows whose results go to `folder`."""
    return folder.with_name(folder.name + _RUNNING)


def checkpoints(
    case: Case, request: RunRequest, folder: Path, warn: Callable[[str], None] = print
) -> Checkpoints | None:
    """What writes the checkpoints that a request asks for, with all that is needed to go on."""
    if request.checkpoint is None:
        return None
    about: dict[str, Any] = {
        **case.about,
        "source": str(Path(request.source).absolute()) if request.is_ssp else request.source,
        "bearing": request.bearing,
        "formats": list(request.formats),
        "every": request.checkpoint,
        "certify": request.certify,
        "threads": request.threads,
        "budget": request.budget,
    }
    return Checkpoints(checkpoint_folder(folder.absolute()), request.checkpoint, about, warn)


class _About(BaseModel):
    """What a checkpoint says that a command needs to go on."""

    model_config = ConfigDict(strict=True, extra="forbid")

    source: str
    overrides: dict[str, Any] = {}
    bearing: str | None
    formats: list[Literal["png", "pdf", "svg"]]
    every: float = Field(ge=1e-6, allow_inf_nan=False)
    certify: bool
    threads: int | None = Field(ge=1)
    budget: float = Field(ge=0.0, allow_inf_nan=False)
    trusted: dict[str, str] = {}
    scenario: str | None = None
    scenario_folder: str | None = None
    ssp_sha256: str | None = None

    @model_validator(mode="after")
    def _of_one_kind(self) -> Self:
        needed = (self.ssp_sha256,) if self.source.endswith(".ssp") else (self.scenario, self.scenario_folder)
        if None in needed:
            raise ValueError("scenario, or digest of the SSP, is missing")
        return self


def request_of(saved: Checkpoint, folder: Path, fmus: Path, *, trust: bool) -> RunRequest:
    """Return the request of a saved run whose results go to `folder`.

    Raises
    ------
    CheckpointError
        When something is missing, or is not what a run writes.
    """
    try:
        about = _About.model_validate(saved.about)
    except ValidationError as error:
        raise CheckpointError(f"{saved.path}: not a checkpoint of a run: {problem_of(error)}") from None
    return RunRequest(
        about.source,
        about.overrides,
        out=folder,
        fmus=fmus,
        bearing=about.bearing,
        formats=tuple(about.formats),
        checkpoint=about.every,
        certify=about.certify,
        threads=about.threads,
        trust=trust,
        budget=about.budget,
    )


def discard(folder: Path) -> None:
    """Remove the checkpoint of a run that is finished, and its folder unless something else is in it."""
    remove(checkpoint_folder(folder))


def remove(place: Path) -> None:
    """Remove checkpoint and record so far from a folder, and it unless something else is in it."""
    with suppress(OSError):
        for path in (place / FILE, *_half_written(place), *files_of(place)):
            path.unlink(missing_ok=True)
        place.rmdir()


def _half_written(folder: Path) -> list[Path]:
    """Return the files of a checkpoint's folder that killed processes left in the middle of writing."""
    name = re.compile(rf"(?:{re.escape(FILE)}|{re.escape(HEAD_FILE)})\.\d+\.part")
    return [path for path in sorted(folder.glob("*.part")) if name.fullmatch(path.name)]


def check_checkpoint(folder: Path) -> None:
    """Raise ResultFolderError when a run with results in `folder` can keep no checkpoint without harm."""
    place = checkpoint_folder(folder)
    check_writable(place)
    path = place / FILE
    if path.exists() or path.is_symlink():
        try:
            read(place)
        except CheckpointError as error:
            raise ResultFolderError(f"{error}; it is left as it is, --out takes another folder") from None
