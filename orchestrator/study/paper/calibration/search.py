"""The design that meets the paper's figures before the fracture, found on static and linear quantities."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares

from orchestrator.study.paper.calibration.coupled import CoupledTrain
from orchestrator.study.paper.calibration.measures import Steady, bearing_index, steady
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
    """A figure of the paper: row of the table, text, value in SI units, relative tolerance, measure."""

    row: int
    text: str
    value: float
    tolerance: float
    measure: Callable[[Steady, Steady], float]


TARGETS = (
    Target(1, "bearing force [N]", 1.8e6, 0.10, lambda v1, v2: v1.force),
    Target(2, "Sommerfeld number", 4.3, 0.10, lambda v1, v2: v1.sommerfeld),
    Target(3, "mean least gap V1 [m]", 100e-6, 0.10, lambda v1, v2: v1.gap),
    Target(4, "its harmonic part [m]", 5e-6, 0.30, lambda v1, v2: v1.gap_harmonic),
    Target(5, "mean least gap V2 - V1 [m]", 15e-6, 0.30, lambda v1, v2: v2.gap - v1.gap),
    Target(7, "largest amplitude [m]", 0.3e-3, 0.20, lambda v1, v2: v1.amplitude),
    Target(8, "largest normal stress [Pa]", 40e6, 0.20, lambda v1, v2: v1.stress),
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


def before_fracture(design: TurbineDesign, depth: str) -> Steady:
    """Measures of the steady state, from statics and the linear unbalance response."""
    train = turbine_train(design)
    coupled = CoupledTrain(train, depth, reduction="craig-bampton")
    return steady(train, coupled.revolution(), bearing_index(train, ANALYSED))


def search(first: TurbineDesign, report: Callable[[str], None] = print) -> TurbineDesign:
    """Least squares of the targets, each in parts of its tolerance, within the bounds.

    Parameters
    ----------
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
        v1, v2 = (before_fracture(design, depth) for depth in ("v1", "v2"))
        result = np.array([(t.measure(v1, v2) / t.value - 1.0) / t.tolerance for t in TARGETS])
        report("  misses in tolerances " + " ".join(f"{m:+7.3f}" for m in result))
        return result

    start = (np.array([design_value(first, f.name) for f in FREEDOMS]) - low) / (high - low)
    found = least_squares(misses, start, bounds=(0.0, 1.0), diff_step=1e-3, xtol=1e-4, max_nfev=8)
    values = low + found.x * (high - low)
    return with_values(first, {f.name: float(v) for f, v in zip(FREEDOMS, values, strict=True)})
