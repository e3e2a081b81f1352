"""The linear investigations on the command line: campbell, modes, stability, harmonic, reductions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from orchestrator.cli.options import DEPTH_CHOICE, Depth, FigureFormats, Fmus, Format, Trust, command_of
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
    float | None,
    typer.Option(
        "--to",
        metavar="HZ",
        min=0.1,
        max=5000.0,
        help="Highest speed of rotation; by default twice the rated one.",
    ),
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
    "their fall over the iterations of IRS. With [bold]--supported[/bold] on the films, solved anew "
    "at every speed; modes are followed through crossings."
)
MODES_HELP = (
    "Mode shapes of the supported train at rated or any speed: frequency, damping ratio, whirl direction.\n\n"
    "The films are linearised at the static equilibrium, which is found through the FMUs. A negative damping "
    "ratio means that the train is unstable."
)
STABILITY_HELP = (
    "Stability and critical speeds: is the train stable, up to which speed, what does it pass through?\n\n"
    "Damping ratio and logarithmic decrement of the least damped modes over speed, on films solved anew at "
    "each; the threshold of instability; critical speeds, the peaks of the unbalance response, with "
    "amplification factor and separation margin (API 684); and the map of undamped critical speeds over the "
    "stiffness of the bearings."
)
HARMONIC_HELP = (
    "Unbalance response over the speed of rotation, unreduced and reduced.\n\n"
    "Amplitudes (largest half axis of the orbit) at bearings and wheels and the largest of the shaft, forces "
    "of the bearings, and amplitude and phase at the probes of each bearing (Bode diagram). Films are solved "
    "anew at every speed; speeds are close where resonances are sharp."
)
BEARING_HELP = (
    "One bearing on its own, every depth side by side: what a film of this shape can do.\n\n"
    "Static curves over the eccentricity (Sommerfeld number, attitude angle, side flow, friction, "
    "temperature rise, largest pressure); stiffness and damping over Sommerfeld number and speed; the speed "
    "up to which a rigid rotor is stable; the pressure over the film as a picture, of a mass-conserving film "
    "its content, too. Of a train or scenario, or of a TOML file of its own: speed, load, the table bearing "
    "with the keys of a train's bearing, and film; load_angle turns the load. No FMU is built."
)
REDUCTIONS_HELP = (
    "What a reduction costs: each beside the unreduced train.\n\n"
    "Largest errors of free-free frequencies, of eigenvalues on the films, of static bearing loads and of "
    "bearing forces from unbalance, because good free-free frequencies do not make a good coupled model; and "
    "the frequencies of IRS after each iteration."
)


@dataclass(frozen=True)
class LinearOptions:
    """Options of every linear investigation; see `orchestrator.linear.case.LinearRequest`."""

    source: Source = "paper"
    depth: FilmDepth = None
    out: Out = None
    fmus: Fmus = None
    trust: Trust = False

    def request(self, command: str, formats: list[Format] | None = None) -> LinearRequest:
        """What is asked for."""
        from orchestrator.fmi.folder import fmu_folder
        from orchestrator.linear.case import LinearRequest

        kinds = tuple(str(kind) for kind in formats or [Format.PNG])
        depth, fmus = self.depth and str(self.depth), self.fmus or fmu_folder()
        return LinearRequest(command, self.source, depth, self.out, fmus, kinds, self.trust)


@dataclass(frozen=True)
class CampbellOptions(LinearOptions):
    """Options of campbell."""

    supported: Annotated[
        bool, typer.Option("--supported", help="On linearised films instead of free-free.")
    ] = False
    count: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            min=1,
            max=20,
            help="Bending frequencies in each direction; by default 8, or as many as there are.",
        ),
    ] = None
    highest: Highest = None
    formats: FigureFormats = None


@dataclass(frozen=True)
class ModesOptions(LinearOptions):
    """Options of modes."""

    count: Annotated[
        int, typer.Option(metavar="N", min=1, max=40, help="Modes, from the lowest frequency.")
    ] = 12
    speed: Annotated[
        float | None,
        typer.Option(metavar="HZ", min=0.0, max=5000.0, help="Speed of rotation; by default the rated one."),
    ] = None
    formats: FigureFormats = None


@dataclass(frozen=True)
class OverSpeedOptions(LinearOptions):
    """Options of stability."""

    highest: Highest = None
    formats: FigureFormats = None


@dataclass(frozen=True)
class HarmonicOptions(OverSpeedOptions):
    """Options of harmonic."""

    probes: Annotated[
        list[float] | None,
        typer.Option(
            "--probe", metavar="DEG", min=-360.0, max=360.0,
            help="Angle of a probe at each bearing from x to y; repeatable, by default 45 and 135.",
        ),
    ] = None  # fmt: skip


@dataclass(frozen=True)
class BearingOptions:
    """Options of bearing."""

    source: Source = "turbine"
    name: Annotated[
        str | None, typer.Argument(metavar="NAME", help="Of the bearing; by default the first.")
    ] = None
    depth: Annotated[
        list[Depth] | None,
        typer.Option(
            metavar=DEPTH_CHOICE,
            parser=one_of(Depth, "--depth"),
            help="Repeatable; by default all with a film.",
        ),
    ] = None
    speed: Annotated[
        float | None,
        typer.Option(metavar="HZ", min=0.01, max=5000.0, help="Speed of rotation; by default the rated one."),
    ] = None
    load: Annotated[
        float | None,
        typer.Option(metavar="N", min=1e-3, help="With gravity; by default what the train puts on it."),
    ] = None
    load_angle: Annotated[
        float | None,
        typer.Option(
            metavar="DEG",
            min=-360.0,
            max=360.0,
            help="Direction of the load, from x to y; by default with gravity, -90.",
        ),
    ] = None
    out: Out = None
    formats: FigureFormats = None

    def request(self) -> LinearRequest:
        """What is asked for."""
        return LinearOptions(self.source, out=self.out).request("bearing", self.formats)


def register(app: typer.Typer) -> None:
    """Add the commands."""
    _add(app, "campbell", CAMPBELL_HELP, "campbell turbine --supported", CampbellOptions, campbell)
    _add(app, "modes", MODES_HELP, "modes small --count 6", ModesOptions, modes)
    _add(app, "stability", STABILITY_HELP, "stability small --depth v2", OverSpeedOptions, stability)
    _add(app, "harmonic", HARMONIC_HELP, "harmonic paper --depth v2 --to 30", HarmonicOptions, harmonic)
    _add(app, "bearing", BEARING_HELP, "bearing small front --depth v1", BearingOptions, bearing)
    _add(app, "reductions", REDUCTIONS_HELP, "reductions turbine", LinearOptions, reductions)


def campbell(options: CampbellOptions) -> int:
    """Campbell diagram, see `CAMPBELL_HELP`."""
    from orchestrator.commands.campbell import run

    request = options.request("campbell-supported" if options.supported else "campbell", options.formats)
    return run(request, _console(), supported=options.supported, count=options.count, highest=options.highest)


def modes(options: ModesOptions) -> int:
    """Mode shapes, see `MODES_HELP`."""
    from orchestrator.commands.modes import run

    return run(
        options.request("modes", options.formats), _console(), count=options.count, hertz=options.speed
    )


def stability(options: OverSpeedOptions) -> int:
    """Stability and critical speeds, see `STABILITY_HELP`."""
    from orchestrator.commands.stability import run

    return run(options.request("stability", options.formats), _console(), highest=options.highest)


def harmonic(options: HarmonicOptions) -> int:
    """Unbalance response, see `HARMONIC_HELP`."""
    from orchestrator.commands.harmonic import run

    request = options.request("harmonic", options.formats)
    return run(request, _console(), highest=options.highest, probes=options.probes or [45.0, 135.0])


def bearing(options: BearingOptions) -> int:
    """One bearing on its own, see `BEARING_HELP`."""
    from orchestrator.commands.bearing import run

    names = [str(depth) for depth in options.depth or ()]
    asked = {"hertz": options.speed, "load": options.load, "load_angle": options.load_angle}
    return run(options.request(), _console(), name=options.name, depths=names, **asked)


def reductions(options: LinearOptions) -> int:
    """Errors of reductions, see `REDUCTIONS_HELP`."""
    from orchestrator.commands.reductions import run

    return run(options.request("reductions"), _console())


def _add(
    app: typer.Typer, name: str, text: str, example: str, options: type, work: Callable[..., int]
) -> None:
    shown = f"bladeloss {name}"
    own = "the first bearing of the train turbine" if options is BearingOptions else "the reference scenario"
    epilog = f"[bold]Examples[/bold]\n\n  {shown:44s} {own}\n  {'bladeloss ' + example:44s} another\n\n{EXIT}"
    app.command(name=name, help=text, epilog=epilog)(command_of(options, work))


def _console() -> Console:
    from rich.console import Console

    return Console()
