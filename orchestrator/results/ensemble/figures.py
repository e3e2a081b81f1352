"""The figures of a run that a study keeps, and how one number for a whole run comes of them."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from orchestrator.results.statistics import BearingStatistics, ShaftStatistics

CONTACT, SHARE, LIMIT = "contact", "worst_share", "worst_limit"
"""Whether solids touch anywhere; of all limits the largest share that is used, and which one that is."""


@dataclass(frozen=True)
class Figure:
    """A figure of a run.

    Attributes
    ----------
    name : str
        As in the summary of a run.
    dims : tuple of str
        Of period (a phase of the run) and bearing those that it has.
    units : str
        SI.
    least : bool
        Whether the least value is the worst one.
    """

    name: str
    dims: tuple[str, ...]
    units: str
    least: bool = False


def _figures(model: type, dims: tuple[str, ...]) -> list[Figure]:
    return [Figure(field.name, dims, **field.metadata) for field in fields(model) if field.metadata]


OF_BEARINGS = _figures(BearingStatistics, ("period", "bearing"))
OF_THE_SHAFT = _figures(ShaftStatistics, ("period",))
OF_THE_RUN = [Figure(CONTACT, (), "1"), Figure(SHARE, (), "1")]
FIGURES = {figure.name: figure for figure in (*OF_THE_RUN, *OF_BEARINGS, *OF_THE_SHAFT)}
"""All figures that a study can keep, by name."""


def one_number(data: xr.Dataset, name: str) -> xr.DataArray:
    """A figure as one number for each sample and depth: its worst value over the bearings of the last phase.

    Parameters
    ----------
    data : xarray.Dataset
        Of a study.
    name : str
        One of its variables; of those that are no figures of runs the largest value counts.
    """
    values = data[name]
    if "period" in values.dims:
        last = values.isel(period=-1)
        for k in range(values.sizes["period"] - 2, -1, -1):  # runs without that phase
            last = last.fillna(values.isel(period=k))
        values = last.drop_vars("period", errors="ignore")
    rest = [dim for dim in values.dims if dim not in ("sample", "depth")]
    if not rest:
        return values
    return values.min(rest) if name in FIGURES and FIGURES[name].least else values.max(rest)


def is_worse(values: NDArray[np.float64], name: str) -> NDArray[np.float64]:
    """Values such that more is worse."""
    return -values if name in FIGURES and FIGURES[name].least else values
