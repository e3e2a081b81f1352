"""Quantities of the paper's comparison, from the histories of the three depths.

Before the fracture: the last 80 ms, two revolutions.  After it: means from 0.4 s behind
it, largest and smallest values from its instant on.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from orchestrator.study.paper.calibration.coupled import History
from orchestrator.study.paper.calibration.films import CENTRE_GAP, GAP, GAP_POSITION
from rotor_fmu.train.train import Train

BEFORE, SETTLE = 0.08, 0.4
"""Windows [s]."""


@dataclass(frozen=True)
class Steady:
    """Before the fracture, at one bearing and one depth: SI units, So without unit."""

    force: float
    sommerfeld: float
    gap: float
    gap_harmonic: float
    amplitude: float
    stress: float


@dataclass(frozen=True)
class Fractured:
    """After the fracture, at one bearing and one depth.

    Attributes
    ----------
    sommerfeld : float
        Of the mean force.
    force, moment, amplitude, stress : float
        Largest [N], [N m], [m], [Pa].
    late_force, late_amplitude, late_stress : float
        The same from 0.4 s behind the fracture on.
    gap, centre_gap : float
        Smallest [m].
    rear_share : float
        Share of the samples whose least gap lies at the rear end.
    """

    sommerfeld: float
    force: float
    moment: float
    amplitude: float
    stress: float
    late_force: float
    late_amplitude: float
    late_stress: float
    gap: float
    centre_gap: float
    rear_share: float


def bearing_index(train: Train, name: str) -> int:
    """Index of a bearing by its name."""
    return [seat.name for seat in train.bearings].index(name)


def steady(train: Train, history: History, bearing: int) -> Steady:
    """Measures of a steady history: all of it counts."""
    seat = train.bearings[bearing]
    force = float(history.force(bearing).mean())
    gap = history.films[:, bearing, GAP]
    return Steady(
        force=force,
        sommerfeld=seat.sommerfeld(force, train.speed),
        gap=float(gap.mean()),
        gap_harmonic=float(np.ptp(gap)) / 2.0,
        amplitude=float(history.amplitude.max()),
        stress=float(history.stress.max()),
    )


def fractured(train: Train, history: History, bearing: int, fracture: float) -> Fractured:
    """Measures of a run behind its fracture [s]."""
    seat = train.bearings[bearing]
    behind, late = history.time > fracture, history.time > fracture + SETTLE
    force, moment = history.force(bearing), history.moment(bearing)
    films = history.films[:, bearing]
    gap = films[behind, GAP]
    return Fractured(
        sommerfeld=seat.sommerfeld(float(force[late].mean()), train.speed),
        force=float(force[behind].max()),
        moment=float(moment[behind].max()),
        amplitude=float(history.amplitude[behind].max()),
        stress=float(history.stress[behind].max()),
        late_force=float(force[late].max()),
        late_amplitude=float(history.amplitude[late].max()),
        late_stress=float(history.stress[late].max()),
        gap=float(gap.min()),
        centre_gap=float(films[behind, CENTRE_GAP].min()),
        rear_share=float((films[behind, GAP_POSITION] > 0.0).mean()),
    )


def window_before(history: History, fracture: float) -> History:
    """The part of a run that counts as steady."""
    part = (history.time > fracture - BEFORE) & (history.time <= fracture + 1e-9)
    return History(history.time[part], history.films[part], history.amplitude[part], history.stress[part])
