"""The user's cache: what has not been used for long goes, so that it does not grow for ever."""

from __future__ import annotations

import os
import re
import shutil
import time
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

_FMU = re.compile(r".+-[0-9a-f]{16}\.fmu")
_PACKAGE = re.compile(r"[a-z_]+-[0-9a-f]{32}")  # of the units' loader, with compiled kernels
LARGEST = 100_000_000
"""Bytes of FMUs that are kept; ours have some 0.2 MB."""
_DAY = 86400.0
_IDLE = 30 * _DAY  # s, of packages


def used(files: Iterable[Path]) -> None:
    """Note that these are in use, which keeps them for a day at least."""
    for file in files:
        with suppress(OSError):  # of another user
            os.utime(file)


def prune(folder: Path, largest: int = LARGEST) -> None:
    """Remove what is no longer used of the cache.

    Parameters
    ----------
    folder : Path
        The folder of FMUs in the cache. Beside it lie the packages that units have put there.
    largest : int
        Bytes of FMUs that may stay; those used longest ago go first, none that was used within a day, so that
        none is taken from a run that is about to load it.
    """
    now = time.time()
    found = sorted(
        (about.st_mtime, about.st_size, path)
        for path in _matching(folder, _FMU)
        if path.is_file() and (about := path.stat())
    )
    size = sum(bytes_ for _, bytes_, _ in found)
    for last, bytes_, path in found:
        if size <= largest or now - last < _DAY:
            break
        with suppress(OSError):
            path.unlink()
            size -= bytes_
    for path in _matching(folder.parent, _PACKAGE):
        if path.is_dir() and now - path.stat().st_mtime > _IDLE:
            shutil.rmtree(path, ignore_errors=True)


def _matching(folder: Path, name: re.Pattern[str]) -> Iterable[Path]:
    with suppress(OSError):
        return [path for path in folder.iterdir() if name.fullmatch(path.name) and not path.is_symlink()]
    return []
