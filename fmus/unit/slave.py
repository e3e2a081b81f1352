"""Base of the facades: a unit of the port as an FMI 2.0 co-simulation slave.

A facade maps values to physics; everything FMI asks for beyond that is here:
value references, modes, the complete FMU state, refusal of bad input.

Modes
-----
Until the end of Initialization Mode outputs follow the inputs and parameters:
they are computed on get after a set.  From then on they change in ``do_step`` only.

Failure
-------
A failed step is ``fmi2Discard`` with the reason in the log; it leaves the unit as it was
and may be repeated with other inputs or a smaller step.  A bad parameter or a failed
start is logged and kept: the outputs are NaN until it is corrected.  An initialization
that ends without a start, and a call that FMI forbids, raise `fmus.unit.loader.Refusal`:
pythonfmu makes ``fmi2Fatal`` of it.  Whoever goes on all the same finds every ``do_step``
refused.  The output `failure` says of which kind the failure is.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, ClassVar

from pythonfmu import Fmi2Slave
from pythonfmu.enums import Fmi2Status

from fmus.port.failure import FAILURE, Failure
from fmus.port.variable import Kind
from fmus.unit.failure import UnitError, attempt, problem_of
from fmus.unit.hooks import Hooks
from fmus.unit.layout import Layout
from fmus.unit.loader import Refusal, for_log
from fmus.unit.state import UnitState, unpack
from fmus.unit.values import Values

INSTANTIATED, INITIALIZATION, STEP, TERMINATED = range(4)  # modes, FMI 2.0, section 4.2.4


class UnitSlave(Hooks, Fmi2Slave):
    """A unit of the port; facades fill in the hooks.

    Parameters
    ----------
    layout : Layout
        The variables of the unit.
    **kwargs
        What pythonfmu passes: instance_name, resources, visible, logger.
    """

    digest: ClassVar[bytes] = bytes(16)  # of the FMU; the entry script sets it

    def __init__(self, layout: Layout, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.layout = layout
        self._values = Values(layout)
        self.values = self._values.numbers
        self.inputs = self.values[layout.inputs]
        self.strings = self._values.strings
        self._code = layout[FAILURE.name]
        self.start_time = 0.0
        self._mode = INSTANTIATED
        self._prepared_for: tuple[bytes, ...] | None = None  # the parameters of the model at hand
        self._unsolved = True  # something was set since `start` last ran
        self._stale = self._all_lazy = (1 << len(layout.lazy)) - 1
        """A bit for each group of lazy variables that does not belong to the present state."""
        self._tuned = False  # a parameter was changed since the last step
        self._failure = ""  # of the start
        self._misuse = ""  # a call that FMI forbids

    # -- life cycle ----------------------------------------------------------

    def setup_experiment(
        self, start_time: float, stop_time: float | None = None, tolerance: float | None = None
    ) -> None:
        """Take the start time."""
        self.start_time = float(start_time)
        self._unsolved = True

    def enter_initialization_mode(self) -> None:
        """Begin the initialization."""
        self._mode = INITIALIZATION

    def exit_initialization_mode(self) -> None:
        """Freeze the start: from here on outputs change in `do_step` only."""
        self._solve()
        self._mode = STEP
        if self._failure:
            self.log_queue.clear()  # it says the same
            raise Refusal(f"initialization ended without a start: {self._failure}", self)

    def terminate(self) -> None:
        """End the simulation."""
        self._mode = TERMINATED

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Advance the unit; False (fmi2Discard) with the reason in the log if it cannot."""
        try:
            self._get_ready(current_time, step_size)
            self.advance(current_time, step_size)
        except Exception as error:  # any: pythonfmu would make fmi2Fatal of it
            code, reason = problem_of(error, Failure.STEP)
            self._values.put(self._code, code)
            self._report(f"step from t = {current_time} s by {step_size} s refused: {reason}")
            return False
        self._values.put(self._code, Failure.NONE)
        return True

    def _get_ready(self, time: float, step: float) -> None:
        """Refuse a step that cannot be taken, and take on what was tuned."""
        if self._misuse:
            raise UnitError(self._misuse, Failure.CALL)
        if self._failure:
            raise UnitError(self._failure, Failure(int(self.values[self._code])))
        if self._mode != STEP:
            text = "a step is due between the end of initialization and termination only"
            raise UnitError(text, Failure.CALL)
        self._stale = self._all_lazy
        if not (0.0 < step < math.inf and math.isfinite(time)):
            raise UnitError("the step must be positive and finite", Failure.CALL)
        self._values.check_inputs(self.inputs)
        if self._tuned:
            self._retune()

    def _retune(self) -> None:
        """Make the model of the parameters as they are now, in the state in which it stands."""
        model = self.model_state()
        self._prepare_if_changed()
        if model is not None:
            self.restore_model(model)
        self._tuned = False

    def _solve(self) -> None:
        """Prepare and start where something was set since; the reason of a failure is kept."""
        if not self._unsolved:
            return
        code, self._failure = attempt(Failure.PARAMETER, self._initialize)
        self._unsolved = False
        self._stale = self._all_lazy
        if self._failure:
            self._report(f"no start: {self._failure}", Fmi2Status.warning)
            self.values[self.layout.outputs] = math.nan
            if self._prepared_for is None:
                self.values[list(self.layout.computed)] = math.nan
        self._values.put(self._code, code)

    def _initialize(self) -> None:
        self._values.check_inputs(self.inputs[: self.starts_on()])
        for i in self.layout.settable["Real"]:
            if math.isnan(self.values[i]):
                raise UnitError(f"parameter {self.layout.variables[i].name} is not a number")
        self._prepare_if_changed()
        self.start()

    def _prepare_if_changed(self) -> None:
        if self._values.parameters() != self._prepared_for:
            self._prepared_for = None
            self.prepare()
            self._prepared_for = self._values.parameters()

    # -- values --------------------------------------------------------------

    def get_real(self, vrs: list[int]) -> list[float]:
        """Return values, computed first where that is due."""
        block = self._values.block(vrs)
        if self._stale or self._unsolved:
            self._update(vrs, block)
        try:
            return self._values.read(vrs, block)
        except IndexError:
            raise self._unknown(vrs) from None

    def get_integer(self, vrs: list[int]) -> list[int]:
        """Return Integer values."""
        return [int(value) if math.isfinite(value) else 0 for value in self.get_real(vrs)]

    def get_boolean(self, vrs: list[int]) -> list[bool]:
        """Return Boolean values."""
        return [value != 0.0 for value in self.get_real(vrs)]

    def get_string(self, vrs: list[int]) -> list[str]:
        """Return String values, computed first where that is due."""
        self._update(vrs, None)
        try:
            return [self.strings[i] for i in vrs]
        except KeyError:
            raise self._unknown(vrs) from None

    def set_real(self, vrs: list[int], values: Sequence[float]) -> None:
        """Set inputs, and parameters before the end of initialization, behind it those that are tunable."""
        block = self._values.block(vrs)
        if self._mode != STEP or block is None or block.stop > self.layout.inputs.stop:
            self._check_settable(vrs, "Real")
        self._values.write(vrs, values, block)

    def set_integer(self, vrs: list[int], values: Sequence[int]) -> None:
        """Set Integer parameters."""
        self._write("Integer", vrs, values)

    def set_boolean(self, vrs: list[int], values: Sequence[bool]) -> None:
        """Set Boolean parameters."""
        self._write("Boolean", vrs, values)

    def set_string(self, vrs: list[int], values: Sequence[str]) -> None:
        """Set String parameters."""
        self._check_settable(vrs, "String")
        self.strings.update(zip(vrs, values, strict=True))

    def _write(self, kind: Kind, vrs: list[int], values: Sequence[float]) -> None:
        self._check_settable(vrs, kind)
        self._values.write(vrs, values, self._values.block(vrs))

    def _check_settable(self, vrs: list[int], kind: Kind) -> None:
        """Refuse what FMI does not allow to be set now."""
        if self._mode == STEP:
            allowed = kind == "Real" and max(vrs, default=-1) < self.layout.inputs.stop
            if not allowed and kind == "Real" and self.layout.tunable.issuperset(vrs):
                allowed = self._tuned = True
        else:
            allowed = self.layout.settable[kind].issuperset(vrs)
            self._unsolved = True
        if not allowed:
            names = [v.name for i, v in enumerate(self.layout.variables) if i in set(vrs)]
            when = "after initialization" if self._mode == STEP else "at all, or not with this type"
            raise self._forbidden(f"{', '.join(names[:3]) or vrs} cannot be set {when}")

    def _update(self, vrs: list[int], block: slice | None) -> None:
        if self._mode < STEP and self._unsolved and not self.layout.computed.isdisjoint(vrs):
            self._solve()
        if block is not None and block.stop <= self.layout.first_lazy:
            return  # at a glance, for it is asked at every step
        for i, (group, members) in enumerate(self.layout.lazy.items()):
            first, last = self.layout.lazy_span[group]
            if block is not None and (block.stop <= first or last < block.start):
                continue
            if self._stale >> i & 1 and not members.isdisjoint(vrs):
                reason = self._failure or attempt(Failure.STEP, self.observe, group).reason
                if reason:
                    self.values[list(members)] = math.nan
                    self._report(f"{group} not computed: {reason}", Fmi2Status.warning)
                self._stale &= ~(1 << i)

    # -- state ---------------------------------------------------------------

    def _get_fmu_state(self) -> UnitState:
        """Return the whole unit: values, texts, model, and where it stands."""
        # parameters cannot change in the step mode
        known = self._prepared_for
        prepared = known is not None and (self._mode == STEP or known == self._values.parameters())
        texts = [self._failure, self._misuse, *self.strings.values()]
        model = self.model_state() if prepared else None
        numbers = self._values.pack()
        where = self._mode, prepared, self._unsolved, self._stale, self.start_time
        return UnitState(*where, numbers, texts, model)

    def _set_fmu_state(self, state: UnitState | bytes) -> None:
        reason = attempt(Failure.CALL, self._restore, state).reason
        if reason:
            self._misuse = reason
            self._report(reason, Fmi2Status.error)

    def _restore(self, state: UnitState | bytes) -> None:
        if isinstance(state, bytes):
            state = unpack(state, self.digest, 2 + len(self.strings), self.model_type)
        self._values.unpack(state.values)
        self._failure, self._misuse, *strings = state.texts
        self.strings.update(zip(self.strings, strings, strict=True))
        if state.prepared:
            self._prepare_if_changed()
        else:
            self._prepared_for = None
        if state.model is not None:
            self.restore_model(state.model)
        self._mode, self._unsolved, self.start_time = state.mode, state.unsolved, state.start_time
        self._stale = state.stale

    @classmethod
    def _fmu_state_to_bytes(cls, state: UnitState | bytes) -> bytes:  # pythonfmu asks the class
        return state if isinstance(state, bytes) else state.pack(cls.digest)

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> bytes:
        return state  # unpacked where it is restored, where a problem can be reported

    def _forbidden(self, reason: str) -> Refusal:
        """Return the refusal of a call that FMI forbids, after which no step will follow."""
        self._misuse = self._misuse or reason
        return Refusal(reason, self)

    def _unknown(self, vrs: list[int]) -> Refusal:
        return self._forbidden(f"a value reference among {vrs} is unknown")

    def _report(self, message: str, status: Fmi2Status = Fmi2Status.discard) -> None:
        self.log(for_log(self, message), status)
