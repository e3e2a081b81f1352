"""The film of one bearing at one instant as a picture: pressure and gap over the unwrapped bearing.

What a film leaves in its work space after an evaluation is read; nothing is solved anew.  Films with memory
are led along the samples before that instant; of tilting pads each has its film.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearing_fmu import depths
from bearing_fmu.film import Film
from bearing_fmu.films.aligned.corner_films import AlignedFilms
from bearing_fmu.films.aligned.corner_films import served as served_aligned
from bearing_fmu.films.aligned.workspace import AlignedFilm
from bearing_fmu.films.jfo.film import ConservingFilm
from bearing_fmu.films.jfo.workspace import JfoFilm
from bearing_fmu.films.short.short import effective_state
from bearing_fmu.films.tilted.corner_films import TiltedFilms, served
from bearing_fmu.films.tilted.layered import CLUSTERING as ON_LAYER
from bearing_fmu.films.tilted.layered import LayeredFilm
from bearing_fmu.films.tilted.on_layer import FilmOnLayer
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.films.turbulence import ALONG
from bearing_fmu.kernels.axial import axial_basis
from bearing_fmu.kernels.cells import axial_cells
from bearing_fmu.kernels.compiled import kernel
from bearing_fmu.kernels.grid import COS, SIN
from bearing_fmu.outputs import INPUTS, OUTPUTS
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.tilting.film import TiltingFilm
from fmus.port.bore import TURN
from fmus.port.variable import Value

Floats = NDArray[np.float64]

_DRAWN = {"table": "v2"}
"""Depths that keep no pressure, and the one whose film they look up."""


@dataclass(frozen=True)
class FilmMap:
    """Pressure and gap over an unwrapped bearing.

    Attributes
    ----------
    angle : ndarray, shape (m,)
        From x towards y in rad, 0 to 2 pi.
    z : ndarray, shape (n,)
        From the mid-plane in m.
    pressure : ndarray, shape (n, m)
        Of the film over the cavity's in Pa; 0 where it is ruptured.
    gap : ndarray, shape (n, m)
        Between journal and rigid bore in m, as the film sees it: without tilts where it knows none; negative
        where asperities, or a soft layer, give way. Not-a-number in grooves.
    content : ndarray, shape (n, m), or None
        Share of the gap that oil fills, of a mass-conserving film.
    """

    angle: Floats
    z: Floats
    pressure: Floats
    gap: Floats
    content: Floats | None = None


def film_map(
    depth: str,
    values: Mapping[str, Value],
    q: ArrayLike,
    v: ArrayLike,
    speed: ArrayLike,
    *,
    columns: int = 121,
    rows: int = 25,
    step: float = 0.0,
    tilts: ArrayLike | None = None,
) -> FilmMap | None:
    """Evaluate a film and draw it.

    Parameters
    ----------
    depth : str
        Name of a depth.
    values : mapping
        Parameters of its unit by name.
    q, v : array_like, shape (4,) or (n, 4)
        Position of the journal relative to its bore, x, y in m and tilts in rad, and their rates; or those
        of the samples that lead to this instant, the first one in balance.
    speed : array_like, shape () or (n,)
        Rotor speed in rad/s.
    columns, rows : int
        Points around the circumference and along the axis.
    step : float
        From one sample to the next in s.
    tilts : array_like, shape (pads,), optional
        Of tilting pads about their pivots, rad; by default as they stand at rest there.

    Returns
    -------
    FilmMap or None
        None for a depth that solves no film, or whose film cannot be looked into.

    Raises
    ------
    FilmFailure
        The film has no answer at this state.
    """
    if depth not in depths.films():
        return None
    film = depths.find(_DRAWN.get(depth, depth)).make(values)
    if not isinstance(film, Film):
        return None
    positions, rates = np.atleast_2d(np.asarray(q, dtype=float)), np.atleast_2d(np.asarray(v, dtype=float))
    inputs = np.zeros((len(positions), INPUTS))
    inputs[:, :4], inputs[:, 4:8], inputs[:, 16] = positions + film.offset, rates, speed
    angle, place = np.linspace(0.0, TURN, columns), np.linspace(-1.0, 1.0, rows)
    if isinstance(film, TiltingFilm):
        return _of_pads(film, inputs[-1], angle, place, None if tilts is None else np.asarray(tilts, float))
    if isinstance(film, ConservingFilm):
        _lead(film, inputs, step)
        return _conserving(film, positions[-1], angle, place)
    if isinstance(film, FilmOnLayer):
        _lead(film, inputs, step)
    return _solved(film, inputs[-1], film.offset, angle, place)


def _lead(film: Film, inputs: Floats, step: float) -> None:
    """Lead a film with memory along its samples; its work space holds what it came to."""
    state = film.rest()
    for k, row in enumerate(inputs):
        _, state = film.evaluate(state, row, step if k else 0.0)


def _solved(film: Film, inputs: Floats, offset: Floats, angle: Floats, place: Floats) -> FilmMap | None:
    """The map of a film without memory, or of one on a layer that was led here, in the space it left."""
    speed, p = float(inputs[16]), film.parameters
    space, data = film.take()
    try:
        led = isinstance(film, FilmOnLayer)
        status = 0 if led else film.solver.kernel(inputs, offset, np.empty(OUTPUTS), *data)
        if status:
            raise film.failure(status, inputs, offset)
        constants, _, _, solved, work = data
        pressure = _pressure(solved, constants[0], work[4:8], work[8:12], speed, angle, place)
    finally:
        film.bring_back(space)
    if pressure is None:
        return None
    scales = constants[0]
    absolute = np.maximum(pressure + scales["ambient"], 0.0) * scales["pressure"]
    seen = inputs[:4] - offset
    if not film.solver.tilts:
        seen[2:] = 0.0
    return FilmMap(angle, place * 0.5 * p.width, absolute, _gap(p, seen, angle, place))


def _of_pads(
    film: TiltingFilm, inputs: Floats, angle: Floats, place: Floats, tilts: Floats | None
) -> FilmMap | None:
    """What the films of pads hold; between them is the oil of the supply."""
    p, shape = film.parameters, (place.size, angle.size)
    pressure, gap = np.full(shape, p.feed_pressure), np.full(shape, np.nan)
    for pad, shift, (constants, _, _, solved, work) in film.looked_into(inputs, tilts):
        here = _pressure(solved, constants[0], work[4:8], work[8:12], float(inputs[16]), angle, place)
        if here is None:
            return None
        seen = inputs[:4] - film.offset
        seen[:2] += shift
        if not film.solver.tilts:
            seen[2:] = 0.0
        own = _gap(pad, seen, angle, place)
        on = np.isfinite(own)
        gap[on] = own[on]
        pressure[on] = (np.maximum(here + constants[0]["ambient"], 0.0) * constants[0]["pressure"])[on]
    return FilmMap(angle, place * 0.5 * p.width, pressure, gap)


def _conserving(film: ConservingFilm, q: Floats, angle: Floats, place: Floats) -> FilmMap:
    """What the last evaluation of a mass-conserving film has left in its work space, which comes first."""
    space, data = film.take()
    try:
        scales, solved = data[0][0], data[3]
        assert isinstance(solved, JfoFilm)
        where = np.arctan2(solved.film.rings[0][SIN], solved.film.rings[0][COS])[: solved.volumes.shape[1]]
        ring = np.array([np.interp(angle, where, row, period=TURN) for row in solved.net.content])
        nodes = axial_basis(ring.shape[0]).nodes[: ring.shape[0]]
        content = np.array([np.interp(place, nodes, column) for column in ring.T]).T
        end = float(solved.net.ends[0])  # pressures count from the cavity's
        ring_at = solved.film.rings[0][:, : where.size]
        pressure = _between(ring_at, solved.net.pressure - end, angle, place) + end
        p = film.parameters
    finally:
        film.bring_back(space)
    absolute = np.maximum(pressure, 0.0) * scales["pressure"]
    return FilmMap(angle, place * 0.5 * p.width, absolute, _gap(p, q, angle, place), content)


def _pressure(
    film: Any, scales: Any, q: Floats, v: Floats, speed: float, angle: Floats, z: Floats
) -> Floats | None:
    """Pressure over the ambient one, in units of the film's, shape (z, angle)."""
    if isinstance(film, LayeredFilm):
        if film.change[8] > 0.0:
            return _of_cells(film, angle, z)
        film = served(film.rigid)
    if isinstance(film, TiltedFilms):
        film = served(film)
    if isinstance(film, AlignedFilms):
        film = served_aligned(film)
    if isinstance(film, TiltedFilm):
        n, m = film.face.shape[1], film.circle.shape[2]
        return _between(film.rings[0], film.pressures[0, :n, :m], angle, z)
    if isinstance(film, AlignedFilm):
        return _between(film.rings[0], _both_halves(film), angle, z)
    if isinstance(film, np.ndarray):
        return _short(scales, q, v, speed, angle, z)
    return None


