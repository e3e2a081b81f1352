"""The facade of the spring: F = -stiffness x - damping v; the work done on it is hidden state."""

import struct

from fmus.port.failure import FAILURE
from fmus.port.variable import Variable
from fmus.unit.failure import UnitError
from fmus.unit.layout import Layout
from fmus.unit.slave import UnitSlave

VARIABLES = (
    Variable("x", "input", "m", "displacement", 0.001),
    Variable("v", "input", "m/s", "velocity", 0.0),
    Variable(
        "F", "output", "N", "force on the body", depends_on=("x", "v"), starts_on=("x", "v", "stiffness")
    ),
    Variable("work", "output", "J", "work done on the spring since the start"),
    Variable("stiffness", "parameter", "N/m", "stiffness", 1e6, minimum=0.0),
    Variable("damping", "parameter", "N.s/m", "damping", 1e3, minimum=0.0),
    Variable("springs", "parameter", "", "springs in parallel", 1, minimum=1, kind="Integer"),
    Variable("rigid", "parameter", "", "not allowed", False, kind="Boolean"),
    Variable("label", "parameter", "", "a name, 100 % free", "plain", kind="String"),
    Variable("compliance", "calculatedParameter", "", "1 / stiffness", starts_on=("stiffness",)),
    Variable("energy", "output", "J", "energy in the spring", lazy="energy"),
    FAILURE,
)
LAYOUT = Layout(VARIABLES)


class Work(float):
    """The work done so far: a state that is a number."""

    def to_bytes(self):
        return struct.pack("<d", self)

    @classmethod
    def from_bytes(cls, data):
        return cls(*struct.unpack("<d", data))


class SpringSlave(UnitSlave):
    """A spring-damper."""

    model_type = Work

    def __init__(self, gain: float = 1.0, **kwargs):
        super().__init__(LAYOUT, **kwargs)
        self.gain = gain
        self.observed = 0

    def prepare(self):
        stiffness, self.damping, springs, rigid = self.values[4:8]
        if not stiffness > 0.0:
            raise ValueError(f"stiffness = {stiffness} N/m, allowed is > 0 (100 % sure)")
        if rigid:
            raise UnitError("rigid = true is not allowed")
        self.stiffness = self.gain * stiffness * springs
        self.values[LAYOUT["compliance"]] = 1.0 / self.stiffness

    def _force(self):
        x, v = self.inputs
        return -self.stiffness * x - self.damping * v

    def start(self):
        self.work = 0.0
        self.values[2:4] = self._force(), 0.0

    def advance(self, time, step):
        if abs(self.inputs[0]) > 0.1:
            raise UnitError("the spring is torn")
        self.work += -self._force() * self.inputs[1] * step
        self.values[2:4] = self._force(), self.work

    def observe(self, group):
        self.observed += 1
        self.values[LAYOUT["energy"]] = 0.5 * self.stiffness * self.inputs[0] ** 2

    def model_state(self):
        return Work(self.work if hasattr(self, "work") else 0.0)

    def restore_model(self, state):
        self.work = state
