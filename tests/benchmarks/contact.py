"""Benchmark i: the film in contact, at several grids, over the states of a run through the fracture.

``python -m tests.benchmarks i``: scenario inertia on rigid shells, and on lined ones. The way of each
bearing that comes to contact is gone again on the default grid and up to two doublings, each film with its
own memory, and compared where solids touch.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from time import perf_counter

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from bearing_fmu.film import Film, FilmFailure, make_film
from bearing_fmu.outputs import INPUTS, OUT_C, OUT_GAP, OUT_K
from bearing_fmu.parameters import BearingParameters
from fmus import port
from tests.benchmarks.runs import prepare, run
from tests.benchmarks.table import percent, show

Array = NDArray[np.float64]

GRIDS = ((48, 8), (64, 12), (96, 16))
FINEST = (192, 30)  # 30 rows are the most
END, LOSS = 0.07, 0.02
STEP = 1e-4
LEAST_SHARE = 0.02
"""Of the film's force: what the error of the contact's is taken over at least."""
REPEATS = 3

QUANTITIES = ("film force", "contact force", "friction power", "K", "largest pressure")
_PLACE = {variable.name: i for i, variable in enumerate(port.BEARING_OUTPUTS)}
_CONTACT, _POWER, _PEAK = (_PLACE[name] for name in ("contact_force", "friction_power", "p_max"))
_PRESSED, _GAP = _PLACE["contact_pressure"], _PLACE["h_min"]


def ways(record: xr.Dataset) -> Iterator[tuple[BearingParameters, Array]]:
    """Parameters and inputs, one row a step, of the bearings that come to contact."""
    times = record["time"].values
    rows = np.flatnonzero(np.diff(times, prepend=-STEP) > 0.5 * STEP)
    for name in record.bearing.values:
        one = record.sel(bearing=name)
        if not (one["contact_force"] > 0.0).any():
            continue
        inputs = np.zeros((rows.size, INPUTS))
        place = np.hstack([one["displacement"] - one["offset"], one["tilt"] - one["offset_tilt"]])
        inputs[:, :4], inputs[:, 16] = place[rows], float(record["rotor_speed"])
        inputs[:, 4:8] = np.hstack([one["velocity"], one["tilt_rate"]])[rows]
        yield BearingParameters.of(json.loads(str(one["bearing_parameters"].values))), inputs


def follow(film: Film, inputs: Array, repeats: int = 1) -> tuple[Array, Array]:
    """Outputs at each step, not-a-number where the film has no answer, and processor time in us."""
    state, found, times = film.rest(), np.full((len(inputs), OUT_GAP + 18), np.nan), np.zeros(len(inputs))
    for i, row in enumerate(inputs):
        try:
            times[i] = np.inf
            for _ in range(repeats):
                begun = perf_counter()
                out, after = film.evaluate(state, row, STEP if i else 0.0)
                times[i] = min(times[i], 1e6 * (perf_counter() - begun))
        except FilmFailure:
            continue
        found[i], state = out[: found.shape[1]], after
    return found, times


def deviations(found: Array, exact: Array, half: float) -> list[float]:
    """Of film force, contact force, friction power, K and largest pressure, of outputs."""
    scale = np.array([1.0, 1.0, half, half])
    k, k_exact = (out[OUT_K:OUT_C].reshape(4, 4) / np.outer(scale, scale) for out in (found, exact))
    film, film_exact = (out[:2] - out[OUT_GAP + 5 : OUT_GAP + 7] for out in (found, exact))
    force = float(np.linalg.norm(film_exact))
    return [
        float(np.linalg.norm(film - film_exact)) / force,
        abs(found[_CONTACT] - exact[_CONTACT]) / max(exact[_CONTACT], LEAST_SHARE * force),
        abs(found[_POWER] / exact[_POWER] - 1.0),
        float(np.abs(k - k_exact).max() / np.abs(k_exact).max()),
        abs(found[_PEAK] / exact[_PEAK] - 1.0),
    ]


def _table(title: str, record: xr.Dataset) -> None:
    errors: dict[tuple[int, int], list[list[float]]] = {grid: [] for grid in GRIDS}
    times: dict[tuple[int, int], list[float]] = {grid: [] for grid in GRIDS}
    rigid, peaks, gaps, missed, apart = [], [], [], 0, []
    for parameters, inputs in ways(record):
        exact, _ = follow(make_film("v1", replace(parameters, columns=FINEST[0], rows=FINEST[1])), inputs)
        bare = follow(make_film("v1", replace(parameters, layer_thickness=0.0)), inputs, REPEATS)[1]
        missed += int(np.isnan(exact[:, 0]).sum())
        touching = np.flatnonzero(exact[:, _CONTACT] > 0.0)
        open_ = np.flatnonzero(exact[:, _GAP] > 0.1 * parameters.clearance)
        rigid.append(bare[touching])
        peaks.append(exact[touching][:, [_PEAK, _PRESSED, _CONTACT]].max(axis=0))
        gaps.append(exact[touching, _GAP])
        for grid in GRIDS:
            film = make_film("v1", replace(parameters, columns=grid[0], rows=grid[1]))
            found, time = follow(film, inputs, REPEATS if grid == GRIDS[0] else 1)
            missed += int(np.isnan(found[:, 0]).sum())
            errors[grid] += [deviations(found[i], exact[i], 0.5 * parameters.width) for i in touching]
            times[grid] += time[touching].tolist()
            if grid == GRIDS[0]:
                apart.append(time[open_] / bare[open_])
    rows = []
    for grid in GRIDS:
        pairs = zip(np.nanmedian(errors[grid], axis=0), np.nanmax(errors[grid], axis=0), strict=True)
        cells = [f"{percent(a)} / {percent(b)}" for a, b in pairs]
        rows.append((f"{grid[0]} x {grid[1]}", *cells, f"{np.mean(times[grid]):.0f}"))
    peak, pressed, force = np.max(peaks, axis=0)
    gap = np.concatenate(gaps)
    show(
        f"i. {title}: {gap.size} states, rigid gaps {1e6 * gap.min():.1f} to {1e6 * gap.max():.1f} um; "
        f"deviation from {FINEST[0]} x {FINEST[1]}, median / worst",
        ("grid", *QUANTITIES, "us"),
        rows,
        f"{missed} steps without an answer on any grid; at most: film {1e-6 * peak:.0f} MPa, "
        f"asperities {1e-6 * pressed:.0f} MPa, contact {1e-3 * force:.0f} kN; a rigid bore takes "
        f"{np.mean(np.concatenate(rigid)):.0f} us there; where nothing is close "
        f"{np.median(np.concatenate(apart)):.2f} times as long as one",
    )


def main() -> None:
    """Print both tables."""
    for title, source in (("Rigid shells", "inertia"), ("Lined shells", "lined")):
        case = prepare(source, end=END, event={"time": LOSS}, record={"interval": STEP})
        record = run(case).result.record
        _table(f"{title}, scenario {source} {1e3 * (END - LOSS):g} ms through the loss", record)


if __name__ == "__main__":
    main()
