"""The files of a study, and how its dataset is read."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from orchestrator.results.netcdf import load

DATA, TABLE, SAMPLES, SIGN = "study.nc", "study.csv", "samples.csv", "study.toml"
"""Dataset, table of one number a run, samples, and the study as it was asked for."""
RUNS, WORST = "runs", "worst"
"""Folders of what was kept of each run, and of the results of the worst ones."""


def is_study(path: Path) -> bool:
    """Whether a folder holds a study."""
    return (path / DATA).is_file() and (path / RUNS).is_dir()


def read_study(folder: Path) -> xr.Dataset:
    """The dataset of a study, in memory."""
    return load(folder / DATA)


def name_of_run(sample: int, depth: str) -> str:
    """Of the folder of a run's own results."""
    return f"{sample:05d}-{depth}"
