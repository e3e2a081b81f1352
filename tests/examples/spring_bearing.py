"""A bearing of your own: a linear spring and damper with the port of bladeloss' bearings.

Build it with ``pythonfmu build -f spring_bearing.py`` and use it with
``bladeloss run small --depth-at rear=SpringBearing.fmu --trust``.
"""

import numpy as np
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real

POSITION, VELOCITY = ("x", "y", "tilt_x", "tilt_y"), ("v_x", "v_y", "tilt_rate_x", "tilt_rate_y")
WRENCH, AXES = ("Fx", "Fy", "Mx", "My"), range(1, 5)
INPUTS = [f"{body}.{name}" for body in ("journal", "housing") for name in POSITION + VELOCITY] + ["speed"]
OUTPUTS = [f"{what}.{name}" for what in ("wrench", "F0") for name in WRENCH]
OUTPUTS += [f"{matrix}[{i},{j}]" for matrix in "KC" for i in AXES for j in AXES]
OUTPUTS += ["h_min", "h_min_centre", "h_min_z", "p_max", "contact_force"]
OUTPUTS += [f"contact.{name}" for name in WRENCH] + ["friction_power", "eccentricity", "sommerfeld"]
OUTPUTS += ["contact_pressure", "overlap", "wiped", "contact_area", "oil_flow", "oil_temperature"]
PARAMETERS = {"clearance": 1e-3, "stiffness": 5e8, "damping": 5e5} | {
    f"offset.{name}": 0.0 for name in POSITION
}


class SpringBearing(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.values = dict.fromkeys(INPUTS + OUTPUTS, 0.0) | PARAMETERS
        for role, names in (("input", INPUTS), ("output", OUTPUTS), ("parameter", PARAMETERS)):
            kind = {"variability": Fmi2Variability.fixed} if role == "parameter" else {}
            for name in names:
                get, put = (lambda n=name: self.values[n]), (lambda x, n=name: self.values.update({n: x}))
                variable = Real(name, causality=Fmi2Causality[role], getter=get, setter=put, **kind)
                self.register_variable(variable, nested=False)
        self.initializing = True

    def get_real(self, references):  # the start is solved in Initialization Mode: outputs follow the inputs
        if self.initializing:
            self.evaluate()
        return super().get_real(references)

    def exit_initialization_mode(self):
        self.evaluate()
        self.initializing = False

    def do_step(self, current_time, step_size):  # inputs are those at the end of the step
        self.evaluate()
        return True

    def evaluate(self):
        p = self.values
        q, v = (np.array([p[f"journal.{n}"] for n in names]) for names in (POSITION, VELOCITY))
        centre = np.array([p[f"offset.{n}"] for n in POSITION])
        stiffness, damping = p["stiffness"] * np.diag([1, 1, 0, 0]), p["damping"] * np.diag([1, 1, 0, 0])
        force = -stiffness @ (q - centre) - damping @ v  # the wrench on the rotor
        law = np.concatenate([force, force + stiffness @ q + damping @ v, stiffness.ravel(), damping.ravel()])
        p.update(zip(OUTPUTS, law.tolist(), strict=False))
        p["eccentricity"] = float(np.hypot(*(q - centre)[:2])) / p["clearance"]
        p["h_min"] = p["h_min_centre"] = p["clearance"] * (1.0 - p["eccentricity"])
