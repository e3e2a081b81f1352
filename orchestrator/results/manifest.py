"""Which files of a folder this program wrote: their list with digests, which ``sha256sum -c`` reads as well.

A file that is not listed, or that was changed since, belongs to the user.
"""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path

MANIFEST = "bladeloss.sha256"
PART = f"{MANIFEST}.part"
"""A list, or a mark, that is being written."""
_LINE = re.compile(r"([0-9a-f]{64})  (.+)")

Manifest = dict[str, frozenset[str]]
"""Digests that a file may have, by its path in the folder; two while it is being replaced."""


def files_in(folder: Path) -> list[str]:
    """The files of a folder and of those in it, but for the list itself; links count as files."""
    found = (
        Path(root, name).relative_to(folder).as_posix()
        for root, folders, names in os.walk(folder)
        for name in (*names, *(one for one in folders if Path(root, one).is_symlink()))
    )
    return sorted(name for name in found if name not in (MANIFEST, PART))


def digests_of(folder: Path, names: Iterable[str]) -> Manifest:
    """The digests of files."""
    return {name: frozenset({_digest(folder / name)}) for name in names}


def read(folder: Path) -> Manifest:
    """The list in a folder; empty if there is none that can be read."""
    found: Manifest = {}
    try:
        text = (folder / MANIFEST).read_text(encoding="utf-8") if is_plain(folder, MANIFEST) else ""
    except (OSError, ValueError):
        return {}
    for line in text.splitlines():
        if match := _LINE.fullmatch(line):
            found[match[2]] = found.get(match[2], frozenset()) | {match[1]}
    return found


def write(folder: Path, manifest: Mapping[str, frozenset[str]]) -> None:
    """Write the list, whole or not at all."""
    fresh = folder / PART
    lines = (f"{digest}  {name}\n" for name in sorted(manifest) for digest in sorted(manifest[name]))
    with fresh.open("w", encoding="utf-8") as file:
        file.write("".join(lines))
        file.flush()
        os.fsync(file.fileno())
    fresh.replace(folder / MANIFEST)


def is_ours(folder: Path, name: str, manifest: Mapping[str, frozenset[str]]) -> bool:
    """Whether a file is as this program left it."""
    return name in manifest and is_plain(folder, name) and _digest(folder / name) in manifest[name]


def is_plain(folder: Path, name: str) -> bool:
    """Whether a path leads to a file within the folder, by way of no link."""
    above = (folder / step for step in Path(name).parents if step != Path())
    path = folder / name
    return path.is_file() and not path.is_symlink() and not any(step.is_symlink() for step in above)


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
