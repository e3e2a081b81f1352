"""Trains, their modes, and single bearings."""

from __future__ import annotations

from pathlib import Path
from typing import Protocol

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike
from rich.console import Console

from bearing_fmu import depths
from fmus import port
from orchestrator.commands.modes import mode_data
from orchestrator.errors import OrchestratorError
from orchestrator.fmi.blas import one_blas_thread
from orchestrator.fmi.folder import fmu_folder
from orchestrator.linear.case import LinearRequest, linear_case
from orchestrator.scenario.file import read_train
from rotor_fmu.train.train import Train
from rotor_fmu.train.wording import choice


class Evaluate(Protocol):
    """A bearing as a function of its journal's state, see `bearing`."""

    def __call__(
        self, q: ArrayLike, v: ArrayLike = (0.0,) * 4, speed: float = port.NOMINAL_SPEED
    ) -> dict[str, float]:
        """Outputs of the port by name."""
        ...


def train(source: str | Path = "turbine") -> Train:
    """Read a train by the name of a bundled one, its folder or its file.

    Raises
    ------
    Error
        With one line for each problem.
    """
    return read_train(str(source))


@one_blas_thread()
def modes(
    source: str | Path = "paper",
    *,
    count: int = 12,
    depth: str | None = None,
    fmus: str | Path | None = None,
    trust: bool = False,
) -> xr.Dataset:
    """Modes of a train on its linearised films at rated speed: frequency, damping ratio, shape.

    Parameters
    ----------
    source : str or Path
        A scenario or a train, by name or path.
    count : int
        How many, from the lowest frequency.
    depth : str, optional
        Of all films in place of the scenario's.
    fmus, trust
        As in `run`.

    Raises
    ------
    Error
        For anything wrong with the input, or when there is no static equilibrium.
    """
    folder = fmu_folder() if fmus is None else Path(fmus)
    request = LinearRequest("modes", str(source), depth, None, folder, (), trust)
    return mode_data(linear_case(request, Console(quiet=True), writes=False), count)


def bearing(depth: str = "v1", **parameters: float) -> Evaluate:
    """A bearing on its own, as a function of its journal's state.

    Parameters
    ----------
    depth : str
        Modelling depth, one of `bearing_fmu.depths`.
    **parameters
        As in a train's file: ``diameter``, ``width``, ``clearance``, ``viscosity``, ``roughness`` and so on;
        what is not given is as the port says.

    Returns
    -------
    callable
        ``evaluate(q, v=(0, 0, 0, 0), speed=157.08)`` of position (x, y in m, tilts in rad) and velocity of
        the journal, and the speed in rad/s; returns the port's outputs by name (`fmus.port.bearing`): the
        wrench ``wrench.Fx`` and so on, the law, ``h_min``, ``p_max``.

    Raises
    ------
    Error
        No such depth or parameter, or a value out of its range.
    """
    known = {**port.BEARING_KEYS}
    for key in parameters:
        if key not in known:
            raise OrchestratorError(f"{key}: no parameter of a bearing; {choice(key, known)}")
    values = {v.name: v.start for v in port.BEARING_PARAMETERS if v.start is not None}
    values |= {known[key]: value for key, value in parameters.items()}
    try:
        film = depths.find(depth).make(values)
    except ValueError as error:
        raise OrchestratorError(str(error)) from None
    names = [variable.name for variable in (*port.BEARING_OUTPUTS, *port.BEARING_DETAILS)]

    def evaluate(
        q: ArrayLike, v: ArrayLike = (0.0,) * 4, speed: float = port.NOMINAL_SPEED
    ) -> dict[str, float]:
        inputs = np.concatenate([np.asarray(q, float), np.asarray(v, float), np.zeros(8), [float(speed)]])
        try:
            outputs, _ = film.evaluate(film.rest(), inputs, 0.0)
        except ArithmeticError as error:
            raise OrchestratorError(str(error)) from None
        return dict(zip(names, map(float, outputs), strict=False))

    return evaluate
