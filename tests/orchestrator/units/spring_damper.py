"""A bearing of the port: F = -k q - c v - k3 |q|^2 q on each translation, k and c also on the tilts.

Its force in x jumps by `spring.jump` where the journal goes over x = 0.

It refuses a step that takes the journal farther than the clearance.
"""

import numpy as np
from port_unit import PortUnit

from fmus import port

_OWN = (
    port.Variable("spring.stiffness", "parameter", start=2e7),
    port.Variable("spring.damping", "parameter", start=2e4),
    port.Variable("spring.cubic", "parameter", start=0.0),
    port.Variable("spring.jump", "parameter", start=0.0),
    port.Variable("refuse_after", "parameter", "s", start=1e9),
    port.Variable("refuse_from", "parameter", "s", start=1e9),
    port.Variable("refuse_to", "parameter", "s", start=1e9),
    port.Variable("refuse_over", "parameter", "s", start=1e9),
    port.Variable("break_after", "parameter", "s", start=1e9),
)


class SpringDamper(PortUnit):
    def __init__(self, **kwargs):
        super().__init__(port.BEARING + _OWN, **kwargs)

    def solve(self):
        p = self.values
        q = np.array(self.read(port.JOURNAL[:4])) - self.read([f"offset.{n}" for n in port.POSITION])
        v = np.array(self.read(port.JOURNAL[4:]))
        k, c, k3 = p["spring.stiffness"], p["spring.damping"], p["spring.cubic"]
        r = np.array([q[0], q[1], 0.0, 0.0])
        force = -k * q - c * v - k3 * (r @ r) * r
        force[0] -= p["spring.jump"] * (q[0] > 0.0)
        stiffness = k * np.eye(4) + k3 * ((r @ r) * np.diag([1.0, 1.0, 0.0, 0.0]) + 2.0 * np.outer(r, r))
        damping = c * np.eye(4)
        absolute = np.array(self.read(port.JOURNAL[:4]))
        self.write(port.FORCE, force)
        self.write(port.F0, force + stiffness @ absolute + damping @ v)
        self.write(port.K, stiffness.ravel())
        self.write(port.C, damping.ravel())
        self.write(["h_min", "h_min_centre"], [p["clearance"] - np.hypot(q[0], q[1])] * 2)
        self.write(["eccentricity"], [np.hypot(q[0], q[1]) / p["clearance"]])

    def do_step(self, current_time, step_size):
        end = current_time + step_size
        self.values["failure"] = port.Failure.NONE
        if end > self.values["break_after"]:
            raise RuntimeError("the spring is broken")
        if end > self.values["refuse_after"]:
            return self.refuse("100% of the travel is used up")
        p = self.values
        if p["refuse_from"] < end <= p["refuse_to"] and step_size > p["refuse_over"]:
            return self.refuse("too long a step")
        self.solve()
        if not self.values["eccentricity"] < 1.0:
            self.values["failure"] = port.Failure.FILM
            return self.refuse("the journal has left its bore")
        return True
