"""The folder of a run's results: it appears whole, and only when everything in it is written."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from orchestrator.errors import OrchestratorError

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
_SIGN = "scenario.toml"  # a folder with this file and nothing alien to it is an earlier result


class ResultFolderError(OrchestratorError):
    """A folder that cannot take results."""


def check_folder(folder: Path, sign: str = _SIGN) -> None:
    """Make sure that results can go to a folder, before hours are spent on them.

    Parameters
    ----------
    folder : Path
        Where they are to go.
    sign : str
        File by which an earlier result of the same kind is known.

    Raises
    ------
    ResultFolderError
        When the path is a file, or a folder with files that are not an earlier result, or when nothing can
        be written there.
    """
    check_writable(folder)
    if folder.is_dir() and any(folder.iterdir()) and not (folder / sign).is_file():
        raise ResultFolderError(
            f"{folder}: holds files that are no earlier result; --out takes a new folder, an empty one or "
            "that of an earlier run"
        )


def check_writable(folder: Path) -> None:
    """Raise ResultFolderError when a folder cannot be made, or nothing can be written to it."""
    if folder.exists() and not folder.is_dir():
        raise ResultFolderError(f"{folder}: is a file; --out takes a folder")
    parent = _nearest(folder)
    try:  # what the permissions say is not all: the file system may be read-only or full
        with tempfile.TemporaryFile(dir=parent) as file:
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


@contextmanager
def result_folder(folder: Path, ours: Sequence[str] = RUN_FILES) -> Iterator[Path]:
    """Write results into a temporary folder that takes its place at the end.

    Parameters
    ----------
    folder : Path
        Where the results go.  Results of an earlier run in it are replaced, other files stay.
    ours : sequence of str
        Files and folders of an earlier result.

    Yields
    ------
    Path
        The temporary folder; it vanishes when the block raises, and `folder` stays as it was. A process
        that is killed leaves the old results, the new ones, or a folder that is marked as partial.
    """
    missing = [path for path in folder.parents if not path.exists()]
    folder.parent.mkdir(parents=True, exist_ok=True)
    temporary = Path(tempfile.mkdtemp(prefix=temporary_prefix(folder), dir=folder.parent))
    try:
        yield temporary
        if folder.is_dir():
            _replace(temporary, folder, ours)
        else:
            temporary.chmod(0o777 & ~_umask())
            temporary.rename(folder)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
        if not folder.exists():
            for path in missing:
                path.rmdir()


def _replace(fresh: Path, folder: Path, ours: Sequence[str]) -> None:
    """Put the files of `fresh` into `folder` in place of those of an earlier run, marked meanwhile."""
    mark, own = folder / PARTIAL, fresh / PARTIAL
    mark.write_text("The results are not complete: the process ended while it replaced earlier ones.\n")
    for name in ours:
        target = folder / name
        if target.is_dir():
            shutil.rmtree(target)
        elif target != mark:
            target.unlink(missing_ok=True)
    for path in fresh.iterdir():
        if path != own:
            path.rename(folder / path.name)
    if own.exists():
        own.replace(mark)
    else:
        mark.unlink()


def _umask() -> int:
    """The process's mask for new files, which mkdtemp overrides."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
