"""``bladeloss study``: many runs over samples of a scenario's parameters."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from rich.console import Console

from orchestrator.errors import outcome_of
from orchestrator.fmi.folder import fmu_folder
from orchestrator.fmi.watchdog import BUDGET
from orchestrator.results.folder import named
from orchestrator.study.ensemble.conduct import Means, check_study_folder, conduct, plan_of
from orchestrator.study.ensemble.crowd import require_dask
from orchestrator.study.ensemble.file import read_study_file
from orchestrator.study.ensemble.words import conclusions


@dataclass(frozen=True)
class StudyRequest:
    """What the command line asks for.

    Attributes
    ----------
    source : Path
        The study's TOML.
    out : Path or None
        Folder of the study; None: ``results/<name of the file>``.
    fmus : Path
        Folder of the FMUs.
    jobs : int or None
        Runs at once; None: one a core.
    scheduler : str or None
        Address of a Dask cluster.
    budget, limit : float
        Wall time in s that a call to a unit, and a run, may take; 0 for any.
    trust, retry, dry : bool
        Run FMUs of others; do runs again that died or hung; only check and say what there is to do.
    """

    source: Path
    out: Path | None = None
    fmus: Path = field(default_factory=fmu_folder)
    jobs: int | None = None
    scheduler: str | None = None
    budget: float = BUDGET
    limit: float = 0.0
    trust: bool = False
    retry: bool = False
    dry: bool = False


def run(request: StudyRequest, console: Console) -> int:
    """Carry out a study, or what is missing of it, and say what came out.

    Returns
    -------
    int
        Exit status: 0 when every run has its row, however it ended.

    Raises
    ------
    OrchestratorError
        For anything wrong with the input; nothing has run then.
    """
    require_dask()
    file = read_study_file(request.source)
    folder = named(request.out) if request.out else Path("results") / request.source.stem
    check_study_folder(folder)
    means = Means(
        folder, request.fmus, request.jobs, request.scheduler, request.budget, request.limit,
        request.trust, request.retry, console,
    )  # fmt: skip
    plan = plan_of(file, means)
    runs = len(plan.first())
    refine = plan.study.refine
    more = f", then some samples at {', '.join(refine.depths)}" if refine else ""
    at = ", ".join(plan.subject.depths)
    said = f"{len(plan.samples)} samples at {at}: {runs} runs{more}; all samples are right"
    console.print(said, highlight=False, soft_wrap=True)
    if request.dry:
        return 0
    try:
        data = conduct(file, plan, means)
    except KeyboardInterrupt as error:
        return outcome_of(error).status
    for line in conclusions(data):
        console.print(line, highlight=False, soft_wrap=True)
    console.print(
        f"\nStudy in {folder}; its page: bladeloss report {folder}", highlight=False, soft_wrap=True
    )
    return 0
