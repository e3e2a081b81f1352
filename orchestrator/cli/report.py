"""``bladeloss report`` on the command line."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from orchestrator.cli.options import command_of

REPORT_HELP = (
    "Make one page of the results of one or several runs, to read and to hand over.\n\n"
    "What was run and how far to trust it, what every limit says, orbits of all bearings in their "
    "clearances, forces, gaps, spectra, waterfall, films at their worst instants, the shaft in space over "
    "time. One HTML file that needs no network and no server; several runs stand side by side in the same "
    "axes. [bold]--pdf[/bold] writes the same for printing.\n\n"
    "Limits come from [bold]limits.toml[/bold] beside the train's file where there is one, from "
    "[bold]--limits[/bold], or else from standards."
)
REPORT_EPILOG = """\
[bold]Examples[/bold]

  bladeloss report results/paper-v1                     into its folder
  bladeloss report results/paper-v* --out depths.html   side by side
  bladeloss report results/paper-v1 --pdf               and to be printed
  bladeloss run small --report                          with a run
  bladeloss report results/contact                      a study: how likely is contact

[bold]Exit status[/bold]

  0    written, whatever the verdicts    2    wrong input
  1    no plotting library (pip install 'bladeloss\\[report]')
  13   the file could not be written
"""


@dataclass(frozen=True)
class ReportOptions:
    """Options of the command; see `orchestrator.commands.report.ReportRequest`."""

    results: Annotated[
        list[Path], typer.Argument(metavar="RESULT...", help="Folders of runs, or of a study.")
    ]
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="The page; by default report.html in the run's folder, of several in this one.",
        ),
    ] = None
    bearing: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="Opens the page; by default the one with the worst verdict."),
    ] = None
    limits: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Limits in place of those of the runs (TOML).")
    ] = None
    pdf: Annotated[bool, typer.Option("--pdf", help="The same for printing beside it, as a PDF.")] = False


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command(name="report", help=REPORT_HELP, epilog=REPORT_EPILOG)(command_of(ReportOptions, report))


def report(options: ReportOptions) -> int:
    """Make a report, see `REPORT_HELP`."""
    from rich.console import Console

    from orchestrator.commands.report import ReportRequest, run

    return run(ReportRequest(**vars(options)), Console())
