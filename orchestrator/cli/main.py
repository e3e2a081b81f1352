"""The command ``bladeloss``.

Only the options are declared here; what a command does is imported when it runs, so that
``--help`` answers at once.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Annotated, Any

import typer

from orchestrator.cli import compare as cli_compare
from orchestrator.cli import export_ssp as cli_ssp
from orchestrator.cli import linear as cli_linear
from orchestrator.cli import resume as cli_resume
from orchestrator.cli.options import (
    Budget,
    Coupling,
    Depth,
    FigureFormats,
    Format,
    GivenDepth,
    Reduction,
    Trust,
    guarded,
)
from orchestrator.cli.wrong_use import Commands, WrongChoice, one_of
from orchestrator.outcome import status_lines
from rotor_fmu.train.wording import choice

app = typer.Typer(
    name="bladeloss",
    cls=Commands,
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode="rich",
    pretty_exceptions_show_locals=False,
)
cli_compare.register(app)
cli_linear.register(app)
cli_ssp.register(app)
cli_resume.register(app)


RUN_HELP = (
    "Simulate a scenario; without argument the reference scenario of 2 s.\n\n"
    "Builds the FMUs that are missing or stale, finds the static equilibrium of the train on its rotating "
    "films, runs to the end time and leaves a folder with the record (record.nc for analysis, record.csv for "
    "FMI tools), the summary (summary.txt, summary.json), the scenario as run (scenario.toml) and the "
    "figures.\n\n"
    "Options replace values of the scenario; what is not given stays as there. The reference scenario has "
    "depth v1, coupling linear-implicit, reduction irs, step 1e-4 s."
)
RUN_EPILOG = f"""\
[bold]Examples[/bold]

  bladeloss run                                the reference scenario
  bladeloss run --depth v2                     the same with aligned films
  bladeloss run --depth-at LP2-front=v2        v1, but for one bearing
  bladeloss run --depth-at LP2-front=own.fmu --trust  your own bearing there
  bladeloss run small                          a small train: some seconds
  bladeloss run my.toml --end 0.5 --out cut    your own, cut short

[bold]Exit status[/bold]

{status_lines()}

  From 3 on, what was simulated lies in <DIR>-partial, with the reason
  in PARTIAL.txt.
