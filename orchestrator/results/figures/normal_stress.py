"""Largest normal stress in the shaft over time (Figure 9 of the paper)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from orchestrator.results import quantities
from orchestrator.results.figures.shaft_maxima import shaft_maximum

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def normal_stress(records: Sequence[xr.Dataset]) -> Figure:
    """Draw the largest normal stress from bending along the shaft over time."""
    return shaft_maximum(records, "normal_stress", quantities.STRESS, "Largest normal stress in the shaft")
