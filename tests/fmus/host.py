"""A host of FMUs for the tests: fmpy's slave with the log kept and access by name."""

import atexit
from ctypes import PyDLL, byref, c_void_p
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    calloc,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    free,
)

DISCARD = 2
_libraries: dict[str, PyDLL] = {}


@atexit.register
def _end_libraries() -> None:
    """Libraries of pythonfmu 0.7 that end later than the interpreter write to freed memory."""
    for library in _libraries.values():
        library.finalizePythonInterpreter.restype = None
        library.finalizePythonInterpreter()


class Host:
    """One FMU file, extracted; `open` makes instances of it."""

    def __init__(self, fmu: Path, folder: Path) -> None:
        self.folder = Path(extract(fmu, str(folder)))
        self.description = read_model_description(str(self.folder))

    def open(self, name: str = "instance") -> "Instance":
        return Instance(self, name)


class Instance:
    """An instance; values are got and set by name."""

    def __init__(self, host: Host, name: str) -> None:
        self.log: list[tuple[int, str]] = []
        description = host.description
        self.variables = {v.name: v for v in description.modelVariables}
        self.slave = FMU2Slave(
            guid=description.guid,
            modelIdentifier=description.coSimulation.modelIdentifier,
            unzipDirectory=str(host.folder),
            instanceName=name,
        )
        library = self.slave.dll._name
        _libraries.setdefault(library, PyDLL(library))
        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = fmi2CallbackLoggerTYPE(self._keep)
        self._callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        self._callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        self.slave.instantiate(callbacks=self._callbacks, loggingOn=True)
        assert isinstance(self.slave.component, (int, c_void_p))

    def _keep(self, environment, name, status, category, message) -> None:
        self.log.append((status, message.decode()))

    @property
    def said(self) -> str:
        return "\n".join(message for _, message in self.log)

    def start(self, values=None, time: float = 0.0) -> "Instance":
        """Set start values and go through Initialization Mode."""
        self.set(values or {})
        self.slave.setupExperiment(startTime=time)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        return self

    def set(self, values) -> None:
        for kind in ("Real", "Integer", "Boolean", "String"):
            chosen = {self.variables[n]: x for n, x in values.items() if self.variables[n].type == kind}
            if chosen:
                setter = getattr(self.slave, f"set{kind}")
                setter([v.valueReference for v in chosen], list(chosen.values()))

    def get(self, *names):
        found = []
        for name in names:
            v = self.variables[name]
            found.append(getattr(self.slave, f"get{v.type}")([v.valueReference])[0])
        return found[0] if len(found) == 1 else found

    def step(self, time: float, step: float) -> bool:
        """Step; False for fmi2Discard, anything worse raises."""
        try:
            self.slave.doStep(time, step)
        except FMICallException as error:
            if error.status != DISCARD:
                raise
            return False
        return True

    def state(self) -> bytes:
        """The FMU state, serialised."""
        return self.serialise(self.keep())

    def keep(self) -> c_void_p:
        """The FMU state, as it is until somebody asks for bytes; give it back with `serialise`."""
        return self.slave.getFMUstate()

    def go_back(self, handle: c_void_p) -> None:
        """Return to a kept state, which stays valid."""
        self.slave.setFMUstate(handle)

    def serialise(self, handle: c_void_p) -> bytes:
        """The bytes of a kept state, which is freed."""
        try:
            return self.slave.serializeFMUstate(handle)
        finally:
            self.slave.fmi2FreeFMUstate(self.slave.component, byref(handle))

    def restore(self, state: bytes) -> None:
        handle = self.slave.deSerializeFMUstate(state)
        self.slave.setFMUstate(handle)
        self.slave.fmi2FreeFMUstate(self.slave.component, byref(handle))

    def close(self) -> None:
        self.slave.terminate()
        self.slave.freeInstance()
