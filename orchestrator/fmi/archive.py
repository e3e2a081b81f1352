"""Extracts zip archives of others, FMU and SSP: into their folder and nowhere else, or not at all.

What an archive says of itself is checked before anything is written, and what is written is counted
as it comes, for the sizes in its headers may be untrue.
"""

from __future__ import annotations

import errno
import re
import shutil
import stat
from dataclasses import dataclass
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile, ZipInfo

from orchestrator.errors import OrchestratorError

MIB = 1 << 20
_CHUNK = MIB // 4
_ENCRYPTED = 0x41  # bits 0 and 6 of the flags of an entry
_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EACCES)
_UNFIT = re.compile(r"[\x00-\x1f\x7f]")
_KINDS = {
    stat.S_IFLNK: "a symbolic link",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
}


class ArchiveError(OrchestratorError):
    """An archive that is not extracted; the text names it, the entry, and what is allowed."""


@dataclass(frozen=True)
class Limits:
    """How much an archive may hold.

    Attributes
    ----------
    entries : int
        Files and folders.
    total : int
        Bytes of all files, extracted.
    ratio : int
        Times the archive's own size, once the files are larger than `free`. Text of modelDescriptions
        comes to 20.
    free : int
        Bytes, see `ratio`.
    """

    entries: int = 20_000
    total: int = 2048 * MIB
    ratio: int = 200
    free: int = 16 * MIB


LIMITS = Limits()


def extract(path: Path, folder: Path, kind: str, limits: Limits = LIMITS) -> int:
    """Extract an archive.

    Parameters
    ----------
    path : Path
        The archive.
    folder : Path
        Where its entries go; new or empty. It is removed if the archive is refused.
    kind : str
        What the archive should be, for messages: FMU, SSP.
    limits : Limits, optional
        How much it may hold.

    Returns
    -------
    int
        Bytes written.

    Raises
    ------
    FileNotFoundError
        When there is no archive.
    ArchiveError
        When it cannot be read, has an entry that could do harm, or is too large.
    """
    if not path.exists():
        raise FileNotFoundError(2, "no such file", str(path))
    if not path.is_file():  # a folder, or a pipe or a device, which has no end
        raise ArchiveError(f"{path}: not a readable {kind}: no file")
    try:
        with ZipFile(path) as archive:
            entries = archive.infolist()
            _check(path, entries, limits)
            return _write(path, archive, entries, folder, limits)
    except Exception as error:  # damaged bytes end in errors of zipfile, zlib, struct, codecs, ...
        shutil.rmtree(folder, ignore_errors=True)
        if isinstance(error, ArchiveError):
            raise
        if isinstance(error, OSError) and error.errno in _NO_ROOM:
            raise ArchiveError(
                f"{path}: cannot be extracted to {folder.parent}: {error.strerror}; TMPDIR names another"
            ) from None
        raise ArchiveError(f"{path}: not a readable {kind}: {error}") from None


def inside(path: Path, folder: Path, relative: str) -> Path:
    """Return where something lies that the archive at `path`, extracted to `folder`, refers to.

    Raises
    ------
    ArchiveError
        When it leads out of the folder of the archive.
    """
    target = (folder / relative).resolve()
    if not target.is_relative_to(folder.resolve()):
        raise ArchiveError(f"{path}: {relative!r} leads out of the archive; allowed are files in it")
    return target


def _check(path: Path, entries: list[ZipInfo], limits: Limits) -> None:
    """Refuse an archive for what it says of itself."""
    if len(entries) > limits.entries:
        raise ArchiveError(f"{path}: holds {len(entries)} entries; allowed are {limits.entries}")
    declared = sum(entry.file_size for entry in entries)
    if declared > limits.total:
        raise _too_large(path, limits)
    files: set[str] = set()
    for entry in entries:
        problem = _problem(entry)
        if not problem and entry.filename.rstrip("/") in files:
            problem = "is there twice; allowed are names of their own"
        if problem:
            raise ArchiveError(f"{path}: entry {entry.orig_filename!r} {problem}")
        files.add(entry.filename.rstrip("/"))


def _problem(entry: ZipInfo) -> str:
    """Say what is wrong with an entry, if anything is."""
    name = entry.orig_filename  # as in the archive; zipfile has cut `filename` at a NUL
    parts = name.removesuffix("/").split("/")
    if name.startswith("/") or "\\" in name or ":" in name:
        return "is absolute or has a drive or a backslash; allowed are relative paths with slashes"
    if not {"", ".", ".."}.isdisjoint(parts):
        return "leaves its folder or has an empty part; allowed are relative paths without . and .."
    if _UNFIT.search(name):
        return "has a control character in its name; allowed are printable names"
    kind = _KINDS.get(stat.S_IFMT(entry.external_attr >> 16))
    if kind:
        return f"is {kind}; allowed are files and folders"
    if entry.flag_bits & _ENCRYPTED:
        return "is encrypted; allowed are plain entries"
    if entry.compress_type not in (ZIP_STORED, ZIP_DEFLATED):
        return f"is compressed by method {entry.compress_type}; allowed are 0 (stored) and 8 (deflated)"
    return ""


def _write(path: Path, archive: ZipFile, entries: list[ZipInfo], folder: Path, limits: Limits) -> int:
    size, written = path.stat().st_size, 0
    for entry in entries:
        target = inside(path, folder, entry.filename)
        if entry.is_dir():
            target.mkdir(parents=True, exist_ok=True)
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        with archive.open(entry) as source, target.open("xb") as out:
            while chunk := source.read(_CHUNK):
                written += len(chunk)
                if written > limits.total:
                    raise _too_large(path, limits)
                if written > limits.free and written > limits.ratio * size:
                    raise ArchiveError(
                        f"{path}: entry {entry.filename!r} makes more than {limits.ratio} bytes of one; such "
                        "archives are made to fill disks"
                    )
                out.write(chunk)
    return written


def _too_large(path: Path, limits: Limits) -> ArchiveError:
    return ArchiveError(f"{path}: holds more than the {limits.total // MIB} MiB that are allowed")
