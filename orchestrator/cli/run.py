"""``bladeloss run`` on the command line."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

from orchestrator.cli.options import (
    Budget,
    Coupling,
    Depth,
    FigureFormats,
    Fmus,
    Format,
    GivenDepth,
    Reduction,
    Trust,
    command_of,
    finite,
)
from orchestrator.cli.wrong_use import WrongChoice, one_of
from orchestrator.outcome import status_lines
from rotor_fmu.train.wording import choice

RUN_HELP = (
    "Simulate a scenario; without argument the reference scenario.\n\n"
    "Builds the FMUs that are missing or stale, finds the static equilibrium of the train on its rotating "
    "films, runs to the end time and leaves a folder with the record (record.nc for analysis, record.csv for "
    "FMI tools), the summary (summary.txt, summary.json), the scenario as run (scenario.toml) and the "
    "figures.\n\n"
    "Options replace values of the scenario; what is not given stays as there. The reference scenario has "
    "depth v1, coupling multirate, reduction irs."
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


@dataclass(frozen=True)
class RunOptions:
    """Options of the command; see `orchestrator.case.request.RunRequest`."""

    scenario: Annotated[
        str, typer.Argument(help="A bundled scenario (see [bold]bladeloss info[/bold]), a TOML or SSP file.")
    ] = "paper"
    depth: GivenDepth = None
    depth_at: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=DEPTH", help="One bearing: LP2-front=v2, or your own FMU; repeatable."),
    ] = None
    coupling: Annotated[
        Coupling | None,
        typer.Option(
            metavar="NAME",
            parser=one_of(Coupling, "--coupling"),
            help="linear-implicit (affine law); multirate (each bearing at its own rate); iterated: newton, "
            "iqn-ils; to compare, explicit and force only: gauss-seidel, jacobi.",
        ),
    ] = None
    step: Annotated[
        float | None,
        typer.Option(metavar="SECONDS", help="Macro step; fixed, unless --tol is given with it."),
    ] = None
    tol: Annotated[
        float | None,
        typer.Option(metavar="SHARE", help="Halve steps whose relative defect exceeds it, e.g. 1e-3."),
    ] = None
    ledger: Annotated[bool, typer.Option("--ledger", help="Keep the energy ledger; slower.")] = False
    end: Annotated[float | None, typer.Option(metavar="SECONDS", help="End time.")] = None
    reduction: Annotated[
        Reduction | None,
        typer.Option(
            metavar="NAME",
            parser=one_of(Reduction, "--reduction"),
            help="Of the shaft: irs, irs-plain, guyan, craig-bampton or none.",
        ),
    ] = None
    bearing: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="Shown in the figures; by default the most loaded one."),
    ] = None
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Results; by default results/<SCENARIO>-<DEPTH>."),
    ] = None
    checkpoint: Annotated[
        float | None,
        typer.Option(
            min=1e-6,
            metavar="EVERY",
            callback=finite,
            help="Simulated seconds between checkpoints; see resume.",
        ),
    ] = None
    certify: Annotated[
        bool, typer.Option("--certify", help="Run again at half the step; keep the energy ledger.")
    ] = False
    threads: Annotated[
        int | None,
        typer.Option(min=1, metavar="N", help="For the bearings; by default 2 where that pays."),
    ] = None
    fmus: Fmus = None
    figure_format: FigureFormats = None
    figures: Annotated[bool, typer.Option(help="Draw the figures.")] = True
    report: Annotated[
        bool, typer.Option("--report", help="Make the page report.html, see bladeloss report.")
    ] = False
    trust: Trust = False
    budget: Budget = 60.0
    rotor: Annotated[str | None, typer.Option(hidden=True, help="GUID of the rotor that is meant.")] = None

    @property
    def overrides(self) -> dict[str, Any]:
        """What replaces values of the scenario, in the shape of its file."""
        given = {
            "depth": self.depth and str(self.depth),
            "depth_at": _assignments(self.depth_at or []),
            "coupling": self.coupling and str(self.coupling),
            "step": self.step,
            "tolerance": self.tol,
            "ledger": self.ledger or None,
            "end": self.end,
            "reduction": self.reduction and str(self.reduction),
        }
        return {key: value for key, value in given.items() if value not in (None, {})}


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command(name="run", help=RUN_HELP, epilog=RUN_EPILOG)(command_of(RunOptions, run))


def run(options: RunOptions) -> int:
    """Simulate a scenario, see `RUN_HELP`."""
    from rich.console import Console

    from orchestrator.case.request import RunRequest
    from orchestrator.commands import run as run_command
    from orchestrator.fmi.folder import fmu_folder

    request = RunRequest(
        options.scenario,
        options.overrides,
        options.out,
        options.fmus or fmu_folder(),
        options.bearing,
        tuple(str(kind) for kind in options.figure_format or [Format.PNG]) if options.figures else (),
        options.checkpoint,
        options.certify,
        options.threads,
        options.trust,
        options.budget,
        options.rotor,
        options.report,
    )
    return run_command.run(request, Console(), Console(stderr=True))


def _assignments(items: list[str]) -> dict[str, str]:
    """``["A=v2"]`` as ``{"A": "v2"}``; a depth is checked here, a name against the train later."""
    found: dict[str, str] = {}
    for item in items:
        name, equals, depth = (part.strip() for part in item.partition("="))
        fmu = depth.endswith(".fmu")
        if not (name and equals and (fmu or depth in list(Depth))):
            allowed = choice(depth, (*Depth, "the path of an .fmu file"))
            raise WrongChoice(f"--depth-at {item}: not NAME=DEPTH; of depths {allowed}")
        if name in found:
            raise WrongChoice(f"--depth-at {item}: {name} has been given {found[name]}; allowed is one depth")
        found[name] = str(Path(depth).absolute()) if fmu else depth
    return found
