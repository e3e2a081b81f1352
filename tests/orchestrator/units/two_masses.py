"""A rotor of the port with one bearing: a journal mass joined to an inner mass by a spring.

The four coordinates are alike.  The journal mass feels the bearing, the inner one the
wheel's unbalance.  The step is exact for a wrench that varies linearly in time; the
affine law is solved for its end value.
"""

import numpy as np
from port_unit import PortUnit
from scipy.linalg import expm

from fmus import port

_OWN = (
    port.Variable("journal_mass", "parameter", "kg", start=100.0),
    port.Variable("inner_mass", "parameter", "kg", start=400.0),
    port.Variable("shaft_stiffness", "parameter", "N/m", start=4e6),
    port.Variable("shaft_damping", "parameter", "N.s/m", start=1e3),
)
_LAW = [port.at_bearing(1, name) for name in port.LAW]
_JOURNAL = [port.at_bearing(1, name) for name in port.JOURNAL]
_START = [f"bearing[1].start.{name}" for name in port.POSITION]


class TwoMasses(PortUnit):
    def __init__(self, **kwargs):
        super().__init__(port.rotor(["only"], ["wheel"], 2) + _OWN, **kwargs)
        self.state = np.zeros(16)  # q of journal, q of inner mass, then their rates

    def law(self):
        values = np.array(self.read(_LAW))
        return values[:4], values[4:20].reshape(4, 4), values[20:].reshape(4, 4)

    def matrices(self):
        """M, C, K of the two masses (8, 8) and the constant load."""
        p = self.values
        one = np.eye(4)
        link = np.block([[one, -one], [-one, one]])
        mass = np.diag([p["journal_mass"]] * 4 + [p["inner_mass"]] * 4)
        weight = np.zeros(8)
        weight[5] = -p["inner_mass"] * p["gravity"]
        weight[1] = -p["journal_mass"] * p["gravity"]
        return mass, p["shaft_damping"] * link, p["shaft_stiffness"] * link, weight

    def solve(self):
        p = self.values
        mass, damping, stiffness, weight = self.matrices()
        p["bearing[1].load"] = -weight.sum()
        speed, start = p["speed"], np.zeros(16)
        unbalance = p["wheel[1].unbalance"] * speed**2 * np.exp(1j * p["wheel[1].unbalance_phase"])
        rotating = np.zeros(8, dtype=complex)
        rotating[4:6] = unbalance, -1j * unbalance
        force, k, c = self.law()
        if p["start.from_law"]:
            supported, load = stiffness.copy(), weight.copy()
            supported[:4, :4] += k
            load[:4] += force
            start[:8] = np.linalg.solve(supported, load)
            dynamic = supported - speed**2 * mass + 1j * speed * damping
            dynamic[:4, :4] += 1j * speed * c
            orbit = np.linalg.solve(dynamic, rotating)
        else:
            start[:4] = self.read(_START)
            start[4:8] = start[:4] + weight[4:] / p["shaft_stiffness"]
            journal = np.array(self.read([f"{n}_cos" for n in _START])) - 1j * np.array(
                self.read([f"{n}_sin" for n in _START])
            )
            dynamic = stiffness - speed**2 * mass + 1j * speed * damping
            inner = np.linalg.solve(dynamic[4:, 4:], rotating[4:] - dynamic[4:, :4] @ journal)
            orbit = np.concatenate([journal, inner])
        if p["start.orbit"]:
            start[:8] += orbit.real
            start[8:] += (1j * speed * orbit).real
        self.state = start
        self.publish()

    def publish(self):
        self.write(_JOURNAL, np.concatenate([self.state[:4], self.state[8:12]]))
        self.write(["node[1].x", "node[1].y", "node[2].x", "node[2].y"], self.state[[0, 1, 4, 5]])

    def wheel_force(self, time):
        p = self.values
        total = np.zeros(8)
        parts = [(p["wheel[1].unbalance"], p["wheel[1].unbalance_phase"])]
        if time >= p["fracture.time"]:
            parts.append((p["wheel[1].blade_unbalance"], p["wheel[1].blade_phase"]))
        for unbalance, phase in parts:
            angle = p["speed"] * time + phase
            total[4:6] += unbalance * p["speed"] ** 2 * np.array([np.cos(angle), np.sin(angle)])
        return total

    def do_step(self, current_time, step_size):
        mass, damping, stiffness, weight = self.matrices()
        inverse = np.linalg.inv(mass)
        dynamics = np.block([[np.zeros((8, 8)), np.eye(8)], [-inverse @ stiffness, -inverse @ damping]])
        # first-order hold: z' = A z + B (load + slope t)
        big = np.zeros((32, 32))
        big[:16, :16] = dynamics
        big[8:16, 16:24] = inverse
        big[16:24, 24:] = np.eye(8)
        transition = expm(big * step_size)
        free, of_load, of_slope = transition[:16, :16], transition[:16, 16:24], transition[:16, 24:]
        start = np.concatenate([self.state[:4], self.state[8:12]])
        force, k, c = self.law()
        tangent = np.hstack([k, c])
        first = force - tangent @ start
        of_end = of_slope / step_size
        of_start = of_load - of_end
        begin = weight + self.wheel_force(current_time)
        end = weight + self.wheel_force(current_time + step_size)
        state = free @ self.state + of_start @ begin + of_end @ end + of_start[:, :4] @ first
        journal = [0, 1, 2, 3, 8, 9, 10, 11]
        gain = of_end[:, :4]
        last = np.linalg.solve(np.eye(4) + tangent @ gain[journal], force - tangent @ state[journal])
        self.state = state + gain @ last
        self.publish()
        return True

    def _get_fmu_state(self):
        return {"values": dict(self.values), "state": self.state.tolist(), "initializing": self.initializing}

    def _set_fmu_state(self, state):
        self.values.update(state["values"])
        self.state = np.array(state["state"])
        self.initializing = state["initializing"]
