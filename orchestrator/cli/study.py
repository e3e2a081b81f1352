"""``bladeloss study`` on the command line."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from orchestrator.cli.options import Budget, Fmus, Trust, command_of, finite

STUDY_HELP = (
    "Run a scenario many times, over samples of its parameters and those of its train.\n\n"
    "The study is a TOML file: a base scenario, parameters with lists, grids or distributions, the depths "
    "that each sample is run at, what is kept of a run, and perhaps a second stage at a deeper depth where "
    "the first says so. All samples are checked before anything runs. Runs go side by side on the cores of "
    "this machine, or on a Dask cluster; a run that fails, hangs or dies is a row with its outcome. The "
    "folder holds a dataset ([bold]study.nc[/bold]), a table ([bold]study.csv[/bold]) and a small file of "
    "each run; the same command goes on with what is missing, and [bold]bladeloss report DIR[/bold] makes a "
    "page of it."
)
STUDY_EPILOG = """\
[bold]Examples[/bold]

  bladeloss study contact.toml                       on all cores
  bladeloss study contact.toml --dry-run             checked, and how many runs
  bladeloss study contact.toml --scheduler tcp://host:8786
  bladeloss report results/contact                   how likely is contact

[bold]Exit status[/bold]

  0    every run has its row      130  stopped; go on by the same command
  1    no Dask (pip install 'bladeloss\\[study]')
  2    wrong input, no run

  The keys of the file: orchestrator/study/ensemble/README.md.
"""


@dataclass(frozen=True)
class StudyOptions:
    """Options of the command; see `orchestrator.study.ensemble.conduct.Means`."""

    study: Annotated[Path, typer.Argument(metavar="STUDY.toml", help="What to run.")]
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Of the study; by default results/<STUDY>.")
    ] = None
    jobs: Annotated[
        int | None, typer.Option(min=1, metavar="N", help="Runs at once; by default one a core.")
    ] = None
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Of a Dask cluster, such as tcp://host:8786.")
    ] = None
    limit: Annotated[
        float,
        typer.Option(
            min=0.0, metavar="SECONDS", callback=finite, help="Give up a run that takes longer; 0: never."
        ),
    ] = 0.0
    retry: Annotated[
        bool, typer.Option("--retry", help="Do runs again that died, hung or took too long.")
    ] = False
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Check all samples, say how many runs there are, and stop.")
    ] = False
    fmus: Fmus = None
    trust: Trust = False
    budget: Budget = 60.0


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command(name="study", help=STUDY_HELP, epilog=STUDY_EPILOG)(command_of(StudyOptions, study))


def study(options: StudyOptions) -> int:
    """Carry out a study, see `STUDY_HELP`."""
    from rich.console import Console

    from orchestrator.cli.unneeded import found

    found()  # Dask, before it is looked for
    from orchestrator.commands.study import run
    from orchestrator.fmi.folder import fmu_folder
    from orchestrator.results.folder import named
    from orchestrator.study.ensemble.conduct import Means

    means = Means(
        named(options.out) if options.out else Path("results") / options.study.stem,
        options.fmus or fmu_folder(), options.jobs, options.scheduler, options.budget, options.limit,
        options.trust, options.retry, Console(),
    )  # fmt: skip
    return run(options.study, means, dry=options.dry_run)
