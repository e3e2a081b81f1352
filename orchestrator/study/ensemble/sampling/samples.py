"""From the parameters of a study to its samples; the same seed gives the same samples."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from orchestrator.errors import OrchestratorError
from orchestrator.study.ensemble.sampling.schema import SENSITIVITY, Parameter, Sampling, Span, Study

_EDGE = 1e-12  # of probabilities: quantiles are finite there
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Samples:
    """The samples of a study.

    Attributes
    ----------
    columns : dict of list
        Values of each parameter, one a sample.
    unit : ndarray (samples, parameters) or None
        Of a sensitivity design the samples as probabilities.
    """

    columns: dict[str, list[Any]]
    unit: Array | None = None

    def __len__(self) -> int:
        return len(next(iter(self.columns.values())))

    def __getitem__(self, index: int) -> dict[str, Any]:
        return {name: column[index] for name, column in self.columns.items()}


def grid_of(parameter: Parameter) -> list[Any]:
    """The values of a parameter with a grid."""
    if not isinstance(parameter.grid, Span):
        return list(parameter.grid)
    span = parameter.grid
    space = np.linspace if span.spacing == "linear" else np.geomspace
    return [float(value) for value in space(span.start, span.stop, span.count)]


def frozen(parameter: Parameter) -> Any:
    """The distribution of a parameter with its arguments.

    Raises
    ------
    ValueError
        Says what is allowed.
    """
    from scipy import stats  # some tenths of a second

    kinds = (stats.rv_continuous, stats.rv_discrete)
    distribution = getattr(stats, str(parameter.distribution), None)
    if not isinstance(distribution, kinds):
        from rotor_fmu.train.wording import likely

        names = [name for name in dir(stats) if isinstance(getattr(stats, name), kinds)]
        some = "uniform, norm, truncnorm, lognorm, triang, weibull_min and the others of scipy.stats"
        raise ValueError(f"{likely(str(parameter.distribution), names)}allowed are {some}")
    known = [name for name in (distribution.shapes or "").split(", ") if name]
    known += ["loc"] + (["scale"] if isinstance(distribution, stats.rv_continuous) else [])
    unknown = [name for name in parameter.arguments if name not in known]
    missing = [name for name in known if name not in (*parameter.arguments, "loc", "scale")]
    if unknown or missing:
        given = ", ".join(unknown) if unknown else f"without {', '.join(missing)}"
        raise ValueError(f"arguments {given}; allowed are {', '.join(known)}")
    found = distribution(**parameter.arguments)
    quantiles = np.asarray(found.ppf([0.1, 0.5, 0.9]), dtype=float)
    if not np.isfinite(quantiles).all() or quantiles[0] == quantiles[-1]:
        raise ValueError(f"arguments {parameter.arguments}; allowed are those of a range that is not empty")
    return found


def samples_of(study: Study) -> Samples:
    """Draw the samples of a study that is right: lists of values, times grids, times draws.

    Raises
    ------
    OrchestratorError
        When the library of a sensitivity design is not installed.
    """
    kinds: dict[str, list[str]] = {"values": [], "grid": [], "drawn": []}
    for name, parameter in study.parameters.items():
        kind = "values" if parameter.values is not None else "grid" if parameter.grid is not None else "drawn"
        kinds[kind].append(name)
    drawn = [study.parameters[name] for name in kinds["drawn"]]
    unit = probabilities(study.sampling, len(drawn), study.seed) if study.sampling and drawn else None
    columns: dict[str, list[Any]] = {name: [] for name in study.parameters}
    draws = _rows(kinds["drawn"], drawn, unit)
    lists = {name: study.parameters[name].values or [] for name in kinds["values"]}
    rows = [dict(zip(lists, row, strict=True)) for row in zip(*lists.values(), strict=True)] or [{}]
    grids = [grid_of(study.parameters[name]) for name in kinds["grid"]]
    for row, point, draw in itertools.product(rows, itertools.product(*grids), draws):
        for name, value in (row | dict(zip(kinds["grid"], point, strict=True)) | draw).items():
            columns[name].append(value)
    sensitive = study.sampling is not None and study.sampling.method in SENSITIVITY
    return Samples(columns, unit if sensitive else None)


def size_of(study: Study) -> int:
    """How many samples there will be."""
    size, lists = 1, 1
    for parameter in study.parameters.values():
        if parameter.values is not None:
            lists = len(parameter.values)
        elif parameter.grid is not None:
            size *= parameter.grid.count if isinstance(parameter.grid, Span) else len(parameter.grid)
    drawn = sum(parameter.distribution is not None for parameter in study.parameters.values())
    return size * lists * (_draws(study.sampling, drawn) if study.sampling and drawn else 1)


def _draws(sampling: Sampling, drawn: int) -> int:
    if sampling.method == "sensitivity-sobol":
        return sampling.count * (2 * drawn + 2 if sampling.second_order else drawn + 2)
    return sampling.count * (drawn + 1) if sampling.method == "sensitivity-morris" else sampling.count


def problem_of(names: int, seed: int = 0) -> dict[str, Any]:
    """What SALib calls the problem: parameters as probabilities."""
    return {"num_vars": names, "names": [str(k) for k in range(names)], "bounds": [[0.0, 1.0]] * names}


def probabilities(sampling: Sampling, drawn: int, seed: int) -> Array:
    """Points of the unit cube, shape (draws, parameters that are drawn)."""
    from scipy.stats import qmc

    if sampling.method == "random":
        return np.random.default_rng(seed).random((sampling.count, drawn))
    if sampling.method == "latin-hypercube":
        return np.asarray(qmc.LatinHypercube(drawn, rng=np.random.default_rng(seed)).random(sampling.count))
    if sampling.method == "sobol":
        engine = qmc.Sobol(drawn, rng=np.random.default_rng(seed))
        return np.asarray(engine.random_base2(round(math.log2(sampling.count))))
    require_salib()
    from SALib.sample import morris, sobol

    problem = problem_of(drawn)
    if sampling.method == "sensitivity-sobol":
        points = sobol.sample(problem, sampling.count, calc_second_order=sampling.second_order, seed=seed)
    else:
        points = morris.sample(problem, sampling.count, num_levels=sampling.levels, seed=seed)
    return np.asarray(points, dtype=float)


def require_salib() -> None:
    """Raise OrchestratorError where SALib is not installed."""
    try:
        import SALib  # noqa: F401
    except ImportError:
        raise OrchestratorError(
            "a sensitivity design needs the package SALib: pip install 'bladeloss[study]'"
        ) from None


def _rows(names: list[str], drawn: list[Parameter], unit: Array | None) -> list[dict[str, Any]]:
    if unit is None:
        return [{}]
    columns = dict(zip(names, map(_column, drawn, unit.T), strict=True))
    return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]


def _column(parameter: Parameter, unit: Array) -> list[Any]:
    values = frozen(parameter).ppf(np.clip(unit, _EDGE, 1.0 - _EDGE))
    from scipy import stats

    whole = isinstance(getattr(stats, str(parameter.distribution)), stats.rv_discrete)
    return [int(value) if whole else float(value) for value in np.asarray(values)]


def text_rows(samples: Samples) -> Iterator[list[str]]:
    """The samples as rows of a table, head first."""
    yield ["sample", *samples.columns]
    for index in range(len(samples)):
        yield [str(index), *map(_text, samples[index].values())]


def _text(value: Any) -> str:
    return repr(value) if isinstance(value, float) else str(value)


Row = Mapping[str, Any]
