"""A scenario run at several depths, each by the own command in a process of its own, and read back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from bearing_fmu import depths
from fmus import port
from orchestrator.case.certify import at_half_step
from orchestrator.errors import OrchestratorError
from orchestrator.results.record_files import RECORD_FILE, read_record
from orchestrator.results.verdicts.judge import worst_bearing
from orchestrator.scenario.file import scenario_toml, with_overrides
from orchestrator.scenario.parameters import bearing_parameters
from orchestrator.study.children import COMMAND, Child, cores, run_children
from orchestrator.study.comparison import Comparison, gather
from orchestrator.study.progress import show_runs
from rotor_fmu.recipe import rotor_recipe
from rotor_fmu.train.file import bundled_file

if TYPE_CHECKING:
    import xarray as xr

    from orchestrator.scenario.scenario import Scenario
    from rotor_fmu.train.train import Train

COMPARED = "compared.toml"
"""The scenario that is run at every depth."""


@dataclass(frozen=True)
class Means:
    """How the runs are carried out.

    Attributes
    ----------
    fmus : Path
        Folder of the FMUs, which are there.
    jobs : int or None
        Runs at the same time; None: one a core.
    budget : float
        Wall time in s that a call to a unit may take; 0 for any.
    command : sequence of str
        What runs a scenario.
    """

    fmus: Path
    jobs: int | None
    budget: float
    command: Sequence[str] = COMMAND


def fitting(scenario: Scenario, train: Train, console: Console) -> list[str]:
    """Depths with a film that can have every bearing of a train, the deepest first.

    Of each of the others a line says why it is left out.

    Raises
    ------
    OrchestratorError
        None can have them.
    """
    fit, reasons = [], []
    for name in depths.films():
        try:
            for seat in train.bearings:
                depths.find(name).make(bearing_parameters(seat, scenario.film))
        except ValueError as error:
            reasons.append(f"{name} left out: {seat.name}: {error}")
        else:
            fit.append(name)
    if not fit:
        raise OrchestratorError("\n".join(reasons))
    for line in reasons:
        console.print(line, highlight=False, markup=False, soft_wrap=True)
    return fit


def run_depths(
    scenario: Scenario, train: Train, names: Sequence[str], folder: Path, means: Means, console: Console
) -> tuple[Comparison, list[xr.Dataset]]:
    """Run a scenario at several depths.

    Parameters
    ----------
    scenario, train : Scenario, Train
        What is run; its depth counts for nothing.
    names : sequence of str
        Of the depths, the deepest first.
    folder : Path
        Made if missing. Afterwards the results of each run lie in the folder of its depth, also partial
        ones, beside the scenario (`COMPARED`).
    means : Means
        How the runs are carried out.
    console : rich.console.Console
        Shows the progress.

    Returns
    -------
    Comparison, list of xarray.Dataset
        And the records that the runs left, in the order of the depths.

    Raises
    ------
    OrchestratorError
        What a run says is wrong with the input.
    """
    folder.mkdir(parents=True, exist_ok=True)
    if bundled_file(scenario.train) is None:
        path = (scenario.folder / scenario.train).absolute()
        scenario = scenario.model_copy(update={"train": str(path)})
    source = folder / COMPARED
    source.write_text(scenario_toml(scenario), encoding="utf-8")
    jobs = min(means.jobs or cores(), len(names))
    options = ["--fmus", str(means.fmus.absolute()), "--budget", str(means.budget), "--no-figures"]
    options += ["--rotor", rotor_recipe(train).guid]  # the train may be edited while they start
    options += ["--threads", str(max(1, cores() // jobs))]
    children = [Child(d, (str(source), "--depth", d, *options), folder / d) for d in names]
    with show_runs(names, console) as show:
        ended = run_children(children, jobs, show, command=means.command)
    records: dict[str, xr.Dataset | None] = {}
    for child in children:
        if child.results.is_dir() and child.results != child.folder:
            child.results.rename(child.folder)
        written = (child.folder / RECORD_FILE).is_file()
        records[child.name] = read_record(child.folder) if written else None
    left = [record for record in records.values() if record is not None]
    bearing = scenario.analysed_bearing or (worst_bearing(left) if left else train.bearings[0].name)
    return gather(records, ended, bearing, scenario, train), left


def refine(scenario: Scenario, doublings: int = 1) -> list[Scenario]:
    """Scenarios of twice the film resolution, as far as films can have it, and half the macro step each.

    Raises
    ------
    OrchestratorError
        No film can be finer.
    """
    most = {key: int(port.bearing_parameter(key).maximum or 0) for key in ("columns", "rows")}
    found = [scenario]
    for _ in range(doublings):
        film = {key: min(2 * getattr(found[-1].film, key), most[key]) for key in most}
        if film == {key: getattr(found[-1].film, key) for key in most}:
            shown = ", ".join(f"film.{key} = {value}" for key, value in film.items())
            raise OrchestratorError(f"--check: {shown} is the finest film; allowed are fewer --doublings")
        found.append(with_overrides(at_half_step(found[-1]), {"film": film}))
    return found[1:]
