"""The start of a run: bearings aligned to the running train, static equilibrium, 1X orbit.

Everything goes through the FMUs in Initialization Mode and ends as parameters: offsets
of the bearings, start positions of the rotor.  The steps are

1. the position of each journal in its film under its target load,
2. the shape that the shaft takes under these wrenches, which gives the offsets
   (running alignment: each bearing gets its load although journals float at different heights);
   where the train says how high its bearings stand, they stand there, and the loads follow,
3. the equilibrium of rotor and films, by Newton's method on the affine laws,
4. the linear response to the nominal unbalance about it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from fmus import port
from orchestrator.errors import EquilibriumError
from orchestrator.master.start.journal_position import (
    aligned_positions,
    carry,
    evaluate,
    least_forces,
    tilted_positions,
)
from orchestrator.master.start.pads import set_whirl
from orchestrator.master.system import System
from orchestrator.scenario.parameters import offset_names, start_names
from rotor_fmu.train.train import BearingSeat, Train

Array = NDArray[np.float64]

ALIGNMENT_STEPS = 10
"""Allowed to balance loads and film moments; three are usual."""

NEWTON_STEPS = 30
"""Allowed for the equilibrium; two are usual after the alignment."""

TOLERANCE = 1e-9
"""Of the equilibrium: step of a journal against the clearance, of its tilt against clearance over width."""

REACH = 0.1
"""Largest Newton step in the same measure."""

AUXILIARY_STIFFNESS = 1e-3
"""Of the springs that hold the shaft while it is aligned, against load over clearance."""


@dataclass(frozen=True)
class Start:
    """How a run starts.

    Attributes
    ----------
    loads : ndarray (bearings, 2)
        Static forces of the bearings on the shaft in N.
    offsets : ndarray (bearings, 4)
        Bearing centres and axes in the fixed frame, in m and rad.
    static, cosine, sine : ndarray (bearings, 4)
        Journals in their housings: ``q(t) = static + cosine cos(speed t) + sine sin(speed t)``.
    static_line : ndarray (nodes, 2)
        Static x, y of the shaft in m.
    tangents : ndarray (bearings, 4, 8)
        Stiffness and damping [K C] of the bearings in the static position; of a start that is applied.
    """

    loads: Array
    offsets: Array
    static: Array
    cosine: Array
    sine: Array
    static_line: Array
    tangents: Array = field(default_factory=lambda: np.zeros((0, 4, 8)))


def find_start(system: System, train: Train, speed: float) -> Start:
    """Find the start of a run.

    Parameters
    ----------
    system : System
        In Initialization Mode, with the parameters of the scenario set and all offsets zero.
    train : Train
        For clearances, widths, residual tilts and heights of the bearings, nodes, direction of gravity.
    speed : float
        Rotor speed in rad/s.

    Returns
    -------
    Start
        Not yet applied; see `apply_start`.

    Raises
    ------
    EquilibriumError
        Naming the bearing and what could not be reached.
    """
    seats = train.bearings
    clearances = np.array([seat.clearance for seat in seats])
    residual = np.array([[seat.residual_tilt_x, seat.residual_tilt_y] for seat in seats])
    system.set_speed(speed)
    set_whirl(system, 0.0)
    loads = system.rotor.get_real([port.at_bearing(i, "load") for i in range(1, len(seats) + 1)])
    if not np.all(np.isfinite(loads)):
        raise EquilibriumError(f"rotor: no target loads: {system.rotor.reason}")
    forces = np.outer(loads, train.upwards)
    least = least_forces(system, forces, clearances)
    film = aligned_positions(system, forces, clearances)
    film = tilted_positions(system, forces, film, -residual, least)
    system.rotor.set_parameters({"start.from_law": True, "start.orbit": False})
    shape, film = _align(system, forces, film, least, np.maximum(np.abs(loads), least) / clearances)
    offsets = shape - film
    if any(seat.height is not None for seat in seats):
        offsets[:, :2] = np.outer([seat.height or 0.0 for seat in seats], train.upwards)
        shape = offsets + film
    for bearing, offset in zip(system.bearings, offsets, strict=True):
        bearing.set_real(offset_names(), offset)
    static = _equilibrium(system, shape, _measure(seats))
    line = _line(system, train.nodes)
    system.rotor.set_parameters({"start.orbit": True})
    system.rotor_group.push()
    system.rotor_group.fetch()
    return Start(
        loads=system.forces[:, :2].copy(),
        offsets=offsets,
        static=static,
        cosine=system.motion[:, :4] - static,
        sine=system.motion[:, 4:] / speed,
        static_line=line,
    )


def rest_at(system: System, seats: Sequence[BearingSeat], speed: float, positions: Array) -> Array:
    """Find the equilibrium on the films of another speed; the bearings stay where `find_start` has put them.

    Parameters
    ----------
    system, seats
        As left by `find_start`.
    speed : float
        Of the films, in rad/s; the shaft's rest does not depend on it.
    positions : ndarray (bearings, 4)
        Where the search starts, such as the equilibrium of a neighbouring speed.

    Returns
    -------
    ndarray (bearings, 4)
        Positions; `System.responses` holds the responses there.

    Raises
    ------
    EquilibriumError
        As `find_start`.
    """
    system.rotor.set_parameters({"start.from_law": True, "start.orbit": False})
    system.set_film_speed(speed)
    return _equilibrium(system, positions, _measure(seats))


def apply_start(system: System, start: Start) -> None:
    """Set a start as parameters of the units; they stay in Initialization Mode."""
    bearings = len(system.bearings)
    for bearing, offset in zip(system.bearings, start.offsets, strict=True):
        bearing.set_real(offset_names(), offset)
    system.rotor.set_parameters({"start.from_law": False, "start.orbit": True})
    for part, values in (("", start.static), ("_cos", start.cosine), ("_sin", start.sine)):
        system.rotor.set_real(start_names(bearings, part), values)
    system.laws[:] = 0.0
    for group in system.groups:
        group.push()
    system.rotor_group.fetch()
    for group in (system.bearing_group, system.rotor_group):
        group.feed()
        group.fetch()


def begin(system: System, start: Start, nodes: int) -> Start:
    """Apply a start and leave Initialization Mode.

    Returns
    -------
    Start
        With the static forces and the static line that follow from its parameters.
    """
    apply_start(system, start)
    system.rotor.set_parameters({"start.orbit": False})
    for group in system.groups:
        group.feed()
        group.fetch()
    loads, line, tangents = system.forces[:, :2].copy(), _line(system, nodes), system.tangents
    apply_start(system, start)
    for unit in system.units:
        unit.exit_initialization()
    for group in system.groups:
        group.fetch()
    return replace(start, loads=loads, static_line=line, tangents=tangents)


def _rest_under(system: System, laws: Array) -> Array:
    """Return the journals (bearings, 4) of the shaft at rest under these laws (bearings, 36)."""
    system.laws[:] = laws
    system.rotor_group.push()
    system.rotor_group.fetch()
    journals = system.journals[:, :4].copy()
    if not np.all(np.isfinite(journals)):
        raise EquilibriumError(f"rotor: no shape under the bearings' wrenches: {system.rotor.reason}")
    return journals


def _align(system: System, forces: Array, film: Array, least: Array, stiffness: Array) -> tuple[Array, Array]:
    """Return the shape of the running shaft at the bearings and the film positions, in mutual balance.

    Film moments, and nothing else, upset the balance of weight and target loads. Weak springs anchored at
    the last shape take what is missing; it is added to the loads, so that in the end they carry nothing.
    """
    laws = np.zeros_like(system.laws)
    springs = AUXILIARY_STIFFNESS * stiffness
    laws[:, [4, 9]] = springs[:, None]  # K[1,1] and K[2,2]
    anchor = np.zeros((len(film), 2))
    scale = max(np.abs(forces).max(), least.max())
    for _ in range(ALIGNMENT_STEPS):
        laws[:, :4] = system.forces
        laws[:, :2] += springs[:, None] * anchor
        shape = _rest_under(system, laws)
        missing = -springs[:, None] * (shape[:, :2] - anchor)
        if np.abs(missing).max() < TOLERANCE * scale:
            return _without_rigid_motion(system, shape), film
        forces = forces + missing
        film = carry(system, forces, film, least)
        anchor = shape[:, :2]
    raise EquilibriumError(
        f"alignment: {np.abs(missing).max():.3g} N of {scale:.4g} N are out of balance "
        f"after {ALIGNMENT_STEPS} corrections"
    )


def _without_rigid_motion(system: System, shape: Array) -> Array:
    """Take the best-fitting rigid motion out of a shape; a free shaft is at rest anywhere."""
    z = system.rotor.get_real([port.at_bearing(i, "z") for i in range(1, len(shape) + 1)])
    basis = np.column_stack([np.ones_like(z), z - z.mean()])
    if len(z) < 2 or np.ptp(z) == 0.0:
        basis[:, 1] = 0.0
    (x, tilt_y), (y, slope_y) = np.linalg.lstsq(basis, shape[:, :2], rcond=None)[0].T
    rigid = np.column_stack(
        [
            x + tilt_y * basis[:, 1],
            y + slope_y * basis[:, 1],
            np.full_like(z, -slope_y),
            np.full_like(z, tilt_y),
        ]
    )
    return shape - rigid


def _measure(seats: Sequence[BearingSeat]) -> Array:
    """What steps of the journals are measured by (bearings, 4)."""
    clearances = np.array([seat.clearance for seat in seats])
    tilts = clearances / np.array([seat.width for seat in seats])
    return np.column_stack([clearances, clearances, tilts, tilts])


def _equilibrium(system: System, positions: Array, measure: Array) -> Array:
    """Newton's method for rotor and films at rest; `measure` (bearings, 4) scales steps.

    In the end tilting pads give stiffness and damping of a motion with the rotation.
    """
    set_whirl(system, 0.0)
    for _ in range(NEWTON_STEPS):
        evaluate(system, positions)
        if not np.all(np.isfinite(system.responses)):
            worst = int(np.argmin(np.isfinite(system.responses).all(axis=1)))
            unit = system.bearings[worst]
            reason = unit.reason.removeprefix(f"{unit.name}: ")
            raise EquilibriumError(f"{unit.name}: no film at the trial position: {reason}")
        step = _rest_under(system, system.responses[:, 4 : 4 + system.laws.shape[1]]) - positions
        size = np.abs(step / measure)
        if size.max() < TOLERANCE:
            if set_whirl(system, 1.0):
                evaluate(system, positions + step)
                _rest_under(system, system.responses[:, 4 : 4 + system.laws.shape[1]])
            return positions + step
        positions = positions + step * min(1.0, REACH / size.max())
    worst = int(np.argmax(size.max(axis=1)))
    raise EquilibriumError(
        f"{system.bearings[worst].name}: after {NEWTON_STEPS} Newton steps the journal still moves by "
        f"{size.max():.3g} of its clearance"
    )


def _line(system: System, nodes: int) -> Array:
    """Return x, y of all nodes (nodes, 2) as the rotor stands."""
    names = [f"node[{k}].{key}" for key in ("x", "y") for k in range(1, nodes + 1)]
    return system.rotor.get_real(names).reshape(2, nodes).T.copy()
