"""A journal that goes round in a bearing, step by step, for units whose film or pads remember."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fmus import port

INPUTS = [v.name for v in port.BEARING_INPUTS]
STEP = 1e-4


@dataclass(frozen=True)
class Orbit:
    """Round this centre in m; `outputs` are read after each step."""

    centre: tuple[float, float]
    outputs: Sequence[str]

    def place(self, k: int) -> dict[str, float]:
        """Inputs at step k, tilted."""
        t, inputs = k * STEP, np.zeros(17)
        turn, swing = 300.0 * t, 1e-4
        x, y = self.centre
        inputs[:2] = x + swing * np.cos(turn), y + swing * np.sin(turn)
        inputs[4:6] = -300.0 * swing * np.sin(turn), 300.0 * swing * np.cos(turn)
        inputs[2], inputs[16] = 5e-5, 157.0
        return dict(zip(INPUTS, inputs, strict=True))

    def go(self, unit, first: int, last: int) -> list[list[float]]:
        """Outputs of some steps."""
        found = []
        for k in range(first, last):
            unit.set(self.place(k + 1))
            assert unit.step(k * STEP, STEP), unit.said
            found.append(unit.get(*self.outputs))
        return found
