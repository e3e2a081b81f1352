"""What a study keeps of a run."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from orchestrator.results.ensemble.figures import CONTACT, FIGURES, LIMIT, OF_BEARINGS, OF_THE_SHAFT, SHARE
from orchestrator.results.result import Result
from orchestrator.results.summary import summarise
from orchestrator.results.verdicts.judge import judge, own_limits
from orchestrator.study.ensemble.running.row import Row, Value
from orchestrator.study.ensemble.sampling.schema import Keep


def row_of(result: Result, keep: Keep, timing: Mapping[str, float]) -> Row:
    """What a study keeps of a run."""
    record = result.record
    names = [str(name) for name in record["bearing"].values] if "bearing" in record.coords else []
    names = [name for name in names if keep.bearings is None or name in keep.bearings]
    wanted = set(keep.figures if keep.figures is not None else (*FIGURES, LIMIT))
    values: dict[str, Value] = {}
    coords: dict[str, list[Any]] = {"bearing": names}
    summary = summarise(result, analysed=names[0] if names else None)
    if summary.phases:
        coords["period"] = [p.name for p in summary.phases if keep.phases is None or p.name in keep.phases]
        bearings = {(row.phase, row.bearing): row for row in summary.bearings}
        shaft = {row.phase: row for row in summary.shaft}
        for figure in OF_BEARINGS:
            rows = [[_number(getattr(bearings[p, b], figure.name)) for b in names] for p in coords["period"]]
            values[figure.name] = Value(figure.dims, rows, figure.units)
        for figure in OF_THE_SHAFT:
            column = [_number(getattr(shaft[p], figure.name)) for p in coords["period"]]
            values[figure.name] = Value(figure.dims, column, figure.units)
        touched = any(row.contact_first is not None for row in summary.bearings)
        values[CONTACT] = Value((), float(touched), "1")
        verdicts = [v for v in judge(record, own_limits(record)) if v.bound > 0.0 and np.isfinite(v.share)]
        if verdicts:
            worst = max(verdicts, key=lambda v: v.share)
            values[SHARE] = Value((), float(worst.share), "1")
            values[LIMIT] = Value((), f"{worst.limit} ({worst.place}, {worst.phase})")
        values = {name: value for name, value in values.items() if name in wanted}
    if record.sizes.get("time", 0):
        values |= _traces(record.sel(bearing=names), keep)
        coords |= {"time": record["time"].values.tolist()} if keep.traces else {}
        coords |= {"axis": [str(a) for a in record["axis"].values]} if keep.traces else {}
    outcome, message = result.outcome.value, result.message
    return Row(outcome, message, values, coords, timing)


def _number(value: float | None) -> float:
    return float("nan") if value is None else float(value)


def _traces(record: xr.Dataset, keep: Keep) -> dict[str, Value]:
    found = {}
    for name in keep.traces:
        if name in record:
            series = record[name].transpose("time", "bearing", ...)
            dims = tuple(map(str, series.dims))
            found[name] = Value(dims, series.values.tolist(), str(series.attrs.get("units", "")))
    return found
