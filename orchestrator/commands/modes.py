"""``bladeloss modes``: how the train vibrates on its films at rated speed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from rich.table import Table

from orchestrator.fmi.blas import one_blas_thread
from orchestrator.linear.case import HERTZ, LinearCase, linear_case, write_results
from orchestrator.linear.tables import table_of, whirl_name
from orchestrator.results.figures.mode_shapes import mode_shapes_figure
from rotor_fmu.linear.analysis import half_axes, whirl_modes

if TYPE_CHECKING:
    from rich.console import Console

    from orchestrator.linear.case import LinearRequest


@one_blas_thread()
def run(request: LinearRequest, console: Console, *, count: int) -> int:
    """Compute, print and write the modes; returns the exit status.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input; `EquilibriumError` when there is no operating point.
    """
    case = linear_case(request, console)
    data = mode_data(case, count)
    write_results(
        case, [data, case.bearing_data], mode_table(case, data), mode_shapes_figure(data, case.train)
    )
    return 0


def mode_data(case: LinearCase, count: int) -> xr.Dataset:
    """Modes of the unreduced shaft on its films at rated speed (mode, node)."""
    train = case.train
    modes = whirl_modes(case.shaft, train.speed, count, bearings=case.operating_point.bearings)
    shapes = modes.shapes.reshape(train.nodes, 4, -1)
    shapes = shapes / half_axes(shapes[:, 0], shapes[:, 1])[0].max(axis=0)
    dims = ("mode", "node")
    variables: dict[str, Any] = {
        f"{axis}_{part}": (
            dims,
            getattr(shapes[:, i, :].T, name),
            {"units": "1", "long_name": f"{axis}, {part} part; largest half axis of an orbit 1"},
        )
        for i, axis in enumerate(("x", "y"))
        for part, name in (("real", "real"), ("imaginary", "imag"))
    }
    single = {
        "frequency": (modes.frequency / HERTZ, "Hz", "damped frequency"),
        "damping_ratio": (modes.damping_ratio, "1", "damping ratio, negative if unstable"),
        "growth_rate": (modes.eigenvalues.real, "1/s", "real part of the eigenvalue"),
        "whirl_direction": (modes.direction, "1", "whirl direction, -1 backward to 1 forward"),
    }
    for name, (values, unit, label) in single.items():
        variables[name] = (dims[:1], values, {"units": unit, "long_name": label})
    return xr.Dataset(
        variables,
        {
            "mode": np.arange(1, len(modes.frequency) + 1),
            "z": ("node", np.array(train.z), {"units": "m", "long_name": "axial position"}),
        },
        {
            "title": f"Modes of the supported train: {train.name}",
            "films": case.films,
            "rotation": train.speed / HERTZ,
        },
    )


def mode_table(case: LinearCase, data: xr.Dataset) -> Table:
    """Frequency, damping ratio and whirl, and where the shape is largest."""
    table = table_of(f"{case.train.name} on {case.films}, unreduced shaft")
    for name in ("mode", "Hz", "damping\nratio", "whirl", "largest at\nz \\[m]", "nearest\nbearing"):
        table.add_column(name, justify="left" if name in ("whirl", "nearest\nbearing") else "right")
    z = data["z"].values
    x, y = (data[f"{axis}_real"].values + 1j * data[f"{axis}_imaginary"].values for axis in "xy")
    size, _, _ = half_axes(x, y)
    for k, mode in enumerate(data["mode"].values):
        place = z[int(np.argmax(size[k]))]
        seat = min(case.train.bearings, key=lambda s: abs(case.train.z[s.node] - place))
        ratio = float(data["damping_ratio"][k])
        table.add_row(
            str(mode),
            f"{float(data['frequency'][k]):.3f}",
            f"[bold red]{ratio:.4f}[/bold red]" if ratio < 0.0 else f"{ratio:.4f}",
            whirl_name(float(data["whirl_direction"][k])),
            f"{place:.2f}",
            seat.name,
        )
    return table
