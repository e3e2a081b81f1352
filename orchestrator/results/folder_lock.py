"""One run at a time for a folder of results, its checkpoint and its partial results."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path

from orchestrator.results.folder import FIGURES, ResultFolderError, partial_folder, temporary_prefix

try:
    import fcntl
except ImportError:  # not on Windows; there two runs are told apart by nobody
    fcntl = None  # type: ignore[assignment]


@contextmanager
def claim(folder: Path) -> Iterator[Callable[[], None]]:
    """Keep other runs away from a folder, and remove what a killed run left half-written beside it.

    The claim is a lock on a file beside the folder.  It ends with the process, however that ends.

    Parameters
    ----------
    folder : Path
        Where the results go.

    Yields
    ------
    callable
        Ends the claim, where the process ends inside the block.

    Raises
    ------
    ResultFolderError
        When another run has claimed it.
    """
    made = [path for path in folder.absolute().parents if not path.exists()]
    folder.parent.mkdir(parents=True, exist_ok=True)
    path = folder.with_name(f".{folder.name}.lock")
    descriptor = _lock(path, folder)
    try:
        for place in (folder, partial_folder(folder)):
            _remove_rests(place.parent, temporary_prefix(place))
            _remove_rests(place, temporary_prefix(place / FIGURES))
        yield partial(path.unlink, missing_ok=True)
    finally:
        path.unlink(missing_ok=True)
        os.close(descriptor)
        with suppress(OSError):  # something came into it
            for parent in made:
                parent.rmdir()


def _remove_rests(folder: Path, prefix: str) -> None:
    for path in folder.iterdir() if folder.is_dir() else ():
        if path.name.startswith(prefix):
            shutil.rmtree(path, ignore_errors=True)


def _lock(path: Path, folder: Path) -> int:
    while True:
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        if fcntl is None:
            return descriptor
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            os.close(descriptor)
            raise ResultFolderError(
                f"{folder}: another run is writing to it; --out takes a folder of its own"
            ) from None
        with suppress(FileNotFoundError):
            if os.path.samestat(os.fstat(descriptor), path.stat()):
                return descriptor
        os.close(descriptor)  # its owner removed it in between
