"""Sensitivities of a study whose samples are a design for them, with the bounds of SALib."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from orchestrator.results.ensemble.figures import one_number
from orchestrator.study.ensemble.sampling.samples import Samples, problem_of
from orchestrator.study.ensemble.sampling.schema import SENSITIVITY, Study

NAMES = {
    "sensitivity-sobol": ("sobol_first", "sobol_total"),
    "sensitivity-morris": ("morris_mean", "morris_spread"),
}
_SOBOL = {"sobol_first": ("S1", "S1_conf"), "sobol_total": ("ST", "ST_conf")}
_MORRIS = {"morris_mean": ("mu_star", "mu_star_conf"), "morris_spread": ("sigma", "")}
_WORDS = {
    "sobol_first": "first-order Sobol index",
    "sobol_total": "total Sobol index",
    "morris_mean": "mean of the absolute elementary effects",
    "morris_spread": "standard deviation of the elementary effects",
}


def with_sensitivities(study: Study, samples: Samples, data: xr.Dataset) -> xr.Dataset:
    """The dataset with indices by parameter, depth and figure, and half the widths of their 95 % intervals.

    A figure that some run did not give, or that is the same in all runs, has none (nan).
    """
    sampling = study.sampling
    if sampling is None or sampling.method not in SENSITIVITY or samples.unit is None:
        return data
    figures = [
        str(name)
        for name, values in data.data_vars.items()
        if values.dtype.kind == "f"
        and "sample" in values.dims
        and not {"time", "parameter"} & set(values.dims)
    ]
    depths, parameters = data["depth"].values, list(samples.columns)
    shape = (len(depths), len(figures), len(parameters))
    names = _SOBOL if sampling.method == "sensitivity-sobol" else _MORRIS
    found = {
        name: np.full(shape, np.nan) for name in (*names, *(f"{n}_bound" for n, (_, b) in names.items() if b))
    }
    for j, figure in enumerate(figures):
        numbers = one_number(data, figure).transpose("sample", "depth").values
        for i in range(len(depths)):
            values = numbers[:, i]
            if not np.isfinite(values).all() or np.ptp(values) == 0.0:
                continue
            indices = _analyse(study, samples.unit, values)
            for name, (key, bound) in names.items():
                found[name][i, j] = indices[key]
                if bound:
                    found[f"{name}_bound"][i, j] = indices[bound]
    dims = ("depth", "figure", "parameter")
    new = {n: (dims, v, {"long_name": _words(n)}) for n, v in found.items()}
    return data.assign(new).assign_coords(figure=figures, parameter=parameters)


def _words(name: str) -> str:
    base = name.removesuffix("_bound")
    return _WORDS[base] + (", half the width of its 95 % interval" if base != name else "")


def _analyse(study: Study, unit: NDArray[np.float64], values: NDArray[np.float64]) -> dict[str, Any]:
    from SALib.analyze import morris, sobol

    sampling = study.sampling
    assert sampling is not None
    problem = problem_of(unit.shape[1])
    if sampling.method == "sensitivity-sobol":
        result: dict[str, Any] = sobol.analyze(
            problem, values, calc_second_order=sampling.second_order, num_resamples=200, seed=study.seed
        )
    else:
        result = morris.analyze(
            problem, unit, values, num_levels=sampling.levels, num_resamples=200, seed=study.seed
        )
    return result
