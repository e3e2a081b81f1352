"""Depth against depth: the figures of the analysed bearing and the shaft, with their differences."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from orchestrator.results.quantities import AMPLITUDE, FORCE, GAP, MOMENT, SHARE, SOMMERFELD, STRESS, Quantity
from orchestrator.study.comparison import Comparison
from orchestrator.study.depth_run import PhaseFigures

_FIGURES: tuple[tuple[str, Quantity, Callable[[PhaseFigures], float]], ...] = (
    ("bearing force, mean", FORCE, lambda found: found.bearing.force_mean),
    ("bearing force, largest", FORCE, lambda found: found.bearing.force_max),
    ("bearing moment, largest", MOMENT, lambda found: found.bearing.moment_max),
    ("Sommerfeld number, mean", SOMMERFELD, lambda found: found.bearing.sommerfeld_mean),
    ("least gap, mean", GAP, lambda found: found.bearing.least_gap_mean),
    ("least gap, harmonic part", GAP, lambda found: found.bearing.least_gap_harmonic),
    ("least gap, smallest", GAP, lambda found: found.bearing.least_gap_min),
    ("time in solid contact", SHARE, lambda found: found.bearing.contact_share),
    ("solid contact force, largest", FORCE, lambda found: found.contact_largest),
    ("vibration amplitude, largest", AMPLITUDE, lambda found: found.shaft.amplitude_max),
    ("normal stress, largest", STRESS, lambda found: found.shaft.stress_max),
)


@dataclass(frozen=True)
class DepthRow:
    """One figure in one phase at every depth.

    Attributes
    ----------
    phase, label : str
        Which figure.
    quantity : Quantity
        How it is shown.
    values : mapping
        By depth, SI units; not a number where a run does not give it.
    """

    phase: str
    label: str
    quantity: Quantity
    values: Mapping[str, float]

    @property
    def differences(self) -> dict[str, float]:
        """Of every other depth to the first, as a share of the first's value; nan where that is 0."""
        first, *others = self.values
        exact = self.values[first]
        return {d: self.values[d] / exact - 1.0 if exact != 0.0 else math.nan for d in others}

    def shown(self) -> list[str]:
        """The values in one unit, and the differences."""
        values = [value for value in self.values.values() if math.isfinite(value)]
        largest = max(map(abs, values), default=0.0)
        unit = self.quantity.fitting(largest).fitting(largest)
        texts = [unit.text(v).strip() if math.isfinite(v) else "-" for v in self.values.values()]
        changes = [f"{100 * d:+.1f} %" if math.isfinite(d) else "-" for d in self.differences.values()]
        return texts + changes


def depth_rows(found: Comparison) -> Iterator[DepthRow]:
    """All figures of all phases that any of the runs gives."""
    for name in ("before", "after"):
        figures = {depth: getattr(run, name) for depth, run in found.runs.items()}
        told = [item.phase.name for item in figures.values() if item is not None]
        for label, quantity, read in _FIGURES if told else ():
            values = {d: math.nan if item is None else read(item) for d, item in figures.items()}
            yield DepthRow(told[0], label, quantity, values)
