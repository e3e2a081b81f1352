"""Pressure over the film, and the oil that leaves it at the ends."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore
from bearing_fmu.film import Film
from bearing_fmu.films.jfo.film import SOLVER as CONSERVING
from bearing_fmu.films.jfo.film import ConservingFilm
from bearing_fmu.films.tilted.corner_films import served
from bearing_fmu.films.tilted.depth import SOLVER
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.axial import axial_basis
from bearing_fmu.kernels.grid import COS, METRIC, SIN
from bearing_fmu.outputs import INPUTS, OUT_GAP, OUTPUTS
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.result import OPEN
from bearing_fmu.tilting.film import TiltingFilm

Floats = NDArray[np.float64]

OIL_FLOW = OUT_GAP + 16


@dataclass(frozen=True)
class PressureMap:
    """The film of one state on its grid.

    Attributes
    ----------
    angle : ndarray, shape (m,)
        From x to y, rad, ascending from -pi on.
    z : ndarray, shape (n,)
        m, ends included.
    pressure : ndarray, shape (m, n)
        Over the cavity, 0 where the film is ruptured, Pa.
    side_flow : float
        Oil pressed out at both ends, m3/s.
    content : ndarray, shape (m, n), or None
        Of a mass-conserving film the share of the gap that oil fills.
    """

    angle: Floats
    z: Floats
    pressure: Floats
    side_flow: float
    content: Floats | None = None


def pressure_map(
    parameters: BearingParameters, q: Floats, v: Floats, speed: float, *, fed_at: int | None = None
) -> PressureMap:
    """Solve Reynolds' equation as V1 does, and as V2 where there is no tilt, and keep the pressure.

    Parameters
    ----------
    parameters : BearingParameters
        On a rigid bore.
    q, v : ndarray, shape (4,)
        Position and velocity in the bore, m and rad.
    speed : float
        rad/s.
    fed_at : int, optional
        Column of the grid that is held at the cavity's pressure, as the line of the widest gap is in tables.

    Raises
    ------
    FilmFailure
        The state has no film.
    """
    if parameters.tilts:
        return _of_pads(parameters, q, v, speed)
    if parameters.boundary == "jfo":
        return _conserving(parameters, q, v, speed)
    film = Film(SOLVER, replace(parameters, layer_thickness=0.0))
    space, data = film.take()
    work = data[-2]
    inputs = np.zeros(INPUTS)
    inputs[:4], inputs[4:8], inputs[16] = q, v, speed
    try:
        if fed_at is not None:
            work.usual.held[:, fed_at] = 2.0
        status = film.solver.kernel(inputs, film.offset, np.zeros(OUTPUTS), *data)
        if status:
            raise film.failure(status, inputs, film.offset)
        return _map_of(parameters, served(work), data[2])
    finally:
        if fed_at is not None:
            work.usual.held[:, fed_at] = 0.0  # other films share the work space
        film.bring_back(space)


def _of_pads(parameters: BearingParameters, q: Floats, v: Floats, speed: float) -> PressureMap:
    """The films of all pads where they stand at rest."""
    bearing = TiltingFilm(SOLVER, parameters)
    maps = []
    places = bearing.places(q, speed)
    for pad, axes, place in zip(bearing.pads, bearing.axes, places, strict=True):
        seen = np.array(q, dtype=float)
        seen[:2] += place @ axes
        one = pressure_map(pad, seen, v, speed)
        on = [pad.arcs[0].covers(float(angle)) for angle in one.angle]
        maps.append((one.angle[on], one.pressure[on], one.z, one.side_flow))
    angle = np.concatenate([one[0] for one in maps])
    order = np.argsort(angle)
    pressure = np.concatenate([one[1] for one in maps])[order]
    return PressureMap(angle[order], maps[0][2], pressure, sum(one[3] for one in maps))


def _conserving(parameters: BearingParameters, q: Floats, v: Floats, speed: float) -> PressureMap:
    """A mass-conserving film in balance, with its content."""
    film = ConservingFilm(CONSERVING, parameters)
    inputs, out = np.zeros(INPUTS), np.zeros(OUTPUTS)
    inputs[:4], inputs[4:8], inputs[16] = q, v, speed
    status = film.solve(inputs, film.offset, out)
    if status:
        raise film.failure(status, inputs, film.offset)
    space, data = film.take()  # as the solution left it
    try:
        jfo = data[3]
        n, m = parameters.rows, parameters.columns
        unit = 6.0 * parameters.viscosity * (parameters.radius / parameters.clearance) ** 2
        pressure, content = np.full((m, n + 2), parameters.ambient_pressure), np.empty((m, n + 2))
        pressure[:, :n] = unit * jfo.net.pressure[:, :m].T
        content[:, :n] = jfo.net.content[:, :m].T
        nodes, columns = jfo.film.nodes, jfo.film.rings[0]
        angle, along = np.arctan2(columns[SIN], columns[COS]), np.argsort(nodes)
    finally:
        film.bring_back(space)
    content[:, n:] = content[:, along[[1, -2]]] if nodes[n] < nodes[n + 1] else content[:, along[[-2, 1]]]
    grid = np.ix_(np.argsort(angle), along)
    z = 0.5 * parameters.width * nodes[along]
    return PressureMap(np.sort(angle), z, pressure[grid], float(out[OIL_FLOW]), content[grid])


def _map_of(parameters: BearingParameters, work: TiltedFilm, bore: Bore) -> PressureMap:
    """What an evaluation has left in a work space."""
    n, m = work.face.shape[1], work.circle.shape[2]
    unit = 6.0 * parameters.viscosity * (parameters.radius / parameters.clearance) ** 2
    pressure = np.zeros((m, n + 2))
    pressure[:, :n] = unit * work.pressures[0, :n, :m].T
    pressure = np.maximum(pressure + parameters.ambient_pressure, 0.0)
    columns = work.rings[0]
    outwards = -work.pressures[0, 3 * n : 3 * n + 2, :m] / axial_basis(n).stretch[-2:, None]
    outwards[0] *= -1.0
    open_, metric = work.column[OPEN, n : n + 2, :m], columns[METRIC, :m].copy()
    if bore is not None:
        metric[bore.held] = 0.0  # grooves are closed at their ends
    flow = float((np.maximum(outwards, 0.0) * open_**3 * metric).sum()) * 2.0 * np.pi / m
    flow *= parameters.clearance * parameters.radius**3 / parameters.width
    angle = np.arctan2(columns[SIN], columns[COS])
    around, along = np.argsort(angle), np.argsort(work.nodes)
    z = 0.5 * parameters.width * work.nodes[along]
    return PressureMap(angle[around], z, pressure[np.ix_(around, along)], flow)


def short_side_flow(parameters: BearingParameters, eccentricity: float, speed: float) -> float:
    """Oil pressed out of a short plain bearing without ambient pressure, m3/s (Ocvirk 1952): C b w R e."""
    return parameters.clearance * parameters.width * abs(speed) * parameters.radius * eccentricity
