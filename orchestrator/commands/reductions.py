"""``bladeloss reductions``: each reduction beside the unreduced train where it matters."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from rich.table import Table

from orchestrator.fmi.blas import one_blas_thread
from orchestrator.linear.case import HERTZ, REDUCTIONS, LinearCase, linear_case, write_results
from orchestrator.linear.tables import COLUMNS_EXPLAINED, error_text, shaft_column, table_of
from rotor_fmu.linear.analysis import ReductionReport, reduction_report

if TYPE_CHECKING:
    from rich.console import Console

    from orchestrator.linear.case import LinearRequest

SHARES = (0.5, 1.0, 2.0)
"""Speeds of the comparison as shares of the rated one."""

QUANTITIES = {
    "free": "free-free frequencies",
    "supported": "eigenvalues on the films",
    "static": "static bearing loads",
    "unbalance": "bearing forces from unbalance",
}
GOOD = 0.02
"""Errors up to this are written in green, as far as a coupled run is concerned."""

SHOWN = 8
"""Frequencies of the table of iterations."""


@one_blas_thread()
def run(request: LinearRequest, console: Console) -> int:
    """Compute, print and write the comparison; returns the exit status.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input; `EquilibriumError` when there is no operating point.
    """
    case = linear_case(request, console)
    speeds = [share * case.train.speed for share in SHARES]
    reports = [
        reduction_report(
            case.shaft, case.reduced(name), case.operating_point.bearings, speeds, case.unbalance
        )
        for name in REDUCTIONS
    ]
    data = [error_data(case, reports), case.bearing_data]
    if case.reduced("irs-plain").history:
        data.insert(1, iteration_data(case))
        console.print(iteration_table(data[1]))
    write_results(case, data, error_table(case, reports), None)
    return 0


def error_data(case: LinearCase, reports: list[ReductionReport]) -> xr.Dataset:
    """Largest errors (shaft, quantity, rotation); static loads do not depend on speed."""
    values = np.array([[_over_speed(report, key) for key in QUANTITIES] for report in reports])
    return xr.Dataset(
        {
            "error": (
                ("shaft", "quantity", "rotation"),
                values,
                {"units": "1", "long_name": "largest relative error against the unreduced shaft"},
            )
        },
        {
            "shaft": list(REDUCTIONS),
            "quantity": list(QUANTITIES.values()),
            "rotation": ("rotation", reports[0].speeds / HERTZ, {"units": "Hz"}),
        },
        {
            "title": f"Errors of reductions: {case.train.name}",
            "films": case.films,
            "degrees_of_freedom": [report.size for report in reports],
        },
    )


def iteration_data(case: LinearCase) -> xr.Dataset:
    """Elastic frequencies of one plane at rest after each iteration of IRS (iteration, mode)."""
    history = case.reduced("irs-plain").history
    count = min(len(frequencies) for frequencies in history)
    return xr.Dataset(
        {
            "frequency": (
                ("iteration", "mode"),
                np.array([frequencies[:count] for frequencies in history]) / HERTZ,
                {"units": "Hz", "long_name": "natural frequency of one plane, at rest"},
            )
        },
        {"iteration": np.arange(len(history)), "mode": np.arange(1, count + 1)},
        {
            "title": f"Iterated IRS: {case.train.name}",
            "name": "irs-iterations",
            "comment": "iteration 0 is Guyan's static condensation",
        },
    )


def iteration_table(data: xr.Dataset) -> Table:
    """The lowest frequencies after each iteration."""
    table = table_of(
        "Iterated IRS: frequencies at rest [Hz] after each iteration (0: Guyan),\nof the lowest modes",
        narrow=True,
    )
    table.add_column("mode", justify="right")
    shown = data["mode"].values[:SHOWN]
    for mode in shown:
        table.add_column(str(mode), justify="right")
    for iteration, frequencies in zip(data["iteration"].values, data["frequency"].values, strict=True):
        table.add_row(str(iteration), *(f"{f:.6g}" for f in frequencies[: len(shown)]))
    return table


def error_table(case: LinearCase, reports: list[ReductionReport]) -> Table:
    """Largest error of each quantity at each speed, a column a reduction."""
    table = table_of(
        f"{case.train.name}: errors of reduced shafts against the unreduced one "
        f"({case.shaft.size} degrees of freedom), {case.films}"
    )
    table.add_column("largest relative error of", no_wrap=True)
    table.add_column("Hz", justify="right")
    for method, report in zip(REDUCTIONS, reports, strict=True):
        table.add_column(f"{shaft_column(method)}\n{report.size}", justify="right")
    for key, name in QUANTITIES.items():
        rows = np.array([_over_speed(report, key) for report in reports]).T
        if key == "static":
            table.add_row(name, "", *(error_text(e, GOOD) for e in rows[0]), end_section=True)
            continue
        for k, row in enumerate(rows):
            last = k == len(rows) - 1
            speed = f"{reports[0].speeds[k] / HERTZ:g}"
            table.add_row(
                name if k == 0 else "", speed, *(error_text(e, GOOD) for e in row), end_section=last
            )
    table.caption = (
        "Frequencies and eigenvalues: the lowest 16, relative to each. Loads and forces: relative to the "
        f"largest. Green: up to {GOOD:g}. {COLUMNS_EXPLAINED}"
    )
    return table


def _over_speed(report: ReductionReport, key: str) -> np.ndarray:
    """Largest error of a quantity at each speed, (speeds,)."""
    errors = getattr(report, key).error
    if key == "static":
        return np.full(len(report.speeds), errors.max())
    return np.asarray(errors.reshape(len(report.speeds), -1).max(axis=1))
