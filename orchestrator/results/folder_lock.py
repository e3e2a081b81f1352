"""One run at a time for a folder of results, its checkpoint and its partial results."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path

from filelock import FileLock, Timeout

from orchestrator.results.folder import ResultFolderError, partial_folder
from orchestrator.results.replacing import finish_replacing


@contextmanager
def lock_folder(folder: Path) -> Iterator[Callable[[], None]]:
    """Keep other runs away from a folder, and complete or remove what a killed run left half-written.

    The lock is on a file beside the folder.  It ends with the process, however that ends.

    Parameters
    ----------
    folder : Path
        Where the results go.

    Yields
    ------
    callable
        Removes the file, where the process ends inside the block.

    Raises
    ------
    ResultFolderError
        When another run has locked it.
    """
    made = [path for path in folder.absolute().parents if not path.exists()]
    folder.parent.mkdir(parents=True, exist_ok=True)
    path = folder.with_name(f".{folder.name}.lock")
    if path.is_symlink() or (path.exists() and path.stat().st_size):  # which the lock would empty
        raise ResultFolderError(f"{path}: is not of bladeloss; move it, or name another folder with --out")
    lock = FileLock(path, timeout=0)
    try:
        lock.acquire()
    except Timeout:
        raise ResultFolderError(
            f"{folder}: another run is writing to it; --out takes a folder of its own"
        ) from None
    try:
        for place in (folder, partial_folder(folder)):
            finish_replacing(place)
        yield partial(path.unlink, missing_ok=True)
    finally:
        with suppress(OSError):  # where an open file cannot be removed, its release does it
            path.unlink()
        lock.release()
        with suppress(OSError):  # something came into it
            for parent in made:
                parent.rmdir()
