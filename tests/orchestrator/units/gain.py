"""The part of the loop without a state: u = E y."""

from loop_matrices import E
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Gain(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        for k in range(3):
            setattr(self, f"y{k}", 0.0)
            setattr(self, f"u{k}", 0.0)
            self.register_variable(Real(f"y{k}", causality=Fmi2Causality.input))
            self.register_variable(Real(f"u{k}", causality=Fmi2Causality.output))

    def exit_initialization_mode(self):
        self.do_step(0.0, 0.0)

    def do_step(self, current_time, step_size):
        self.u0, self.u1, self.u2 = (float(value) for value in E @ [self.y0, self.y1, self.y2])
        return True
