"""A study from its file to its folder: read, checked, carried out, gathered."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import xarray as xr
from rich.console import Console

from orchestrator.errors import OrchestratorError
from orchestrator.fmi.folder import ensure_fmus, fmu_folder
from orchestrator.fmi.trust import require_trust
from orchestrator.fmi.watchdog import BUDGET
from orchestrator.results.ensemble.files import DATA, RUNS, SAMPLES, SIGN, TABLE, name_of_run
from orchestrator.results.folder import ResultFolderError, check_writable
from orchestrator.results.folder_lock import lock_folder
from orchestrator.results.record_files import netcdf
from orchestrator.study.children import cores
from orchestrator.study.ensemble.gathering.gather import Rows, dataset_of, table_of
from orchestrator.study.ensemble.gathering.sensitivity import with_sensitivities
from orchestrator.study.ensemble.gathering.worst import Again, worst_runs
from orchestrator.study.ensemble.progress import show_tally
from orchestrator.study.ensemble.running.checks import sample_problems
from orchestrator.study.ensemble.running.crowd import Crowd, crowd, require_dask
from orchestrator.study.ensemble.running.row import Row
from orchestrator.study.ensemble.running.subject import FunctionSubject, ScenarioSubject
from orchestrator.study.ensemble.sampling.file import StudyFile
from orchestrator.study.ensemble.sampling.samples import samples_of, text_rows
from orchestrator.study.ensemble.stages import Plan, Store, carry_out, loops, missing_of, rows_of
from rotor_fmu.train.wording import choice

_SIGNATURE = "# A study by bladeloss; its runs lie beside this file.\n"


@dataclass(frozen=True)
class Means:
    """How a study is carried out, without influence on its numbers.

    Attributes
    ----------
    folder : Path
        Of the study.
    fmus : Path
        Of the FMUs.
    jobs : int or None
        Runs at once; None: one a core.
    scheduler : str or None
        Address of a Dask cluster, in place of this machine's cores.
    budget, limit : float
        Wall time in s that a call to a unit, and a run, may take; 0 for any.
    trust, retry : bool
        Run FMUs of others; do runs again that died, hung or took too long.
    console : rich.console.Console
        Told what is done.
    """

    folder: Path
    fmus: Path = field(default_factory=fmu_folder)
    jobs: int | None = None
    scheduler: str | None = None
    budget: float = BUDGET
    limit: float = 0.0
    trust: bool = False
    retry: bool = False
    console: Console = field(default_factory=lambda: Console(quiet=True))


def plan_of(
    file: StudyFile, means: Means, function: Callable[..., Mapping[str, float] | float] | None = None
) -> Plan:
    """Draw the samples of a study and check every one of them.

    Raises
    ------
    StudyError
        With a line for each problem.
    """
    study = file.study
    if function is not None:
        depths = tuple(study.depths or ("",))
        return Plan(study, FunctionSubject(study, function, depths), samples_of(study))
    subject = ScenarioSubject.of(file, means.fmus, means.budget)
    names = [seat.name for seat in subject.train.bearings]
    unknown = [name for name in study.keep.bearings or () if name not in names]
    if unknown:
        raise file.error(
            [(("keep", "bearings"), f"keep.bearings: {n!r}; {choice(n, names)}") for n in unknown]
        )
    plan = Plan(study, subject, samples_of(study))
    samples = [plan.samples[index] for index in range(len(plan.samples))]
    problems = list(sample_problems(file, subject, samples, plan.depths))
    if problems:
        raise file.error(problems)
    return plan


def conduct(file: StudyFile, plan: Plan, means: Means) -> xr.Dataset:
    """Carry out what is missing of a study, and write its dataset and its table.

    Returns
    -------
    xarray.Dataset
        Also in the folder, beside the rows of its runs.

    Raises
    ------
    OrchestratorError
        A folder that holds something else, no Dask, no cluster.
    KeyboardInterrupt
        After Ctrl-C; what is done is kept.
    """
    require_dask()
    folder, store = means.folder, Store(means.folder, means.retry)
    check_study_folder(folder)
    if isinstance(plan.subject, ScenarioSubject):
        require_trust(plan.subject.foreign(), trust=means.trust)
    with lock_folder(folder):
        (folder / RUNS).mkdir(parents=True, exist_ok=True)
        _write(folder / SIGN, (_SIGNATURE + file.text).encode())
        _write(folder / SAMPLES, _csv(plan).encode())
        try:
            digests = _stages(plan, store, means)
        except KeyboardInterrupt:
            kept = sum(1 for _ in (folder / RUNS).glob("*.json"))
            said = f"Stopped; {kept} runs are kept in {folder}, and the same command goes on from there"
            means.console.print(said, highlight=False, soft_wrap=True)
            raise
        data = dataset_of(plan.study, plan.samples, Rows(plan.depths, rows_of(digests, store)))
        data = with_sensitivities(plan.study, plan.samples, data)
        runs = worst_runs(data, plan.study.keep.rank, plan.study.keep.worst)
        data = data.assign_attrs(worst_runs=" ".join(name_of_run(*run) for run in runs))
        _write(folder / DATA, netcdf(data))
        _write(folder / TABLE, table_of(data).encode())
        if isinstance(plan.subject, ScenarioSubject) and runs:
            again = Again(folder, means.jobs or cores(), means.trust, means.console)
            again.carry_out(plan.subject, plan.samples, runs)
    return data


def check_study_folder(folder: Path) -> None:
    """Raise ResultFolderError when a folder cannot take a study."""
    check_writable(folder)
    sign = folder / SIGN
    ours = sign.is_file() and sign.read_text(encoding="utf-8", errors="replace").startswith(_SIGNATURE)
    if folder.is_dir() and any(folder.iterdir()) and not ours:
        raise ResultFolderError(
            f"{folder}: holds files that are no earlier study; --out takes a new folder, an empty one "
            "or that of a study"
        )


def _stages(plan: Plan, store: Store, means: Means) -> dict[tuple[int, str], str]:
    """Do what is missing of both stages; return what each run is known by."""
    first = plan.digests(plan.first())
    missing = missing_of(first, store)
    if missing == 0 and plan.study.refine is None:
        return first
    with crowd(means.scheduler, means.jobs or cores(), means.limit) as workers:
        if missing:
            _ahead(plan, workers, means)
            what = "First stage" if plan.study.refine else "Study"
            _stage(what, plan, first, store, (workers, means.console))
        second = plan.digests(plan.second(rows_of(first, store)))
        if missing_of(second, store):
            _stage("Second stage", plan, second, store, (workers, means.console))
    return {**first, **second}


def _stage(
    what: str,
    plan: Plan,
    digests: Mapping[tuple[int, str], str],
    store: Store,
    where: tuple[Crowd, Console],
) -> None:
    workers, console = where
    rows: list[Row] = []
    with show_tally(what, missing_of(digests, store), console) as count:

        def done(row: Row) -> None:
            rows.append(row)
            count(row)

        carry_out(plan, digests, store, workers, done)
    loop, rest = loops(rows)
    if loop:
        console.print(f"A run: time loop {loop:.3g} s, besides {rest:.3g} s (medians)", highlight=False)


def _ahead(plan: Plan, workers: Crowd, means: Means) -> None:
    """Build FMUs and have kernels compiled once, before many would at the same time."""
    subject = plan.subject
    if not isinstance(subject, ScenarioSubject):
        return
    if means.scheduler is None:
        scenario = subject.base
        for depth in plan.depths:
            ensure_fmus(means.fmus, subject.train, subject.needed(scenario, depth), means.console)
    works = ((f"ahead-{os.getpid()}-{depth}", lambda d=depth: subject.first_step(d)) for depth in plan.depths)  # type: ignore[misc]
    refused: list[Row] = []

    def done(_name: str, row: Row) -> None:
        if row.outcome == "refused":
            refused.append(row)

    workers.carry_out(works, done)
    if refused:
        raise OrchestratorError(refused[0].message)


def _write(path: Path, content: bytes) -> None:
    """Write a file, whole or not at all."""
    part = path.with_name(f".{path.name}.part")
    part.write_bytes(content)
    part.replace(path)


def _csv(plan: Plan) -> str:
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(text_rows(plan.samples))
    return out.getvalue()
