"""How results get into their folder: complete on disk first, then file by file in place of earlier ones."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from orchestrator.errors import NotWrittenError
from orchestrator.results import manifest
from orchestrator.results.folder import PARTIAL, temporary_prefix

_MARK = "The results are being replaced, or the process ended meanwhile; what is missing lies in {}.\n"


@contextmanager
def result_folder(folder: Path, adding: bool = False, without: Sequence[str] = ()) -> Iterator[Path]:
    """Write results into a temporary folder that takes its place at the end.

    Parameters
    ----------
    folder : Path
        Where the results go.  What an earlier run wrote there is replaced, other files stay as they are.
    adding : bool
        What is there stays, too, but for `without`.
    without : sequence of str
        Files of an earlier run that go.

    Yields
    ------
    Path
        The temporary folder; it vanishes when the block raises, and `folder` stays as it was. A process
        that is killed leaves the old results, or the new ones, or a folder that is marked as partial with
        all of the new ones in it or in a folder inside it; `finish_replacing` completes them.

    Raises
    ------
    NotWrittenError
        When they cannot get into their place; the text says where they lie.
    """
    folder = folder.resolve()
    missing = [path for path in folder.parents if not path.exists()]
    folder.parent.mkdir(parents=True, exist_ok=True)
    place = folder if folder.is_dir() else folder.parent
    temporary = Path(tempfile.mkdtemp(prefix=temporary_prefix(folder), dir=place))
    try:
        yield temporary
        kept = {name: one for name, one in manifest.read(folder).items() if adding and name not in without}
        manifest.write(temporary, kept | manifest.digests_of(temporary, manifest.files_in(temporary)))
        temporary.chmod(0o777 & ~umask())
        try:
            _put(temporary, folder)
        except OSError as error:
            raise NotWrittenError(
                f"{folder}: results not put in their place: {error}; they lie complete in {temporary}"
            ) from None
    finally:
        if not (temporary / manifest.MANIFEST).exists():
            shutil.rmtree(temporary, ignore_errors=True)
        if not folder.exists():
            for path in missing:
                with suppress(OSError):  # something is in it
                    path.rmdir()


def _put(fresh: Path, folder: Path) -> None:
    if folder.is_dir():
        replace(fresh, folder)
    else:
        fresh.rename(folder)


def replace(fresh: Path, folder: Path) -> None:
    """Put the files of `fresh` into `folder` in place of those of an earlier run, marked meanwhile.

    Each file goes in one step, old ones without a successor at the end. A process that is killed on the way
    leaves `fresh` with the list of all results, and the folder with one that knows old and new.

    Raises
    ------
    FileExistsError
        When a file that is not of this program is in the place of a result.
    """
    old, new = manifest.read(folder), manifest.read(fresh)
    if not (fresh / PARTIAL).exists() and PARTIAL in new and manifest.is_ours(folder, PARTIAL, new):
        shutil.copyfile(folder / PARTIAL, fresh / PARTIAL)  # its reason outlives the mark
    coming = [name for name in sorted(new) if (fresh / name).exists()]  # others have gone before a kill
    for name in (*coming, PARTIAL):
        if _taken(folder, name, old):
            raise FileExistsError(f"{name} is not of an earlier run, or was changed since; it is left")
    mark = _MARK.format(fresh.name)
    marked = frozenset({hashlib.sha256(mark.encode()).hexdigest()})
    none: frozenset[str] = frozenset()
    both = {name: old.get(name, none) | new.get(name, none) for name in {*old, *new, PARTIAL}}
    both[PARTIAL] |= marked
    manifest.write(folder, both)
    _write_whole(folder / PARTIAL, mark)
    for name in coming:
        if name != PARTIAL:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (fresh / name).replace(folder / name)
    for name in old.keys() - new.keys() - {PARTIAL}:
        if manifest.is_ours(folder, name, old):
            (folder / name).unlink()
            _prune((folder / name).parent, folder)
    if PARTIAL in coming:
        (fresh / PARTIAL).replace(folder / PARTIAL)
    elif PARTIAL not in new:
        (folder / PARTIAL).unlink()
    manifest.write(folder, new)
    shutil.rmtree(fresh, ignore_errors=True)


def finish_replacing(folder: Path) -> None:
    """Complete what a killed process began, and remove what it had only half written."""
    folder = folder.resolve()
    ours = re.compile(re.escape(temporary_prefix(folder)) + "[a-z0-9_]{8}")
    for place in (folder.parent, folder):
        for rest in sorted(place.iterdir()) if place.is_dir() else ():
            if not ours.fullmatch(rest.name) or rest.is_symlink() or not rest.is_dir():
                continue
            if (rest / manifest.MANIFEST).exists():
                _put(rest, folder)
            else:
                shutil.rmtree(rest, ignore_errors=True)


def _taken(folder: Path, name: str, listed: manifest.Manifest) -> bool:
    """Whether something that is not of this program is in the place of a result."""
    path = folder / name
    for step in Path(name).parents:
        above = folder / step
        if step != Path() and (above.is_symlink() or (above.exists() and not above.is_dir())):
            return True
    return (path.exists() or path.is_symlink()) and not manifest.is_ours(folder, name, listed)


def _prune(folder: Path, top: Path) -> None:
    """Remove folders that have become empty."""
    while folder != top and not any(folder.iterdir()):
        folder.rmdir()
        folder = folder.parent


def _write_whole(path: Path, text: str) -> None:
    fresh = path.with_name(manifest.PART)
    fresh.write_text(text, encoding="utf-8")
    fresh.replace(path)


def umask() -> int:
    """The process's mask for new files, which mkdtemp overrides."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