def _between(ring: Floats, nodal: Floats, angle: Floats, z: Floats) -> Floats:
    """Between the nodes: along the axis the film's own functions, around the circumference straight."""
    along = axial_basis(nodal.shape[0]).interpolation(z[1:-1]) @ nodal
    where = np.arctan2(ring[SIN], ring[COS])
    rows = [np.interp(angle, where, row, period=TURN) for row in along]
    return np.vstack([np.zeros(angle.size), *rows, np.zeros(angle.size)])


def _of_cells(layered: LayeredFilm, angle: Floats, z: Floats) -> Floats:
    """Between the middles of the cells as the film, beyond the last ones a power with its mean."""
    film = layered.film
    n, m = film.face.shape[1], film.circle.shape[2]
    cells = axial_cells(n, ON_LAYER)
    nodal, first, last = film.pressures[0, :n, :m], cells.nodes[0], cells.nodes[n - 1]
    along = cells.interpolation(np.clip(z, first, last)) @ nodal
    for end, outside, way in (
        (0, z < first, (z + 1.0) / (1.0 + first)),
        (1, z > last, (1.0 - z) / (1.0 - last)),
    ):
        mean = 1.0 + (layered.outer[0, end, :m] - 1.0) / layered.constants[5]
        along[outside] *= way[outside, None] ** (1.0 / np.clip(mean, 0.05, 0.999) - 1.0)
    along = np.minimum(along, nodal.max(axis=0))
    where = np.arctan2(film.rings[0, SIN], film.rings[0, COS])
    return np.array([np.interp(angle, where, row, period=TURN) for row in along])


