"""The operating point: the bearings' stiffness and damping where the train runs.

Found like the start of a run, through the FMUs: the films carry the train at its rated speed,
and the tangents that they export there are its linearised bearings.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from fmus.build.promises import AFFINE
from orchestrator.errors import EquilibriumError
from orchestrator.fmi.blas import one_blas_thread
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.unit import UnitError
from orchestrator.master.assembly import assemble
from orchestrator.master.start.equilibrium import find_start, rest_at
from orchestrator.master.system import System
from orchestrator.results.quantities import HERTZ
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.linear.analysis import LinearBearings
from rotor_fmu.train.train import Train

Array = NDArray[np.float64]

HALVINGS = 6
"""Of the way to a speed at which the search from its neighbour fails."""


@dataclass(frozen=True, eq=False)
class OperatingPoint:
    """Static equilibrium of a train on its films at rated speed.

    Attributes
    ----------
    bearings : LinearBearings
        Stiffness and damping (bearings, 4, 4) in the order x, y, tilt_x, tilt_y.
    loads : ndarray (bearings, 2)
        Static forces of the bearings on the shaft in N.
    """

    bearings: LinearBearings
    loads: Array


@contextmanager
def on_running_films(scenario: Scenario, train: Train, fmus: Path) -> Iterator[System]:
    """Yield a scenario's train in static equilibrium on its films, at rated speed and before any time step.

    The units are in Initialization Mode; the rotor rests under `System.laws`, the films are evaluated there.

    Raises
    ------
    EquilibriumError
        When there is none.
    FmuError, PortError
        As `orchestrator.master.assembly.assemble`.
    """
    with FmuStore() as store:
        # Statics go through the unreduced shaft; the quickest reduction will do for the rest.
        system = assemble(scenario.model_copy(update={"reduction": "guyan"}), train, fmus, store)
        try:
            find_start(system, train, train.speed)
            yield system
        except UnitError as error:
            raise EquilibriumError(str(error)) from None
        finally:
            system.close()


class OverSpeed:
    """Operating points of a train at any speed: its films are solved anew at each.

    The bearings stay where the alignment at rated speed has put them; loads shift between them.

    Parameters
    ----------
    system : System
        Of the train, in equilibrium at rated speed, see `on_running_films`.
    train : Train
        The train.
    """

    def __init__(self, system: System, train: Train) -> None:
        self._system, self._train = system, train
        self._found = {train.speed: (system.bearing_inputs[:, :4].copy(), _point(system))}

    def at(self, speed: float) -> OperatingPoint:
        """The operating point at a speed [rad/s]; the search starts at the nearest that is known.

        Raises
        ------
        EquilibriumError
            When there is none.
        """
        if speed not in self._found:
            self._find(speed, HALVINGS)
        return self._found[speed][1]

    def reachable(self, speeds: Sequence[float]) -> tuple[list[float], str]:
        """Those of the speeds at which there is an equilibrium, and why there is none at others, or nothing.

        Each way from rated speed the search ends at the first without.  At standstill no film carries.
        """
        reached, reasons = [], []
        films = any(AFFINE not in unit.file.promises for unit in self._system.bearings)
        if films and any(speed <= 0.0 for speed in speeds):
            reasons.append("standstill, where no film carries")
        below = sorted((s for s in speeds if (s > 0.0 or not films) and s <= self._train.speed), reverse=True)
        for direction in (below, sorted(s for s in speeds if s > self._train.speed)):
            for speed in direction:
                try:
                    self.at(speed)
                except EquilibriumError as error:
                    reasons.append(f"no equilibrium at {speed / HERTZ:.4g} Hz of rotation: {error}")
                    break
                reached.append(speed)
        return sorted(reached), "; ".join(reasons)

    def _find(self, speed: float, halvings: int) -> None:
        near = min(self._found, key=lambda known: abs(known - speed))
        try:
            positions = rest_at(self._system, self._train.bearings, speed, self._found[near][0])
        except (EquilibriumError, UnitError) as error:
            if not halvings:
                raise EquilibriumError(str(error)) from None
            self._find(0.5 * (near + speed), halvings - 1)
            self._find(speed, halvings - 1)
        else:
            self._found[speed] = positions, _point(self._system)


@contextmanager
def over_speed(scenario: Scenario, train: Train, fmus: Path) -> Iterator[OverSpeed]:
    """Yield the operating points of a scenario's train; raises as `on_running_films`."""
    with on_running_films(scenario, train, fmus) as system:
        yield OverSpeed(system, train)


def _point(system: System) -> OperatingPoint:
    """The operating point of a system in equilibrium."""
    stiffness, damping = np.split(system.tangents, 2, axis=2)
    return OperatingPoint(LinearBearings(stiffness.copy(), damping.copy()), system.forces[:, :2].copy())


@one_blas_thread()
def operating_point(scenario: Scenario, train: Train, fmus: Path) -> OperatingPoint:
    """Find the operating point of a scenario's train; raises as `on_running_films`."""
    with on_running_films(scenario, train, fmus) as system:
        return _point(system)


def bearing_data(points: Mapping[float, OperatingPoint], train: Train, films: str) -> xr.Dataset:
    """Stiffness and damping of a train's bearings over speed, of points by speed in rad/s."""
    dims = ("rotation", "bearing", "wrench", "displacement")
    stiffness, damping = (
        np.array([getattr(point.bearings, name) for point in points.values()])
        for name in ("stiffness", "damping")
    )
    units = "N/m; N/rad; N m/m; N m/rad"
    return xr.Dataset(
        {
            "stiffness": (dims, stiffness, {"units": units, "long_name": "K = -dF/dq"}),
            "damping": (
                dims,
                damping,
                {"units": "; ".join(f"{unit} s" for unit in units.split("; ")), "long_name": "C = -dF/dv"},
            ),
        },
        {
            "rotation": ("rotation", np.array(list(points)) / HERTZ, {"units": "Hz"}),
            "bearing": [seat.name for seat in train.bearings],
            "wrench": ["Fx", "Fy", "Mx", "My"],
            "displacement": ["x", "y", "tilt_x", "tilt_y"],
        },
        {"title": f"Linearised bearings: {train.name}", "films": films, "name": "bearings"},
    )
