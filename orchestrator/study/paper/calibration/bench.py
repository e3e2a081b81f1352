"""Trains that are being designed, carried by the master: steady state, and runs across a fracture."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from rich.console import Console

from orchestrator.case.simulate import simulate
from orchestrator.errors import OrchestratorError
from orchestrator.fmi.folder import ensure_fmus
from orchestrator.linear.operating_point import on_running_films
from orchestrator.master.system import RESPONSE
from orchestrator.results.statistics import bearing_statistics, half_peak_to_peak
from orchestrator.results.windows import phases
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.train.train import Train
from rotor_fmu.train.writer import write_train

SAMPLES = 24
"""Instants of a revolution at which the steady state is looked at."""


@dataclass(frozen=True)
class Steady:
    """Before the fracture, at one bearing and one depth: SI units, So without unit."""

    force: float
    sommerfeld: float
    gap: float
    gap_harmonic: float
    amplitude: float
    stress: float


@dataclass(frozen=True)
class Bench:
    """A folder in which trains are written and their FMUs built; see `bench`."""

    folder: Path

    def scenario(self, train: Train, depth: str, **settings: Any) -> Scenario:
        """A scenario of a train, which is written, with its FMUs; settings are keys of a scenario's file."""
        write_train(train, self.folder / "train")
        depths = {depth, *settings.get("depth_at", {}).values()}
        ensure_fmus(self.folder, train, depths, Console(quiet=True))
        given = {"train": str(self.folder / "train"), "depth": depth, "end": 1.0, **settings}
        return Scenario.model_validate(given)

    def steady(self, train: Train, depth: str, bearing: str, **settings: Any) -> Steady:
        """Steady state with its linear unbalance response over a revolution, without any time step.

        The films are evaluated, nonlinear, along the rotor's orbit; it turns as the unbalance's phases do.
        """
        scenario = self.scenario(train, depth, **settings)
        seat = train.bearings[bearing_index(train, bearing)]
        phases = [f"wheel[{k}].unbalance_phase" for k in range(1, len(train.wheels) + 1)]
        films, shaft = [], []
        with on_running_films(scenario, train, self.folder) as system:
            at_rest = system.rotor.get_real(phases)
            for angle in 2.0 * np.pi * np.arange(SAMPLES) / SAMPLES:
                system.rotor.set_real(phases, at_rest + angle)
                system.rotor_group.push()
                system.rotor_group.fetch()
                system.bearing_inputs[:, :8] = system.journals
                system.bearing_group.push()
                system.bearing_group.fetch()
                films.append(system.responses[bearing_index(train, bearing)].copy())
                shaft.append(system.rotor.get_real(("amplitude.max", "stress.max")))
        response = np.array(films).T
        force = float(np.hypot(*response[[RESPONSE["wrench.Fx"], RESPONSE["wrench.Fy"]]]).mean())
        gap = response[RESPONSE["h_min"]]
        amplitude, stress = np.max(shaft, axis=0)
        return Steady(
            force=force,
            sommerfeld=seat.sommerfeld(force, train.speed),
            gap=float(gap.mean()),
            gap_harmonic=half_peak_to_peak(gap),
            amplitude=float(amplitude),
            stress=float(stress),
        )

    def run(self, train: Train, depth: str, event: Mapping[str, Any], **settings: Any) -> xr.Dataset:
        """Record of a run across a fracture, every step kept.

        Raises
        ------
        OrchestratorError
            When it does not come to its end.
        """
        step = settings.get("step", 1e-4)
        given = {"events": [{"kind": "blade-loss", **event}], "record": {"interval": step}, **settings}
        result = simulate(self.scenario(train, depth, **given), self.folder)
        if not result.outcome.ok:
            raise OrchestratorError(f"{depth}: {result.outcome.value}: {result.message}")
        return result.record


@contextmanager
def bench() -> Iterator[Bench]:
    """Yield a bench whose folder vanishes at the end."""
    with tempfile.TemporaryDirectory(prefix="bladeloss_bench_") as folder:
        yield Bench(Path(folder))


def bearing_index(train: Train, name: str) -> int:
    """Index of a bearing by its name."""
    return [seat.name for seat in train.bearings].index(name)


def near(train: Train, rotor: str, depth: str = "v1") -> dict[str, str]:
    """One depth at the bearings of one rotor only: V1 there and V2 elsewhere saves the time of the others."""
    return {seat.name: depth for seat in train.bearings if seat.name.startswith(f"{rotor}-")}


def late_force(record: xr.Dataset, bearing: str) -> float:
    """Largest bearing force once the transient behind the fracture has gone [N]."""
    after = phases(record)[-1]
    late = replace(after, peak=after.mean)
    return bearing_statistics(record, bearing, late, contact_from=np.inf).force_max
