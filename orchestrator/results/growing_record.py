"""A record on disk that grows while its run goes on.

One file has the numbers, block behind block: of each series over time or revolutions in turn the rows that
came since the block before.  The head, put in its place whole behind each block, has all else: what the
series are, attributes, and how many rows each block has.  What a killed process wrote behind the last
block that the head counts is none of the record.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterator
from dataclasses import dataclass
from io import BytesIO
from itertools import accumulate
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from xarray.backends import BackendArray
from xarray.core import indexing

from orchestrator.whole_file import whole_file

HEAD_FILE, ROWS_FILE = "record-head.npz", "record-rows.bin"
GROWING = ("time", "revolution")
"""Dimensions over which it grows."""

Counts = tuple[int, ...]
"""Rows over each of `GROWING`."""


class GrowingRecordError(ValueError):
    """Files that are no record, or not the one that is meant."""


@dataclass(frozen=True)
class GrowingRecord:
    """A record in a folder.

    Attributes
    ----------
    folder : Path
        Of both files.
    rest : xarray.Dataset
        What does not grow, and the growing series without rows.
    blocks : tuple of Counts
        Rows of each block.
    """

    folder: Path
    rest: xr.Dataset
    blocks: tuple[Counts, ...] = ()

    @property
    def counts(self) -> Counts:
        """Rows in all."""
        return tuple(sum(block[k] for block in self.blocks) for k in range(len(GROWING)))

    @property
    def layout(self) -> list[tuple[str, str, tuple[int, ...], int]]:
        """Name, type, shape of a row and growing dimension of each series, in the order of a block."""
        found = []
        for name, variable in self.rest.variables.items():
            if set(GROWING) & set(variable.dims):
                which = GROWING.index(str(variable.dims[0]))
                found.append((str(name), variable.dtype.str, variable.shape[1:], which))
        return found

    def first(self, counts: Counts) -> GrowingRecord:
        """The record up to the end of the block by which it had these rows.

        Raises
        ------
        GrowingRecordError
            When no block ended there, or the file is too short for it.
        """
        sums = [tuple(map(sum, zip(*self.blocks[:k], strict=True))) for k in range(len(self.blocks) + 1)]
        sums[0] = (0,) * len(GROWING)
        if counts not in sums:
            here, asked = (" and ".join(map(str, c)) for c in (self.counts, counts))
            raise GrowingRecordError(
                f"{self.folder / HEAD_FILE}: has {here} rows over {' and '.join(GROWING)} in "
                f"{len(self.blocks)} blocks, none of which ends at the {asked} that are asked for"
            )
        part = GrowingRecord(self.folder, self.rest, self.blocks[: sums.index(counts)])
        part.check_size()
        return part

    def check_size(self) -> None:
        """Raise GrowingRecordError when the file of rows is too short."""
        path, needed = self.folder / ROWS_FILE, self._bytes
        found = path.stat().st_size if path.is_file() else 0
        if found < needed:
            raise GrowingRecordError(f"{path}: has {found} bytes of {needed}")

    def append(self, data: xr.Dataset) -> GrowingRecord:
        """Write a block of rows, and the head with what else the data hold; return the record with it.

        Raises
        ------
        OSError
            When it cannot be written; the record is what it was.
        GrowingRecordError
            When rows that were written before are not there any more, or the data have other series.
        """
        counts = tuple(data.sizes.get(dimension, 0) for dimension in GROWING)
        rest = _without_rows(data)
        grown = GrowingRecord(self.folder, rest, (*self.blocks, counts) if any(counts) else self.blocks)
        if self.blocks and grown.layout != self.layout:
            raise GrowingRecordError(f"{self.folder / HEAD_FILE}: is of a record with other series")
        self.check_size()
        self.folder.mkdir(parents=True, exist_ok=True)
        path = self.folder / ROWS_FILE
        with path.open("r+b" if path.exists() else "w+b") as file:
            file.seek(self._bytes)
            for name, *_ in grown.layout:
                file.write(np.ascontiguousarray(data[name].values).data)
            file.truncate()
            file.flush()
            os.fsync(file.fileno())
        grown.write_head()
        return grown

    def dataset(self, rest: xr.Dataset | None = None) -> xr.Dataset:
        """The whole record, whose series are read where they are used.

        Parameters
        ----------
        rest : xarray.Dataset, optional
            With what does not grow, and attributes, in place of those in the head.
        """
        rest = self.rest if rest is None else rest
        series: dict[str, xr.Variable] = {}
        for name, kind, shape, _ in self.layout:
            parts = tuple(self._parts(name))
            array = _Series(self.folder / ROWS_FILE, np.dtype(kind), shape, parts)
            variable = rest.variables[name]
            lazy = indexing.LazilyIndexedArray(array)
            series[name] = xr.Variable(variable.dims, lazy, variable.attrs)
        variables = {str(name): series.get(str(name), variable) for name, variable in rest.variables.items()}
        return xr.Dataset(variables, attrs=rest.attrs).set_coords(list(rest.coords))

    def _parts(self, wanted: str) -> Iterator[tuple[int, int]]:
        """Place in the file and rows of a series in each block."""
        at = 0
        for block in self.blocks:
            for name, kind, shape, which in self.layout:
                if name == wanted:
                    yield at, block[which]
                at += block[which] * np.dtype(kind).itemsize * math.prod(shape)

    @property
    def _bytes(self) -> int:
        """Of the file of rows."""
        rows = self.counts
        sizes = ((which, np.dtype(kind).itemsize * math.prod(shape)) for _, kind, shape, which in self.layout)
        return sum(rows[which] * size for which, size in sizes)

    def write_head(self) -> None:
        """Put the head in its place, so that the record ends with the blocks of this one."""
        rest, path = self.rest, self.folder / HEAD_FILE
        words = {
            "attributes": rest.attrs,
            "coordinates": [str(name) for name in rest.coords],
            "variables": {str(name): [x.dims, x.attrs] for name, x in rest.variables.items()},
            "blocks": self.blocks,
        }
        content = BytesIO()
        arrays: dict[str, Any] = {str(name): x.values for name, x in rest.variables.items()}
        np.savez(content, **{"": json.dumps(words), **arrays})
        with whole_file(path) as file:  # on disk, for a checkpoint that counts its rows comes behind it
            file.write(content.getvalue())


def is_growing(folder: Path) -> bool:
    """Whether a folder holds such a record."""
    return (folder / HEAD_FILE).is_file()


def files_of(folder: Path) -> tuple[Path, ...]:
    """The files of such a record in a folder, there or not."""
    return folder / HEAD_FILE, folder / ROWS_FILE


def open_growing(folder: Path) -> GrowingRecord:
    """Open the record in a folder.

    Raises
    ------
    GrowingRecordError
        When it is none, cut off by a power failure, say.
    """
    path = folder / HEAD_FILE
    try:
        with np.load(path) as stored:
            words = json.loads(str(stored[""]))
            found = {name: (dims, stored[name], attrs) for name, (dims, attrs) in words["variables"].items()}
        rest = xr.Dataset(found, attrs=words["attributes"]).set_coords(words["coordinates"])
        blocks = tuple((int(a), int(b)) for a, b in words["blocks"])
    except (OSError, BadZipFile, EOFError, KeyError, ValueError, TypeError, AttributeError) as error:
        reason = " ".join(f"{type(error).__name__}: {error}".split())
        raise GrowingRecordError(f"{path}: no record of a run that goes on: {reason}") from None
    return GrowingRecord(folder, rest, blocks)


def _without_rows(data: xr.Dataset) -> xr.Dataset:
    return data.isel({dimension: slice(0) for dimension in GROWING if dimension in data.dims}).load()


class _Series(BackendArray):
    """A series in the blocks of a file, of which only what is asked for is read."""

    def __init__(
        self, path: Path, kind: np.dtype[Any], row: tuple[int, ...], parts: tuple[tuple[int, int], ...]
    ) -> None:
        self._path, self.dtype, self._parts = path, kind, parts
        self.shape = (sum(rows for _, rows in parts), *row)

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.BASIC, self._read)

    def _read(self, key: tuple[Any, ...]) -> NDArray[Any]:
        first, *within = key
        wanted = np.arange(self.shape[0])[first]
        rows, size = np.atleast_1d(wanted), math.prod(self.shape[1:])
        ends = list(accumulate((count for _, count in self._parts), initial=0))
        found = np.empty((rows.size, *np.empty(self.shape[1:])[tuple(within)].shape), dtype=self.dtype)
        with self._path.open("rb") as file:
            for (at, count), begin in zip(self._parts, ends[:-1], strict=True):
                here = np.flatnonzero((rows >= begin) & (rows < begin + count))
                if here.size:
                    low, high = int(rows[here].min()) - begin, int(rows[here].max()) - begin + 1
                    file.seek(at + low * size * self.dtype.itemsize)
                    block = np.fromfile(file, self.dtype, (high - low) * size)
                    block = block.reshape(high - low, *self.shape[1:])
                    found[here] = block[(rows[here] - begin - low, *within)]
        return found.reshape(np.shape(wanted) + found.shape[1:])
