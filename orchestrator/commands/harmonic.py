"""``bladeloss harmonic``: unbalance response over speed, on the films of each speed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from rich.table import Table

from orchestrator.errors import OrchestratorError
from orchestrator.fmi.blas import one_blas_thread
from orchestrator.linear.case import FULL, HERTZ, LinearCase, linear_case, write_results
from orchestrator.linear.operating_point import bearing_data
from orchestrator.linear.response import Response, followed, resonant_speeds
from orchestrator.linear.tables import COLUMNS_EXPLAINED, shaft_column, table_of, warning
from orchestrator.results.figures.bode import bode_figure
from orchestrator.results.figures.harmonic import harmonic_figure
from orchestrator.results.quantities import FORCE
from rotor_fmu.linear.analysis import half_axes, least_damped

if TYPE_CHECKING:
    from rich.console import Console

    from orchestrator.linear.case import LinearRequest

    Array = NDArray[np.float64]


@one_blas_thread()
def run(
    request: LinearRequest, console: Console, *, highest: float | None = None, probes: Sequence[float] = ()
) -> int:
    """Compute, print and write the response; returns the exit status.

    Parameters
    ----------
    request, console : LinearRequest, Console
        What was asked for, and for output.
    highest : float, optional
        Speed of rotation [Hz]; by default twice the rated one.
    probes : sequence of float
        Angles of probes at each bearing, from x to y [degrees].

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
    with case.over_speed() as films:
        along = followed(case, films, case.highest(highest))
        responses = {name: Response(case, shaft, films) for name, shaft in case.shafts.items()}
        grid = resonant_speeds(case, responses[FULL], along)
        shaft, places, forces = harmonic_data(case, responses, grid)
        phasors = probe_data(case, responses[FULL], grid, probes)
        bearings = bearing_data({s: films.at(s) for s in along.speeds}, case.train, case.films_over_speed)
        worst = least_damped(case.shaft, case.train.speed, films.at(case.train.speed).bearings)
    figures = {
        request.command: harmonic_figure(shaft, places, forces, case.train),
        f"{request.command}-bode": bode_figure(phasors, case.train),
    }
    first = "\n".join(
        filter(None, [warning(worst, case.train.speed), along.missing and f"Left out: {along.missing}."])
    )
    table = harmonic_table(case, shaft, places, forces)
    write_results(case, [shaft, places, phasors, forces, bearings], table, figures, first=first)
    return 0


def harmonic_data(
    case: LinearCase, responses: Mapping[str, Response], grid: Array
) -> tuple[xr.Dataset, xr.Dataset, xr.Dataset]:
    """Largest amplitude of the shaft; amplitudes at bearings and wheels; forces of the bearings.

    Over (shaft, rotation), (shaft, rotation, place) and (shaft, rotation, bearing).
    """
    train = case.train
    nodes = [seat.node for seat in train.bearings] + [wheel.node for wheel in train.wheels]
    names = [seat.name for seat in train.bearings] + [wheel.name for wheel in train.wheels]
    kinds = ["bearing"] * len(train.bearings) + ["wheel"] * len(train.wheels)
    z = np.array(train.z)
    line = np.array([[response.amplitudes(speed) for speed in grid] for response in responses.values()])
    wrenches = np.array([[response.at(speed).wrench for speed in grid] for response in responses.values()])
    pull = half_axes(wrenches[..., 0], wrenches[..., 1])[0]
    axes = {
        "shaft": list(responses),
        "rotation": ("rotation", grid / HERTZ, {"units": "Hz", "long_name": "speed of rotation"}),
    }
    attributes = {"films": case.films_over_speed, "degrees_of_freedom": case.size}

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


def probe_data(case: LinearCase, response: Response, grid: Array, probes: Sequence[float]) -> xr.Dataset:
    """Complex amplitudes of the unreduced shaft at the bearings, along x, y and the probes.

    Displacement = amplitude cos(speed t + phase) (rotation, bearing, probe), where the unbalance with the
    phase 0 lies at x at t = 0.
    """
    angles = np.radians([0.0, 90.0, *probes])
    x, y = (np.array([response.at(speed).shape[i::4] for speed in grid]) for i in range(2))
    nodes = [seat.node for seat in case.train.bearings]
    phasor = x[:, nodes, None] * np.cos(angles) + y[:, nodes, None] * np.sin(angles)
    dims = ("rotation", "bearing", "probe")
    return xr.Dataset(
        {
            "amplitude": (dims, np.abs(phasor), {"units": "m", "long_name": "amplitude along the probe"}),
            "phase": (dims, np.angle(phasor), {"units": "rad", "long_name": "phase, positive: leads"}),
        },
        {
            "rotation": ("rotation", grid / HERTZ, {"units": "Hz", "long_name": "speed of rotation"}),
            "bearing": [seat.name for seat in case.train.bearings],
            "probe": ["x", "y", *(f"{angle:g} deg" for angle in probes)],
        },
        {
            "title": f"Complex amplitudes from unbalance: {case.train.name}",
            "name": "probes",
            "films": case.films_over_speed,
        },
    )


def _micrometres(value: float) -> str:
    """An amplitude [m] in µm, with two digits at least."""
    return f"{1e6 * value:.1f}" if value >= 1e-5 else f"{1e6 * value:.2g}"


def harmonic_table(case: LinearCase, shaft: xr.Dataset, places: xr.Dataset, forces: xr.Dataset) -> Table:
    """Response at rated speed and peaks of the unreduced shaft; errors of the reductions' forces."""
    rated = case.train.speed / HERTZ
    at = int(np.abs(shaft["rotation"].values - rated).argmin())
    here, top = float(shaft["rotation"][at]), float(shaft["rotation"][-1])
    reduced = [str(name) for name in shaft["shaft"].values[1:]]
    table = table_of(
        f"{case.train.name} on {case.films_over_speed}: unbalance response at {here:g} Hz, its peak up to "
        f"{top:g} Hz, and errors of reduced shafts at {here:g} Hz",
        narrow=True,
    )
    pull = FORCE.fitting(float(forces["force"].sel(shaft=FULL)[at].max()))
    pull = pull if pull.unit != FORCE.unit else replace(FORCE, unit="kN", factor=1e-3)
    for name in ("", f"µm at\n{here:g} Hz", "peak\nµm", "at\nHz", f"{pull.unit} at\n{here:g} Hz"):
        table.add_column(name, justify="right" if name else "left", no_wrap=True)
    for name in reduced:
        table.add_column(shaft_column(name), justify="right")

    def row(name: str, amplitude: xr.DataArray, force: xr.DataArray | None) -> None:
        full = amplitude.sel(shaft=FULL).values
        compared = amplitude if force is None else force
        exact = float(compared.sel(shaft=FULL)[at])
        found = [float(compared.sel(shaft=other)[at]) for other in reduced]
        table.add_row(
            name,
            _micrometres(full[at]),
            _micrometres(full.max()),
            "end" if full.argmax() == len(full) - 1 else f"{amplitude['rotation'].values[full.argmax()]:.2f}",
            "" if force is None else pull.number(exact),
            *(f"{abs(value / exact - 1.0):.0e}" if exact else "" for value in found),
        )

    row("shaft, largest", shaft["amplitude"], None)
    table.add_section()
    for seat in case.train.bearings:
        row(seat.name, places["amplitude"].sel(place=seat.name), forces["force"].sel(bearing=seat.name))
    table.caption = (
        "End: it still rises at the end of the range. "
        f"Errors: of the amplitude in the first row, of the bearing forces in the others. {COLUMNS_EXPLAINED}"
    )
    return table
