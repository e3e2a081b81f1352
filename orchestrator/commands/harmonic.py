"""``bladeloss harmonic``: unbalance response over speed on the bearings of the operating point."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from rich.table import Table

from orchestrator.errors import OrchestratorError
from orchestrator.fmi.blas import one_blas_thread
from orchestrator.linear.case import FULL, HERTZ, LinearCase, linear_case, write_results
from orchestrator.linear.tables import COLUMNS_EXPLAINED, shaft_column, table_of
from orchestrator.results.figures.harmonic import harmonic_figure
from rotor_fmu.linear.analysis import HarmonicResponse, half_axes, unbalance_responses

if TYPE_CHECKING:
    from rich.console import Console

    from orchestrator.linear.case import LinearRequest

    Array = NDArray[np.float64]

STEP = 0.25
"""Interval of the axis of speed [Hz]; the rated speed is added."""


@one_blas_thread()
def run(request: LinearRequest, console: Console, *, highest: float) -> int:
    """Compute, print and write the response; returns the exit status.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input; `EquilibriumError` when there is no operating point.
    """
    case = linear_case(request, console)
    if not case.unbalance.any():
        raise OrchestratorError(
            f"{request.source}: no wheel of train {case.train.name} has an unbalance, so nothing responds; "
            "give the train wheels, or the scenario unbalance.grade or unbalance.at"
        )
    rated = case.train.speed / HERTZ
    rotation = np.arange(1.0, np.ceil(highest / STEP) + 1.0) * STEP
    if rated <= highest:
        rotation = np.union1d(rotation.round(9), [round(rated, 9)])
    shaft, places, forces = harmonic_data(case, rotation)
    figure = harmonic_figure(shaft, places, forces, case.train)
    table = harmonic_table(case, shaft, places, forces)
    write_results(case, [shaft, places, forces, case.bearing_data], table, figure)
    return 0


def harmonic_data(case: LinearCase, rotation: Array) -> tuple[xr.Dataset, xr.Dataset, xr.Dataset]:
    """Largest amplitude of the shaft; amplitudes at bearings and wheels; forces of the bearings.

    Over (shaft, rotation), (shaft, rotation, place) and (shaft, rotation, bearing).
    """
    train = case.train
    nodes = [seat.node for seat in train.bearings] + [wheel.node for wheel in train.wheels]
    names = [seat.name for seat in train.bearings] + [wheel.name for wheel in train.wheels]
    kinds = ["bearing"] * len(train.bearings) + ["wheel"] * len(train.wheels)
    bearings, z = case.operating_point.bearings, np.array(train.z)
    amplitude, force = [], []
    for shaft in case.shafts.values():
        found = unbalance_responses(shaft, HERTZ * rotation, bearings, case.unbalance)
        amplitude.append([_amplitudes(response) for response in found])
        force.append([half_axes(r.wrench[:, 0], r.wrench[:, 1])[0] for r in found])
    line, pull = np.array(amplitude), np.array(force)
    axes = {
        "shaft": list(case.shafts),
        "rotation": ("rotation", rotation, {"units": "Hz", "long_name": "speed of rotation"}),
    }
    attributes = {"films": case.films, "degrees_of_freedom": case.size}

    def described(values: Array, unit: str, label: str, *more: str) -> tuple[tuple[str, ...], Array, dict]:
        return ("shaft", "rotation", *more), values, {"units": unit, "long_name": label}

    return (
        xr.Dataset(
            {
                "amplitude": described(line.max(axis=2), "m", "largest amplitude of the shaft"),
                "position": described(z[line.argmax(axis=2)], "m", "where it is"),
            },
            axes,
            {"title": f"Unbalance response: {train.name}", **attributes},
        ),
        xr.Dataset(
            {"amplitude": described(line[:, :, nodes], "m", "amplitude, largest half axis", "place")},
            {**axes, "place": names, "kind": ("place", kinds)},
            {"title": f"Amplitudes from unbalance: {train.name}", "name": "amplitudes", **attributes},
        ),
        xr.Dataset(
            {"force": described(pull, "N", "force from unbalance, largest half axis", "bearing")},
            {**axes, "bearing": [seat.name for seat in train.bearings]},
            {"title": f"Bearing forces from unbalance: {train.name}", "name": "forces", **attributes},
        ),
    )


def _amplitudes(response: HarmonicResponse) -> Array:
    """Largest half axis of every node's orbit, (nodes,)."""
    return half_axes(response.shape[0::4], response.shape[1::4])[0]


def harmonic_table(case: LinearCase, shaft: xr.Dataset, places: xr.Dataset, forces: xr.Dataset) -> Table:
    """Response at rated speed and peaks of the unreduced shaft; errors of the reductions' forces."""
    rated = case.train.speed / HERTZ
    at = int(np.abs(shaft["rotation"].values - rated).argmin())
    here, top = float(shaft["rotation"][at]), float(shaft["rotation"][-1])
    reduced = [str(name) for name in shaft["shaft"].values[1:]]
    table = table_of(
        f"{case.train.name} on {case.films}: unbalance response at {here:g} Hz, its peak up to "
        f"{top:g} Hz, and errors of reduced shafts at {here:g} Hz",
        narrow=True,
    )
    for name in ("", f"µm at\n{here:g} Hz", "peak\nµm", "at\nHz", f"kN at\n{here:g} Hz"):
        table.add_column(name, justify="right" if name else "left", no_wrap=True)
    for name in reduced:
        table.add_column(shaft_column(name), justify="right")

    def row(name: str, amplitude: xr.DataArray, force: xr.DataArray | None) -> None:
        full = amplitude.sel(shaft=FULL).values
        compared = amplitude if force is None else force
        exact = float(compared.sel(shaft=FULL)[at])
        errors = [float(compared.sel(shaft=other)[at]) / exact - 1.0 for other in reduced]
        table.add_row(
            name,
            f"{full[at] * 1e6:.1f}",
            f"{full.max() * 1e6:.1f}",
            f"{float(amplitude['rotation'][int(full.argmax())]):.2f}",
            "" if force is None else f"{exact * 1e-3:.2f}",
            *(f"{abs(error):.0e}" for error in errors),
        )

    row("shaft, largest", shaft["amplitude"], None)
    table.add_section()
    for seat in case.train.bearings:
        row(seat.name, places["amplitude"].sel(place=seat.name), forces["force"].sel(bearing=seat.name))
    table.caption = (
        f"Errors: of the amplitude in the first row, of the bearing forces in the others. {COLUMNS_EXPLAINED}"
    )
    return table
