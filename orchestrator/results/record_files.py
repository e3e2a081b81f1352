"""The record on disk: NetCDF for analysis, CSV for FMI tools."""

from __future__ import annotations

import uuid
from collections.abc import Callable, Iterator
from io import BytesIO, FileIO
from pathlib import Path
from typing import Any

import h5netcdf
import numpy as np
import xarray as xr
from numpy.typing import NDArray
from xarray.backends import H5NetCDFStore
from xarray.backends.common import ArrayWriter

from orchestrator.results.growing_record import GROWING, HEAD_FILE, is_growing, open_growing
from orchestrator.results.netcdf import load

RECORD_FILE = "record.nc"
TABLE_FILE = "record.csv"

_PART = 2**20
"""Bytes of a series that are in memory at a time while it is written."""
_LINES = 1000
"""Likewise, of a table."""


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
    _write_whole(record_path, lambda path: _write_netcdf(record, path))
    _write_whole(table_path, lambda path: _write_table(record, path))
    return record_path, table_path


def netcdf(data: xr.Dataset) -> bytes:
    """Return a dataset as the content of a NetCDF file, with its numbers compressed.

    It is made in memory, because HDF5 writing to a disk that is full ends the process.
    """
    content = BytesIO()
    with h5netcdf.File(content, "w") as file:
        data.dump_to_store(H5NetCDFStore(file), encoding=_encoding(data))
    return content.getvalue()


def _encoding(data: xr.Dataset) -> dict[Any, dict[str, Any]]:
    numeric = [name for name, variable in data.variables.items() if variable.dtype.kind == "f"]
    return {
        # CF allows no missing values in a coordinate, and nothing has a value that stands for one
        name: {"_FillValue": None} | ({"zlib": True, "complevel": 1} if data[name].ndim else {})
        for name in numeric
    }


def _write_netcdf(record: xr.Dataset, path: Path) -> None:
    """Write a record, part by part: what `netcdf` returns, but never all of it in memory."""
    series = {
        str(name): variable
        for name, variable in record.variables.items()
        if variable.dims[:1] in [(dimension,) for dimension in GROWING] and str(name) not in record.indexes
    }
    drawn = {  # takes the room of no more than a number
        name: variable.copy(data=np.broadcast_to(np.zeros((), variable.dtype), variable.shape))
        for name, variable in series.items()
    }
    with _NeverFull(path, "w+b") as file:
        try:
            with h5netcdf.File(file, "w") as store:
                data = record.assign(drawn)
                writer = _Without(set(series))
                data.dump_to_store(H5NetCDFStore(store), encoding=_encoding(data), writer=writer)
                for name, variable in series.items():
                    rows = max(1, _PART // max(1, variable.nbytes // max(1, variable.shape[0])))
                    for row in range(0, variable.shape[0], rows):
                        store[name][row : row + rows] = variable[row : row + rows].values
        except (OSError, RuntimeError):  # it found not what it had written
            if file.fault is None:
                raise
        if file.fault is not None:
            raise file.fault


class _Without(ArrayWriter):
    """Writes variables, but for some whose place is only laid out."""

    def __init__(self, without: set[str]) -> None:
        super().__init__()
        self._without = without

    def add(self, source: Any, target: Any, region: Any = None) -> None:
        """Write one."""
        if target.variable_name not in self._without:
            super().add(source, target, region)


_TABLE = 1 << 16
"""Bytes that HDF5 writes of a table at most, at once."""


class _NeverFull(FileIO):
    """A file that takes what there is no room for: HDF5 ends the process at an error.

    It reads what it has written of its tables, too, and ends the process where that is something else; so
    these, which are small, are kept in memory. Numbers are dropped.

    Attributes
    ----------
    fault : OSError or None
        What came first.
    """

    fault: OSError | None = None

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self._kept: list[tuple[int, bytes]] = []

    def write(self, content: Any) -> int:
        """Write, or go on as if."""
        start, count = self.tell(), memoryview(content).nbytes
        if self.fault is None:
            try:
                return self._write(content, count)
            except OSError as error:
                self.fault = error
        if count <= _TABLE:
            self._kept.append((start, bytes(content)))
        self.seek(start + count)
        return count

    def readinto(self, buffer: Any) -> int:
        """Read what was written, zeros in place of what was dropped."""
        target = memoryview(buffer).cast("B")
        start, count = self.tell(), len(target)
        found = super().readinto(target)
        if self.fault is not None:
            target[found:] = bytes(count - found)
            for at, content in self._kept:  # what was written later counts
                first, last = max(at, start), min(at + len(content), start + count)
                if first < last:
                    target[first - start : last - start] = content[first - at : last - at]
            found = count
        self.seek(start + found)
        return found

    def truncate(self, size: int | None = None) -> int:
        """Make the file as long, or go on as if."""
        if self.fault is None:
            try:
                return super().truncate(size)
            except OSError as error:
                self.fault = error
        return self.tell() if size is None else size

    def _write(self, content: Any, count: int) -> int:
        done = 0
        while done < count:
            done += super().write(memoryview(content).cast("B")[done:])
        return count


def is_newer(growing: Path, folder: Path) -> bool:
    """Whether a record that grows in one folder is not, or not yet, the record in the other."""
    head, whole = growing / HEAD_FILE, folder / RECORD_FILE
    return head.is_file() and not (whole.is_file() and whole.stat().st_mtime_ns >= head.stat().st_mtime_ns)


def read_record(path: Path) -> xr.Dataset:
    """Read ``record.nc``, given the file or its folder, into memory.

    Given the folder of a checkpoint, it is the record so far of a run that goes on, or was killed.
    """
    if path.is_dir() and not (path / RECORD_FILE).is_file() and is_growing(path):
        growing = open_growing(path)
        growing.check_size()
        return growing.dataset().load()
    return load(path / RECORD_FILE if path.is_dir() else path)


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
    with path.open("w", encoding="utf-8", newline="\n") as file:
        for row in range(0, max(1, record.sizes["time"]), _LINES):
            names, columns = zip(*table_columns(record.isel(time=slice(row, row + _LINES))), strict=True)
            header = "" if row else ",".join(names)
            np.savetxt(file, np.column_stack(columns), "%.10g", ",", header=header, comments="")


def _write_whole(path: Path, write: Callable[[Path], object]) -> None:
    """Write beside the target and move the finished file there."""
    part = path.with_name(f".{path.stem}_{uuid.uuid4().hex}{path.suffix}")
    try:
        write(part)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
