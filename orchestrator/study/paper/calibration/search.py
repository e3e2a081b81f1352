"""The design that meets the paper's figures before the fracture, found on static and linear quantities."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares

from orchestrator.study.paper import published
from orchestrator.study.paper.calibration.bench import Bench, Steady
from orchestrator.study.paper.published import Published
from rotor_fmu.train.turbine_geometry import TurbineDesign, turbine_train

ANALYSED = "LP1-front"
"""The analysed bearing."""


@dataclass(frozen=True)
class Freedom:
    """A figure of the design that the search may move.

    Attributes
    ----------
    name : str
        Of the design's attribute, with a dot for one of a journal.
    low, high : float
        Bounds; see CALIBRATION.md for their reasons.
    fixed_by : int
        Row of the table which it mainly answers to.
    """

    name: str
    low: float
    high: float
    fixed_by: int


FREEDOMS = (
    Freedom("lp_wheel_mass", 20e3, 40e3, 1),
    Freedom("viscosity", 0.008, 0.040, 2),
    Freedom("lp.relative_clearance", 1.0e-3, 3.0e-3, 3),
    Freedom("lp_balance", 0.2, 2.5, 4),
    Freedom("lp.residual_tilt", 0.0, 1.5e-4, 5),
    Freedom("generator_balance", 1.0, 16.0, 7),
    Freedom("lp_core_diameter", 1.00, 1.50, 8),
)


@dataclass(frozen=True)
class Target:
    """A figure of the paper: row of the table, text, what is published, how it is found from V1 and V2."""

    row: int
    text: str
    published: Published
    measure: Callable[[Steady, Steady], float]

    def miss(self, v1: Steady, v2: Steady) -> float:
        """How far off, in tolerances."""
        return (self.measure(v1, v2) / self.published.value - 1.0) / self.published.tolerance


TARGETS = (
    Target(1, "bearing force [N]", published.FORCE_BEFORE, lambda v1, v2: v1.force),
    Target(2, "Sommerfeld number", published.SOMMERFELD_BEFORE, lambda v1, v2: v1.sommerfeld),
    Target(3, "mean least gap V1 [m]", published.GAP_MEAN, lambda v1, v2: v1.gap),
    Target(4, "its harmonic part [m]", published.GAP_HARMONIC, lambda v1, v2: v1.gap_harmonic),
    Target(5, "mean least gap V2 - V1 [m]", published.GAP_V2_OVER_V1, lambda v1, v2: v2.gap - v1.gap),
    Target(7, "largest amplitude [m]", published.AMPLITUDE_BEFORE, lambda v1, v2: v1.amplitude),
    Target(8, "largest normal stress [Pa]", published.STRESS_BEFORE, lambda v1, v2: v1.stress),
)


def design_value(design: TurbineDesign, name: str) -> float:
    """Value of a freedom in a design."""
    part, _, key = name.rpartition(".")
    return float(getattr(getattr(design, part) if part else design, key))


def with_values(design: TurbineDesign, values: dict[str, float]) -> TurbineDesign:
    """A design with other values of some freedoms."""
    for name, value in values.items():
        part, _, key = name.rpartition(".")
        change = {key: value}
        design = replace(design, **({part: replace(getattr(design, part), **change)} if part else change))
    return design


def before_fracture(bench: Bench, design: TurbineDesign, depth: str) -> Steady:
    """Measures of the steady state, from statics and the linear unbalance response."""
    return bench.steady(turbine_train(design), depth, ANALYSED, reduction="craig-bampton")


def search(bench: Bench, first: TurbineDesign, report: Callable[[str], None] = print) -> TurbineDesign:
    """Least squares of the targets, each in parts of its tolerance, within the bounds.

    Parameters
    ----------
    bench : Bench
        Where trains are made.
    first : TurbineDesign
        Where the search begins; what is no freedom stays.
    report : callable
        Gets a line for each evaluation.

    Returns
    -------
    TurbineDesign
        Not rounded.
    """
    low, high = (np.array([getattr(f, side) for f in FREEDOMS]) for side in ("low", "high"))

    def misses(share: np.ndarray) -> np.ndarray:
        values = low + share * (high - low)
        design = with_values(first, {f.name: float(v) for f, v in zip(FREEDOMS, values, strict=True)})
        v1, v2 = (before_fracture(bench, design, depth) for depth in ("v1", "v2"))
        result = np.array([target.miss(v1, v2) for target in TARGETS])
        report("  misses in tolerances " + " ".join(f"{m:+7.3f}" for m in result))
        return result

    start = (np.array([design_value(first, f.name) for f in FREEDOMS]) - low) / (high - low)
    found = least_squares(misses, start, bounds=(0.0, 1.0), diff_step=1e-3, xtol=1e-4, max_nfev=8)
    values = low + found.x * (high - low)
    return with_values(first, {f.name: float(v) for f, v in zip(FREEDOMS, values, strict=True)})
