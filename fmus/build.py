"""Builds the FMUs: one for the rotor of each train, one for each bearing depth."""

from __future__ import annotations

from pathlib import Path

from fmus.archive import guid_in, write_archive
from fmus.recipe import Recipe

DEPTHS = ("v1", "v2", "v3")
DEFAULT_TRAIN = "turbine"


def write(recipe: Recipe, out: Path) -> Path:
    """Build one FMU in the folder `out` and return its path.

    The file appears whole or not at all; the same sources give the same bytes.
    """
    out.mkdir(parents=True, exist_ok=True)
    path = out / recipe.file_name
    write_archive(path, recipe.content())
    return path


def is_stale(path: Path, recipe: Recipe) -> bool:
    """Tell whether the FMU at `path` is missing or made from other sources or data than now."""
    return guid_in(path) != f"{{{recipe.guid}}}"