def _both_halves(film: AlignedFilm) -> Floats:
    """Nodal pressures of all rows; the film holds those with z >= 0."""
    half = film.shapes @ film.modal[0].T
    rows = 2 * half.shape[0] - int(np.count_nonzero(film.weights) and _has_middle(film))
    nodes = axial_basis(rows).nodes[:rows]
    upper = np.flatnonzero(nodes > -1e-12)
    nearest = [int(np.argmin(abs(nodes[upper] - abs(node)))) for node in nodes]
    return np.asarray(half[nearest])


def _has_middle(film: AlignedFilm) -> bool:
    """Whether a row lies at z = 0, where the modes are those of the centre."""
    return bool(np.isclose(film.shapes, film.fine[0], rtol=1e-9).all(axis=1).any())


def _short(scales: Any, q: Floats, v: Floats, speed: float, angle: Floats, z: Floats) -> Floats:
    """The short bearing's closed form, see `bearing_fmu.films.short.short`."""
    state, jacobian = np.zeros(4), np.zeros((4, 4))
    _effective(q, v, float(scales["sigma"]), state, jacobian)
    x, y = state[:2]
    a, b = speed * y + 2.0 * state[2], speed * x - 2.0 * state[3]
    gap = 1.0 - x * np.cos(angle) - y * np.sin(angle)
    drag = 1.0 + ALONG[0] / 12.0 * (float(scales["reynolds"]) * abs(speed) * gap) ** ALONG[1]
    wedge = (a * np.cos(angle) - b * np.sin(angle)) / gap**3 * drag
    return np.asarray(0.5 * float(scales["slenderness"]) * np.outer(1.0 - z * z, wedge))


@kernel
def _effective(q: Floats, v: Floats, sigma: float, state: Floats, jacobian: Floats) -> None:
    effective_state(q, v, sigma, state, jacobian)


def _gap(p: BearingParameters, q: Floats, angle: Floats, z: Floats) -> Floats:
    """Gap to the rigid bore in m, shape (z, angle)."""
    lever = 0.5 * p.width * z
    x = ((q[0] + q[3] * lever) / p.clearance)[:, None]
    y = ((q[1] - q[2] * lever) / p.clearance)[:, None]
    gap = 1.0 - x * np.cos(angle) - y * np.sin(angle)
    if p.arcs:
        moved = np.full(angle.size, np.nan)
        for arc in p.arcs:
            inside = np.array([arc.covers(float(phi)) for phi in angle])
            moved[inside] = -arc.preload * np.cos(angle[inside] - arc.towards)
        gap = gap + moved
    return np.asarray(p.clearance * gap)
