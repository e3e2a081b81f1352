"""How an evaluation of the film can end."""

from __future__ import annotations

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray


class FilmStatus(IntEnum):
    """Result code of an evaluation; every failure carries advice.

    After a failure no output has been written.
    """

    OK = 0
    NOT_FINITE = 1
    GAP_CLOSED = 2
    TOO_DEEP = 3
    NO_SOLUTION = 4
    NOT_CONVERGED = 5

    @property
    def advice(self) -> str:
        """What happened and what helps, one sentence."""
        return _ADVICE[self]


# The same as plain numbers, for compiled code.
OK, NOT_FINITE, NO_SOLUTION, NOT_CONVERGED = (
    int(status)
    for status in (FilmStatus.OK, FilmStatus.NOT_FINITE, FilmStatus.NO_SOLUTION, FilmStatus.NOT_CONVERGED)
)

_ADVICE = {
    FilmStatus.OK: "the film was evaluated",
    FilmStatus.NOT_FINITE: "an input or offset is NaN or infinite: look at the unit that sent it",
    FilmStatus.GAP_CLOSED: (
        "the gap is closed and the bearing has no solid contact: take a smaller step, "
        "or give roughness and contact modulus"
    ),
    FilmStatus.TOO_DEEP: (
        "the journal overlaps the bore by more than 50 roughnesses and a tenth of the clearance: "
        "the state is a wild trial, take a smaller step"
    ),
    FilmStatus.NO_SOLUTION: (
        "the Reynolds equation gave no finite pressure: the state is beyond the range of double precision"
    ),
    FilmStatus.NOT_CONVERGED: "the film rupture was not found within the iteration limit: refine the grid",
}


class FilmFailure(ArithmeticError):
    """An evaluation of the film that gave no result.

    Attributes
    ----------
    status : FilmStatus
        Why.
    state : ndarray, shape (9,)
        Relative position (4), relative velocity (4), speed.

    Parameters
    ----------
    status, state : FilmStatus, ndarray
        As above.
    words : str
        The state for people, see `bearing_fmu.state_in_words`.
    """

    def __init__(self, status: FilmStatus, state: NDArray[np.float64], words: str) -> None:
        self.status = status
        self.state = state
        super().__init__(f"{status.name}: {status.advice}; at {words}")
