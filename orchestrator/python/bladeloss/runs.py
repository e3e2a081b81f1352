"""Run scenarios."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import xarray as xr
from rich.console import Console

from orchestrator.case.carry_out import carry_out
from orchestrator.case.conclude import completed, conclude
from orchestrator.case.prepare import prepare
from orchestrator.case.request import RunRequest
from orchestrator.case.simulate import Execution
from orchestrator.case.threads import default_threads
from orchestrator.errors import OrchestratorError
from orchestrator.fmi.folder import fmu_folder
from orchestrator.outcome import Outcome
from orchestrator.results.folder_lock import lock_folder
from orchestrator.scenario.file import load_scenario
from orchestrator.scenario.scenario import Scenario


class RunError(OrchestratorError):
    """A run that did not reach its end, or that means nothing.

    Attributes
    ----------
    outcome : Outcome
        How it ended.
    record : xarray.Dataset
        What was simulated till then; may hold no instant.
    """

    def __init__(self, outcome: Outcome, message: str, record: xr.Dataset) -> None:
        super().__init__(f"{outcome.value}: {message}")
        self.outcome = outcome
        self.record = record


def run(
    source: str | Path = "paper",
    *,
    out: str | Path | None = None,
    fmus: str | Path | None = None,
    threads: int | None = None,
    trust: bool = False,
    progress: bool | None = None,
    figures: bool = True,
    report: bool = False,
    **changes: Any,
) -> xr.Dataset:
    """Run a scenario and return its record.

    Parameters
    ----------
    source : str or Path
        Name of a bundled scenario, path of a TOML or SSP file.
    out : str or Path, optional
        Folder for what `bladeloss run` leaves (record, summary, figures); nothing is written without it.
    fmus : str or Path, optional
        Folder of the FMUs; by default in the user's cache.
    threads : int, optional
        On which the bearings step; as many as pay. Threads of BLAS are held at one meanwhile.
    trust : bool
        Run FMUs of others, native code with all your rights.
    progress : bool, optional
        Show how far it is; by default on a terminal and in a notebook.
    figures : bool
        Draw the figures into `out`.
    report : bool
        Make ``report.html``, too; needs `out`.
    **changes
        Values in place of the scenario's: ``end=0.5``, ``depth="v2"``, tables by two underscores
        (``event__unbalance=0.4``) or as mappings (``depth_at={"rear": "v3"}``); None takes a key out.

    Raises
    ------
    Error
        For anything wrong with the input, in the words of the command line.
    RunError
        When the run does not reach its end; has its record.
    """
    if report and out is None:
        raise OrchestratorError("report: needs a folder for the page; allowed is out=FOLDER with it")
    console = Console(stderr=True)
    shown = console.is_terminal or console.is_jupyter if progress is None else progress
    quiet = Console(quiet=True)
    request = RunRequest(
        str(source),
        nested(changes),
        None if out is None else Path(out),
        fmu_folder() if fmus is None else Path(fmus),
        formats=("png",) if figures else (),
        threads=threads,
        trust=trust,
        report=report,
    )
    with prepare(request, quiet, writes=out is not None) as case:
        execution = Execution(threads=request.threads or default_threads(case.scenario, case.train))
        if request.out is None:
            result = completed(case, carry_out(case, console if shown else quiet, execution))
        else:
            with lock_folder(request.out):
                result = completed(case, carry_out(case, console if shown else quiet, execution))
                conclude(case, request, request.out, (result, None), quiet, quiet)
    if not result.outcome.ok:
        raise RunError(result.outcome, result.message, result.record)
    return result.record


def scenario(source: str | Path = "paper", **changes: Any) -> Scenario:
    """Read and check a scenario; see `run` for its changes, and `Scenario` for its keys."""
    return load_scenario(str(source), nested(changes))


def nested(changes: Mapping[str, Any]) -> dict[str, Any]:
    """``{"event__unbalance": 0.4}`` as ``{"event": {"unbalance": 0.4}}``."""
    result: dict[str, Any] = {}
    for key, value in changes.items():
        *tables, last = key.split("__")
        table = result
        for name in tables:
            table = table.setdefault(name, {})
            if not isinstance(table, dict):
                raise OrchestratorError(f"{key}: {name} is given as a value, too; allowed is one of them")
        table[last] = dict(value) if isinstance(value, Mapping) else value
    return result
