"""The operating point: the bearings' stiffness and damping where the train runs.

Found like the start of a run, through the FMUs: the films carry the train at its rated speed,
and the tangents that they export there are its linearised bearings.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from orchestrator.errors import EquilibriumError
from orchestrator.fmi.blas import one_blas_thread
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.unit import UnitError
from orchestrator.master.assembly import assemble
from orchestrator.master.start.equilibrium import find_start
from orchestrator.master.system import System
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.linear.analysis import LinearBearings
from rotor_fmu.train.train import Train

Array = NDArray[np.float64]


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


@one_blas_thread()
def operating_point(scenario: Scenario, train: Train, fmus: Path) -> OperatingPoint:
    """Find the operating point of a scenario's train; raises as `on_running_films`."""
    with on_running_films(scenario, train, fmus) as system:
        stiffness, damping = np.split(system.tangents, 2, axis=2)
        return OperatingPoint(LinearBearings(stiffness.copy(), damping.copy()), system.forces[:, :2].copy())


def bearing_data(point: OperatingPoint, train: Train, films: str) -> xr.Dataset:
    """Stiffness and damping of a train's bearings (bearing, wrench, displacement), and what they are of."""
    dims = ("bearing", "wrench", "displacement")
    units = "N/m; N/rad; N m/m; N m/rad"
    return xr.Dataset(
        {
            "stiffness": (dims, point.bearings.stiffness, {"units": units, "long_name": "K = -dF/dq"}),
            "damping": (
                dims,
                point.bearings.damping,
                {"units": "; ".join(f"{unit} s" for unit in units.split("; ")), "long_name": "C = -dF/dv"},
            ),
        },
        {
            "bearing": [seat.name for seat in train.bearings],
            "wrench": ["Fx", "Fy", "Mx", "My"],
            "displacement": ["x", "y", "tilt_x", "tilt_y"],
        },
        {"title": f"Linearised bearings: {train.name}", "films": films, "name": "bearings"},
    )
