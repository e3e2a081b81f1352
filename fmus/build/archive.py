"""Writes an FMU archive: whole or not at all, and the same bytes for the same content; reads its GUID."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from defusedxml.ElementTree import fromstring

_EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest a zip can name
_UNIX = 3
_LARGEST = 64 << 20  # bytes of a description; more is none of ours


def write_archive(path: Path, files: Mapping[str, bytes]) -> None:
    """Write `files` as a zip archive, in the place of what may be there."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with ZipFile(temporary, "w") as archive:
            for name in sorted(files):
                entry = ZipInfo(name, _EPOCH)
                entry.compress_type, entry.create_system = ZIP_DEFLATED, _UNIX
                entry.external_attr = (0o100755 if name.startswith("binaries/") else 0o100644) << 16
                archive.writestr(entry, files[name])
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def guid_in(path: Path) -> str | None:
    """Return the GUID of the FMU at `path`; None if there is no FMU that can be read without risk."""
    try:
        with ZipFile(path) as archive, archive.open("modelDescription.xml") as file:
            text = file.read(_LARGEST + 1)
        guid: str | None = fromstring(text, forbid_dtd=True).get("guid") if len(text) <= _LARGEST else None
    except Exception:  # damaged bytes end in errors of zipfile, zlib, expat, defusedxml, ...
        return None
    return guid
