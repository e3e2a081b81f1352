"""One FMU instance, driven by prepared calls.

Variables that travel every macro step are bound once to numpy arrays (`orchestrator.fmi.block`).
Everything else goes through fmpy.  Any status but OK is an error with the reason that
the unit logged (FMI 2.0.4, sections 2.1.3 and 4.2).
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from typing import Any

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from numpy.typing import NDArray

from orchestrator.errors import FmuError, PortError
from orchestrator.fmi.file import Call, FmuFile
from orchestrator.fmi.unit_error import Status, UnitError, failure_of

__all__ = ["Status", "Unit", "UnitError"]

_KEPT_MESSAGES = 50
_STATUSES = frozenset(Status)
_VALUE_CONVERSION: dict[str, Callable[[Any], Any]] = {
    "Real": float, "Integer": int, "Boolean": bool, "String": str,
}  # fmt: skip


class Unit:
    """An instance of an FMU in co-simulation.

    Parameters
    ----------
    file : FmuFile
        The extracted FMU.
    name : str
        Instance name, used in every message.
    release_gil : bool
        Call the unit's steps without holding Python's lock, for units that step on several threads.

    Attributes
    ----------
    call : list of str or None
        The C function that it is in, for a watchdog on another thread.
    evaluations : int
        Steps that it has begun.

    Raises
    ------
    FmuError
        When the unit cannot be instantiated.
    """

    def __init__(self, file: FmuFile, name: str, *, release_gil: bool = False) -> None:
        self.name = name
        self.file = file
        self.evaluations = 0
        self.call: Call | None = ["fmi2Instantiate"]
        self._messages: list[str] = []
        self._states: dict[int, Any] = {}
        self._initialized = False
        self._worst = Status.OK
        self._callbacks = fmi2CallbackFunctions(
            logger=fmi2CallbackLoggerTYPE(self._log),
            allocateMemory=fmi2CallbackAllocateMemoryTYPE(fmpy.calloc),
            freeMemory=fmi2CallbackFreeMemoryTYPE(fmpy.free),
        )
        description = file.description
        if file.instances and description.coSimulation.canBeInstantiatedOnlyOncePerProcess:
            raise FmuError(
                f"{file.path}: canBeInstantiatedOnlyOncePerProcess, and {name} would be a second instance"
            )
        file.instances.append(self)
        try:
            self._slave = FMU2Slave(
                guid=description.guid,
                modelIdentifier=description.coSimulation.modelIdentifier,
                unzipDirectory=str(file.folder),
                instanceName=name,
            )
            self._slave.instantiate(callbacks=self._callbacks, loggingOn=True)
        except Exception as error:  # fmpy raises bare exceptions here
            file.instances.remove(self)
            reason = "; ".join(self._messages) or str(error)
            raise FmuError(f"{file.path}: cannot be instantiated as {name}: {reason}") from None
        finally:
            self.call = None
        self._library = file.library
        self.component = ctypes.c_void_p(self._slave.component)
        self._do_step = (self._slave.dll if release_gil else self._library)["fmi2DoStep"]
        self._do_step.restype = ctypes.c_int
        self._do_step.argtypes = [ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_int]

    def _log(self, _environment: int, _name: bytes, _status: int, _category: bytes, message: bytes) -> None:
        text = (message or b"").decode("utf-8", errors="replace").replace("%%", "%").strip()
        if text:
            self._messages.append(text)
            del self._messages[:-_KEPT_MESSAGES]

    @property
    def messages(self) -> tuple[str, ...]:
        """The last messages that the unit logged."""
        return tuple(self._messages)

    @property
    def reason(self) -> str:
        """The last message, for what went wrong."""
        return self._messages[-1] if self._messages else "no reason logged"

    @property
    def failed(self) -> bool:
        """Whether a call ended with an error after which nothing more may be asked of the unit."""
        return self._worst >= Status.ERROR

    def variable(self, name: str) -> Any:
        """Return the description of a variable.

        Raises
        ------
        PortError
            When the unit has none of this name.
        """
        try:
            return self.file.variables[name]
        except KeyError:
            raise PortError(f"{self.file.path}: {self.name} has no variable {name!r}") from None

    def prepare(self, function: str, arguments: tuple[Any, ...], memory: object) -> Callable[[], None]:
        """Bind a C function to fixed arguments; the call raises `UnitError` unless it ends with OK.

        The call keeps `memory`, to which the arguments point, alive.
        """
        call = self._library[function]
        call.restype = ctypes.c_int

        def run(_alive: object = memory) -> None:
            self.call = [function]
            try:
                status = call(*arguments)
            finally:
                self.call = None
            if status:
                self._fail(function, status)

        return run

    def _fail(self, function: str, status: int) -> None:
        code = Status(status) if status in _STATUSES else Status.FATAL  # whatever the unit means by it
        self._worst = max(self._worst, code)
        reason = self._messages[-1] if self._messages else ""  # before the next call logs another
        said = failure_of(self.file.variables, self._slave) if code is Status.DISCARD else 0
        raise UnitError(self.name, function, code, reason, said)

    def _call(self, method: str, *arguments: Any) -> Any:
        self.call = [f"fmi2{method[0].upper()}{method[1:]}"]
        try:
            status = getattr(self._slave, method)(*arguments)
        except FMICallException as error:
            self._fail(error.function, error.status)
        finally:
            self.call = None
        if isinstance(status, int) and status:
            self._fail(method, status)
        return status

    def set_parameters(self, values: dict[str, float | int | bool | str]) -> None:
        """Set parameters by name, each converted to the variable's own type."""
        for name, value in values.items():
            variable = self.variable(name)
            converted = _VALUE_CONVERSION[variable.type](value)
            self._call(f"set{variable.type}", [variable.valueReference], [converted])

    def get_string(self, name: str) -> str:
        """Get a String variable by name."""
        (text,) = self._call("getString", [self.variable(name).valueReference])
        return text.decode() if isinstance(text, bytes) else str(text)

    def get_real(self, names: Sequence[str]) -> NDArray[np.float64]:
        """Get Real variables by name."""
        return np.array(self._call("getReal", self._references(names)))

    def set_real(self, names: Sequence[str], values: NDArray[np.float64]) -> None:
        """Set Real variables by name."""
        self._call("setReal", self._references(names), np.ravel(values).tolist())

    def _references(self, names: Sequence[str]) -> list[int]:
        return [self.variable(name).valueReference for name in names]

    def enter_initialization(self, start: float = 0.0, stop: float | None = None) -> None:
        """Set up the experiment and enter Initialization Mode."""
        self._call("setupExperiment", None, start, stop)
        self._call("enterInitializationMode")

    def exit_initialization(self) -> None:
        """Leave Initialization Mode: the state is frozen, steps may follow.

        Raises
        ------
        UnitError
            When there is no start.  A unit that says so by its output `failure` is asked before, for in
            its status pythonfmu knows nothing less than fatal, after which it may not be asked.
        """
        if said := failure_of(self.file.variables, self._slave):
            raise UnitError(self.name, "start", Status.DISCARD, self.reason, said)
        self._call("exitInitializationMode")
        self._initialized = True

    def do_step(self, time: float, step: float) -> None:
        """Carry out one macro step.

        Raises
        ------
        UnitError
            When the unit does not accept the step.
        """
        self.evaluations += 1
        self.call = ["fmi2DoStep"]
        try:
            status = self._do_step(self.component, time, step, 0)
        finally:
            self.call = None
        if status:
            self._fail("fmi2DoStep", status)

    def get_state(self) -> Any:
        """Return a handle of the complete state; give it back with `free_state`."""
        state = self._call("getFMUstate")
        self._states[state.value] = state
        return state

    def set_state(self, state: Any) -> None:
        """Return to a state, which stays valid."""
        self._call("setFMUstate", state)

    def free_state(self, state: Any) -> None:
        """Free a state."""
        self._states.pop(state.value, None)
        self._call("freeFMUstate", state)

    def serialize(self, state: Any) -> bytes:
        """Return the bytes of a state."""
        return bytes(self._call("serializeFMUstate", state))

    def deserialize(self, data: bytes) -> Any:
        """Return a state from its bytes; give it back with `free_state`."""
        state = self._call("deSerializeFMUstate", data)
        self._states[state.value] = state
        return state

    def state_bytes(self) -> bytes:
        """Return the bytes of the present state."""
        state = self.get_state()
        try:
            return self.serialize(state)
        finally:
            self.free_state(state)

    def resume(self, data: bytes) -> None:
        """Go on from the bytes of a state after initialization, from Initialization Mode on."""
        state = self.deserialize(data)
        self.set_state(state)
        self.free_state(state)
        self._initialized = True

    def close(self) -> None:
        """Free states and instance; after a fatal error the unit is left alone, as FMI demands."""
        if self._slave.component is None:
            return
        if self._worst < Status.ERROR:
            for state in list(self._states.values()):
                self.free_state(state)
            if self._initialized:
                self._call("terminate")
        if self._worst < Status.FATAL:
            self.call = ["fmi2FreeInstance"]
            self._slave.freeInstance()
            self.file.instances.remove(self)
            self.call = None
        self._slave.component = None
