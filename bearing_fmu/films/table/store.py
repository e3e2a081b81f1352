"""Tables that have been built: kept in this process, and in the user's cache, where they outlast it."""

from __future__ import annotations

import hashlib
import io
import json
import os
from contextlib import suppress
from dataclasses import astuple
from functools import lru_cache
from pathlib import Path

import numpy as np

from bearing_fmu.films.table.build import SIZES, Built, build, unit_bearing
from bearing_fmu.parameters import BearingParameters

_DIGEST = hashlib.sha256().digest_size
_PACKAGE = Path(__file__).parents[2]
_DRAWN_ON = ("films", "films/aligned", "films/tilted", "films/table", "kernels", "bore", ".")
"""Folders that a table follows from, the same in a unit as in the program."""
_STEMS = ("evaluate", "film", "outputs", "parameters", "result", "scales")
"""And of the last of them these files alone."""


def folder() -> Path:
    """Where tables are kept: in the user's cache, which a unit finds without a library."""
    kept = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    return Path(kept or "~/.cache").expanduser() / "bladeloss" / "tables"


def table_of(parameters: BearingParameters) -> Built:
    """The table of a bearing; bearings of one shape share it."""
    return _of_unit(unit_bearing(parameters))[0]


def built_now(parameters: BearingParameters) -> str:
    """Build the table of a bearing unless it is there; returns a line about it, empty if it was there."""
    unit = unit_bearing(parameters)
    known = _of_unit.cache_info().misses
    built, fresh = _of_unit(unit)
    if not fresh or _of_unit.cache_info().misses == known:
        return ""
    return (
        f"bearing table b/d {unit.width / unit.diameter:.3g}, roughness {unit.roughness:.2g} of the "
        f"clearance: deviates from v2 on {built.columns} x {unit.rows} by at most "
        f"{100.0 * built.largest:.2g} % of the force, in 99 of 100 states by {100.0 * built.typical:.2g} %"
    )


@lru_cache(maxsize=1)
def _sources() -> str:
    """Digest of the sources that a table follows from."""
    digest = hashlib.sha256()
    for folder in _DRAWN_ON:
        for path in sorted((_PACKAGE / folder).glob("*.py")):
            if folder != "." or path.stem in _STEMS:
                digest.update(path.name.encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


@lru_cache(maxsize=64)
def _of_unit(unit: BearingParameters) -> tuple[Built, bool]:
    """The table, and whether it was built just now."""
    key = hashlib.sha256(json.dumps([_sources(), SIZES, astuple(unit)]).encode()).hexdigest()[:32]
    path = folder() / f"{key}.npy"
    kept = _read(path)
    if kept is not None:
        return kept, False
    built = build(unit)
    with suppress(OSError):  # no room, no folder: it is built in every process
        _write(path, built)
    return built, True


def _write(path: Path, built: Built) -> None:
    """Write a table, whole or not at all."""
    file = io.BytesIO()
    numbers = np.array([built.last, built.typical, built.largest, built.columns])
    np.save(file, numbers, allow_pickle=False)
    np.save(file, built.coefficients, allow_pickle=False)
    content = file.getvalue()
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        temporary.write_bytes(hashlib.sha256(content).digest() + content)
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def _read(path: Path) -> Built | None:
    """Read a table; None where there is none, or it is not as it was written."""
    try:
        kept = path.read_bytes()
    except OSError:
        return None
    content = kept[_DIGEST:]
    if hashlib.sha256(content).digest() != kept[:_DIGEST]:
        return None
    file = io.BytesIO(content)
    last, typical, largest, columns = np.load(file, allow_pickle=False).tolist()
    return Built(np.load(file, allow_pickle=False), last, typical, largest, int(columns))
