"""The film of one bearing: what a facade, a test or a user evaluates."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearing_fmu import depths
from bearing_fmu.bore.bore import bore_of
from bearing_fmu.contact.greenwood_tripp import slice_table
from bearing_fmu.evaluate import WORK
from bearing_fmu.outputs import INPUTS, OUT_C, OUT_F0, OUT_GAP, OUT_K, OUTPUTS
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.scales import scales
from bearing_fmu.state_in_words import state_in_words
from bearing_fmu.status import FilmFailure, FilmStatus
from bearing_fmu.stock import Stock, WorkSpace, bring_back
from fmus import port
from fmus.port.variable import Value

__all__ = ["BearingResponse", "Film", "FilmFailure", "FilmStatus", "Solver", "make_film"]

Floats = NDArray[np.float64]

_NO_MEMORY = np.zeros(0)
_MOST_BOUND = 64
_LAST = tuple(v.name for v in port.BEARING_OUTPUTS[52:])


@dataclass(frozen=True)
class Solver:
    """What one film of `bearing_fmu.films` brings to the port.

    Attributes
    ----------
    name : str
        For messages.
    kernel : kernel
        From `bearing_fmu.evaluate.port_kernel`.
    prepare : callable
        Makes what the kernel knows as the film, of parameters and the arrays of a work space.
    tilts : bool
        Whether the film sees tilts.
    boundaries : tuple of str
        Boundary conditions at the rupture that it offers.
    bores : bool
        Whether it knows other bores than the plain one.
    stock : Stock, optional
        From which films share their work spaces; by default each film has its own.
    pads : kernel, optional
        From `bearing_fmu.tilting.evaluate.pads_kernel`, where it knows tilting pads.
    """

    name: str
    kernel: Callable[..., int]
    prepare: Callable[[BearingParameters, dict[str, Any]], Any]
    tilts: bool = False
    boundaries: tuple[str, ...] = ("guembel",)
    bores: bool = False
    stock: Stock | None = None
    pads: Callable[..., int] | None = None


@dataclass(frozen=True)
class BearingResponse:
    """Everything a bearing returns at one state, SI units.

    Attributes
    ----------
    wrench : ndarray, shape (4,)
        F = (Fx, Fy, Mx, My) on the journal, film and contact.
    stiffness, damping : ndarray, shape (4, 4)
        K = -dF/dq and C = -dF/dv at what the film remembers; on a soft layer K counts besides what the wall
        goes on to give way, an extrapolation in time, except in balance.
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
    contact_pressure : float
        Largest solid contact pressure, Pa.
    overlap : float
        How deep journal and bore would overlap unloaded, m.
    wiped, contact_area : float
        Shares of the bore in which the contact reaches the hardness, and in which solids really touch.
    oil_flow : float
        Flow out at both ends, m3/s.
    oil_temperature : float
        Supply temperature and half the rise by friction power over oil flow, K.
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
    contact_pressure: float
    overlap: float
    wiped: float
    contact_area: float
    oil_flow: float
    oil_temperature: float


