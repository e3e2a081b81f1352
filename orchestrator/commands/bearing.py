"""``bladeloss bearing``: one bearing, of a train or of a file of its own, at every depth side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from rich.table import Table

from fmus import port
from orchestrator.errors import OrchestratorError
from orchestrator.fmi.blas import one_blas_thread
from orchestrator.linear.bearing import BearingStudy, film_depths, study_bearing
from orchestrator.linear.case import HERTZ, LinearCase, linear_case, write_results
from orchestrator.linear.lone import lone_case
from orchestrator.linear.tables import table_of
from orchestrator.results.figures.bearing import coefficients_figure, curves_figure, pressure_figure
from orchestrator.scenario.parameters import bearing_parameters
from rotor_fmu.linear.analysis import target_loads
from rotor_fmu.train.wording import choice

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr
    from matplotlib.figure import Figure
    from rich.console import Console

    from orchestrator.linear.case import LinearRequest
    from rotor_fmu.train.train import BearingSeat

ROWS = 13
"""Loads in the table, at most."""


@one_blas_thread()
def run(
    request: LinearRequest,
    console: Console,
    *,
    name: str | None,
    depths: Sequence[str],
    hertz: float | None,
    load: float | None,
    load_angle: float | None = None,
) -> int:
    """Compute, print and write; returns the exit status.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input.
    """
    lone = lone_case(request, console)
    case, given, direction = (linear_case(request, console), load, None) if lone is None else lone
    seat = _seat(case, name)
    train, speed = case.train, case.train.speed if hertz is None else HERTZ * hertz
    carried = given if load is None else load
    if carried is None:
        carried = target_loads(train)[train.bearings.index(seat)]
    if carried == 0.0:
        raise OrchestratorError(f"bearing {seat.name} carries no load; name one with --load")
    direction = direction if load_angle is None else float(np.radians(load_angle))
    along = -np.asarray(train.upwards) if direction is None else (np.cos(direction), np.sin(direction))
    force = carried * np.asarray(along, dtype=float)
    values = bearing_parameters(seat, case.scenario.film)
    found = study_bearing(values, seat.clearance, force, speed, depths or film_depths())
    whose = seat.name if seat.name == train.name else f"{seat.name} of {train.name}"
    title = (
        f"{whose}: d {seat.diameter:g} m, b/d {seat.width / seat.diameter:.3g}, "
        f"C {1e6 * seat.clearance:.4g} µm, {seat.viscosity:g} Pa s, {speed / HERTZ:g} Hz, "
        f"{abs(carried) / 1e3:.4g} kN at {np.degrees(np.arctan2(force[1], force[0])):.4g} deg"
    )
    so = seat.sommerfeld(abs(float(carried)), speed)
    figures: dict[str, Figure] = {
        "curves": curves_figure(found.curves, title, so),
        "coefficients": coefficients_figure(found.curves, found.over_speed, title, so),
    }
    data = [found.curves, found.over_speed]
    if found.pressure is not None:
        figures["pressure"] = pressure_figure(found.pressure, title, force, port.bore_in(str(values["bore"])))
        data.append(found.pressure)
    data = [one.assign_attrs(title=title) for one in data]
    refused = "".join(f"{depth} left out: {reason}\n" for depth, reason in found.refused.items())
    write_results(case, data, [_table(found.curves, title), _at_load(found, speed)], figures, first=refused)
    return 0


def _seat(case: LinearCase, name: str | None) -> BearingSeat:
    """The bearing asked for, or the first."""
    seats = {seat.name: seat for seat in case.train.bearings}
    seat = next(iter(seats.values())) if name is None else seats.get(name)
    if seat is None:
        raise OrchestratorError(f"bearing {name}: no such bearing; {choice(str(name), seats)}")
    if not seat.has_film:
        raise OrchestratorError(
            f"bearing {seat.name}: the train gives its stiffness and damping, and no bore"
        )
    return seat


def _table(curves: xr.Dataset, title: str) -> Table:
    """Every depth over the load."""
    table = table_of(f"{title}; stable up to this speed times the root of C/g", narrow=True)
    for head in ("So", "depth", "eps", "angle\ndeg", "gap\nµm", "p\nMPa", "friction\nkW",
                 "flow\nl/s", "rise\nK", "stable\nup to"):  # fmt: skip
        table.add_column(head, justify="left" if head == "depth" else "right", no_wrap=True)
    step = -(-curves.sizes["sommerfeld"] // ROWS)
    for so in curves["sommerfeld"].values[::step]:
        for k, depth in enumerate(curves["depth"].values):
            table.add_row(f"{so:.3g}" if k == 0 else "", *_row(curves.sel(depth=depth, sommerfeld=so), 3))
    return table


def _at_load(found: BearingStudy, speed: float) -> Table:
    """Every depth under the load at the speed: a column each."""
    here = found.over_speed.sel(rotation=speed / HERTZ, method="nearest")
    names = [str(depth) for depth in here["depth"].values]
    table = table_of("Under its load")
    table.add_column("")
    for name in names:
        table.add_column(name, justify="right")
    heads = ("eps", "angle [deg]", "least gap [µm]", "largest pressure [MPa]", "friction [kW]",
             "side flow [l/s]", "temperature rise [K]", "stable up to w root(C/g)")  # fmt: skip
    rows = [_row(here.sel(depth=name))[1:] for name in names]
    for head, *cells in zip(heads, *rows, strict=True):
        table.add_row(head.replace("[", "\\["), *cells)
    for key, scale, unit in (("stiffness", 1e-9, "GN/m"), ("damping", 1e-6, "MN s/m")):
        for k, axis in enumerate(("xx", "xy", "yx", "yy")):
            entries = [scale * float(here[key].sel(depth=name).values.ravel()[k]) for name in names]
            table.add_row(f"{'K' if key == 'stiffness' else 'C'}{axis} [{unit}]".replace("[", "\\["),
                          *(f"{x:.4g}" for x in entries))  # fmt: skip
    return table


def _figure(value: float, digits: int) -> str:
    """A number with so many significant digits, from a thousand on as a whole one."""
    return f"{value:.0f}" if abs(value) >= 1e3 else f"{value:.{digits}g}"


def _row(point: xr.Dataset, digits: int = 4) -> list[str]:
    """Figures of one depth under one load, to so many significant digits."""
    scales = {"eccentricity": 1.0, "attitude": 1.0, "h_min": 1e6, "p_max": 1e-6, "friction_power": 1e-3,
              "side_flow": 1e3, "temperature_rise": 1.0, "threshold": 1.0}  # fmt: skip
    numbers = [scale * float(point[key]) for key, scale in scales.items()]
    shown = [_figure(x, digits) if np.isfinite(x) else "-" for x in numbers[:-1]]
    stable = "any" if np.isinf(numbers[-1]) else f"{numbers[-1]:.3g}"
    return [str(point["depth"].values), *shown, stable]
