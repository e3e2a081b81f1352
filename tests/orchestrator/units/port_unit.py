"""A unit of the port in plain pythonfmu, as someone else would write one."""

from pythonfmu import Boolean, Fmi2Causality, Fmi2Slave, Fmi2Variability, Integer, Real, String
from pythonfmu.enums import Fmi2Status

_TYPES = {"Real": Real, "Integer": Integer, "Boolean": Boolean, "String": String}


class PortUnit(Fmi2Slave):
    """Registers variables and keeps their values; `solve` fills the outputs in Initialization Mode."""

    def __init__(self, variables, **kwargs):
        super().__init__(**kwargs)
        self.values = {}
        self.initializing = True
        for v in variables:
            neutral = "" if v.kind == "String" else 0.0
            self.values[v.name] = neutral if v.start is None else v.start
            self.register_variable(
                _TYPES[v.kind](
                    v.name,
                    causality=Fmi2Causality[v.causality],
                    getter=lambda name=v.name: self.values[name],
                    setter=lambda value, name=v.name: self.values.__setitem__(name, value),
                    variability=Fmi2Variability[v.variability],
                ),
                nested=False,
            )

    def get_real(self, vrs):
        if self.initializing:
            self.solve()
        return super().get_real(vrs)

    def exit_initialization_mode(self):
        self.solve()
        self.initializing = False

    def read(self, names):
        return [self.values[name] for name in names]

    def write(self, names, values):
        self.values.update(zip(names, (float(v) for v in values), strict=True))

    def refuse(self, reason):
        self.log(reason.replace("%", "%%"), Fmi2Status.discard)
        return False

    def solve(self):
        raise NotImplementedError