class Film:
    """Prepared evaluator of one bearing without memory, see `bearing_fmu.depths.Film`.

    Nothing is kept but work space, which no two evaluations use at a time: the same input gives the same
    output to the last bit, whatever was evaluated before and on whatever thread.

    Parameters
    ----------
    solver : Solver
        The film.
    parameters : BearingParameters
        The bearing.
    offset : array_like, shape (4,)
        Bearing centre in the fixed frame: x, y in m, tilts in rad.

    Raises
    ------
    ValueError
        A boundary condition or a bore that the film does not have.
    """

    def __init__(
        self, solver: Solver, parameters: BearingParameters, offset: Floats | tuple[float, ...] = (0.0,) * 4
    ) -> None:
        if parameters.boundary not in solver.boundaries:
            raise ValueError(
                f"bearing parameter boundary = {parameters.boundary!r}: the {solver.name} film has "
                f"{' and '.join(solver.boundaries)} only"
            )
        if parameters.arcs and not solver.bores:
            raise ValueError(f"bearing parameter bore: the {solver.name} film knows the plain bore only")
        self.solver = solver
        self.parameters = parameters
        self.offset = np.array(offset, dtype=np.float64)
        table = slice_table(parameters)
        self._constants = scales(parameters, table, aligned=not solver.tilts), table.coefficients
        self._bore = bore_of(parameters.arcs, parameters.columns)
        self._resolution = int(parameters.columns), int(parameters.rows)
        self._kernel = solver.kernel
        # of one resolution some films share their work space with others
        self._free = [] if solver.stock is None else solver.stock.of(*self._resolution)
        self._bound: dict[WorkSpace, tuple[Any, ...]] = {}

    @classmethod
    def of(cls, solver: Solver, values: Mapping[str, Value]) -> Film:
        """The film of these parameters by the names of the port's variables."""
        offset = tuple(float(values.get(f"offset.{name}", 0.0)) for name in port.POSITION)
        return cls(solver, BearingParameters.of(values), offset)

    def rest(self) -> Floats:
        """No memory, no state."""
        return _NO_MEMORY

    def evaluate(self, state: Floats, inputs: Floats, dt: float) -> tuple[Floats, Floats]:
        """Evaluate the port, see `bearing_fmu.depths.Film.evaluate`; raises `FilmFailure`."""
        out = np.empty(OUTPUTS)
        status = self.solve(inputs, self.offset, out)
        if status:
            raise self.failure(status, inputs, self.offset)
        return out, state

    def solve(self, inputs: Floats, offset: Floats, out: Floats) -> int:
        """Evaluate the port into an array.

        Parameters
        ----------
        inputs : ndarray, shape (17,), float64
            In the order of `fmus.port.BEARING_INPUTS`.
        offset : ndarray, shape (4,), float64
            Bearing centre in the fixed frame: x, y in m, tilts in rad.
        out : ndarray, shape (58,), float64
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
            bring_back(self._free, space)

    def take(self) -> tuple[WorkSpace, tuple[Any, ...]]:
        """A work space that nobody uses, to be brought back, and what the kernel takes in it."""
        try:
            space = self._free.pop()
        except IndexError:
            stock = self.solver.stock
            space = WorkSpace() if stock is None else stock.new(*self._resolution)
        data = self._bound.get(space)
        if data is None:
            if len(self._bound) >= _MOST_BOUND:
                self._bound.clear()
            film = self.solver.prepare(self.parameters, space.arrays)
            data = self._bound[space] = *self._constants, self._bore, film, np.zeros(WORK)
        return space, data

    def bring_back(self, space: WorkSpace) -> None:
        """Let others use a work space."""
        bring_back(self._free, space)

    def failure(self, status: int, inputs: Floats, offset: Floats) -> FilmFailure:
        """Return the error that belongs to a failed `solve`: status, advice and the relative state."""
        relative = inputs[:8] - inputs[8:16]
        relative[:4] -= offset
        speed = float(inputs[16])
        words = state_in_words(self.parameters, relative[:4], relative[4:], speed, tilted=self.solver.tilts)
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
        inputs[:4] += self.offset
        out, _ = self.evaluate(_NO_MEMORY, inputs, 0.0)
        gap = out[OUT_GAP:OUTPUTS]
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
            **dict(zip(_LAST, gap[12:].tolist(), strict=True)),
        )


def make_film(depth: str, parameters: BearingParameters) -> Film:
    """Prepare the film of one bearing.

    Parameters
    ----------
    depth : str
        Name of a depth of this package.
    parameters : BearingParameters
        The bearing.

    Raises
    ------
    ValueError
        Unknown depth.
    """
    film = depths.find(depth).make(parameters.values())
    if not isinstance(film, Film):
        raise ValueError(f"bearing depth {depth!r}: none of the films of this package")
    return film
