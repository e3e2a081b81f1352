"""Builds the FMUs: one for the rotor of each train, one for each bearing depth."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

from fmus import port
from fmus.build.archive import guid_in, write_archive
from fmus.build.recipe import Recipe
from rotor_fmu.start_values import default_starts
from rotor_fmu.train.train import Train

DEFAULT_TRAIN = "turbine"
DEPTHS = {
    "v1": "Journal bearing: Reynolds equation with misalignment and solid contact.",
    "v2": "Journal bearing: Reynolds equation of the aligned journal, with solid contact.",
    "v3": "Journal bearing: short-bearing formula, with solid contact.",
}


def build(out: Path, trains: Sequence[Train] = (), depths: Sequence[str] = tuple(DEPTHS)) -> list[Path]:
    """Build FMUs in the folder `out`.

    Parameters
    ----------
    out : Path
        Folder, made if missing.
    trains : sequence of Train
        One rotor FMU for each.
    depths : sequence of str
        Keys of `DEPTHS`, one bearing FMU for each.

    Returns
    -------
    list of Path
        The files, rotors first.

    Raises
    ------
    ValueError
        If a depth or the name of a train is not allowed.
    """
    recipes = [rotor_recipe(train) for train in trains] + [bearing_recipe(depth) for depth in depths]
    return [write(recipe, out) for recipe in recipes]


def refresh(out: Path, trains: Sequence[Train] = (), depths: Sequence[str] = tuple(DEPTHS)) -> list[Path]:
    """Build what is missing or stale in `out`; return the paths of these files only."""
    recipes = [rotor_recipe(train) for train in trains] + [bearing_recipe(depth) for depth in depths]
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


def bearing_recipe(depth: str, starts: Mapping[str, port.Value] | None = None) -> Recipe:
    """Return the recipe of the bearing of one depth, with start values of your own if you like."""
    if depth not in DEPTHS:
        raise ValueError(f"bearing depth {depth!r}: allowed are {', '.join(DEPTHS)}")
    return Recipe(
        file_name=f"bearing_{depth}.fmu",
        name=f"bladeloss_bearing_{depth}",
        description=DEPTHS[depth],
        facade="bearing_fmu.facade",
        facade_class="BearingSlave",
        packages=("fmus", "bearing_fmu"),
        variables=lambda: port.BEARING,
        arguments={"depth": depth, "starts": dict(sorted((starts or {}).items()))},
        starts=starts or {},
        memoryless=True,
    )


def rotor_recipe(train: Train, starts: Mapping[str, port.Value] | None = None) -> Recipe:
    """Return the recipe of the rotor of a train, with start values of your own if you like."""
    if not re.fullmatch(r"[A-Za-z0-9_]+", train.name):
        raise ValueError(f"train name {train.name!r}: allowed are letters, digits and underscores")
    return Recipe(
        file_name="rotor.fmu" if train.name == DEFAULT_TRAIN else f"rotor_{train.name}.fmu",
        name=f"bladeloss_rotor_{train.name}",
        description=f"Rotor of the train {train.name}: {train.length:g} m, {len(train.bearings)} bearings.",
        facade="rotor_fmu.facade",
        facade_class="RotorSlave",
        packages=("fmus", "rotor_fmu"),
        variables=partial(_rotor_port, train),
        resources={"train.json": train.to_json().encode()},
        keeps_starts=True,
        builder_modules=("rotor_fmu.start_values",),
        starts=starts or {},
    )


def _rotor_port(train: Train) -> tuple[port.Variable, ...]:
    names = [b.name for b in train.bearings], [w.name for w in train.wheels]
    return port.rotor(*names, train.nodes, default_starts(train))
