"""Start values of a train's rotor unit: it hovers, balanced, under constant forces.

For the builder.  The forces are the target loads of the bearings; the shape is the
catenary of the shaft on these forces, with its whirl under the nominal unbalance; both
of the unreduced shaft, so that they do not depend on the reduction chosen later.
"""

from __future__ import annotations

import numpy as np

from fmus import port
from rotor_fmu.linear.harmonic import unbalance_response
from rotor_fmu.linear.whirl import LinearBearings
from rotor_fmu.shaft.condensation import condense_static
from rotor_fmu.shaft.matrices import assemble
from rotor_fmu.shaft.statics import target_loads
from rotor_fmu.train.train import Train

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
    model = assemble(train)
    static, bearings = condense_static(model, train.weight), len(train.bearings)
    loads = np.zeros((bearings, 4))
    loads[:, :2] = np.outer(target_loads(train), train.upwards)
    springs = np.tile(_SPRING * np.eye(4), (bearings, 1, 1))
    shape = np.zeros((bearings, 4))
    for _ in range(_ROUNDS):  # the springs' share goes into F0 until it has vanished
        shape = static.under_law((loads + _SPRING * shape).ravel(), springs).journals.reshape(-1, 4)
    phases = np.exp(1j * np.array([wheel.unbalance_phase for wheel in train.wheels]))
    supports = LinearBearings(springs, np.zeros_like(springs))
    whirl = unbalance_response(model, train.speed, supports, np.array(train.nominal_unbalance) * phases)
    orbit = whirl.shape[model.bearing_dofs]
    parts = {"": shape, "_cos": orbit.real, "_sin": -orbit.imag}
    starts: dict[str, port.Value] = {port.SPEED: train.speed, "gravity": train.weight}
    for i in range(bearings):
        starts[port.at_bearing(i + 1, "F0.Fx")] = float(loads[i, 0])
        starts[port.at_bearing(i + 1, "F0.Fy")] = float(loads[i, 1])
        for part, positions in parts.items():
            for name, value in zip(port.POSITION, positions[i], strict=True):
                starts[port.at_bearing(i + 1, f"start.{name}{part}")] = float(value)
    for j, (wheel, unbalance) in enumerate(zip(train.wheels, train.nominal_unbalance, strict=True), 1):
        starts[f"wheel[{j}].unbalance"] = unbalance
        starts[f"wheel[{j}].unbalance_phase"] = wheel.unbalance_phase
    return starts
