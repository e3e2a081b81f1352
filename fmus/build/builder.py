"""Builds FMUs from recipes."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from fmus.build.archive import guid_in, write_archive
from fmus.build.recipe import Recipe


def build(out: Path, recipes: Iterable[Recipe]) -> list[Path]:
    """Build FMUs in the folder `out` and return their paths."""
    return [write(recipe, out) for recipe in recipes]


def refresh(out: Path, recipes: Iterable[Recipe]) -> list[Path]:
    """Build what is missing or stale in `out`; return the paths of these files only."""
    return [write(recipe, out) for recipe in recipes if is_stale(out / recipe.file_name, recipe)]


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
