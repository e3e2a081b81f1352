"""Jumps of a law: errors of a step that no halving makes less.

A force that jumps, as that of a film whose front goes over a cell, cannot be met by a shorter step: halving
only finds the instant.  Once that is clear, the step over the jump counts, and the next one begins with the
law behind it.
"""

from __future__ import annotations

import math

STAYS = 0.7
"""Share of its error that a step halved twice must keep for halving to be no help: what goes with the step
falls to a quarter or less. What a start leaves that is soon damped falls more slowly until steps are short
enough to follow it (0.65 on the small train), a jump not at all."""

SLIGHT, STUBBORN = 0.05, 5
"""Error up to which a step over a jump counts once two halvings were no help, as a run does; and how many are
tried where it is larger."""

LEAST, LARGEST = 1e-6, 0.2
"""Relative error that may be taken for a jump: below is rounding, above a run has no meaning."""


class Jumps:
    """What was missed on the way to a jump.

    Attributes
    ----------
    behind : float
        Halvings of the interval to which steps are to grow again behind a jump; infinite elsewhere.
    """

    def __init__(self) -> None:
        self.behind = math.inf
        self._errors: list[float] = []
        self._level, self._end = 0, -math.inf

    def found(self, error: float, level: int, end: float) -> bool:
        """Whether the error of a step of this level, which ends there, is a jump; notes what was missed.

        Shorter steps that end before the jump may be accepted in between.
        """
        if not self._errors:
            self._level, self._end = level, end
        self._errors.append(error)
        tries = 3 if error <= SLIGHT else 1 + STUBBORN
        if len(self._errors) < tries or not LEAST < error <= LARGEST or error <= STAYS * self._errors[-3]:
            return False
        self.behind, self._end = self._level, end
        return True

    def share(self, level: int) -> float:
        """Share of the error from its length that a step over a jump has of one as long as those around.

        What is missed within a step reaches the shaft as an impulse, which goes with the length; the estimate
        counts on steps of one length, and those before and behind are as long as that with which it was met.
        """
        return 2.0 ** (self._level - level)

    def passed(self, end: float) -> None:
        """Note that a step was accepted."""
        if end >= self._end:
            self._errors.clear()

    def grown(self, level: int) -> None:
        """Note the level of the next step."""
        if level <= self.behind:
            self.behind = math.inf

    def taken_back(self) -> None:
        """Note that a step was taken back: it is not to grow for a jump before it."""
        self.behind = math.inf
