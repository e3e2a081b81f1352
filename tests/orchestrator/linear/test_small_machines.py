"""What linear commands show of machines unlike the bundled ones: small, or far below their modes."""

from __future__ import annotations

import numpy as np
import pytest

from orchestrator.commands.harmonic import _micrometres
from orchestrator.results.figures.campbell import _top


@pytest.mark.parametrize(("value", "text"), [(1.6e-7, "0.16"), (3.4e-6, "3.4"), (9.57e-5, "95.7")])
def test_amplitudes_keep_two_digits(value, text):
    assert _micrometres(value) == text


def test_a_diagram_reaches_little_above_the_rotation():
    rotation = np.linspace(5.0, 50.0, 4)
    modes = np.tile([12.0, 20.0, 40.0, 70.0, 90.0, 120.0, 400.0, 1500.0], (4, 1))
    assert _top(modes, rotation) == 200.0
    assert _top(10.0 * modes, rotation) == 1200.0  # six modes at least
    assert _top(0.1 * modes, rotation) == 150.0  # all
