"""From a request to a case: read it, check that it can run and be written, build its FMUs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from rich.console import Console

from orchestrator.case.case import Case, folder_case, ssp_case
from orchestrator.case.checkpoint_folder import check_checkpoint
from orchestrator.case.request import RunRequest
from orchestrator.case.watched import part
from orchestrator.errors import OrchestratorError
from orchestrator.fmi.folder import do_ahead, ensure_fmus
from orchestrator.fmi.trust import require_trust
from orchestrator.fmi.voucher import vouch, vouched
from orchestrator.observers.checkpoint import Checkpoint, CheckpointError
from orchestrator.results.folder import check_folder, check_room, named, partial_folder
from orchestrator.scenario.file import load_with_train, parse_with_train, scenario_toml
from orchestrator.scenario.parameters import needed_depths
from orchestrator.scenario.problems import record_size
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.recipe import rotor_recipe
from rotor_fmu.train.wording import choice


@contextmanager
def prepare(
    request: RunRequest, console: Console, saved: Checkpoint | None = None, *, writes: bool = True
) -> Iterator[Case]:
    """Make the case of a request, or of a checkpoint; what it extracts vanishes at the end.

    Parameters
    ----------
    request : RunRequest
        What to run.
    console : rich.console.Console
        Told which FMUs are built.
    saved : Checkpoint, optional
        Of an earlier run of the request.
    writes : bool
        Whether results will be written, so that their folder is looked at now.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input; nothing is written then but FMUs.
    """
    with (_ssp_case if request.is_ssp else _scenario_case)(request, saved) as case:
        names = [seat.name for seat in case.train.bearings]
        if request.bearing is not None and request.bearing not in names:
            raise OrchestratorError(
                f"--bearing {request.bearing}: no such bearing; {choice(request.bearing, names)}"
            )
        folder = result_folder_of(request, case.scenario)
        if writes:
            for place in (folder, partial_folder(folder)):
                check_folder(place)
            # the record, and what it is joined from; with a certificate that of twice the steps besides
            copies = 3.0 if request.certify else 2.0
            check_room(folder, copies * record_size(case.scenario, case.train))
        if request.checkpoint is not None:
            check_checkpoint(folder)
        known = vouched(saved.about.get("trusted", {})) if saved is not None else ()
        foreign = case.units.foreign(case.scenario)
        trusted = require_trust(foreign, trust=request.trust, known=known)
        if trusted:
            part()
        if not request.is_ssp:
            needed = needed_depths(case.scenario, case.train)
            ensure_fmus(request.fmus, case.train, needed, console)
            do_ahead(case.scenario, case.train, needed, console)
        if note := size_note(case.scenario.reduction, 4 * case.train.nodes, request.budget):
            console.print(note, highlight=False, soft_wrap=True)
        vouchers = vouch(trusted) if request.checkpoint is not None and trusted else {}
        yield replace(case, about={**case.about, "trusted": vouchers})


def size_note(reduction: str, size: int, budget: float) -> str:
    """What an unreduced shaft of many degrees of freedom costs, in a line; empty where it is little.

    Its modes take time with the third power: 7 s of a processor of 2024 at 1116, the bundled turbine's.

    Raises
    ------
    OrchestratorError
        If that is longer than a call to a unit may take, `budget` [s], so that the run could not end.
    """
    seconds = 7.0 * (size / 1116.0) ** 3
    if reduction != "none" or seconds < 60.0:
        return ""
    cost = f"{size} degrees of freedom, whose modes take some {seconds / 60.0:.0f} min to find"
    other = "with irs it is seconds, and `bladeloss reductions` says what that changes"
    if 0.0 < budget < seconds:
        asked = f"--budget {math.ceil(2.0 * seconds / 60.0) * 60}"
        raise OrchestratorError(
            f"reduction none: {cost}, longer than a call to a unit may take (--budget {budget:g}, in s); "
            f"allowed are another reduction ({other}), or {asked}"
        )
    return f"Reduction none: {cost}; {other}"


def result_folder_of(request: RunRequest, scenario: Scenario) -> Path:
    """Return the folder asked for, or ``results/<scenario>-<depth>``, ``-mixed`` where bearings differ."""
    if request.out is not None:
        return named(request.out)
    name = Path(request.source).stem
    if not request.is_ssp:
        depths = {scenario.depth, *scenario.depth_at.values()}
        name += f"-{scenario.depth}" + ("-mixed" if len(depths) > 1 else "")
    return Path("results") / name


@contextmanager
def _scenario_case(request: RunRequest, saved: Checkpoint | None) -> Iterator[Case]:
    if saved is None:
        scenario, train = load_with_train(request.source, _with_ledger(request))
        if request.rotor not in (None, rotor_recipe(train).guid):
            raise OrchestratorError(f"train {scenario.train}: was edited meanwhile; start anew")
    else:
        text, place = saved.about["scenario"], Path(saved.about["scenario_folder"])
        scenario, train = parse_with_train(text, place, str(saved.path))
    about = {"scenario": scenario_toml(scenario), "scenario_folder": str(scenario.folder.absolute())}
    with folder_case(scenario, train, request.fmus, about) as case:
        yield case


@contextmanager
def _ssp_case(request: RunRequest, saved: Checkpoint | None) -> Iterator[Case]:
    path = Path(request.source)
    with ssp_case(path, _with_ledger(request)) as case:
        found = case.about["ssp_sha256"]
        if saved is not None and saved.about.get("ssp_sha256") != found:
            raise CheckpointError(
                f"{saved.path}: made with another {path} (sha256 {saved.about.get('ssp_sha256')}, not "
                f"{found}); put that file back, or start anew"
            )
        yield case


def _with_ledger(request: RunRequest) -> dict[str, object]:
    """The overrides; a certificate needs the energy ledger."""
    return {**request.overrides, **({"ledger": True} if request.certify else {})}
