"""The films of a train's bearings, evaluated in this process instead of through FMUs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.film import make_film
from bearing_fmu.parameters import BearingParameters
from fmus import port
from rotor_fmu.train.train import BearingSeat

Array = NDArray[np.float64]

FORCE, WRENCH, LAW_F0, LAW_K, LAW_C = slice(0, 2), slice(0, 4), slice(4, 8), slice(8, 24), slice(24, 40)
"""Blocks of a row of outputs."""

_NAMES = [variable.name for variable in port.BEARING_OUTPUTS]
GAP, CENTRE_GAP, GAP_POSITION, CONTACT = (
    _NAMES.index(name) for name in ("h_min", "h_min_centre", "h_min_z", "contact_force")
)


def bearing_parameters(seat: BearingSeat, columns: int = 48, rows: int = 8) -> BearingParameters:
    """Film and contact data of a seat at a resolution."""
    return BearingParameters(
        seat.diameter,
        seat.width,
        seat.clearance,
        seat.viscosity,
        seat.ambient_pressure,
        seat.roughness,
        seat.contact_modulus,
        seat.friction,
        columns,
        rows,
    )


class Films:
    """All films of a train.

    Parameters
    ----------
    seats : sequence of BearingSeat
        The bearings.
    depths : sequence of str
        Depth of each bearing.
    speed : float
        Of the rotor [rad/s].
    columns, rows : int
        Resolution.

    Attributes
    ----------
    offsets : ndarray, (n_b, 4)
        Centres and axes of the bores in the fixed frame [m], [rad].
    outputs : ndarray, (n_b, 52)
        Of the last evaluation, in the order of the port.
    """

    def __init__(
        self,
        seats: Sequence[BearingSeat],
        depths: Sequence[str],
        speed: float,
        *,
        columns: int = 48,
        rows: int = 8,
    ) -> None:
        self.seats = tuple(seats)
        self._films = [
            make_film(depth, bearing_parameters(seat, columns, rows))
            for seat, depth in zip(seats, depths, strict=True)
        ]
        self.offsets = np.zeros((len(self._films), 4))
        self.outputs = np.zeros((len(self._films), len(_NAMES)))
        self._inputs = np.zeros((len(self._films), len(port.BEARING_INPUTS)))
        self._inputs[:, -1] = speed

    def evaluate(self, motion: Array) -> tuple[Array, Array, Array]:
        """Laws F0 (n_b, 4), K and C (n_b, 4, 4) at journal motions q, v (n_b, 8) in the fixed frame.

        Raises
        ------
        ArithmeticError
            Naming the bearing that has no response there.
        """
        self._inputs[:, :8] = motion
        for i, film in enumerate(self._films):
            status = film.evaluate(self._inputs[i], self.offsets[i], self.outputs[i])
            if status:
                raise ArithmeticError(f"{self.seats[i].name}: film status {status} at {motion[i]}")
        laws = self.outputs
        return laws[:, LAW_F0], laws[:, LAW_K].reshape(-1, 4, 4), laws[:, LAW_C].reshape(-1, 4, 4)

    def at_rest(self, index: int, position: Array) -> Array | None:
        """Outputs of one bearing with its journal at rest in its bore; None when there is no response."""
        inputs, out = np.zeros(self._inputs.shape[1]), np.empty(self.outputs.shape[1])
        inputs[:4], inputs[-1] = position, self._inputs[index, -1]
        return None if self._films[index].evaluate(inputs, np.zeros(4), out) else out
