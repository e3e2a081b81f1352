"""``bladeloss campbell``: whirl frequencies over speed, and what reductions make of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from rich.table import Table

from orchestrator.errors import OrchestratorError
from orchestrator.fmi.blas import one_blas_thread
from orchestrator.linear.campbell import free_data, supported_data
from orchestrator.linear.case import FULL, HERTZ, LinearCase, linear_case, write_results
from orchestrator.linear.operating_point import bearing_data
from orchestrator.linear.tables import COLUMNS_EXPLAINED, error_text, shaft_column, table_of, whirl_name
from orchestrator.results.figures.campbell import free_figure, supported_figure
from rotor_fmu.linear.analysis import WhirlError, free_branches

if TYPE_CHECKING:
    import xarray as xr
    from rich.console import Console

    from orchestrator.linear.case import LinearRequest

COUNT = 8
"""Frequencies in each direction, unless another number is asked for."""

TOLERANCE = 1e-4
"""Errors up to this are written in green: no diagram shows them."""


@one_blas_thread()
def run(
    request: LinearRequest, console: Console, *, supported: bool, count: int | None, highest: float | None
) -> int:
    """Compute, print and write the diagram; returns the exit status.

    Without a count the diagram has `COUNT` frequencies in each direction, or as many as all shafts have.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input, or modes that the shaft does not have.
    """
    case = linear_case(request, console)
    top = case.highest(highest)
    if supported:
        with case.over_speed() as films:
            data = supported_data(case, films, count or COUNT, top)
            points = {HERTZ * hertz: films.at(HERTZ * hertz) for hertz in data["rotation"].values}
        bearings = bearing_data(points, case.train, case.films_over_speed)
        table = supported_table(case, data)
        write_results(case, [data, bearings], table, supported_figure(data, case.train))
        return 0
    data, iterations = _free(case, count, top)
    write_results(case, [data, iterations], free_table(case, data), free_figure(data, iterations, case.train))
    return 0


def _free(case: LinearCase, asked: int | None, highest: float) -> tuple[xr.Dataset, xr.Dataset]:
    """As `free_data`, of as many modes as there are; refused where reductions keep fewer than asked for."""
    wanted = count = asked or COUNT
    while True:
        try:
            found = free_data(case, count, highest)
            break
        except WhirlError as error:
            fewer = min(error.found, count - 1)
            if fewer < 1 or (asked and _has(case, count, highest)):
                raise OrchestratorError(f"--count {count}: {error}") from None
            count = fewer
    if count < wanted:
        case.console.print(
            f"The shaft has {count} bending modes in each direction, not {wanted}.", highlight=False
        )
    return found


def _has(case: LinearCase, count: int, highest: float) -> bool:
    """Whether the unreduced shaft has that many bending modes in each direction."""
    try:
        free_branches(case.shaft, case.shaft.z, [0.0, HERTZ * highest], count)
    except WhirlError:
        return False
    return True


def free_table(case: LinearCase, data: xr.Dataset) -> Table:
    """Largest error of each bending frequency over speed and direction, a row a mode."""
    top = float(data["rotation"][-1])
    size = data.attrs["degrees_of_freedom"]
    table = table_of(
        f"Largest relative errors of the bending frequencies, 0 to {top:g} Hz of rotation, "
        f"{case.shaft.size} degrees of freedom reduced to {size}"
    )
    shafts = [str(name) for name in data["shaft"].values[1:]]
    for name in ("mode", "at rest [Hz]", *shafts):
        table.add_column(shaft_column(name), justify="right")
    at_rest = data["frequency"].sel(shaft=FULL, direction="forward").isel(rotation=0).values
    worst = abs(data["error"]).max(["rotation", "direction"])
    for k, frequency in enumerate(at_rest):
        errors = [float(worst.sel(shaft=name)[k]) for name in shafts]
        table.add_row(str(k + 1), f"{frequency:.3f}", *(error_text(error, TOLERANCE) for error in errors))
    table.add_section()
    largest = [float(worst.sel(shaft=name).max()) for name in shafts]
    table.add_row("all", "", *(error_text(error, TOLERANCE) for error in largest))
    table.caption = (
        f"{COLUMNS_EXPLAINED} Modal truncation is what plain IRS converges to: the floor set by leaving "
        f"G out of its transformation. Green: up to {TOLERANCE:.0e}."
    )
    return table


def supported_table(case: LinearCase, data: xr.Dataset) -> Table:
    """Modes at the speed nearest to the rated one, and the largest errors of each over speed."""
    at = int(np.abs(data["rotation"].values - case.train.speed / HERTZ).argmin())
    top, here = float(data["rotation"][-1]), float(data["rotation"][at])
    methods = [str(name) for name in data["shaft"].values[1:]]
    table = table_of(
        f"{case.train.name} on {case.films_over_speed}: modes at {here:g} Hz of rotation, "
        f"and largest error of an eigenvalue, 0 to {top:g} Hz"
    )
    for name in ("mode", "Hz", "damping\nratio", "whirl", *methods):
        table.add_column(shaft_column(name), justify="left" if name == "whirl" else "right")
    modes, errors = data.sel(shaft=FULL).isel(rotation=at), data["error"].max("rotation")
    for k, mode in enumerate(data["mode"].values):
        if not np.isfinite(float(modes["frequency"][k])):
            continue  # at other speeds only
        table.add_row(
            str(mode),
            f"{float(modes['frequency'][k]):.3f}",
            f"{float(modes['damping_ratio'][k]):.4f}",
            whirl_name(float(modes["whirl_direction"][k])),
            *(error_text(float(errors.sel(shaft=name)[k]), TOLERANCE) for name in methods),
        )
    largest = [float(errors.sel(shaft=name).max()) for name in methods]
    table.add_section()
    table.add_row("all", "", "", "", *(error_text(error, TOLERANCE) for error in largest))
    missing = data.attrs.get("missing")
    table.caption = f"{COLUMNS_EXPLAINED} Left out: {missing}." if missing else COLUMNS_EXPLAINED
    return table