"""


def _version(wanted: bool) -> None:
    if wanted:
        from importlib import metadata

        typer.echo(f"bladeloss {metadata.version('bladeloss')}")
        raise typer.Exit


@app.callback()
def bladeloss(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    """Simulate what a turbine train on hydrodynamic bearings does when a blade breaks.

    Start with [bold]bladeloss run[/bold]. Rotor and bearings are FMUs; their depth is one word.
    """


@app.command(help=RUN_HELP, epilog=RUN_EPILOG)
def run(
    scenario: Annotated[
        str, typer.Argument(help="A bundled scenario (see [bold]bladeloss info[/bold]), a TOML or SSP file.")
    ] = "paper",
    depth: GivenDepth = None,
    depth_at: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=DEPTH", help="One bearing: LP2-front=v2, or your own FMU; repeatable."),
    ] = None,
    coupling: Annotated[
        Coupling | None,
        typer.Option(
            metavar="NAME",
            parser=one_of(Coupling, "--coupling"),
            help="linear-implicit (affine law); iterated: newton, iqn-ils; to compare, explicit and force "
            "only: gauss-seidel, jacobi.",
        ),
    ] = None,
    step: Annotated[
        float | None,
        typer.Option(metavar="SECONDS", help="Macro step; fixed, unless --tol is given with it."),
    ] = None,
    tol: Annotated[
        float | None,
        typer.Option(metavar="SHARE", help="Halve steps whose relative defect exceeds it, e.g. 1e-3."),
    ] = None,
    ledger: Annotated[bool, typer.Option("--ledger", help="Keep the energy ledger; slower.")] = False,
    end: Annotated[float | None, typer.Option(metavar="SECONDS", help="End time.")] = None,
    reduction: Annotated[
        Reduction | None,
        typer.Option(
            metavar="NAME",
            parser=one_of(Reduction, "--reduction"),
            help="Of the shaft: irs, irs-plain, guyan, craig-bampton or none.",
        ),
    ] = None,
    bearing: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="Shown in the figures; by default the most loaded one."),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Results; by default results/<SCENARIO>-<DEPTH>."),
    ] = None,
    checkpoint: Annotated[
        float | None,
        typer.Option(min=1e-6, metavar="EVERY", help="Simulated seconds between checkpoints; see resume."),
    ] = None,
    certify: Annotated[
        bool, typer.Option("--certify", help="Run again at half the step; keep the energy ledger.")
    ] = False,
    threads: Annotated[
        int | None,
        typer.Option(min=1, metavar="N", help="For the bearings; by default 2 where that pays."),
    ] = None,
    fmus: Annotated[Path, typer.Option(metavar="DIR", help="Folder of the FMUs.")] = Path("fmus"),
    figure_format: FigureFormats = None,
    figures: Annotated[bool, typer.Option(help="Draw the figures.")] = True,
    trust: Trust = False,
    budget: Budget = 60.0,
) -> None:
    """Simulate a scenario, see `RUN_HELP`."""
    overrides: dict[str, Any] = {
        key: value
        for key, value in (
            ("depth", depth and str(depth)),
            ("depth_at", _assignments(depth_at or [])),
            ("coupling", coupling and str(coupling)),
            ("step", step),
            ("tolerance", tol),
            ("ledger", ledger or None),
            ("end", end),
            ("reduction", reduction and str(reduction)),
        )
        if value not in (None, {})
    }

    def work() -> int:
        from rich.console import Console

        from orchestrator.case.request import RunRequest
        from orchestrator.commands.run import run as run_scenario

        formats = tuple(str(item) for item in figure_format or [Format.PNG]) if figures else ()
        request = RunRequest(
            scenario, overrides, out, fmus, bearing, formats, checkpoint, certify, threads, trust, budget
        )
        return run_scenario(request, Console(), Console(stderr=True))

    guarded(work)


@app.command()
def build(
    out: Annotated[Path, typer.Option(metavar="DIR", help="Folder of the FMUs.")] = Path("fmus"),
    train: Annotated[
        list[str],
        typer.Option(metavar="TRAIN", help="Bundled train or folder with train.toml; repeatable."),
    ] = ["turbine"],  # noqa: B006
    ssp: Annotated[
        bool, typer.Option(help="With the turbine: also bladeloss.ssp, the reference scenario.")
    ] = True,
) -> None:
    """Build the FMUs: the rotor of a train, and a bearing of each depth; and the SSP.

    For other FMI tools; [bold]bladeloss run[/bold] builds what it needs by itself. The same
    sources give the same bytes.
    """

    def work() -> int:
        from rich.console import Console

        from orchestrator.fmi.folder import build_all

        build_all(out, train, Console())
        if ssp and "turbine" in train:
            from orchestrator.commands.export_ssp import DEFAULT_NAME, DEFAULT_SCENARIO, export_scenario

            export_scenario(DEFAULT_SCENARIO, out / f"{DEFAULT_NAME}.ssp", out, Console())
        return 0

    guarded(work)


@app.command()
def info() -> None:
    """List the bundled scenarios and trains, with the names of bearings and wheels."""

    def work() -> int:
        from rich.console import Console

        from orchestrator.commands.info import show

        show(Console())
        return 0

    guarded(work)


def _assignments(items: list[str]) -> dict[str, str]:
    """``["A=v2"]`` as ``{"A": "v2"}``; a depth is checked here, a name against the train later."""
    found: dict[str, str] = {}
    for item in items:
        name, equals, depth = (part.strip() for part in item.partition("="))
        fmu = depth.endswith(".fmu")
        if not (name and equals and (fmu or depth in list(Depth))):
            allowed = choice(depth, (*Depth, "the path of an .fmu file"))
            raise WrongChoice(f"--depth-at {item}: not NAME=DEPTH; of depths {allowed}")
        found[name] = str(Path(depth).absolute()) if fmu else depth
    return found


def main() -> None:
    """Entry point of the command.

    Linear algebra gets one thread, before numpy is loaded: on matrices of this size more of them
    wait for one another, and for the threads of the bearings.
    """
    for library in ("OPENBLAS", "OMP", "MKL"):
        os.environ.setdefault(f"{library}_NUM_THREADS", "1")
    sys.exit(app())


if __name__ == "__main__":
    main()
