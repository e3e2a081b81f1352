"""``bladeloss modes``: how the train vibrates on its films at rated speed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from rich.table import Table

from orchestrator.fmi.blas import one_blas_thread
from orchestrator.linear.case import HERTZ, LinearCase, linear_case, write_results
from orchestrator.linear.operating_point import OperatingPoint, bearing_data
from orchestrator.linear.tables import table_of, warning, whirl_name
from orchestrator.results.figures.mode_shapes import mode_shapes_figure
from rotor_fmu.linear.analysis import NOISE, half_axes, least_damped, log_decrement, whirl_modes

if TYPE_CHECKING:
    from rich.console import Console

    from orchestrator.linear.case import LinearRequest


@one_blas_thread()
def run(request: LinearRequest, console: Console, *, count: int, hertz: float | None = None) -> int:
    """Compute, print and write the modes; returns the exit status.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input; `EquilibriumError` when there is no operating point.
    """
    case = linear_case(request, console)
    speed = case.train.speed if hertz is None else HERTZ * hertz
    if hertz is None:
        point = case.operating_point
    else:
        with case.over_speed() as films:
            point = films.at(speed)
    data = mode_data(case, count, speed, point)
    worst = least_damped(case.shaft, speed, point.bearings)
    bearings = bearing_data({speed: point}, case.train, case.films_at(speed))
    figure = mode_shapes_figure(data, case.train)
    write_results(case, [data, bearings], mode_table(case, data), figure, first=warning(worst, speed))
    return 0


def mode_data(
    case: LinearCase, count: int, speed: float | None = None, point: OperatingPoint | None = None
) -> xr.Dataset:
    """Modes of the unreduced shaft on its films at a speed [rad/s], by default the rated one (mode, node)."""
    train = case.train
    speed = train.speed if speed is None else speed
    point = case.operating_point if point is None else point
    modes = whirl_modes(case.shaft, speed, count, bearings=point.bearings)
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
        "log_decrement": (log_decrement(modes), "1", "logarithmic decrement, negative if unstable"),
        "growth_rate": (modes.eigenvalues.real, "1/s", "real part of the eigenvalue"),
        "bending": (modes.bending, "1", "share of the shaft in what strains, 0: rigid on its bearings"),
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
            "films": case.films_at(speed),
            "rotation": speed / HERTZ,
        },
    )


def mode_table(case: LinearCase, data: xr.Dataset) -> Table:
    """Frequency, damping ratio and whirl, and where the shape is largest."""
    table = table_of(f"{case.train.name} on {data.attrs['films']}, unreduced shaft", narrow=True)
    for name in (
        "mode",
        "Hz",
        "damping\nratio",
        "log.\ndecr.",
        "shaft\nbends",
        "whirl",
        "largest at\nz \\[m]",
        "nearest\nbearing",
    ):
        left = name in ("whirl", "nearest\nbearing")
        table.add_column(name, justify="left" if left else "right", no_wrap=name == "whirl")
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
            f"[bold red]{ratio:.4f}[/bold red]" if ratio < -NOISE else f"{_unsigned(ratio):.4f}",
            f"{_unsigned(float(data['log_decrement'][k])):.3f}",
            f"{100.0 * float(data['bending'][k]):.0f} %",
            whirl_name(float(data["whirl_direction"][k])),
            f"{place:.2f}",
            seat.name,
        )
    table.caption = (
        "Shaft bends: its share in the strain of the mode, the rest is that of the bearings and of what "
        "they stand on; near 0 % it moves on them as a rigid body, on films in oil whirl at about half the "
        "speed of rotation."
    )
    return table


def _unsigned(damping: float) -> float:
    """Damping, without the sign that rounding gives to none."""
    return 0.0 if abs(damping) < NOISE else damping
