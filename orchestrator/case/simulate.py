"""From a scenario and a folder of FMUs to a record: the entry point of command line and tests."""

from __future__ import annotations

import os
from collections.abc import Callable
from copy import copy
from functools import partial
from pathlib import Path

import numpy as np

from orchestrator.errors import EquilibriumError
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.unit import UnitError
from orchestrator.master.assembly import assemble
from orchestrator.master.coupling import SCHEMES, make_scheme
from orchestrator.master.journal_in_words import with_state
from orchestrator.master.observer import Observer
from orchestrator.master.start.equilibrium import Start, begin, find_start
from orchestrator.master.start.journal_position import evaluate
from orchestrator.master.system import System
from orchestrator.master.time_loop import Course, run
from orchestrator.observers.checkpoint import Keeper, Saver
from orchestrator.observers.ledger import Ledger
from orchestrator.observers.recorder import Recorder
from orchestrator.outcome import Outcome
from orchestrator.results.ledger import with_ledger
from orchestrator.results.record import empty_record, make_record, outcome_attributes
from orchestrator.results.result import Execution, Progress, Result, Stage, Stopwatch, Timing
from orchestrator.results.validity import unresolved
from orchestrator.scenario.file import train_of
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.train.train import Train

__all__ = ["Execution", "Progress", "Result", "Stage", "Stopwatch", "Timing", "carry_out", "simulate"]

_NO_TIME = Timing(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)

QUICK_DEPTHS = ("v2", "v3")
"""Films of some microseconds, which threads would only delay."""

WORTH_A_THREAD = 4
"""Bearings with a slow film from which a second thread gains more than its handing over costs."""


def simulate(
    scenario: Scenario, fmus: Path, progress: Progress | None = None, execution: Execution | None = None
) -> Result:
    """Run a scenario on FMUs.

    Parameters
    ----------
    scenario : Scenario
        From `orchestrator.scenario.file.load_scenario`.
    fmus : Path
        Folder with the rotor FMU of the scenario's train and the bearing FMUs of its depths.
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
    FmuError
        When an FMU is missing or cannot be instantiated.
    PortError
        When an FMU does not carry the port.
    CheckpointError
        When a checkpoint to go on from belongs to other FMUs.
    """
    announce = progress or (lambda _stage, _time: None)
    execution = execution or Execution()  # one a run: its watchdog holds on to what the run uses
    train = train_of(scenario)
    clock = Stopwatch()
    with FmuStore() as store:
        execution.watchdog.partial = partial(failed_start, scenario, train, Outcome.UNIT_HUNG)
        execution.watchdog.leftovers.append(store.remove)
        announce(Stage.LOAD, 0.0)
        system = assemble(scenario, train, fmus, store, execution.threads)
        try:
            return carry_out(
                scenario,
                train,
                system,
                lambda: find_start(system, train.bearings, train.speed, train.nodes),
                clock,
                announce,
                execution,
            )
        finally:
            system.close()


def default_threads(scenario: Scenario, train: Train) -> int:
    """Two threads where the films take long enough for it to pay, and there are processors; else one."""
    slow = sum(scenario.depth_of(seat.name) not in QUICK_DEPTHS for seat in train.bearings)
    return 2 if slow >= WORTH_A_THREAD and (os.cpu_count() or 1) > 1 else 1


