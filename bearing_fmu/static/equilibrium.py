"""Where a bearing carries a static load, and how stiff it is there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.film import BearingResponse, Film

Floats = NDArray[np.float64]

_ROUNDS = 200
_MET = 1e-9
_BOLD, _NEAREST = 0.4, 0.01  # step over the gap, and the least of it over the clearance
_PATIENCE = 40  # rounds between which steps are bounded to half of before, as pads may begin to carry
_STILL = np.zeros(4)


@dataclass(frozen=True)
class Carried:
    """A bearing under a static load.

    Attributes
    ----------
    load : ndarray, shape (2,)
        On the journal, N.
    speed : float
        rad/s.
    position : ndarray, shape (2,)
        Of the journal in the bore, m.
    response : BearingResponse
        There.
    """

    load: Floats
    speed: float
    position: Floats
    response: BearingResponse

    @property
    def attitude(self) -> float:
        """Angle from the load to the journal, in the sense of a positive rotation, rad; -pi to pi."""
        along = self.load[0] * self.position[0] + self.load[1] * self.position[1]
        across = self.load[0] * self.position[1] - self.load[1] * self.position[0]
        return float(np.arctan2(across, along))

    def matrices(self) -> tuple[Floats, Floats]:
        """K C/W and B C w/W, shape (2, 2); x along the load, y in the sense of rotation across it."""
        size = float(np.hypot(*self.load))
        c, s = self.load / size
        turn = np.array([[c, s], [-s, c]])
        return turn @ self.response.stiffness[:2, :2] @ turn.T / size, (
            turn @ self.response.damping[:2, :2] @ turn.T * abs(self.speed) / size
        )


def carried(
    film: Film,
    load: Sequence[float],
    speed: float,
    start: Sequence[float] | None = None,
    tilts: Sequence[float] = (0.0, 0.0),
) -> Carried:
    """Find where a film carries a load, by Newton's method with its tangent.

    Parameters
    ----------
    film : Film
        Of any depth.
    load : sequence of float, shape (2,)
        On the journal, N.
    speed : float
        rad/s.
    start : sequence of float, shape (2,), optional
        First position, m; by default near the middle, towards the load.
    tilts : sequence of float, shape (2,), optional
        Of the journal in the bore, held, rad.

    Raises
    ------
    ArithmeticError
        There is no such position, or none was found.
    """
    force, clearance = np.asarray(load, float), film.parameters.clearance
    size = float(np.hypot(*force))
    position = np.array(0.1 * clearance * force / size if start is None else start)
    for rounds in range(_ROUNDS):
        found = film.respond(np.array([*position, *tilts]), _STILL, speed)
        missing = -force - found.wrench[:2]
        if float(np.hypot(*missing)) < _MET * size:
            return Carried(force, speed, position, found)
        step = _step(found.stiffness[:2, :2], -missing, clearance)
        most = _BOLD * max(found.h_min, _NEAREST * clearance) * 0.5 ** (rounds // _PATIENCE)
        position = position + step * min(1.0, most / float(np.hypot(*step)))
    raise ArithmeticError(f"no position was found where the film carries {size:.4g} N")


def _step(stiffness: Floats, net: Floats, clearance: float) -> Floats:
    """Newton's step under the net force; where nothing holds the journal, in the direction of the force."""
    try:
        return np.asarray(np.linalg.solve(stiffness, net))
    except np.linalg.LinAlgError:
        return clearance * net / float(np.hypot(*net))


def carried_each(
    film: Film, loads: Sequence[Sequence[float]], speeds: Sequence[float]
) -> Iterator[Carried | None]:
    """`carried` of one load and speed after another, each from the one before; None where there is none."""
    start: Sequence[float] | None = None
    for load, speed in zip(loads, speeds, strict=True):
        try:
            found = carried(film, load, speed, start)
        except (ArithmeticError, np.linalg.LinAlgError):
            yield None
            continue
        start = found.position.tolist()
        yield found


def threshold(stiffness: Floats, damping: Floats) -> float:
    """Speed up to which a rigid rotor in two like bearings is stable, times the root of C/g.

    With the equivalent stiffness k of the whirl at the limit and the square n of its frequency over the speed
    (Lund 1965; Glienicke 1966) a mass k/n per load is the limit.

    Parameters
    ----------
    stiffness, damping : ndarray, shape (2, 2)
        K C/W and B C w/W.

    Returns
    -------
    float
        Infinite where the bearing is stable at any speed.
    """
    (kxx, kxy), (kyx, kyy) = stiffness
    (bxx, bxy), (byx, byy) = damping
    k = (kxx * byy + kyy * bxx - kxy * byx - kyx * bxy) / (bxx + byy)
    n = ((k - kxx) * (k - kyy) - kxy * kyx) / (bxx * byy - bxy * byx)
    return float(np.sqrt(k / n)) if n > 0.0 and k > 0.0 else float("inf")
