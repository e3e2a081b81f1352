"""Builds FMUs from recipes, and finds those that are built."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from fmus.build.archive import as_written, guid_in, holds, write_archive
from fmus.build.recipe import Recipe


class NotOursError(ValueError):
    """A file in the place of an FMU that this program did not write, or that was changed since."""


def build(out: Path, recipes: Iterable[Recipe]) -> list[Path]:
    """Build FMUs in the folder `out` under their plain names, for other tools, and return their paths.

    Raises
    ------
    NotOursError
        When two would have the same name, or a file there is not of this program.
    """
    by_name: dict[str, Recipe] = {}
    for recipe in recipes:
        if by_name.setdefault(recipe.file_name, recipe).guid != recipe.guid:
            raise NotOursError(
                f"{recipe.file_name}: two unlike units would have this name; build one of them"
            )
    for name in by_name:
        check_target(out / name)
    return [write(recipe, out) for recipe in by_name.values()]


def check_target(path: Path) -> None:
    """Raise NotOursError when a file that is not of this program is in the place of one to be written."""
    if path.is_symlink() or (path.exists() and not as_written(path)):
        raise NotOursError(
            f"{path}: is not of bladeloss, or was changed since, and is left as it is; move it, or name "
            "another place with --out"
        )


def write(recipe: Recipe, out: Path) -> Path:
    """Build one FMU in the folder `out` and return its path.

    The file appears whole or not at all; the same sources give the same bytes.
    """
    out.mkdir(parents=True, exist_ok=True)
    path = out / recipe.file_name
    write_archive(path, recipe.content())
    return path


def place(out: Path, recipe: Recipe) -> Path:
    """Where the FMU of a recipe lies in a folder that runs and trains share, or will: named by its digest.

    One of its plain name serves as well if it has its GUID.
    """
    stored, plain = out / recipe.stored_name, out / recipe.file_name
    return plain if not stored.exists() and not is_stale(plain, recipe) else stored


def refresh(out: Path, recipes: Iterable[Recipe], own: bool = False) -> list[Path]:
    """Build what `out` lacks, or does not hold byte for byte; return the paths of these files only.

    Parameters
    ----------
    out : Path
        Shared by any number of runs at once: a file appears whole, and what is in it follows from its name.
    recipes : iterable of Recipe
        The units.
    own : bool
        The folder is this program's own, where whatever is damaged is replaced.

    Raises
    ------
    NotOursError
        When a file is in the place of an FMU that this program did not write.
    """
    built = []
    for recipe in recipes:
        content, target = recipe.content(), out / recipe.stored_name
        if holds(place(out, recipe), content):
            continue
        if target.exists() and not (own or as_written(target)):
            raise NotOursError(
                f"{target}: is not what bladeloss builds under this name, and is left as it is; move it, or "
                "name another folder with --fmus"
            )
        out.mkdir(parents=True, exist_ok=True)
        write_archive(target, content)
        built.append(target)
    return built


def is_stale(path: Path, recipe: Recipe) -> bool:
    """Tell whether the FMU at `path` is missing or made from other sources or data than now."""
    return guid_in(path) != f"{{{recipe.guid}}}"
