"""A rotor of the port without mass: q = q0 + S w at once, S a full unsymmetric compliance over both bearings.

With the affine law at its inputs it solves (1 + S K) q = q0 + S F0; with a force alone it takes that force.
Either way the outputs depend on the inputs of the same instant: direct feedthrough.
"""

import numpy as np
from port_unit import PortUnit

from fmus import port

BEARINGS = (1, 2)
_SIZE = 4 * len(BEARINGS)
_OWN = (
    *(port.Variable(f"free[{i}]", "parameter") for i in range(1, _SIZE + 1)),
    *(port.Variable(f"S[{i},{j}]", "parameter") for i in range(1, _SIZE + 1) for j in range(1, _SIZE + 1)),
)


class Compliance(PortUnit):
    def __init__(self, **kwargs):
        super().__init__(port.rotor(["front", "rear"], ["wheel"], 4) + _OWN, **kwargs)

    def solve(self):
        free = np.array(self.read(v.name for v in _OWN[:_SIZE]))
        compliance = np.array(self.read(v.name for v in _OWN[_SIZE:])).reshape(_SIZE, _SIZE)
        constant, stiffness = np.zeros(_SIZE), np.zeros((_SIZE, _SIZE))
        for k, bearing in enumerate(BEARINGS):
            law = self.read([port.at_bearing(bearing, name) for name in port.LAW])
            own = slice(4 * k, 4 * k + 4)
            constant[own], stiffness[own, own] = law[:4], np.reshape(law[4:20], (4, 4))
        q = np.linalg.solve(np.eye(_SIZE) + compliance @ stiffness, free + compliance @ constant)
        for k, bearing in enumerate(BEARINGS):
            own = [port.at_bearing(bearing, name) for name in port.JOURNAL]
            self.write(own, [*q[4 * k : 4 * k + 4], 0.0, 0.0, 0.0, 0.0])

    def do_step(self, current_time, step_size):
        self.solve()
        return True

    def _get_fmu_state(self):
        return {"values": dict(self.values), "init": self.initializing}

    def _set_fmu_state(self, state):
        self.values.update(state["values"])
        self.initializing = state["init"]