def carry_out(
    scenario: Scenario,
    train: Train,
    system: System,
    find: Callable[[], Start],
    clock: Stopwatch,
    announce: Progress,
    execution: Execution,
) -> Result:
    """Run an assembled system.

    Parameters
    ----------
    scenario, train : Scenario, Train
        What is run, and how it is coupled and recorded.
    system : System
        In Initialization Mode, parameters set.
    find : callable
        Returns the start of the run.
    clock : Stopwatch
        Started before the units were loaded.
    announce : callable
        See `Progress`.
    execution : Execution
        Checkpoints and the like.
    """
    announce(Stage.WARM_UP, 0.0)
    _warm_up(system, train)
    load = clock.lap()
    announce(Stage.EQUILIBRIUM, 0.0)
    resume, checkpoints = execution.resume, execution.checkpoints
    try:
        if resume is None:
            start = begin(system, find(), train.nodes)
        else:
            resume.restore_units(system)
            start = resume.start()
    except (EquilibriumError, UnitError) as error:
        outcome = error.outcome if isinstance(error, UnitError) else Outcome.NO_EQUILIBRIUM
        timing = Timing(load, clock.lap(), 0.0, 0.0, 0.0, 0.0, 0.0)
        return failed_start(scenario, train, outcome, f"at the start: {error}", timing)
    equilibrium = clock.lap()
    announce(Stage.RUN, 0.0)
    course = _course(scenario)
    stride = max(1, round(scenario.record.interval / scenario.step))
    recorder = Recorder(system, train.nodes, course.steps, stride)
    loads = np.abs(start.loads)
    system.set_scale(float(loads.mean()), [seat.width for seat in train.bearings])
    ledger = Ledger(system) if scenario.ledger else None
    keepers: dict[str, Keeper] = {"record": recorder, **({} if ledger is None else {"ledger": ledger})}
    observers: list[Observer] = [recorder, *([] if ledger is None else [ledger])]
    observers += [] if checkpoints is None else [Saver(checkpoints, system, start, keepers)]

    def on_time(time: float) -> None:
        watchdog.beat(time)
        announce(Stage.RUN, time)

    def hung(message: str) -> Result:
        kept = copy(recorder)  # its size stays as it is, whatever the time loop does
        record = make_record(kept, start, scenario, train, Outcome.UNIT_HUNG, message, provenance)
        timing = Timing(load, equilibrium, 0.0, 0.0, 0.0, 0.0, clock.lap())
        return Result(record, Outcome.UNIT_HUNG, message, timing, 0, system.bearing_group.evaluations)

    provenance = {unit.file.path.name: str(unit.file.description.guid) for unit in system.units}
    watchdog = execution.watchdog
    watchdog.partial, watchdog.patience = hung, 1.0
    before = [(group.step_time, group.exchange_time) for group in system.groups]
    end = run(
        system,
        make_scheme(scenario.coupling, scenario.tolerance),
        observers,
        course,
        on_time=on_time,
        resume=None if resume is None else lambda stepper: resume.restore_run(stepper, keepers),
    )
    (rotor, rotor_exchange), (film, film_exchange) = (
        (group.step_time - earlier[0], group.exchange_time - earlier[1])
        for group, earlier in zip(system.groups, before, strict=True)
    )
    fmi = rotor_exchange + film_exchange
    rest = end.wall_time - film - rotor - fmi - end.record_time
    outcome, message = end.outcome, with_state(end, system, start.offsets)
    record = make_record(recorder, start, scenario, train, outcome, message, provenance)
    if outcome.ok and (message := unresolved(record)):
        outcome = Outcome.UNRESOLVED
        record = record.assign_attrs(outcome_attributes(outcome, message))
    record = record.assign_attrs(end.counts.attributes(system.bearing_group.evaluations))
    if ledger is not None and not system.rotor.failed:
        record = with_ledger(record, ledger.balance())
    return Result(
        record,
        outcome,
        message,
        Timing(load, equilibrium, film, rotor, fmi, end.record_time, rest),
        end.counts.accepted,
        system.bearing_group.evaluations,
        end.counts,
    )


def failed_start(
    scenario: Scenario, train: Train, outcome: Outcome, message: str, timing: Timing = _NO_TIME
) -> Result:
    """Return the result of a run that came to no start."""
    return Result(empty_record(scenario, train, outcome, message), outcome, message, timing, 0, 0)


def _course(scenario: Scenario) -> Course:
    """Steps end on the fracture where they are controlled; else the rotor takes it inside a step, exactly."""
    controlled = scenario.tolerance is not None or SCHEMES[scenario.coupling].iterates
    events = (scenario.event.time,) if controlled and scenario.event is not None else ()
    return Course(scenario.end, scenario.step, scenario.tolerance, events)


def _warm_up(system: System, train: Train) -> None:
    """Let every unit compute once, so that reductions and compilations count as loading."""
    positions = np.zeros((len(train.bearings), 4))
    positions[:, 1] = [-0.5 * seat.clearance for seat in train.bearings]
    evaluate(system, positions)
    system.rotor_group.fetch()
