"""What the linear investigations share: the train asked for, its operating point, their results."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

from bearing_fmu.depths import LINEAR
from fmus import port
from orchestrator.fmi.folder import do_ahead, ensure_fmus, fmu_folder
from orchestrator.fmi.trust import own_bearings, require_trust
from orchestrator.linear.operating_point import (
    HERTZ,
    OperatingPoint,
    OverSpeed,
    bearing_data,
    operating_point,
    over_speed,
)
from orchestrator.results.figures.save import save
from orchestrator.results.files import room_for
from orchestrator.results.folder import check_folder, named, named_after
from orchestrator.results.record_files import netcdf
from orchestrator.results.replacing import result_folder
from orchestrator.scenario.file import (
    bundled_scenarios,
    load_with_train,
    on_train,
    read_train,
    scenario_toml,
)
from orchestrator.scenario.parameters import needed_depths, wheel_unbalances
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.linear.analysis import (
    DEFAULT_SIZE,
    METHODS,
    Method,
    ReducedShaft,
    ShaftModel,
    reduced_shaft,
    unreduced_shaft,
)
from rotor_fmu.train.train import Train

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

REDUCTIONS: tuple[Method, ...] = ("irs", "irs-plain", "guyan", "craig-bampton")
assert set(REDUCTIONS) | {"none"} == set(METHODS)
FULL = "unreduced"

LEAST_SIZE = 24
"""Degrees of freedom below which no shaft is reduced to half its own."""


@dataclass(frozen=True)
class LinearRequest:
    """What the command line asks for.

    Attributes
    ----------
    command : str
        Names folder and files.
    source : str
        Scenario or train.
    depth : str or None
        Depth of all films in place of the scenario's.
    out : Path or None
        Folder of the results; None: ``results/<source>-<command>``.
    fmus : Path
        Folder of the FMUs.
    formats : sequence of str
        File types of the figure.
    trust : bool
        Run FMUs of others without asking.
    """

    command: str
    source: str
    depth: str | None = None
    out: Path | None = None
    fmus: Path = field(default_factory=fmu_folder)
    formats: Sequence[str] = ("png",)
    trust: bool = False

    @property
    def folder(self) -> Path:
        """Where the results go."""
        return named(self.out) if self.out else Path("results") / f"{named_after(self.source)}-{self.command}"


@dataclass(frozen=True)
class LinearCase:
    """A train to be investigated.

    Attributes
    ----------
    request : LinearRequest
        What was asked for.
    scenario : Scenario
        Names depths and unbalance.
    train : Train
        The train.
    console : rich.console.Console
        For what happens meanwhile.
    told : set of str
        What the console has been told about reductions.
    """

    request: LinearRequest
    scenario: Scenario
    train: Train
    console: Console
    told: set[str] = field(default_factory=set)

    @property
    def shaft(self) -> ShaftModel:
        """The unreduced shaft."""
        return unreduced_shaft(self.train)

    def reduced(self, method: Method) -> ReducedShaft:
        """The shaft under a reduction, or under the one that took its place; then the console is told."""
        shaft = reduced_shaft(self.train, method, self.size)
        if shaft.reason and shaft.carried_out not in self.told:
            self.told.add(shaft.carried_out)
            self.console.print(f"Reduction: {shaft.carried_out}", highlight=False, soft_wrap=True)
        return shaft

    @property
    def size(self) -> int:
        """Degrees of freedom to which the shaft is reduced: as in runs, but of a small shaft half its own."""
        return min(DEFAULT_SIZE, max(self.shaft.size // 2, LEAST_SIZE), self.shaft.size)

    @property
    def shafts(self) -> dict[str, ShaftModel | ReducedShaft]:
        """Unreduced, then reduced by every method."""
        shafts: dict[str, ShaftModel | ReducedShaft] = {FULL: self.shaft}
        return shafts | {method: self.reduced(method) for method in REDUCTIONS}

    @cached_property
    def operating_point(self) -> OperatingPoint:
        """Linearised bearings at rated speed; FMUs are built where missing."""
        self._ensure()
        return operating_point(self.scenario, self.train, self.request.fmus)

    def highest(self, asked: float | None) -> float:
        """Highest speed of rotation [Hz] of an investigation: what was asked for, or twice the rated one."""
        return asked or 2.0 * self.train.speed / HERTZ

    @contextmanager
    def over_speed(self) -> Iterator[OverSpeed]:
        """Yield linearised bearings at any speed; FMUs are built where missing."""
        self._ensure()
        with over_speed(self.scenario, self.train, self.request.fmus) as points:
            yield points

    def _ensure(self) -> None:
        require_trust(own_bearings(self.scenario), trust=self.request.trust)
        needed = needed_depths(self.scenario, self.train)
        ensure_fmus(self.request.fmus, self.train, needed, self.console)
        do_ahead(self.scenario, self.train, needed, self.console)

    @property
    def unbalance(self) -> NDArray[np.complex128]:
        """Nominal unbalance of each wheel, U exp(i phase) in kg m."""
        amounts, phases = np.reshape(wheel_unbalances(self.scenario, self.train), (-1, 2)).T
        return np.asarray(amounts * np.exp(1j * phases))

    @property
    def bearing_data(self) -> xr.Dataset:
        """Stiffness and damping of the bearings at the operating point."""
        return bearing_data({self.train.speed: self.operating_point}, self.train, self.films)

    @property
    def films(self) -> str:
        """The films in words."""
        return self.films_at(self.train.speed)

    def films_at(self, speed: float) -> str:
        """The films, linearised at a speed [rad/s], in words."""
        return f"{self.bearings_in_words}, linearised at {speed / HERTZ:g} Hz"

    @property
    def films_over_speed(self) -> str:
        """The films, solved anew at each speed, in words; those of depth linear are what they are."""
        depths = {self.scenario.depth_of(seat.name) for seat in self.train.bearings}
        constant = depths == {LINEAR.name} and not any(
            len(port.coefficient_rows(seat.coefficients)) > 1 for seat in self.train.bearings
        )
        return f"{self.bearings_in_words}, {'the same' if constant else 'solved anew'} at every speed"

    @property
    def bearings_in_words(self) -> str:
        """Modelling depth of the bearings in words."""
        depths = {self.scenario.depth_of(seat.name) for seat in self.train.bearings}
        if depths == {LINEAR.name}:
            given = all(seat.coefficients for seat in self.train.bearings)
            source = "as given" if given else f"of films {self.scenario.linear_from.upper()}"
            return f"stiffness and damping {source}"
        return f"films {depths.pop().upper() if len(depths) == 1 else 'of mixed depths'}"


def linear_case(request: LinearRequest, console: Console, *, writes: bool = True) -> LinearCase:
    """Read what is to be investigated: a scenario, or a train under the settings of a plain scenario.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input or with the folder of the results.
    """
    overrides = {"depth": request.depth, "depth_at": None} if request.depth else {}
    path = Path(request.source)
    is_scenario = path.suffix == ".toml" and path.name != "train.toml"
    if request.source in bundled_scenarios() or is_scenario:
        scenario, train = load_with_train(request.source, overrides)
    else:
        train = read_train(request.source)
        settings: dict[str, Any] = {"train": request.source, "end": 1.0, "title": f"Train {train.name}"}
        settings |= {"depth": request.depth} if request.depth else {}
        scenario = on_train(Scenario.model_validate(settings), train)
    if writes:
        check_folder(request.folder, f"{request.command}.nc")
    return LinearCase(request, scenario, train, console)


def write_results(
    case: LinearCase,
    data: Sequence[xr.Dataset],
    tables: Table | Sequence[Table],
    figures: Figure | Mapping[str, Figure] | None,
    *,
    first: str = "",
) -> None:
    """Write the data as NetCDF and CSV, the tables as text and the figures; say what and where.

    Parameters
    ----------
    case : LinearCase
        What was investigated.
    data : sequence of xarray.Dataset
        The first is named as the command, others by their attribute ``name``.
    tables : rich.table.Table or sequence of them
        Printed, and written as text.
    figures : matplotlib.figure.Figure, or mapping of them by name, or None
        Drawn in every format asked for; one is named as the command.
    first : str
        Said before the tables.
    """
    request = case.request
    shown = [tables] if isinstance(tables, Table) else list(tables)
    drawn = dict(figures) if isinstance(figures, Mapping) else {request.command: figures}
    written: list[str] = []
    with room_for(data, request.folder), result_folder(request.folder) as fresh:
        for index, dataset in enumerate(data):
            name = request.command if index == 0 else str(dataset.attrs["name"])
            described = dataset.assign_attrs(
                {"train": case.train.name, "scenario": scenario_toml(case.scenario), **dataset.attrs}
            )
            (fresh / f"{name}.nc").write_bytes(netcdf(described))
            write_table(described, fresh / f"{name}.csv")
            written += [f"{name}.nc", f"{name}.csv"]
        with (fresh / f"{request.command}.txt").open("w", encoding="utf-8") as file:
            say(Console(file=file, width=120), first, shown)
        written.append(f"{request.command}.txt")
        for name, figure in drawn.items():
            names = [f"{name}.{kind}" for kind in request.formats] if figure is not None else []
            if figure is not None:
                save(figure, [fresh / name for name in names])
            written += names
    say(case.console, first, shown)
    for name in written:
        case.console.print(str(request.folder / name), highlight=False, soft_wrap=True)


def say(console: Console, first: str, tables: Sequence[Table]) -> None:
    """Print a text, red where it says that the train is unstable, and tables."""
    for line in first.splitlines():
        console.print(line, style="bold red" if line.startswith("UNSTABLE") else "", highlight=False)
    for table in tables:
        console.print(table)


def write_table(data: xr.Dataset, path: Path) -> None:
    """Write a dataset as one long table: a line for every combination of coordinates, units in the head."""
    frame = data.to_dataframe().reset_index()
    units = {name: data[name].attrs.get("units", "") for name in frame.columns if name in data.variables}
    frame.columns = [f"{name} [{units[name]}]" if units.get(name) else str(name) for name in frame.columns]
    frame.to_csv(path, index=False, float_format="%.10g", lineterminator="\n")
