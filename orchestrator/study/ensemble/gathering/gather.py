"""The rows of a study as one dataset, and as a table; the same rows give the same bytes."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from orchestrator.results.ensemble.figures import FIGURES, one_number
from orchestrator.study.ensemble.running.row import NOT_REFINED, Row, Value
from orchestrator.study.ensemble.sampling.samples import Samples
from orchestrator.study.ensemble.sampling.schema import Study

_ORDER = ("period", "time", "bearing", "axis")
_PHASES = ("steady", "before", "after")


@dataclass(frozen=True)
class Rows:
    """Rows by sample and depth.

    Attributes
    ----------
    depths : sequence of str
        All of them, those of the first stage first.
    rows : mapping
        By sample and depth; those that are missing were not asked for.
    """

    depths: Sequence[str]
    rows: Mapping[tuple[int, str], Row]


def dataset_of(study: Study, samples: Samples, found: Rows) -> xr.Dataset:
    """Gather rows.

    Returns
    -------
    xarray.Dataset
        Dimensions sample and depth, for figures phase and bearing, for series time, too; parameters are
        coordinates along sample. What a run did not give is nan.
    """
    coords = _coords(found)
    sizes = {"sample": len(samples), "depth": len(found.depths)} | {k: len(v) for k, v in coords.items()}
    places = {dim: {value: k for k, value in enumerate(values)} for dim, values in coords.items()}
    arrays: dict[str, tuple[tuple[str, ...], np.ndarray[Any, Any], str]] = {}
    outcome = np.full((len(samples), len(found.depths)), NOT_REFINED, dtype=object)
    message = np.full(outcome.shape, "", dtype=object)
    for (sample, depth), row in sorted(found.rows.items()):
        at = sample, found.depths.index(depth)
        outcome[at], message[at] = row.outcome, row.message
        for name, value in row.values.items():
            if name not in arrays:
                arrays[name] = _empty(value, sizes)
            dims, array, _ = arrays[name]
            if dims[2:] != tuple(value.dims):
                continue
            if not value.dims:
                array[at] = value.data
                continue
            inner = np.ix_(*([places[dim][c] for c in row.coords[dim]] for dim in value.dims))
            array[at][inner] = np.asarray(value.data)
    variables: dict[str, Any] = {
        "outcome": (("sample", "depth"), outcome.astype(str), {"long_name": "how the run ended"}),
        "message": (("sample", "depth"), message.astype(str), {"long_name": "what failed"}),
    }
    for name in sorted(arrays, key=_rank):
        dims, array, units = arrays[name]
        text = array.dtype == object
        about = {"long_name": name.replace("_", " ")} | ({"units": units} if units else {})
        variables[name] = (dims, array.astype(str) if text else array, about)
    parameters = {n: ("sample", _column(c), _about(study, n)) for n, c in samples.columns.items()}
    axes: dict[str, Any] = {"sample": np.arange(len(samples)), "depth": list(found.depths), **coords}
    if "time" in axes:
        axes["time"] = ("time", axes["time"], {"units": "s", "long_name": "time"})
    attributes = {
        "Conventions": "CF-1.11",
        "title": study.title,
        "seed": study.seed,
        "parameters": " ".join(samples.columns),
    }
    if study.refine is not None:
        attributes["first_stage"] = " ".join(study.depths or ())
        attributes["refined_where"] = rule_text(study)
    return xr.Dataset(variables, {**axes, **parameters}, attributes)


def rule_text(study: Study) -> str:
    """The rule of the second stage in words."""
    refine = study.refine
    assert refine is not None
    side = f"below {refine.below:g}" if refine.below is not None else f"above {refine.above:g}"
    return f"{refine.figure} at depth {refine.depth or (study.depths or [''])[0]} {side}, or none"


def _coords(found: Rows) -> dict[str, list[Any]]:
    """What there is along each dimension, in an order that does not depend on that of the rows."""
    values: dict[str, dict[Any, None]] = {}
    for _, row in sorted(found.rows.items()):
        for value in row.values.values():
            for dim in value.dims:
                values.setdefault(dim, {}).update(dict.fromkeys(row.coords[dim]))
    result = {dim: list(values[dim]) for dim in _ORDER if dim in values}
    if "period" in result:
        result["period"].sort(key=lambda p: (_PHASES.index(p) if p in _PHASES else len(_PHASES), p))
    if "time" in result:
        result["time"].sort()
    return result


def _empty(value: Value, sizes: Mapping[str, int]) -> tuple[tuple[str, ...], np.ndarray[Any, Any], str]:
    dims = ("sample", "depth", *value.dims)
    shape = tuple(sizes[dim] for dim in dims)
    text = isinstance(value.data, str)
    return dims, np.full(shape, "" if text else np.nan, dtype=object if text else float), value.units


def _rank(name: str) -> tuple[int, str]:
    known = list(FIGURES)
    return (known.index(name) if name in known else len(known), name)


def _column(values: Sequence[Any]) -> np.ndarray[Any, Any]:
    numbers = all(isinstance(value, int | float) and not isinstance(value, bool) for value in values)
    return np.asarray(values, dtype=float) if numbers else np.asarray([str(value) for value in values])


def _about(study: Study, name: str) -> dict[str, Any]:
    parameter = study.parameters[name]
    about: dict[str, Any] = {"long_name": name, "key": parameter.key}
    if parameter.unit:
        about["units"] = parameter.unit
    if parameter.factor:
        about["factor"] = "of what the base has"
    return about


def table_of(data: xr.Dataset) -> str:
    """The dataset as CSV, a line a run: parameters, depth, outcome, and of each figure one number."""
    numbers = {}
    for name, values in data.data_vars.items():
        if set(values.dims) <= {"sample", "depth", "period", "bearing"} and values.dtype.kind == "f":
            numbers[str(name)] = one_number(data, str(name)).transpose("sample", "depth").values
    texts = [n for n in ("worst_limit", "message") if n in data]
    names = str(data.attrs["parameters"]).split()
    out = io.StringIO()
    write = csv.writer(out, lineterminator="\n")
    units = {name: data[name].attrs.get("units", "") for name in (*names, *numbers)}
    heads = [f"{name} [{units[name]}]" if units[name] else name for name in (*names, *numbers)]
    write.writerow(["sample", "depth", *heads[: len(names)], "outcome", *heads[len(names) :], *texts])
    columns = [data[name].values.tolist() for name in names]
    for i in range(data.sizes["sample"]):
        for j, depth in enumerate(data["depth"].values):
            outcome = str(data["outcome"].values[i, j])
            row = [i, depth, *(column[i] for column in columns), outcome]
            row += [_cell(values[i, j]) for values in numbers.values()]
            write.writerow([*row, *(data[n].values[i, j] for n in texts)])
    return out.getvalue()


def _cell(value: float) -> str:
    return "" if np.isnan(value) else repr(float(value))
