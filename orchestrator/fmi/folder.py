"""The folder of FMUs: what is missing or stale is built."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path

from rich.console import Console

from fmus.build.builder import build, refresh
from orchestrator.errors import FmuError
from orchestrator.fmi.blas import one_blas_thread
from orchestrator.scenario.file import read_train
from orchestrator.scenario.scenario import is_fmu
from rotor_fmu.train.train import Train


@one_blas_thread()
def ensure_fmus(folder: Path, train: Train, depths: Collection[str], console: Console) -> list[Path]:
    """Build the FMUs that a run needs and the folder lacks, or holds from other sources or data.

    Parameters
    ----------
    folder : Path
        Folder of the FMUs, made if missing.
    train : Train
        The train; its rotor is one FMU.
    depths : collection of str
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
        When the folder cannot be written to.
    """
    try:
        built = refresh(folder, [train], sorted(depth for depth in depths if not is_fmu(depth)))
    except OSError as error:
        raise FmuError(f"{folder}: FMUs cannot be built there: {error}") from error
    if built:
        console.print(f"Built {', '.join(str(path) for path in built)}", highlight=False, soft_wrap=True)
    return built


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
