"""A rotor of the port on two bearings: over each a journal mass joined to an inner mass by a spring.

The two oscillators are independent and alike in all four coordinates.  The journal mass
feels the bearing; the wheel is the inner mass over the first bearing.  The step is exact
for a wrench that varies linearly in time; the affine law is solved for its end value.
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
BEARINGS = (1, 2)
JOURNAL = [0, 1, 2, 3, 8, 9, 10, 11]  # q and v of the journal mass among the 16 states of an oscillator


class TwoMasses(PortUnit):
    def __init__(self, **kwargs):
        super().__init__(port.rotor(["front", "rear"], ["wheel"], 4) + _OWN, **kwargs)
        self.states = np.zeros((2, 16))  # q of journal, q of inner mass, then their rates

    def at(self, bearing, names):
        return np.array(self.read([port.at_bearing(bearing, name) for name in names]))

    def law(self, bearing):
        values = self.at(bearing, port.LAW)
        return values[:4], values[4:20].reshape(4, 4), values[20:].reshape(4, 4)

    def matrices(self):
        """M, C, K of two masses (8, 8) and their weight."""
        p = self.values
        one = np.eye(4)
        link = np.block([[one, -one], [-one, one]])
        weight = np.zeros(8)
        weight[[1, 5]] = -p["gravity"] * np.array([p["journal_mass"], p["inner_mass"]])
        mass = np.diag([p["journal_mass"]] * 4 + [p["inner_mass"]] * 4)
        stiffness = p["shaft_stiffness"] * link
        stiffness[[6, 7], [6, 7]] += p["shaft_stiffness"]  # the tilts of the inner mass are held
        return mass, p["shaft_damping"] * link, stiffness, weight

    def solve(self):
        weight = self.matrices()[3]
        for bearing in BEARINGS:
            self.write([port.at_bearing(bearing, "load")], [-weight.sum()])
            self.write([port.at_bearing(bearing, "z")], [bearing])
            self.states[bearing - 1] = self.start(bearing)
        self.publish()

    def start(self, bearing):
        p = self.values
        mass, damping, stiffness, weight = self.matrices()
        speed, state = p["speed"], np.zeros(16)
        rotating = np.zeros(8, dtype=complex)
        if bearing == 1:
            unbalance = p["wheel[1].unbalance"] * speed**2 * np.exp(1j * p["wheel[1].unbalance_phase"])
            rotating[4:6] = unbalance, -1j * unbalance
        dynamic = stiffness - speed**2 * mass + 1j * speed * damping
        if p["start.from_law"]:
            force, k, c = self.law(bearing)
            supported, load = stiffness.copy(), weight.copy()
            supported[:4, :4] += k
            load[:4] += force
            state[:8] = np.linalg.solve(supported, load)
            dynamic[:4, :4] += k + 1j * speed * c
            orbit = np.linalg.solve(dynamic, rotating)
        else:
            static, cosine, sine = (
                self.at(bearing, [f"start.{name}{part}" for name in port.POSITION])
                for part in ("", "_cos", "_sin")
            )
            state[:4] = static
            state[4:8] = np.linalg.solve(stiffness[4:, 4:], weight[4:] - stiffness[4:, :4] @ static)
            journal = cosine - 1j * sine
            inner = np.linalg.solve(dynamic[4:, 4:], rotating[4:] - dynamic[4:, :4] @ journal)
            orbit = np.concatenate([journal, inner])
        if p["start.orbit"]:
            state[:8] += orbit.real
            state[8:] += (1j * speed * orbit).real
        return state

    def publish(self):
        for bearing, state in zip(BEARINGS, self.states, strict=True):
            self.write([port.at_bearing(bearing, name) for name in port.JOURNAL], state[JOURNAL])
            journal, inner = 2 * bearing - 1, 2 * bearing
            self.write([f"node[{n}].{axis}" for n in (journal, inner) for axis in "xy"], state[[0, 1, 4, 5]])

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
        # first-order hold: z' = A z + B (load + slope t)
        big = np.zeros((32, 32))
        big[:8, 8:16] = np.eye(8)
        big[8:16, :24] = np.hstack([-inverse @ stiffness, -inverse @ damping, inverse])
        big[16:24, 24:] = np.eye(8)
        transition = expm(big * step_size)
        free, of_load, of_end = transition[:16, :16], transition[:16, 16:24], transition[:16, 24:] / step_size
        of_start = of_load - of_end
        for bearing, state in zip(BEARINGS, self.states, strict=True):
            force, k, c = self.law(bearing)
            tangent = np.hstack([k, c])
            begin, end = weight.copy(), weight.copy()
            if bearing == 1:
                begin += self.wheel_force(current_time)
                end += self.wheel_force(current_time + step_size)
            begin[:4] += force - tangent @ state[JOURNAL]
            moved = free @ state + of_start @ begin + of_end @ end
            gain = of_end[:, :4]
            last = np.linalg.solve(np.eye(4) + tangent @ gain[JOURNAL], force - tangent @ moved[JOURNAL])
            self.states[bearing - 1] = moved + gain @ last
        self.publish()
        return True

    def _get_fmu_state(self):
        return {"values": dict(self.values), "states": self.states.tolist(), "init": self.initializing}

    def _set_fmu_state(self, state):
        self.values.update(state["values"])
        self.states = np.array(state["states"])
        self.initializing = state["init"]
