"""The folder of FMUs: what is missing, or not to the byte what this program builds, is built."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from pathlib import Path

import platformdirs
from rich.console import Console

from bearing_fmu import depths
from bearing_fmu.recipe import bearing_recipe
from fmus.build import builder
from fmus.build.recipe import Recipe
from orchestrator.errors import FmuError
from orchestrator.fmi.blas import one_blas_thread
from orchestrator.fmi.cache import prune, used
from orchestrator.scenario.file import read_train
from orchestrator.scenario.parameters import bearing_parameters
from orchestrator.scenario.scenario import Scenario, is_fmu
from rotor_fmu.recipe import rotor_recipe
from rotor_fmu.train.train import Train


def fmu_folder() -> Path:
    """Where the FMUs of runs lie by default: in the user's cache."""
    return platformdirs.user_cache_path("bladeloss", appauthor=False) / "fmus"


def recipes(trains: Iterable[Train], names: Iterable[str]) -> list[Recipe]:
    """A rotor for each train, a bearing for each of these depths; ValueError for an unfit name."""
    return [rotor_recipe(train) for train in trains] + [bearing_recipe(name) for name in names]


def build(out: Path, trains: Iterable[Train] = (), names: Iterable[str] | None = None) -> list[Path]:
    """Build the rotors of trains and the bearings of depths, by default of all, in the folder `out`."""
    return builder.build(out, recipes(trains, depths.names() if names is None else names))


@one_blas_thread()
def ensure_fmus(folder: Path, train: Train, names: Collection[str], console: Console) -> list[Path]:
    """Build the FMUs that a run needs and the folder lacks, or does not hold byte for byte.

    Parameters
    ----------
    folder : Path
        Folder of the FMUs, made if missing; any number of runs may share it.
    train : Train
        The train; its rotor is one FMU.
    names : collection of str
        Depths of the bearings; one FMU each. Paths of FMUs are left alone.
    console : rich.console.Console
        Told what was built.

    Returns
    -------
    list of Path
        The files built.

    Raises
    ------
    FmuError
        When the folder cannot be written to, or holds something else in the place of an FMU.
    """
    own = folder.absolute() == fmu_folder().absolute()
    try:
        wanted = recipes([train], sorted(name for name in names if not is_fmu(name)))
        built = builder.refresh(folder, wanted, own)
        if own:
            used(builder.place(folder, recipe) for recipe in wanted)
            if built:
                prune(folder)
    except OSError as error:
        raise FmuError(
            f"{folder}: FMUs cannot be built there: {error}; --fmus names another folder"
        ) from error
    except ValueError as error:
        raise FmuError(str(error)) from error
    if built:
        console.print(f"Built {', '.join(str(path) for path in built)}", highlight=False, soft_wrap=True)
    return built


def do_ahead(scenario: Scenario, train: Train, names: Collection[str], console: Console) -> None:
    """Do what the depths do once for bearings of a kind, such as to build a table; tell of it.

    Parameters
    ----------
    scenario, train : Scenario, Train
        Films and bearings.
    names : collection of str
        Depths in use.
    console : rich.console.Console
        Told what was done.

    Raises
    ------
    FmuError
        When a bearing cannot have this depth.
    """
    for depth in depths.depths():
        if not depth.ahead or depth.name not in names:
            continue
        for seat in train.bearings:
            if not seat.has_film or depth.name not in (scenario.depth_of(seat.name), scenario.linear_from):
                continue
            try:
                line = depth.prepare(bearing_parameters(seat, scenario.film))
            except ValueError as error:
                raise FmuError(f"bearing {seat.name}: {error}") from None
            if line:
                console.print(line, highlight=False, soft_wrap=True)


@one_blas_thread()
def build_all(folder: Path, trains: Sequence[str], console: Console) -> list[Path]:
    """Build the rotors of trains, given by name or folder, and a bearing of each depth.

    Raises
    ------
    OrchestratorError
        When a train cannot be read.
    FmuError
        When an FMU cannot be built.
    """
    loaded = [read_train(name) for name in trains]
    try:
        built = build(folder, loaded)
    except (OSError, ValueError) as error:
        raise FmuError(f"{folder}: {error}") from error
    for path in built:
        console.print(f"{path}  {path.stat().st_size / 1e6:.2f} MB", highlight=False, soft_wrap=True)
    return built
