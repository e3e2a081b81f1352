"""A train in its films: its steady state before the fracture and the run across it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from orchestrator.study.paper.calibration.films import FORCE, Films
from orchestrator.study.paper.calibration.start import align, find_equilibrium
from rotor_fmu.reduction.reduce import Method
from rotor_fmu.shaft.fields import Extremes
from rotor_fmu.train.train import Train
from rotor_fmu.vibration.rotor import Rotor

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Blade:
    """Lost blade: name of the wheel, mass times radius [kg m], angle at t = 0 [rad], instant [s]."""

    wheel: str
    unbalance: float
    phase: float = 0.0
    time: float = 0.2


@dataclass(frozen=True, eq=False)
class History:
    """Samples of a run.

    Attributes
    ----------
    time : ndarray, (t,)
        [s].
    films : ndarray, (t, n_b, 52)
        Outputs of the films in the order of the port.
    amplitude, stress : ndarray, (t,)
        Largest of all nodes [m], [Pa].
    """

    time: Array
    films: Array
    amplitude: Array
    stress: Array

    def force(self, bearing: int) -> Array:
        """Magnitude of the bearing force over time [N]."""
        return np.hypot(*self.films[:, bearing, FORCE].T)

    def moment(self, bearing: int) -> Array:
        """Magnitude of the bearing moment over time [N m]."""
        return np.hypot(*self.films[:, bearing, 2:4].T)


class CoupledTrain:
    """Rotor and films, aligned, in static equilibrium plus linear unbalance response.

    Parameters
    ----------
    train : Train
        The train.
    depth : str
        Depth of the bearings.
    depth_at : mapping, optional
        Depth by name of the bearing, where it differs.
    reduction : str
        Of the shaft.
    columns, rows : int
        Resolution of the films.
    """

    def __init__(
        self,
        train: Train,
        depth: str,
        *,
        depth_at: Mapping[str, str] | None = None,
        reduction: Method = "irs",
        columns: int = 48,
        rows: int = 8,
    ) -> None:
        self.train, self.reduction = train, reduction
        depths = [(depth_at or {}).get(seat.name, depth) for seat in train.bearings]
        self.films = Films(train.bearings, depths, train.speed, columns=columns, rows=rows)
        rotor = Rotor(train, reduction=reduction)
        align(train, rotor, self.films)
        self.law = find_equilibrium(rotor, self.films)

    def revolution(self, samples: int = 24) -> History:
        """One revolution of the steady state with its linear unbalance response, without any time step."""
        rotor = Rotor(self.train, reduction=self.reduction)
        times = 2.0 * np.pi / self.train.speed * np.arange(samples) / samples
        rows, extremes = [], []
        for time in times:
            rotor.start_from_law(*self.law, orbit=True, time=float(time))
            self.films.evaluate(rotor.kinematics())
            rows.append(self.films.outputs.copy())
            extremes.append(rotor.extremes())
        return _history(times, rows, extremes)

    def run(self, blade: Blade, end: float, step: float = 1e-4, interval: float = 1e-4) -> History:
        """Run across the fracture, linearly implicit: the rotor under the laws, then the films.

        Parameters
        ----------
        blade : Blade
            What breaks off.
        end : float
            [s].
        step : float
            Macro step [s].
        interval : float
            Time between two samples [s].
        """
        index = [wheel.name for wheel in self.train.wheels].index(blade.wheel)
        unbalance, phase = np.zeros((2, len(self.train.wheels)))
        unbalance[index], phase[index] = blade.unbalance, blade.phase
        rotor = Rotor(
            self.train,
            reduction=self.reduction,
            blade_unbalance=unbalance,
            blade_phase=phase,
            fracture_time=blade.time,
        )
        rotor.start_from_law(*self.law, orbit=True)
        every = max(1, round(interval / step))
        times, rows, extremes = [], [], []
        law = self.films.evaluate(rotor.kinematics())
        for k in range(round(end / step)):
            rotor.step(k * step, step, *law, self.train.speed)
            law = self.films.evaluate(rotor.kinematics())
            if (k + 1) % every == 0:
                times.append((k + 1) * step)
                rows.append(self.films.outputs.copy())
                extremes.append(rotor.extremes())
        return _history(np.array(times), rows, extremes)


def _history(times: Array, rows: list[Array], extremes: list[Extremes]) -> History:
    amplitude, _, stress, _ = np.array(extremes).T
    return History(times, np.array(rows), amplitude, stress)
