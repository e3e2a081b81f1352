"""Linear investigations of a train's shaft: the public face of this part of the package.

Modes, whirl, unbalance response and the errors of reductions need no time integration, and so
no unit: they are pure functions of the shaft's matrices and of bearing stiffness and damping.
"""

from __future__ import annotations

from functools import lru_cache

from rotor_fmu.linear.critical import (
    LEAST_DECREMENT,
    NOISE,
    REACH,
    CriticalSpeed,
    LeastDamped,
    critical_speeds,
    least_damped,
    least_damped_of,
    log_decrement,
    thresholds,
    undamped_critical_speeds,
)
from rotor_fmu.linear.free_whirl import (
    WhirlBranches,
    WhirlError,
    free_branches,
    irs_iterates,
    modal_truncation,
)
from rotor_fmu.linear.harmonic import HarmonicResponse, unbalance_response, unbalance_responses
from rotor_fmu.linear.reduction_report import ReductionReport, matched, reduction_report
from rotor_fmu.linear.resonance import distinct, refined, resonances
from rotor_fmu.linear.tracking import ModesAt, Tracks, follow, modal_assurance
from rotor_fmu.linear.whirl import LinearBearings, WhirlModes, campbell, half_axes, whirl_modes
from rotor_fmu.reduction.reduce import DEFAULT_SIZE, METHODS, Method, ReducedShaft, reduce
from rotor_fmu.shaft.matrices import ShaftModel, assemble
from rotor_fmu.shaft.statics import target_loads
from rotor_fmu.train.train import Train

__all__ = [
    "DEFAULT_SIZE",
    "LEAST_DECREMENT",
    "METHODS",
    "NOISE",
    "REACH",
    "CriticalSpeed",
    "HarmonicResponse",
    "LeastDamped",
    "LinearBearings",
    "Method",
    "ModesAt",
    "ReducedShaft",
    "ReductionReport",
    "ShaftModel",
    "Tracks",
    "WhirlBranches",
    "WhirlError",
    "WhirlModes",
    "campbell",
    "critical_speeds",
    "distinct",
    "follow",
    "free_branches",
    "half_axes",
    "irs_iterates",
    "least_damped",
    "least_damped_of",
    "log_decrement",
    "matched",
    "modal_assurance",
    "modal_truncation",
    "reduced_shaft",
    "reduction_report",
    "refined",
    "resonances",
    "target_loads",
    "thresholds",
    "unbalance_response",
    "unbalance_responses",
    "undamped_critical_speeds",
    "unreduced_shaft",
    "whirl_modes",
]


@lru_cache(maxsize=4)
def unreduced_shaft(train: Train) -> ShaftModel:
    """The matrices of a train's shaft; not to be changed."""
    return assemble(train)


@lru_cache(maxsize=16)
def reduced_shaft(train: Train, method: Method, size: int = DEFAULT_SIZE) -> ReducedShaft:
    """The shaft reduced to a number of degrees of freedom; not to be changed."""
    return reduce(unreduced_shaft(train), method, size=size)
