"""``bladeloss compare`` on the command line."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from orchestrator.cli.options import Budget, Depth, FigureFormats, Fmus, Format, guarded
from orchestrator.cli.wrong_use import one_of

COMPARE_HELP = (
    "Run a scenario at several depths and hold the results beside one another.\n\n"
    "The runs go side by side, each as a [bold]bladeloss run[/bold] of its own. Left are the figures with "
    "all depths, the table of forces, gaps, contact, amplitude and stress with their differences, what an "
    "engineer would have concluded from each depth, and the folders of the runs. The bundled "
    "scenario is held against the paper's study: 14 rows (paper, here, verdict, and the reason for what is "
    "missed).\n\n"
    "[bold]--check[/bold] repeats everything with twice the film resolution and half the macro step, "
    "and again ([bold]--doublings[/bold]), and tells what changes."
)
COMPARE_EPILOG = """\
[bold]Exit status[/bold]

  0    all runs finished, whatever the verdicts
  1    internal or file error
  2    wrong input, no run
  8    the process of a run died

  Others as of bladeloss run, of the first run that did not finish; the
  results are then in <DIR>-partial, with the reasons in PARTIAL.txt.
"""


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command(help=COMPARE_HELP, epilog=COMPARE_EPILOG)(compare)


def compare(
    scenario: Annotated[
        str, typer.Argument(help="A bundled scenario (see [bold]bladeloss info[/bold]) or a TOML file.")
    ] = "paper",
    depth: Annotated[
        list[Depth] | None,
        typer.Option(
            metavar="DEPTH",
            parser=one_of(Depth, "--depth"),
            help="To be compared; repeatable, by default all that solve a film and know the bores.",
        ),
    ] = None,
    end: Annotated[float | None, typer.Option(metavar="SECONDS", help="End time.")] = None,
    step: Annotated[float | None, typer.Option(metavar="SECONDS", help="Macro step.")] = None,
    columns: Annotated[
        int | None, typer.Option(metavar="N", help="Resolution of the films around the circumference.")
    ] = None,
    rows: Annotated[
        int | None, typer.Option(metavar="N", help="Resolution of the films along the axis.")
    ] = None,
    bearing: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="The analysed bearing; by default the scenario's."),
    ] = None,
    jobs: Annotated[
        int | None, typer.Option(metavar="N", min=1, help="Runs at the same time; by default one a core.")
    ] = None,
    check: Annotated[
        bool, typer.Option("--check", help="Repeat with finer films and smaller steps.")
    ] = False,
    doublings: Annotated[
        int, typer.Option(metavar="N", min=1, max=3, help="How often --check doubles and halves.")
    ] = 2,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Results; by default results/<SCENARIO>-compare.")
    ] = None,
    fmus: Fmus = None,
    figure_format: FigureFormats = None,
    figures: Annotated[bool, typer.Option(help="Draw the figures.")] = True,
    budget: Budget = 60.0,
) -> None:
    """Compare the depths, see `COMPARE_HELP`."""
    film = {key: value for key, value in (("columns", columns), ("rows", rows)) if value is not None}
    given: dict[str, Any] = {"end": end, "step": step, "film": film or None, "analysed_bearing": bearing}

    def work() -> int:
        from rich.console import Console

        from orchestrator.commands.compare import CompareRequest, run
        from orchestrator.fmi.folder import fmu_folder

        formats = tuple(str(item) for item in figure_format or [Format.PNG]) if figures else ()
        overrides = {key: value for key, value in given.items() if value is not None}
        depths = tuple(map(str, depth or ()))
        request = CompareRequest(
            scenario,
            overrides,
            out,
            fmus or fmu_folder(),
            depths,
            jobs,
            doublings if check else 0,
            formats,
            budget,
        )
        return run(request, Console(), Console(stderr=True))

    guarded(work)
