"""Reading the own NetCDF files gives what xarray reads, and files of others are left to it."""

from errno import EFBIG

import h5netcdf
import numpy as np
import pytest
import xarray as xr

from orchestrator.results import netcdf
from orchestrator.results.record_files import _TABLE, _NeverFull, read_record, write_record
from tests.orchestrator.limits import largest_file
from tests.orchestrator.results.synthetic_record import record


def read_by_xarray(path):
    with xr.open_dataset(path, engine="h5netcdf") as data:
        return data.load()


@pytest.fixture
def not_left(monkeypatch):
    """What is read without xarray's own way."""

    def left(*_, **__):
        raise AssertionError("left to xarray")

    monkeypatch.setattr(xr, "load_dataset", left)


def every_kind():
    """Texts, truth, whole numbers, missing ones, no rows, a single one, attributes of every kind."""
    return xr.Dataset(
        {
            "missing": (("time", "axis"), np.array([[1.0, np.nan], [np.inf, -0.0]]), {"units": "N"}),
            "single": ((), 3.0),
            "none": (("nothing",), np.zeros(0)),
            "bare": (("four",), np.arange(4.0, dtype="float32")),
            "words": (("axis",), ["µm", ""]),
            "whole": (("time",), np.array([1, -(2**40)])),
        },
        coords={
            "time": ("time", [0.0, 1e-3], {"units": "s"}),
            "axis": ["x", "y"],
            "true": ("axis", [True, False]),
        },
        attrs={
            "text": "°",
            "empty": "",
            "number": 1.5,
            "three": [1, 2, 3],
            "one": [1.0],
            "words": ["a", "b"],
        },
    )


@pytest.mark.parametrize("data", [every_kind(), xr.Dataset()], ids=["every kind", "nothing"])
def test_all_is_read_as_xarray_reads_it(data, not_left, tmp_path):
    path = tmp_path / "data.nc"
    data.to_netcdf(path, engine="h5netcdf")
    found, expected = netcdf.load(path), read_by_xarray(path)
    xr.testing.assert_identical(found, expected)
    assert list(found.data_vars) == list(expected.data_vars) and list(found.coords) == list(expected.coords)
    assert {name: v.dtype for name, v in found.variables.items()} == {
        name: v.dtype for name, v in expected.variables.items()
    }
    assert {name: type(value) for name, value in found.attrs.items()} == {
        name: type(value) for name, value in expected.attrs.items()
    }


def test_a_record_is_read_as_xarray_reads_it(not_left, tmp_path):
    path, _ = write_record(record(), tmp_path)
    xr.testing.assert_identical(read_record(tmp_path), read_by_xarray(path))


def test_what_others_laid_out_is_left_to_xarray(tmp_path):
    with h5netcdf.File(tmp_path / "other.nc", "w") as file:
        file.dimensions = {"x": 2}
        file.create_variable("numbers", ("x",), float)[:] = [1.0, 2.0]
        file.create_group("more").create_variable("further", ("x",), float)
    found = netcdf.load(tmp_path / "other.nc")
    assert list(found.variables) == ["numbers"] and found["numbers"].values.tolist() == [1.0, 2.0]


def test_what_is_no_such_file_is_an_error_of_reading(tmp_path):
    (tmp_path / "text.nc").write_text("nothing")
    for name in ("text.nc", "none.nc"):
        with pytest.raises(OSError):
            netcdf.load(tmp_path / name)


def test_a_file_without_room_reads_what_was_written_of_tables(tmp_path):
    """HDF5 reads them again, and ends the process where they are something else."""

    def found(start, count):
        buffer = bytearray(b"?" * count)
        file.seek(start)
        assert file.readinto(buffer) == count and file.tell() == start + count
        return bytes(buffer)

    with _NeverFull(tmp_path / "full", "w+b") as file, largest_file(100):
        assert file.write(b"a" * 80) == 80
        assert file.fault is None
        for content in (b"b" * 50, b"c" * (_TABLE + 1), b"d" * 10):
            assert file.write(content) == len(content)
        assert file.fault.errno == EFBIG
        assert found(70, 60) == b"a" * 10 + b"b" * 50
        file.seek(125)
        file.write(b"e" * 3)
        assert found(120, 12) == b"bbbbbeeebb" + bytes(2)
        assert found(130 + _TABLE, 12) == b"\0" + b"d" * 10 + b"\0"
