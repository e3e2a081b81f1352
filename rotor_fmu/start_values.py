"""Start values of a train's rotor unit: it hovers, balanced, under constant forces.

For the builder.  The forces are the target loads of the bearings; the shape is the
catenary of the shaft on these forces, with its whirl under the nominal unbalance.
"""

from __future__ import annotations

import numpy as np

from fmus import port
from rotor_fmu.shaft.statics import target_loads
from rotor_fmu.train.train import Train
from rotor_fmu.vibration.rotor import Rotor

_SPRING = 1e4
"""Holds the rigid-body motion while the shape is solved [N/m], [N m/rad]; soft beside any shaft."""

_ROUNDS = 4


def default_starts(train: Train) -> dict[str, port.Value]:
    """Return start values by variable name.

    Parameters
    ----------
    train : Train
        The train.

    Returns
    -------
    dict
        Speed, forces, journal positions and 1X orbit, unbalances.
    """
    rotor = Rotor.of_train(train)
    bearings = len(train.bearings)
    loads = np.zeros((bearings, 4))
    loads[:, 1] = target_loads(train)
    springs = np.tile(_SPRING * np.eye(4), (bearings, 1, 1))
    none, shape = np.zeros_like(springs), np.zeros((bearings, 4))
    for _ in range(_ROUNDS):  # the springs' share goes into F0 until it has vanished
        rotor.start_from_law(loads + _SPRING * shape, springs, none, orbit=False)
        shape = rotor.kinematics()[:, :4]
    rotor.start_from_law(loads + _SPRING * shape, springs, none, orbit=True)
    now = rotor.kinematics()
    parts = {"": shape, "_cos": now[:, :4] - shape, "_sin": now[:, 4:] / train.speed}
    starts: dict[str, port.Value] = {port.SPEED: train.speed}
    for i in range(bearings):
        starts[port.at_bearing(i + 1, "F0.Fy")] = float(loads[i, 1])
        for part, positions in parts.items():
            for name, value in zip(port.POSITION, positions[i], strict=True):
                starts[port.at_bearing(i + 1, f"start.{name}{part}")] = float(value)
    for j, (wheel, unbalance) in enumerate(zip(train.wheels, train.nominal_unbalance, strict=True), 1):
        starts[f"wheel[{j}].unbalance"] = unbalance
        starts[f"wheel[{j}].unbalance_phase"] = wheel.unbalance_phase
    return starts
