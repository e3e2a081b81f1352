"""What a blade fracture makes of a design: the depths side by side, by coupled runs as short as will do."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from orchestrator.study.children import Ended
from orchestrator.study.comparison import Comparison, gather
from orchestrator.study.paper.calibration.bench import Bench, near
from orchestrator.study.paper.calibration.statics import ANALYSED
from orchestrator.study.paper.published import DEPTHS
from orchestrator.study.paper.requirement import Verdict
from orchestrator.study.paper.rows import rows
from rotor_fmu.train.train import Train
from rotor_fmu.train.turbine_geometry import TurbineDesign, turbine_train


@dataclass(frozen=True)
class Blade:
    """The lost blade: wheel, mass times radius [kg m], angle at t = 0 [rad]."""

    wheel: str
    unbalance: float
    phase: float = 0.0


@dataclass(frozen=True)
class Means:
    """How runs are carried out: a quick one looks for a design, a long one with films resolved proves it.

    Attributes
    ----------
    behind : float
        Time behind the fracture [s].
    step : float
        Macro step [s].
    film : tuple of int
        Columns and rows.
    reduction : str
        Of the shaft.
    elsewhere : str
        Depth of bearings off the analysed rotor at V1 and V2; empty: as at the analysed one.
    first : float
        Instant of the fracture [s]: whole revolutions, as the paper's 1 s.
    """

    behind: float = 0.9
    step: float = 1e-4
    film: tuple[int, int] = (48, 8)
    reduction: str = "craig-bampton"
    elsewhere: str = "v2"
    first: float = 0.2

    def settings(self, train: Train, depth: str) -> tuple[str, dict[str, Any]]:
        """Depth of the scenario and its keys."""
        keys: dict[str, Any] = {
            "end": self.first + self.behind,
            "step": self.step,
            "film": {"columns": self.film[0], "rows": self.film[1]},
            "reduction": self.reduction,
        }
        if depth == "v3" or self.elsewhere in ("", depth):
            return depth, keys
        return self.elsewhere, {**keys, "depth_at": near(train, ANALYSED.partition("-")[0], depth)}


def fractured(
    place: Bench,
    design: TurbineDesign,
    blade: Blade,
    means: Means | None = None,
    depths: tuple[str, ...] = DEPTHS,
) -> Comparison:
    """Run a design across the fracture at several depths.

    Raises
    ------
    OrchestratorError
        When a run does not come to its end.
    """
    means, train = means or Means(), turbine_train(design)
    loss = {
        "wheel": blade.wheel,
        "unbalance": blade.unbalance,
        "phase": blade.phase % (2.0 * math.pi),
        "time": means.first,
    }
    records = {}
    for depth in depths:
        everywhere, keys = means.settings(train, depth)
        records[depth] = place.run(train, everywhere, loss, **keys)
    keys = means.settings(train, "v3")[1]
    scenario = place.scenario(train, "v3", events=[{"kind": "blade-loss", **loss}], **keys)
    return gather(records, dict.fromkeys(depths, Ended("finished")), ANALYSED, scenario, train)


def figures(found: Comparison) -> dict[str, float]:
    """The figures of a table of designs, by name; what a run that is missing would give is left out."""
    result: dict[str, float] = {}
    for depth, run in found.runs.items():
        before, after = run.require("before"), run.require("after")
        film, shaft = after.bearing, after.shaft
        result |= {
            f"{depth}.so": film.sommerfeld_mean,
            f"{depth}.force": film.force_max / 1e6,
            f"{depth}.gap": film.least_gap_min * 1e6,
            f"{depth}.centre": film.centre_line_gap_min * 1e6,
            f"{depth}.contact": film.contact_share,
            f"{depth}.front": after.ends[0],
            f"{depth}.amplitude": shaft.amplitude_max * 1e3,
            f"{depth}.stress": shaft.stress_max / 1e6,
            f"{depth}.gap_before": before.bearing.least_gap_mean * 1e6,
            f"{depth}.harmonic_before": before.bearing.least_gap_harmonic * 1e6,
            f"{depth}.amplitude_before": before.shaft.amplitude_max * 1e3,
            f"{depth}.stress_before": before.shaft.stress_max / 1e6,
        }
    return result


def rows_met(found: Comparison) -> tuple[int, ...]:
    """Numbers of the rows that are met."""
    return tuple(row.number for row in rows(found) if row.verdict is Verdict.MET)
