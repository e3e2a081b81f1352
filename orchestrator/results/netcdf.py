"""Reads NetCDF files that this package wrote, in a fifth of the time that xarray takes with h5netcdf.

h5netcdf looks up each dimension of each variable in the file several times, which for the hundred variables
of a record takes longer than their numbers. Here each is looked up once; what the attributes mean is left
to xarray.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import xarray as xr

_HIDDEN = frozenset(
    {"CLASS", "NAME", "REFERENCE_LIST", "DIMENSION_LIST"}
    | {"_Netcdf4Dimid", "_Netcdf4Coordinates", "_nc3_strict", "_NCProperties"}
)
_NO_VARIABLE = b"This is a netCDF dimension but not a netCDF variable."


def load(path: Path) -> xr.Dataset:
    """Return the whole content of a file, as ``xarray.load_dataset`` would.

    Files laid out in a way that this package does not use, with groups, say, are left to that.

    Raises
    ------
    OSError
        No such file, or none of HDF5.
    """
    with h5py.File(path) as file:
        try:
            raw = _raw(file)
        except (AttributeError, KeyError, TypeError, ValueError):  # not laid out so
            raw = None
    if raw is None:
        return xr.load_dataset(path, engine="h5netcdf")
    return xr.decode_cf(raw).load()


def _raw(file: h5py.File) -> xr.Dataset:
    """All variables with their attributes, undecoded."""
    items = dict(file.items())
    dimensions = {
        int(item.attrs["_Netcdf4Dimid"]): name
        for name, item in items.items()
        if item.attrs.get("CLASS") == b"DIMENSION_SCALE"
    }
    variables = {
        name: _variable(item, dimensions)
        for name, item in items.items()
        if not item.attrs.get("NAME", b"").startswith(_NO_VARIABLE)
    }
    return xr.Dataset(variables, attrs=_attributes(file))


def _variable(item: h5py.Dataset, dimensions: dict[int, str]) -> xr.Variable:
    own = item.attrs["_Netcdf4Coordinates"] if item.ndim else ()
    dims = [dimensions[int(number)] for number in own]
    if h5py.check_string_dtype(item.dtype):
        return xr.Variable(dims, item.asstr()[()], _attributes(item), {"dtype": str})
    return xr.Variable(dims, item[()], _attributes(item), {"dtype": item.dtype})


def _attributes(item: h5py.File | h5py.Dataset) -> dict[str, Any]:
    return {name: _plain(value) for name, value in item.attrs.items() if name not in _HIDDEN}


def _plain(value: Any) -> Any:
    """An attribute as h5netcdf tells it: texts as lists, one of anything without a list around it."""
    if not hasattr(value, "dtype") or not value.shape:
        if isinstance(value, bytes | h5py.Empty):
            raise ValueError(value)
        return value
    if value.dtype.kind in "OS":
        value = value.tolist()
    return value[0] if len(value) == 1 else value
