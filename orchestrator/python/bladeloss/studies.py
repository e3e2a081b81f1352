"""Studies: many runs over samples of a scenario's parameters, or many values of any function."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import xarray as xr
from rich.console import Console

from orchestrator.fmi.folder import fmu_folder
from orchestrator.results.folder import named
from orchestrator.study.ensemble.conduct import Means, conduct, plan_of
from orchestrator.study.ensemble.sampling.file import read_study_file


def study(
    source: str | Path | Mapping[str, Any],
    *,
    out: str | Path | None = None,
    function: Callable[..., Mapping[str, float] | float] | None = None,
    fmus: str | Path | None = None,
    jobs: int | None = None,
    scheduler: str | None = None,
    limit: float = 0.0,
    trust: bool = False,
    progress: bool | None = None,
) -> xr.Dataset:
    """Carry out a study, or what is missing of it, and return its dataset; needs the extra ``study``.

    Parameters
    ----------
    source : str, Path or mapping
        A study's TOML file, or what one says.
    out : str or Path, optional
        Folder of the study; nothing is kept without it.
    function : callable, optional
        In place of runs of a scenario: called with the parameters as keywords (and ``depth`` where the study
        has depths), returns a number or numbers by name. It runs in processes of its own.
    fmus : str or Path, optional
        Folder of the FMUs; by default in the user's cache.
    jobs : int, optional
        Runs at once; one a core.
    scheduler : str, optional
        Address of a Dask cluster in place of this machine's cores.
    limit : float
        Wall time in s that a run may take; 0 for any.
    trust : bool
        Run FMUs of others, native code with all your rights.
    progress : bool, optional
        Show how far it is; by default on a terminal and in a notebook.

    Returns
    -------
    xarray.Dataset
        Dimensions sample and depth, for figures period and bearing; parameters are coordinates.

    Raises
    ------
    Error
        For anything wrong with the input; nothing has run then. A run that fails is a row with its outcome.
    """
    console = Console(stderr=True)
    shown = console.is_terminal or console.is_jupyter if progress is None else progress
    file = read_study_file(source, of_runs=function is None)
    with tempfile.TemporaryDirectory() as own:
        means = Means(
            Path(own) / "study" if out is None else named(Path(out)),
            fmu_folder() if fmus is None else Path(fmus),
            jobs,
            scheduler,
            limit=limit,
            trust=trust,
            console=console if shown else Console(quiet=True),
        )
        return conduct(file, plan_of(file, means, function), means)
