"""The film of one bearing: what a facade, a test or a user evaluates."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.contact.greenwood_tripp import slice_table
from bearing_fmu.evaluate import WORK, evaluate_v1, evaluate_v2, evaluate_v3
from bearing_fmu.films.aligned.aligned import aligned_film
from bearing_fmu.films.short.flooded import short_film
from bearing_fmu.films.tilted.workspace import WorkSpace, stock, tilted_film, work_space
from bearing_fmu.outputs import INPUTS, OUT_C, OUT_F0, OUT_GAP, OUT_K, OUTPUTS
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.scales import scales
from bearing_fmu.state_in_words import state_words
from bearing_fmu.status import FilmFailure, FilmStatus

__all__ = ["BearingResponse", "Depth", "Film", "FilmFailure", "FilmStatus", "make_film"]

Floats = NDArray[np.float64]


class Depth(StrEnum):
    """Modelling depth of a bearing."""

    V1 = "v1"
    """Reynolds equation over the tilted gap."""
    V2 = "v2"
    """Reynolds equation, tilts and tilt rates ignored."""
    V3 = "v3"
    """Short bearing, tilts and tilt rates ignored."""


_KERNELS: dict[Depth, Callable[..., int]] = {
    Depth.V1: evaluate_v1,
    Depth.V2: evaluate_v2,
    Depth.V3: evaluate_v3,
}


@dataclass(frozen=True)
class BearingResponse:
    """Everything a bearing returns at one state, SI units.

    Attributes
    ----------
    wrench : ndarray, shape (4,)
        F = (Fx, Fy, Mx, My) on the journal, film and contact.
    stiffness, damping : ndarray, shape (4, 4)
        K = -dF/dq and C = -dF/dv.
    h_min, h_min_centre, h_min_z : float
        Least gap over the film and at the mid-plane, and axial position of the least gap, m.
    p_max : float
        Largest film pressure over the cavity, Pa.
    contact_force : float
        Integral of the solid contact pressure, N.
    contact_wrench : ndarray, shape (4,)
        Part of `wrench` from solid contact.
    friction_power : float
        Power lost in film shear and solid friction, W.
    eccentricity : float
        Relative eccentricity at the mid-plane.
    sommerfeld : float
        So = |F| psi^2 / (b d eta omega); 0 at standstill, where it is not defined.
    """

    wrench: Floats
    stiffness: Floats
    damping: Floats
    h_min: float
    h_min_centre: float
    h_min_z: float
    p_max: float
    contact_force: float
    contact_wrench: Floats
    friction_power: float
    eccentricity: float
    sommerfeld: float


class Film:
    """Prepared evaluator of one bearing; made by `make_film`.

    Nothing is kept but work space, which no two evaluations use at a time: the same input gives the same
    output to the last bit, whatever was evaluated before and on whatever thread.

    Attributes
    ----------
    depth : Depth
        Modelling depth.
    parameters : BearingParameters
        The bearing.

    Raises
    ------
    ValueError
        A boundary condition that the depth does not have.
    """

    def __init__(self, depth: Depth, parameters: BearingParameters) -> None:
        if parameters.boundary != "guembel" and depth is not Depth.V1:
            raise ValueError(f"bearing parameter boundary = {parameters.boundary!r} needs depth 'v1'")
        self.depth = depth
        self.parameters = parameters
        table = slice_table(parameters)
        self._constants = scales(parameters, table, aligned=depth is not Depth.V1), table.coefficients
        self._kernel = _KERNELS[depth]
        # Of one resolution V1 shares its work space with other films, see `films.tilted.workspace`.
        self._stock = stock(*self._resolution) if depth is Depth.V1 else []
        self._bound: dict[WorkSpace, tuple[Any, ...]] = {}

    @property
    def _resolution(self) -> tuple[int, int]:
        return int(self.parameters.columns), int(self.parameters.rows)

    def _data(self, space: WorkSpace) -> tuple[Any, ...]:
        """What the kernel takes besides the port's arrays, in a work space."""
        if space not in self._bound:
            aspect = self.parameters.diameter / self.parameters.width
            film: Any
            match self.depth:
                case Depth.V1:
                    film = tilted_film(*self._resolution, aspect, space)
                case Depth.V2:
                    film = aligned_film(*self._resolution, aspect)
                case Depth.V3:
                    film = short_film(self._resolution[0])
            self._bound[space] = *self._constants, film, np.zeros(WORK)
        return self._bound[space]

    def take(self) -> tuple[WorkSpace, tuple[Any, ...]]:
        """A work space that nobody uses, to be brought back, and what the kernel takes in it."""
        try:
            space = self._stock.pop()
        except IndexError:
            space = work_space(*self._resolution) if self.depth is Depth.V1 else WorkSpace()
        return space, self._data(space)

    def bring_back(self, space: WorkSpace) -> None:
        """Let others use a work space."""
        self._stock.append(space)

    def evaluate(self, inputs: Floats, offset: Floats, out: Floats) -> int:
        """Evaluate the port.

        Parameters
        ----------
        inputs : ndarray, shape (17,), float64
            In the order of `fmus.port.BEARING_INPUTS`.
        offset : ndarray, shape (4,), float64
            Bearing centre in the fixed frame: x, y in m, tilts in rad.
        out : ndarray, shape (52,), float64
            Written in the order of `fmus.port.BEARING_OUTPUTS`; untouched on failure.

        Returns
        -------
        int
            0, or another code of `FilmStatus`.
        """
        space, data = self.take()
        try:
            return self._kernel(inputs, offset, out, *data)
        finally:
            self.bring_back(space)

    def failure(self, status: int, inputs: Floats, offset: Floats) -> FilmFailure:
        """Return the error that belongs to a failed `evaluate`: status, advice and the relative state."""
        relative = inputs[:8] - inputs[8:16]
        relative[:4] -= offset
        speed = float(inputs[16])
        words = state_words(self.parameters, relative[:4], relative[4:], speed, tilted=self.depth is Depth.V1)
        return FilmFailure(FilmStatus(status), np.append(relative, speed), words)

    def respond(self, q: Floats, v: Floats, speed: float) -> BearingResponse:
        """Response at a relative state of journal and bore.

        Parameters
        ----------
        q, v : array_like, shape (4,)
            Relative position (m, rad) and velocity (m/s, rad/s).
        speed : float
            Rotor speed, rad/s, positive from x to y; either sign and zero are admissible.

        Raises
        ------
        FilmFailure
            The state has no response; names status, advice and state.
        """
        inputs = np.zeros(INPUTS)
        inputs[:4] = q
        inputs[4:8] = v
        inputs[16] = speed
        out = np.empty(OUTPUTS)
        status = FilmStatus(self.evaluate(inputs, np.zeros(4), out))
        if status is not FilmStatus.OK:
            raise self.failure(status, inputs, np.zeros(4))
        gap = out[OUT_GAP:]
        return BearingResponse(
            wrench=out[:OUT_F0].copy(),
            stiffness=out[OUT_K:OUT_C].reshape(4, 4).copy(),
            damping=out[OUT_C:OUT_GAP].reshape(4, 4).copy(),
            h_min=float(gap[0]),
            h_min_centre=float(gap[1]),
            h_min_z=float(gap[2]),
            p_max=float(gap[3]),
            contact_force=float(gap[4]),
            contact_wrench=gap[5:9].copy(),
            friction_power=float(gap[9]),
            eccentricity=float(gap[10]),
            sommerfeld=float(gap[11]),
        )


def make_film(depth: Depth | str, parameters: BearingParameters) -> Film:
    """Prepare the film of one bearing.

    Parameters
    ----------
    depth : Depth or str
        "v1", "v2" or "v3".
    parameters : BearingParameters
        The bearing.

    Raises
    ------
    ValueError
        Unknown depth.
    """
    try:
        chosen = Depth(depth)
    except ValueError:
        allowed = ", ".join(repr(d.value) for d in Depth)
        raise ValueError(f"bearing depth {depth!r}: must be one of {allowed}") from None
    return Film(chosen, parameters)
