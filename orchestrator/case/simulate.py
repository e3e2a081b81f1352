"""From a case to a record: units loaded, a start found, the time loop, the record."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

import numpy as np
import xarray as xr

from orchestrator.case.case import Case, folder_case
from orchestrator.case.course import course_of
from orchestrator.case.progress import Progress, Stage
from orchestrator.case.record_so_far import RecordSoFar
from orchestrator.errors import EquilibriumError
from orchestrator.fmi.blas import one_blas_thread
from orchestrator.fmi.unit import UnitError
from orchestrator.fmi.watchdog import Watchdog
from orchestrator.master.assembly import join
from orchestrator.master.coupling import make_scheme
from orchestrator.master.journal_in_words import with_state
from orchestrator.master.observer import Observer
from orchestrator.master.start.equilibrium import Start, begin
from orchestrator.master.start.heat import as_it_runs
from orchestrator.master.start.journal_position import evaluate
from orchestrator.master.stepping import Stepper
from orchestrator.master.system import System
from orchestrator.master.time_loop import RunEnd, run
from orchestrator.observers.between import WORDS, Bores
from orchestrator.observers.checkpoint import Checkpoint, Checkpoints, Keeper, Saver
from orchestrator.observers.happenings import Happenings
from orchestrator.observers.ledger import Ledger
from orchestrator.observers.recorder import Recorder
from orchestrator.observers.revolutions import Revolutions
from orchestrator.outcome import Outcome
from orchestrator.results.least_damped import least_damped_attributes
from orchestrator.results.ledger import with_ledger
from orchestrator.results.record import empty_record, loss_attributes, make_record, outcome_attributes
from orchestrator.results.result import Result, Stopwatch, Timing
from orchestrator.results.revolutions import with_revolutions
from orchestrator.results.validity import judge
from orchestrator.scenario.file import train_of
from orchestrator.scenario.scenario import Scenario
from orchestrator.scenario.schedule import schedule_of, turned
from rotor_fmu.train.train import Train

_LEAST_LOAD = 1.0
"""In N, by which forces are measured at least where bearings carry nothing at the start."""
_REDUCTION = "reduction.used"


@dataclass(frozen=True)
class Execution:
    """How a run is carried out, without influence on its numbers.

    Attributes
    ----------
    checkpoints : Checkpoints or None
        Writes the run to disk as it goes.
    resume : Checkpoint or None
        Where to go on instead of at the start.
    threads : int
        On which the bearings step.
    watchdog : Watchdog
        Ends the run when a unit hangs; asleep by itself, and of one run.
    record : Path or None
        Folder to which a long record goes as it grows, where there are no checkpoints; it is read from there,
        and the caller removes it. None: it stays in memory.
    warn : callable
        Told when that cannot be written.
    """

    checkpoints: Checkpoints | None = None
    resume: Checkpoint | None = None
    threads: int = 1
    watchdog: Watchdog[Result] = field(default_factory=Watchdog)
    record: Path | None = None
    warn: Callable[[str], None] = print

    @property
    def growing(self) -> Path | None:
        """Folder of the record that grows."""
        if self.checkpoints is not None:
            return self.checkpoints.folder
        return self.record if self.resume is None else self.resume.path.parent


def simulate(
    scenario: Scenario, fmus: Path, progress: Progress | None = None, execution: Execution | None = None
) -> Result:
    """Run a scenario on the FMUs in a folder, see `execute`."""
    with folder_case(scenario, train_of(scenario), fmus) as case:
        return execute(case, progress, execution)


def execute(case: Case, progress: Progress | None = None, execution: Execution | None = None) -> Result:
    """Run a case.

    Parameters
    ----------
    case : Case
        From `orchestrator.case.case` or `orchestrator.case.prepare`.
    progress : callable, optional
        See `Progress`.
    execution : Execution, optional
        Checkpoints and the like.

    Returns
    -------
    Result
        Also for a run that fails on its way.

    Raises
    ------
    FmuError, PortError, SspError
        When an FMU is missing, cannot be instantiated, lacks the port or does not take its parameters.
    CheckpointError
        When a checkpoint to go on from belongs to other FMUs.
    """
    announce = progress or (lambda _stage, _time: None)
    execution = execution or Execution()
    watchdog, store = execution.watchdog, case.units.store
    watchdog.partial = partial(_failed_start, case, Outcome.UNIT_HUNG)
    watchdog.units, watchdog.remove = store.instances, store.remove
    clock = Stopwatch()
    with one_blas_thread():
        announce(Stage.LOAD, 0.0)
        parts = case.units.parts(case.scenario)
        system = join(parts, case.scenario, case.units.speed, case.units.place, execution.threads)
        try:
            result = _carry_out(case, system, clock, announce, execution)
        finally:
            system.close()
    return replace(result, record=result.record.assign_attrs(case.attributes))


def _carry_out(
    case: Case, system: System, clock: Stopwatch, announce: Progress, execution: Execution
) -> Result:
    """Run an assembled system from its start, or from a checkpoint, to its end."""
    announce(Stage.WARM_UP, 0.0)
    _warm_up(system, case.train)
    load = clock.lap()
    announce(Stage.EQUILIBRIUM, 0.0)
    try:
        if execution.resume is None:
            start = begin(system, case.units.find_start(system), case.train.nodes)
        else:
            execution.resume.restore_units(system)
            start = execution.resume.start()
    except (EquilibriumError, UnitError) as error:
        assert error.outcome is not None
        return _failed_start(case, error.outcome, f"at the start: {error}", Timing(load, clock.lap()))
    loop = _TimeLoop(case, system, start)
    announce(Stage.RUN, 0.0)
    loop.timing = Timing(load, clock.lap())
    return loop.run(announce, execution)


def _failed_start(case: Case, outcome: Outcome, message: str, timing: Timing | None = None) -> Result:
    """Return the result of a run that came to no start."""
    record = empty_record(case.scenario, case.train, outcome, message)
    return Result(record, outcome, message, timing or Timing(), 0, 0)


def _warm_up(system: System, train: Train) -> None:
    """Let every unit compute once, so that reductions and compilations count as loading."""
    positions = np.zeros((len(train.bearings), 4))
    positions[:, 1] = [-0.5 * seat.clearance for seat in train.bearings]
    evaluate(system, positions)
    system.rotor_group.fetch()


class _TimeLoop:
    """A system that stands at its start, with all that watches it."""

    def __init__(self, case: Case, system: System, start: Start) -> None:
        self._case, self._system, self._start, self.timing = case, system, start, Timing()
        self._so_far: RecordSoFar | None = None
        self._train = as_it_runs(case.train, system)
        scenario, train = case.scenario, case.train
        self._schedule = schedule_of(scenario, train)
        self._course, stride = course_of(scenario, train)
        seats = train.bearings
        bores = Bores((seat.clearance for seat in seats), (seat.width for seat in seats), start.offsets)
        self._recorder = Recorder(system, train.nodes, self._course.steps, stride, bores)
        load = float(np.abs(start.loads).mean()) or _LEAST_LOAD
        system.set_scale(load, [seat.width for seat in train.bearings])
        self._ledger = Ledger(system) if scenario.ledger else None
        self._keepers: dict[str, Keeper] = {"record": self._recorder}
        self._observers: list[Observer] = [self._recorder]
        if self._ledger is not None:
            self._keepers["ledger"] = self._ledger
            self._observers.append(self._ledger)
        self._happenings = Happenings(system, scenario.events, start.static, bores)
        if scenario.turns:
            self._keepers["happenings"] = self._happenings
            self._observers.append(self._happenings)
        self._revolutions = Revolutions(system) if scenario.keeps_revolutions else None
        if self._revolutions is not None:
            self._keepers["revolutions"] = self._revolutions
            self._observers.append(self._revolutions)
        self._provenance = {unit.file.path.name: str(unit.file.description.guid) for unit in system.units}
        self._least_damped = least_damped_attributes(train, case.units.speed, start.tangents)
        told = _REDUCTION in system.rotor.file.variables
        self._reduction = system.rotor.get_string(_REDUCTION) if told else ""

    def run(self, announce: Progress, execution: Execution) -> Result:
        """Carry it to its end."""
        scenario, system, watchdog = self._case.scenario, self._system, execution.watchdog
        resume, observers, checkpoints = execution.resume, list(self._observers), execution.checkpoints
        if execution.growing is not None:
            kept = self._recorder, self._revolutions
            self._so_far = RecordSoFar(execution.growing, *kept, self._record_so_far, execution.warn)
            observers.append(self._so_far)
        if checkpoints is not None and self._so_far is not None:
            checkpoints.beside = self._so_far.write
            observers.append(Saver(checkpoints, system, self._start, self._keepers))

        def on_time(time: float) -> None:
            watchdog.beat(time)
            announce(Stage.RUN, time)

        def go_on(stepper: Stepper) -> int:
            assert resume is not None
            step = resume.restore_run(stepper, self._keepers, self._course)
            if self._so_far is not None:
                self._so_far.go_on(resume.path)
            return step

        watchdog.partial, watchdog.patience = self._hung, 1.0
        before = [(group.step_time, group.exchange_time) for group in system.groups]
        end = run(
            system,
            make_scheme(scenario.coupling, self._course.tolerance),
            observers,
            self._course,
            on_time=on_time,
            resume=None if resume is None else go_on,
        )
        spent = [
            (group.step_time - step, group.exchange_time - exchange)
            for group, (step, exchange) in zip(system.groups, before, strict=True)
        ]
        return self._result(end, spent)

    def _result(self, end: RunEnd, spent: list[tuple[float, float]]) -> Result:
        """Make the result of a loop whose groups spent these times in steps and in exchange."""
        (rotor, rotor_exchange), (film, film_exchange) = spent
        fmi = rotor_exchange + film_exchange
        rest = end.wall_time - film - rotor - fmi - end.record_time
        timing = replace(self.timing, film=film, rotor=rotor, fmi=fmi, record=end.record_time, master=rest)
        outcome, message = end.outcome, with_state(end, self._system, self._start.offsets)
        record = self._record(outcome, message)
        if outcome.ok:
            outcome, message = judge(record, self._case.train)
            record = record.assign_attrs(outcome_attributes(outcome, message))
        evaluations = self._system.bearing_group.evaluations
        record = record.assign_attrs(end.counts.attributes(evaluations))
        if self._ledger is not None and not self._system.rotor.failed:
            record = with_ledger(record, self._ledger.balance())
        return Result(record, outcome, message, timing, end.counts.accepted, evaluations, end.counts)

    def _hung(self, message: str) -> Result:
        """Make the result of a loop that hangs in a unit."""
        record = self._record(Outcome.UNIT_HUNG, message)
        return Result(
            record, Outcome.UNIT_HUNG, message, self.timing, 0, self._system.bearing_group.evaluations
        )

    def _record(self, outcome: Outcome, message: str) -> xr.Dataset:
        """The whole record; of what grew on disk its series are read when they are used."""
        if self._so_far is not None:
            self._so_far.finish()
        held = self._held(self._recorder.copy(), outcome, message)  # a time loop that hung may yet go on
        return held if self._so_far is None else self._so_far.joined(held)

    def _record_so_far(self) -> xr.Dataset:
        return self._held(self._recorder, Outcome.INTERRUPTED, "")

    def _held(self, recorder: Recorder, outcome: Outcome, message: str) -> xr.Dataset:
        """The record of the rows that are in memory."""
        case = self._case
        record = make_record(
            recorder, self._start, case.scenario, self._train, outcome, message, self._provenance
        )
        record = record.assign_attrs(self._least_damped)
        if case.scenario.turns:
            series = self._so_far.series if self._so_far is not None else lambda _, held: held
            times = series("time", recorder.times)
            speeds = series("rotation_speed", recorder.speeds)
            ran = turned(self._schedule, times, speeds, self._happenings.happened)
            record = record.assign_attrs(ran.attributes() | loss_attributes(ran))
        if self._recorder.between:
            record = record.assign_attrs(between_evaluations=self._recorder.between, between_how=WORDS)
        if self._revolutions is not None:
            record = with_revolutions(record, self._revolutions)
        return record.assign_attrs({"reduction_used": self._reduction} if self._reduction else {})
