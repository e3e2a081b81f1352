"""What a study's TOML may hold."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field

from orchestrator.scenario.fields import Model

Method = Literal["latin-hypercube", "sobol", "random", "sensitivity-sobol", "sensitivity-morris"]
SENSITIVITY = ("sensitivity-sobol", "sensitivity-morris")
MOST = 1_000_000
"""Samples of a study."""

_Finite = Annotated[float, Field(allow_inf_nan=False)]


class Span(Model):
    """``grid = { start = 0.1, stop = 0.5, count = 9 }``: in equal steps, or with spacing "log" in ratios."""

    start: _Finite
    stop: _Finite
    count: int = Field(ge=2, le=MOST)
    spacing: Literal["linear", "log"] = "linear"


class Parameter(Model):
    """``[parameters.NAME]``: what a sample changes; one of values, grid, distribution.

    Attributes
    ----------
    key : str
        Of the scenario (``event.unbalance``, ``unbalance.at.wheel-1.phase``), or behind ``train.`` of its
        train (``train.bearing.front.clearance``; ``*`` for all bearings).
    unit : str
        For figures and tables.
    factor : bool
        The values are factors of what the scenario or the train has there.
    values : list
        Gone through together with the other lists of values, which are as long.
    grid : list or Span
        Gone through in all combinations with whatever else there is.
    distribution : str
        Name of a distribution of `scipy.stats`, with its `arguments`; drawn as ``[sampling]`` says.
    arguments : dict
        Of the distribution: ``loc``, ``scale`` and its own.
    """

    key: str = Field(min_length=1)
    unit: str = ""
    factor: bool = False
    values: list[Any] | None = None
    grid: Any = None
    distribution: str | None = None
    arguments: dict[str, _Finite] = {}  # noqa: RUF012


class Sampling(Model):
    """``[sampling]``: how distributions are drawn.

    Attributes
    ----------
    method : str
        Latin hypercube, scrambled Sobol sequence, random numbers (`scipy.stats.qmc`); or the design of a
        sensitivity analysis (SALib): Saltelli's for Sobol indices, Morris' trajectories.
    count : int
        Draws; of a sensitivity design its base count, or its trajectories.
    levels : int
        Of Morris' grid.
    second_order : bool
        Of Sobol indices also those of pairs.
    """

    method: Method = "latin-hypercube"
    count: int = Field(ge=1, le=MOST)
    levels: int = Field(4, ge=2, le=100)
    second_order: bool = False


class Keep(Model):
    """``[keep]``: what is kept of each run, besides how it ended.

    Attributes
    ----------
    figures : list of str
        Of the summary; all by default.
    phases : list of str
        All by default.
    traces : list of str
        Series over time at the bearings, by their names in the record.
    bearings : list of str
        All by default.
    worst : int
        Runs whose own results and reports are made in the end.
    rank : str
        Figure by which runs are the worst.
    """

    figures: list[str] | None = None
    phases: list[str] | None = None
    traces: list[str] = []  # noqa: RUF012
    bearings: list[str] | None = None
    worst: int = Field(default=10, ge=0, le=1000)
    rank: str = "worst_share"


class Refine(Model):
    """``[refine]``: a second stage at other depths, for those samples of which the first says so.

    Attributes
    ----------
    depths : list of str
        Of the second stage.
    depth : str
        Of the first stage that decides; its first by default.
    figure : str
        That decides: its worst value over the bearings of the last phase.
    below, above : float
        Refined where it is below, or above; and where the run of the first stage gave none.
    """

    depths: list[str] = Field(min_length=1)
    depth: str | None = None
    figure: str
    below: _Finite | None = None
    above: _Finite | None = None


class Study(Model):
    """A study.

    Attributes
    ----------
    title : str
        Heads table and report.
    scenario : str
        Name of a bundled scenario, or a scenario's TOML relative to the study's file.
    depths : list of str
        Each sample is run at each of them; by default that of the scenario.
    seed : int
        Of whatever is drawn.
    set : dict
        Values in place of the scenario's for all runs, in the shape of its file.
    parameters : dict of Parameter
        By the names that table, figures and dataset give them.
    """

    title: str = ""
    scenario: str = ""
    depths: list[str] | None = Field(None, min_length=1)
    seed: int = Field(0, ge=0, lt=2**32)
    set: dict[str, Any] = {}  # noqa: RUF012
    parameters: dict[str, Parameter] = Field(min_length=1)
    sampling: Sampling | None = None
    keep: Keep = Field(default_factory=Keep)
    refine: Refine | None = None
