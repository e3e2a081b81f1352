"""Writes an FMU or SSP archive: whole or not at all, the same bytes for the same content."""

from __future__ import annotations

import hashlib
import uuid
from collections.abc import Iterable, Mapping
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from defusedxml.ElementTree import fromstring

_EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest a zip can name
_UNIX = 3
_LARGEST = 64 << 20  # bytes of a description, or of all that an archive of ours may hold
_SIGN = b"bladeloss sha256 "


def write_archive(path: Path, files: Mapping[str, bytes]) -> None:
    """Write `files` as a zip archive, in the place of what may be there; see `as_written`."""
    temporary = path.with_name(f".{path.name}.{uuid.uuid4().hex}")
    try:
        with ZipFile(temporary, "w") as archive:
            for name in sorted(files):
                entry = ZipInfo(name, _EPOCH)
                entry.compress_type, entry.create_system = ZIP_DEFLATED, _UNIX
                entry.external_attr = (0o100755 if name.startswith("binaries/") else 0o100644) << 16
                archive.writestr(entry, files[name])
            archive.comment = _sign(files.items())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def _sign(files: Iterable[tuple[str, bytes]]) -> bytes:
    digest = hashlib.sha256()
    for name, content in sorted(files):
        digest.update(f"{name}\0{len(content)}\0".encode() + content)
    return _SIGN + digest.hexdigest().encode()


def as_written(path: Path) -> bool:
    """Tell whether an archive is as `write_archive` left it: by the digest of its content in its comment.

    It keeps the work of people from being overwritten, and proves nothing against somebody with bad will.
    """
    try:
        with ZipFile(path) as archive:
            if sum(entry.file_size for entry in archive.infolist()) > _LARGEST:
                return False
            return archive.comment == _sign((name, archive.read(name)) for name in archive.namelist())
    except Exception:  # damaged bytes end in errors of zipfile, zlib, ...
        return False


def holds(path: Path, content: Mapping[str, bytes]) -> bool:
    """Tell whether the archive at `path` holds exactly these files, byte for byte."""
    try:
        with ZipFile(path) as archive:
            sizes = {entry.filename: entry.file_size for entry in archive.infolist()}
            # sizes first: nothing large is read
            return (
                len(sizes) == len(archive.infolist())
                and sizes == {name: len(text) for name, text in content.items()}
                and all(archive.read(name) == text for name, text in content.items())
            )
    except Exception:  # missing, or damaged bytes
        return False


def guid_in(path: Path) -> str | None:
    """Return the GUID of the FMU at `path`; None if there is no FMU that can be read without risk."""
    try:
        with ZipFile(path) as archive, archive.open("modelDescription.xml") as file:
            text = file.read(_LARGEST + 1)
        guid: str | None = fromstring(text, forbid_dtd=True).get("guid") if len(text) <= _LARGEST else None
    except Exception:  # damaged bytes end in errors of zipfile, zlib, expat, defusedxml, ...
        return None
    return guid
