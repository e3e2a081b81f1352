"""Scan of the blade's unbalance with short coupled runs of the three depths."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from orchestrator.study.paper.calibration.coupled import Blade, CoupledTrain
from orchestrator.study.paper.calibration.measures import Fractured, bearing_index, fractured
from rotor_fmu.train.train import Train

DEPTHS = ("v1", "v2", "v3")
FRACTURE = 0.2
"""Instant of the fracture in short runs [s]: whole revolutions, as the paper's 1 s."""


@dataclass(frozen=True)
class Verdicts:
    """Rows 9 to 14 at one bearing; True where a row is met."""

    sommerfeld: bool
    edge_contact: bool
    order_of_gaps: bool
    force_ratio: bool
    moments: bool
    order_of_maxima: bool


def judge(v1: Fractured, v2: Fractured, v3: Fractured, gap_before: float, moment_before: float) -> Verdicts:
    """Judge the rows after the fracture.

    Parameters
    ----------
    v1, v2, v3 : Fractured
        Measures of the three depths.
    gap_before : float
        Mean least gap of V2 before the fracture [m].
    moment_before : float
        Mean moment of V1 before the fracture [N m].
    """
    return Verdicts(
        sommerfeld=abs(v1.sommerfeld / 7.7 - 1.0) <= 0.15,
        edge_contact=v1.gap <= 0.0 and v1.centre_gap > 30e-6 and 0.01 < v1.rear_share < 0.99,
        order_of_gaps=10e-6 < v2.gap < min(gap_before, v3.gap),
        force_ratio=v1.force / max(v2.force, v3.force) >= 2.1,
        moments=v1.moment > 5.0 * moment_before and v2.moment == v3.moment == 0.0,
        order_of_maxima=v2.amplitude < v3.amplitude and v2.stress > v3.stress,
    )


def coupled_depths(train: Train, rotor: str, depths: Iterable[str] = DEPTHS) -> dict[str, CoupledTrain]:
    """The train at each depth; V1 only at the bearings of one rotor, V2 elsewhere, which saves its time."""
    result = {}
    for depth in depths:
        near = {seat.name: "v1" for seat in train.bearings if seat.name.startswith(f"{rotor}-")}
        mixed = depth == "v1"
        result[depth] = CoupledTrain(train, "v2" if mixed else depth, depth_at=near if mixed else None)
    return result


def scan(
    trains: dict[str, CoupledTrain],
    wheel: str,
    unbalances: Sequence[float],
    analysed: str,
    *,
    behind: float = 0.7,
    phase: float = 0.0,
) -> Iterator[tuple[float, dict[str, Fractured]]]:
    """Measures at each depth for unbalances of a blade [kg m].

    Parameters
    ----------
    trains : dict
        See `coupled_depths`.
    wheel, analysed : str
        Wheel that loses the blade, bearing that is looked at.
    unbalances : sequence of float
        [kg m].
    behind : float
        Time simulated behind the fracture [s].
    phase : float
        Angle of the blade at t = 0 [rad].
    """
    for unbalance in unbalances:
        result = {}
        for depth, coupled in trains.items():
            history = coupled.run(Blade(wheel, unbalance, phase, FRACTURE), FRACTURE + behind)
            index = bearing_index(coupled.train, analysed)
            result[depth] = fractured(coupled.train, history, index, FRACTURE)
        yield unbalance, result
