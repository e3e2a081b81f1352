"""The linear investigations on the command line: campbell, modes, harmonic, reductions."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from orchestrator.cli.options import DEPTH_CHOICE, Depth, FigureFormats, Fmus, Format, Trust, guarded
from orchestrator.cli.wrong_use import one_of

if TYPE_CHECKING:
    from rich.console import Console

    from orchestrator.linear.case import LinearRequest

Source = Annotated[
    str,
    typer.Argument(
        metavar="SCENARIO|TRAIN",
        help="Bundled scenario or train (see [bold]bladeloss info[/bold]), TOML file, or a train's folder.",
    ),
]
FilmDepth = Annotated[
    Depth | None,
    typer.Option(
        metavar=DEPTH_CHOICE,
        parser=one_of(Depth, "--depth"),
        help="Of the films that are linearised; by default the scenario's.",
    ),
]
Out = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="Results; by default results/<NAME>-<COMMAND>."),
]
Highest = Annotated[
    float, typer.Option("--to", metavar="HZ", min=1.0, max=1000.0, help="Highest speed of rotation.")
]
EXIT = """\
[bold]Exit status[/bold]

  0    finished                  2    wrong input
  1    internal or file error    3    no static equilibrium on the films
"""

CAMPBELL_HELP = (
    "Campbell diagram: whirl frequencies over the speed of rotation.\n\n"
    "Of the free shaft, unreduced and reduced by IRS (default, and plain as published), Guyan and "
    "Craig-Bampton (CMS) to equal size, with the largest errors of the bending frequencies as a table, and "
    "their fall over the iterations of IRS. With [bold]--supported[/bold] on the films, linearised where the "
    "train runs at its rated speed."
)
MODES_HELP = (
    "Mode shapes of the supported train at rated speed: frequency, damping ratio, whirl direction.\n\n"
    "The films are linearised at the static equilibrium, which is found through the FMUs. A negative damping "
    "ratio means that the train is unstable."
)
HARMONIC_HELP = (
    "Unbalance response over the speed of rotation, unreduced and reduced.\n\n"
    "Amplitudes (largest half axis of the orbit) at bearings and wheels and the largest of the shaft, and "
    "forces of the bearings. Films are linearised at rated speed and kept: far from it the curve tells about "
    "these springs and dampers, not about the films."
)
REDUCTIONS_HELP = (
    "What a reduction costs: each beside the unreduced train.\n\n"
    "Largest errors of free-free frequencies, of eigenvalues on the films, of static bearing loads and of "
    "bearing forces from unbalance, because good free-free frequencies do not make a good coupled model; and "
    "the frequencies of IRS after each iteration."
)


def register(app: typer.Typer) -> None:
    """Add the commands."""
    app.command(help=CAMPBELL_HELP, epilog=_epilog("campbell", "campbell turbine --supported"))(campbell)
    app.command(help=MODES_HELP, epilog=_epilog("modes", "modes small --count 6"))(modes)
    app.command(help=HARMONIC_HELP, epilog=_epilog("harmonic", "harmonic paper --depth v2 --to 30"))(harmonic)
    app.command(help=REDUCTIONS_HELP, epilog=_epilog("reductions", "reductions turbine"))(reductions)


def campbell(
    source: Source = "paper",
    supported: Annotated[
        bool, typer.Option("--supported", help="On linearised films instead of free-free.")
    ] = False,
    count: Annotated[
        int, typer.Option(metavar="N", min=1, max=20, help="Bending frequencies in each direction.")
    ] = 8,
    highest: Highest = 50.0,
    depth: FilmDepth = None,
    out: Out = None,
    fmus: Fmus = None,
    formats: FigureFormats = None,
    trust: Trust = False,
) -> None:
    """Campbell diagram, see `CAMPBELL_HELP`."""

    def work(request: LinearRequest, console: Console) -> int:
        from orchestrator.commands.campbell import run

        return run(request, console, supported=supported, count=count, highest=highest)

    name = "campbell-supported" if supported else "campbell"
    _run(work, name, source, depth, out, fmus, formats, trust)


def modes(
    source: Source = "paper",
    count: Annotated[
        int, typer.Option(metavar="N", min=1, max=40, help="Modes, from the lowest frequency.")
    ] = 12,
    depth: FilmDepth = None,
    out: Out = None,
    fmus: Fmus = None,
    formats: FigureFormats = None,
    trust: Trust = False,
) -> None:
    """Mode shapes, see `MODES_HELP`."""

    def work(request: LinearRequest, console: Console) -> int:
        from orchestrator.commands.modes import run

        return run(request, console, count=count)

    _run(work, "modes", source, depth, out, fmus, formats, trust)


def harmonic(
    source: Source = "paper",
    highest: Highest = 50.0,
    depth: FilmDepth = None,
    out: Out = None,
    fmus: Fmus = None,
    formats: FigureFormats = None,
    trust: Trust = False,
) -> None:
    """Unbalance response, see `HARMONIC_HELP`."""

    def work(request: LinearRequest, console: Console) -> int:
        from orchestrator.commands.harmonic import run

        return run(request, console, highest=highest)

    _run(work, "harmonic", source, depth, out, fmus, formats, trust)


def reductions(
    source: Source = "paper",
    depth: FilmDepth = None,
    out: Out = None,
    fmus: Fmus = None,
    trust: Trust = False,
) -> None:
    """Errors of reductions, see `REDUCTIONS_HELP`."""

    def work(request: LinearRequest, console: Console) -> int:
        from orchestrator.commands.reductions import run

        return run(request, console)

    _run(work, "reductions", source, depth, out, fmus, None, trust)


def _run(
    work: Callable[[LinearRequest, Console], int],
    name: str,
    source: str,
    depth: Depth | None,
    out: Path | None,
    fmus: Path | None,
    formats: list[Format] | None,
    trust: bool,
) -> None:
    """Do a command's work on a scenario or a train."""

    def guarded_work() -> int:
        from rich.console import Console

        from orchestrator.fmi.folder import fmu_folder
        from orchestrator.linear.case import LinearRequest

        kinds = tuple(str(kind) for kind in formats or [Format.PNG])
        request = LinearRequest(name, source, depth and str(depth), out, fmus or fmu_folder(), kinds, trust)
        return work(request, Console())

    guarded(guarded_work)


def _epilog(command: str, example: str) -> str:
    shown = f"bladeloss {command}"
    return (
        "[bold]Examples[/bold]\n\n"
        f"  {shown:44s} the reference scenario\n"
        f"  {'bladeloss ' + example:44s} another\n\n{EXIT}"
    )
