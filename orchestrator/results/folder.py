"""The folder of a run's results: it appears whole, and only when everything in it is written."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

from orchestrator.errors import OrchestratorError
from orchestrator.results import manifest

PARTIAL = "PARTIAL.txt"
"""Name of the file that marks a run that did not reach its end, with the reason."""
FIGURES = "figures"
RUN_FILES = (
    "record.nc",
    "record.csv",
    "summary.txt",
    "summary.json",
    "scenario.toml",
    "report.html",
    FIGURES,
    PARTIAL,
)
_SIGN = "scenario.toml"  # by which an earlier result of a run is known


class ResultFolderError(OrchestratorError):
    """A folder that cannot take results."""


def named(folder: Path) -> Path:
    """The folder by a name of its own, where it is given as ``.`` or the like."""
    return folder.resolve() if folder.name in ("", "..") else folder


def named_after(source: str) -> str:
    """How results of a scenario, archive or train are named: its file without the ending, or its folder."""
    path = named(Path(source))
    return path.stem if path.suffix.lower() in (".toml", ".ssp") else path.name


def check_folder(folder: Path, sign: str = _SIGN, ours: Sequence[str] = RUN_FILES) -> None:
    """Make sure that results can go to a folder, before hours are spent on them.

    Parameters
    ----------
    folder : Path
        Where they are to go.
    sign : str
        File by which an earlier result of the same kind is known.
    ours : sequence of str
        Files and folders of such a result.

    Raises
    ------
    ResultFolderError
        When the path is a file, or a folder with files that are not an earlier result, or one in which
        something that this program did not write is in the place of a result, or when nothing can be
        written there.
    """
    check_writable(folder)
    if not folder.is_dir() or not any(folder.iterdir()):
        return
    listed = manifest.read(folder)
    if sign not in listed:
        raise ResultFolderError(
            f"{folder}: holds files that are no earlier result; --out takes a new folder, an empty one or "
            "that of an earlier run"
        )
    for name in ours:
        path = folder / name
        if path.is_dir() and not path.is_symlink():
            continue
        if (path.exists() or path.is_symlink()) and not manifest.is_ours(folder, name, listed):
            raise ResultFolderError(
                f"{folder}: {name} is not of an earlier run, or was changed since, and is left as it is; "
                "--out takes another folder"
            )


def check_writable(folder: Path) -> None:
    """Raise ResultFolderError when a folder cannot be made, or nothing can be written to it."""
    try:
        if folder.is_symlink() and not folder.exists():
            raise ResultFolderError(f"{folder}: is a link that leads nowhere; --out takes a folder")
        if folder.exists() and not folder.is_dir():
            raise ResultFolderError(f"{folder}: is a file; --out takes a folder")
        if not folder.name:
            raise ResultFolderError(f"{folder}: has no name; --out takes a folder")
        parent = _nearest(folder)
        longest = temporary_prefix(partial_folder(folder))
    except OSError as error:
        raise ResultFolderError(f"{folder}: {error.strerror}; --out takes a folder") from None
    try:  # what the permissions say is not all: the file system may be read-only or full
        with tempfile.NamedTemporaryFile(prefix=longest, dir=parent) as file:
            file.write(b"room for a file")
    except OSError as error:
        raise ResultFolderError(f"{folder}: nothing can be written in {parent}: {error.strerror}") from None


def check_room(folder: Path, needed: float) -> None:
    """Raise ResultFolderError when a disk has less room than the bytes that results will need there."""
    free = free_room(folder)
    if free < needed:
        raise ResultFolderError(
            f"{folder}: the record takes {needed / 1e6:.3g} MB, and {free / 1e6:.3g} are free; allowed are a "
            "disk with more room (--out), an earlier --end, or a longer record.interval"
        )


def free_room(folder: Path) -> int:
    """Bytes that are free where a folder is, or will be."""
    return shutil.disk_usage(_nearest(folder)).free


def _nearest(folder: Path) -> Path:
    """The folder, or the lowest above it that exists."""
    return next(path for path in (folder, *folder.absolute().parents) if path.exists())


def partial_folder(folder: Path) -> Path:
    """Where an unfinished run goes, so that it never replaces a finished one."""
    return folder.with_name(folder.name + "-partial")


def temporary_prefix(folder: Path) -> str:
    """How the names begin of what is only written, and not yet the results in `folder`."""
    return f".{folder.name}-writing-"
