"""Benchmark i: the film in contact, at several grids, over the states of a run through the fracture.

``python -m tests.benchmarks i``: the paper's scenario as it is, on a rigid bore, and with a soft layer in
every bearing; each run's own states with contact, evaluated at the default grid and up to two doublings.
"""

from __future__ import annotations

import json
import tempfile
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from bearing_fmu.film import BearingResponse, FilmFailure, make_film
from bearing_fmu.parameters import BearingParameters
from orchestrator.scenario.file import load_scenario, train_of
from rotor_fmu.train.writer import write_train
from tests.benchmarks.runs import prepare, run
from tests.benchmarks.table import least_time, percent, show

Array = NDArray[np.float64]

LAYER = {"layer_thickness": 5e-3, "layer_modulus": 5e10, "layer_poisson": 0.35, "layer_hardness": 2e8}
"""White metal: 5 mm of 50 GPa; hardness of some 20 HB."""
GRIDS = ((48, 8), (64, 12), (96, 16))
FINEST = (192, 30)
STATES = 30
END, LOSS = 0.1, 0.02
LEAST_SHARE = 0.02
"""Of the film's force: what the error of the contact's is taken over at least."""

State = tuple[BearingParameters, Array, Array, float]
QUANTITIES = ("film force", "contact force", "friction power", "K", "largest pressure")


def recorded_states(record: xr.Dataset, event: float) -> list[State]:
    """States behind the event in which solids touch, evenly out of all."""
    found: list[State] = []
    late = record.sel(time=record.time > event)
    speed = float(record["rotor_speed"])
    for name in record.bearing.values:
        one = late.sel(bearing=name)
        parameters = BearingParameters.of(json.loads(str(one["bearing_parameters"].values)))
        place = np.hstack([one["displacement"] - one["offset"], one["tilt"] - one["offset_tilt"]])
        rate = np.hstack([one["velocity"], one["tilt_rate"]])
        for i in np.flatnonzero(one["contact_force"].values > 0.0):
            found.append((parameters, place[i], rate[i], speed))
    return [found[i] for i in np.linspace(0, len(found) - 1, min(STATES, len(found))).astype(int)]


def respond(state: State, grid: tuple[int, int]) -> BearingResponse | None:
    """What the bearing answers at a state with another grid; None where it has no answer."""
    parameters, q, v, speed = state
    try:
        return make_film("v1", replace(parameters, columns=grid[0], rows=grid[1])).respond(q, v, speed)
    except FilmFailure:
        return None


def film_force(response: BearingResponse) -> Array:
    """Force of the film alone."""
    return response.wrench[:2] - response.contact_wrench[:2]


def deviations(found: BearingResponse, exact: BearingResponse, half: float) -> list[float]:
    """Of film force, contact force, friction power, K and largest pressure."""
    scale = np.array([1.0, 1.0, half, half])
    k, k_exact = (r.stiffness / np.outer(scale, scale) for r in (found, exact))
    force = float(np.linalg.norm(film_force(exact)))
    return [
        float(np.linalg.norm(film_force(found) - film_force(exact))) / force,
        abs(found.contact_force - exact.contact_force) / max(exact.contact_force, LEAST_SHARE * force),
        abs(found.friction_power / exact.friction_power - 1.0),
        float(np.abs(k - k_exact).max() / np.abs(k_exact).max()),
        abs(found.p_max / exact.p_max - 1.0),
    ]


def _table(title: str, states: list[State]) -> None:
    both = [(state, respond(state, FINEST)) for state in states]
    exact = [response for _, response in both if response is not None]
    states, asked = [state for state, response in both if response is not None], len(states)
    rows = []
    for grid in GRIDS:
        found = [respond(state, grid) for state in states]
        errors = np.array([
            deviations(coarse, finest, 0.5 * state[0].width)
            for state, coarse, finest in zip(states, found, exact, strict=True) if coarse is not None
        ])  # fmt: skip
        pairs = zip(np.median(errors, axis=0), errors.max(axis=0), strict=True)
        timed = [state for state, coarse in zip(states, found, strict=True) if coarse is not None]
        time = np.mean([_time(state, grid) for state in timed[:: max(1, len(timed) // 8)]])
        rows.append(
            (f"{grid[0]} x {grid[1]}", *(f"{percent(a)} / {percent(b)}" for a, b in pairs), f"{time:.0f}")
        )
    peak, pressed, force = (
        max(getattr(r, name) for r in exact) for name in ("p_max", "contact_pressure", "contact_force")
    )
    gaps = [response.h_min for response in exact]
    show(
        f"i. {title}: {len(states)} states, rigid gaps {1e6 * min(gaps):.1f} to {1e6 * max(gaps):.1f} um; "
        f"deviation from {FINEST[0]} x {FINEST[1]}, median / worst",
        ("grid", *QUANTITIES, "us"),
        rows,
        f"{asked - len(states)} more states have no answer there; at most: film {1e-6 * peak:.0f} MPa, "
        f"asperities {1e-6 * pressed:.0f} MPa, contact {1e-3 * force:.0f} kN",
    )


def _time(state: State, grid: tuple[int, int]) -> float:
    """Processor time of an evaluation [us]."""
    parameters, q, v, speed = state
    film = make_film("v1", replace(parameters, columns=grid[0], rows=grid[1]))
    return 1e6 * least_time(partial(film.respond, q, v, speed), repeats=20, rounds=3)


def main() -> None:
    """Print both tables."""
    with tempfile.TemporaryDirectory() as folder:
        train = train_of(load_scenario("paper", {}))
        soft = replace(
            train, name="layered", bearings=tuple(replace(seat, **LAYER) for seat in train.bearings)
        )
        write_train(soft, Path(folder))
        for title, overrides in (("Rigid bore", {}), ("Soft layer", {"train": folder})):
            case = prepare("paper", end=END, event={"time": LOSS}, **overrides)
            timed = run(case)
            _table(
                f"{title}, the paper's scenario {1e3 * (END - LOSS):g} ms through the loss",
                recorded_states(timed.result.record, LOSS),
            )


if __name__ == "__main__":
    main()
