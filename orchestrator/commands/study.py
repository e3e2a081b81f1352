"""``bladeloss study``: many runs over samples of a scenario's parameters."""

from __future__ import annotations

from pathlib import Path

from orchestrator.errors import outcome_of
from orchestrator.study.ensemble.conduct import Means, check_study_folder, conduct, plan_of
from orchestrator.study.ensemble.gathering.words import conclusions
from orchestrator.study.ensemble.running.crowd import require_dask
from orchestrator.study.ensemble.sampling.file import read_study_file


def run(source: Path, means: Means, *, dry: bool = False) -> int:
    """Carry out a study, or what is missing of it, and say what came out.

    Parameters
    ----------
    source : Path
        The study's TOML.
    means : Means
        Where to, and how.
    dry : bool
        Only check all samples, and say what there is to do.

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
    file, console = read_study_file(source), means.console
    check_study_folder(means.folder)
    plan = plan_of(file, means)
    runs = len(plan.first())
    refine = plan.study.refine
    more = f", then some samples at {', '.join(refine.depths)}" if refine else ""
    at = ", ".join(plan.subject.depths)
    said = f"{len(plan.samples)} samples at {at}: {runs} runs{more}; all samples are right"
    console.print(said, highlight=False, soft_wrap=True)
    if dry:
        return 0
    try:
        data = conduct(file, plan, means)
    except KeyboardInterrupt as error:
        return outcome_of(error).status
    for line in conclusions(data):
        console.print(line, highlight=False, soft_wrap=True)
    console.print(
        f"\nStudy in {means.folder}; its page: bladeloss report {means.folder}",
        highlight=False,
        soft_wrap=True,
    )
    return 0
