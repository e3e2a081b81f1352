"""The record on disk: NetCDF for analysis, CSV for FMI tools."""

from __future__ import annotations

import uuid
from collections.abc import Callable, Iterator
from io import BytesIO
from pathlib import Path

import h5netcdf
import numpy as np
import xarray as xr
from numpy.typing import NDArray
from xarray.backends import H5NetCDFStore

RECORD_FILE = "record.nc"
TABLE_FILE = "record.csv"


def write_record(record: xr.Dataset, folder: Path) -> tuple[Path, Path]:
    """Write ``record.nc`` and ``record.csv``.

    Parameters
    ----------
    record : xarray.Dataset
        As in `orchestrator.case.simulate.Result`.
    folder : Path
        Made if missing. Each file appears whole or not at all.

    Returns
    -------
    tuple of Path
        The two files.
    """
    folder.mkdir(parents=True, exist_ok=True)
    record_path, table_path = folder / RECORD_FILE, folder / TABLE_FILE
    _write_whole(record_path, lambda path: path.write_bytes(netcdf(record)))
    _write_whole(table_path, lambda path: _write_table(record, path))
    return record_path, table_path


def netcdf(data: xr.Dataset) -> bytes:
    """Return a dataset as the content of a NetCDF file, with its numbers compressed.

    It is made in memory, because HDF5 writing to a disk that is full ends the process.
    """
    numeric = [name for name, variable in data.variables.items() if variable.dtype.kind == "f"]
    encoding = {
        # CF allows no missing values in a coordinate, and nothing has a value that stands for one
        name: {"_FillValue": None} | ({"zlib": True, "complevel": 1} if data[name].ndim else {})
        for name in numeric
    }
    content = BytesIO()
    with h5netcdf.File(content, "w") as file:
        data.dump_to_store(H5NetCDFStore(file), encoding=encoding)
    return content.getvalue()


def read_record(path: Path) -> xr.Dataset:
    """Read ``record.nc``, given the file or its folder, into memory."""
    with xr.open_dataset(path / RECORD_FILE if path.is_dir() else path, engine="h5netcdf") as record:
        return record.load()


def table_columns(record: xr.Dataset) -> Iterator[tuple[str, NDArray[np.float64]]]:
    """Yield the columns of the CSV: ``time``, then every series of a bearing or of the whole shaft.

    Names follow ``bearing.quantity_axis [unit]``, without commas.
    """
    yield "time", record["time"].values
    names = [str(name).replace(",", ";") for name in record["bearing"].values]
    for label, series in record.data_vars.items():
        if series.dims[:1] != ("time",) or "node" in series.dims:
            continue
        unit = f" [{series.attrs['units']}]"
        if "bearing" not in series.dims:
            yield f"{label}{unit}", series.values
            continue
        for i, name in enumerate(names):
            values = series.isel(bearing=i)
            if "axis" not in series.dims:
                yield f"{name}.{label}{unit}", values.values
                continue
            for j, axis in enumerate(record["axis"].values):
                yield f"{name}.{label}_{axis}{unit}", values.isel(axis=j).values


def _write_table(record: xr.Dataset, path: Path) -> None:
    names, columns = zip(*table_columns(record), strict=True)
    with path.open("w", encoding="utf-8", newline="\n") as file:
        np.savetxt(file, np.column_stack(columns), "%.10g", ",", header=",".join(names), comments="")


def _write_whole(path: Path, write: Callable[[Path], object]) -> None:
    """Write beside the target and move the finished file there."""
    part = path.with_name(f".{path.stem}_{uuid.uuid4().hex}{path.suffix}")
    try:
        write(part)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
