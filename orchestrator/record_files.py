"""The record on disk: NetCDF for analysis, CSV for FMI tools."""

from __future__ import annotations

from pathlib import Path

import xarray as xr


def write_record(record: xr.Dataset, folder: Path) -> tuple[Path, Path]:
    """Write ``record.nc`` and ``record.csv``.

    Parameters
    ----------
    record : xarray.Dataset
        As in `orchestrator.simulate.Result`.
    folder : Path
        Made if missing. Each file appears whole or not at all.

    Returns
    -------
    tuple of Path
        The two files.
    """
    raise NotImplementedError


def read_record(path: Path) -> xr.Dataset:
    """Read ``record.nc``, given the file or its folder, into memory."""
    raise NotImplementedError
