"""Largest vibration amplitude in the shaft over time (Figure 8 of the paper)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from orchestrator.results import quantities
from orchestrator.results.figures.shaft_maxima import shaft_maximum

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def vibration_amplitude(records: Sequence[xr.Dataset]) -> Figure:
    """Draw the largest vibration amplitude along the shaft, from the static line, over time."""
    return shaft_maximum(
        records, "vibration_amplitude", quantities.AMPLITUDE, "Largest vibration amplitude in the shaft"
    )
