"""The operating point: the bearings' stiffness and damping where the train runs.

Found like the start of a run, through the FMUs: the films carry the train at its rated speed,
and the tangents that they export there are its linearised bearings.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from orchestrator.errors import EquilibriumError
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.unit import UnitError
from orchestrator.master.assembly import assemble
from orchestrator.master.start.equilibrium import find_start
from orchestrator.master.system import RESPONSE
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.linear.analysis import LinearBearings
from rotor_fmu.train.train import Train

Array = NDArray[np.float64]

_STIFFNESS = slice(RESPONSE["K[1,1]"], RESPONSE["K[4,4]"] + 1)
_DAMPING = slice(RESPONSE["C[1,1]"], RESPONSE["C[4,4]"] + 1)


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


def operating_point(scenario: Scenario, train: Train, fmus: Path) -> OperatingPoint:
    """Find the operating point of a scenario's train.

    Parameters
    ----------
    scenario : Scenario
        Depths, film resolution and unbalance.
    train : Train
        Its train.
    fmus : Path
        Folder with the FMUs.

    Raises
    ------
    EquilibriumError
        When there is none.
    FmuError, PortError
        As `orchestrator.master.assembly.assemble`.
    """
    with FmuStore() as store:
        system = assemble(scenario, train, fmus, store)
        try:
            find_start(system, train.bearings, train.speed, train.nodes)
            responses = system.responses.copy()
            forces = system.forces[:, :2].copy()
        except UnitError as error:
            raise EquilibriumError(str(error)) from None
        finally:
            system.close()
    count = len(train.bearings)
    stiffness, damping = (responses[:, part].reshape(count, 4, 4) for part in (_STIFFNESS, _DAMPING))
    return OperatingPoint(LinearBearings(stiffness.copy(), damping.copy()), forces)


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
