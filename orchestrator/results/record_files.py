"""The record on disk: NetCDF for analysis, CSV for FMI tools."""

from __future__ import annotations

import json
import uuid
from collections.abc import Callable, Iterator
from io import BytesIO
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

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
    """Read ``record.nc``, given the file or its folder, into memory.

    Given the folder of a checkpoint, it is the record so far of a run that goes on, or was killed.
    """
    blocks = blocks_in(path) if path.is_dir() and not (path / RECORD_FILE).is_file() else []
    if blocks:
        return _joined([_read_block(part) for part in blocks])
    with xr.open_dataset(path / RECORD_FILE if path.is_dir() else path, engine="h5netcdf") as record:
        return record.load()


def block_name(row: int) -> str:
    """Name of the file with the records of a run from a row on, while it goes on."""
    return f"record-{row:09d}.npz"


def blocks_in(folder: Path) -> list[Path]:
    """Those files of a folder, in order."""
    return sorted(folder.glob(f"record-{9 * '[0-9]'}.npz"))


def block(data: xr.Dataset) -> bytes:
    """Return a dataset as the content of such a file: a hundredth of the time that NetCDF takes."""
    variables = {str(name): variable for name, variable in data.variables.items()}
    words = {
        "attributes": data.attrs,
        "coordinates": [str(name) for name in data.coords],
        "variables": {name: [x.dims, x.attrs] for name, x in variables.items()},
    }
    content = BytesIO()
    arrays: dict[str, Any] = {"": json.dumps(words), **{name: x.values for name, x in variables.items()}}
    np.savez(content, **arrays)
    return content.getvalue()


def _read_block(path: Path) -> xr.Dataset:
    try:
        with np.load(path) as stored:
            words = json.loads(str(stored[""]))
            found = {name: (dims, stored[name], attrs) for name, (dims, attrs) in words["variables"].items()}
    except (BadZipFile, EOFError) as error:  # cut off by a power failure, say
        raise ValueError(f"{path.name}: {error}") from None
    return xr.Dataset(found, attrs=words["attributes"]).set_coords(words["coordinates"])


def _joined(parts: list[xr.Dataset]) -> xr.Dataset:
    """One record of parts that follow one another; what has no instants is the last one's."""
    last = parts[-1]
    for dimension in {"time", "revolution"} & set(last.dims):
        names = [name for name, variable in last.variables.items() if dimension in variable.dims]
        of_all = xr.concat([part[names] for part in parts], dimension, join="override")
        last = last.drop_dims(dimension).merge(of_all, compat="override")
    return last.assign_attrs(parts[-1].attrs)


def table_columns(record: xr.Dataset) -> Iterator[tuple[str, NDArray[np.float64]]]:
    """Yield the columns of the CSV: ``time``, then every series of a bearing or of the whole shaft.

    Names follow ``bearing.quantity_axis [unit]``, or ``_pad`` by its number, without commas.
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
            if values.ndim == 1:
                yield f"{name}.{label}{unit}", values.values
                continue
            part = str(values.dims[1])  # x and y, or the pads by their number
            parts = record[part].values if part in record.coords else range(1, values.sizes[part] + 1)
            for j, word in enumerate(parts):
                yield f"{name}.{label}_{word}{unit}", values.isel({part: j}).values


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
