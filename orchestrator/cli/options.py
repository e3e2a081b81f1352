"""What the commands share: choices of options, and how a command ends."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import StrEnum
from inspect import Signature, signature
from pathlib import Path
from typing import Annotated, Any, TypeVar, get_type_hints

import typer

from bearing_fmu import depths
from orchestrator.cli.steadfast import steadfast_output
from orchestrator.cli.wrong_use import WrongChoice, one_of


def finite(context: typer.Context, option: typer.CallbackParam, value: float | None) -> float | None:
    """Refuse a number of seconds that is infinite or none at all."""
    if value is not None and not math.isfinite(value):
        raise WrongChoice(f"{option.opts[0]} {value}: allowed is a finite number")
    return value


Trust = Annotated[
    bool,
    typer.Option("--trust", help="Run FMUs that bladeloss did not build: native code, with all your rights."),
]

Budget = Annotated[
    float,
    typer.Option(
        min=0.0,
        metavar="SECONDS",
        callback=finite,
        help="Give up a unit that takes longer for a call; 0: never.",
    ),
]

Fmus = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="Folder of the FMUs; by default in the user's cache. May be shared."),
]


Depth = StrEnum("Depth", {name: name for name in depths.names()})  # type: ignore[misc]
"""Modelling depth of a bearing."""
DEPTH_CHOICE = "|".join(depths.names())


class Coupling(StrEnum):
    """How rotor and bearings exchange values."""

    LINEAR_IMPLICIT = "linear-implicit"
    MULTIRATE = "multirate"
    NEWTON = "newton"
    IQN_ILS = "iqn-ils"
    GAUSS_SEIDEL = "gauss-seidel"
    JACOBI = "jacobi"


class Reduction(StrEnum):
    """Reduction of the shaft."""

    IRS = "irs"
    IRS_PLAIN = "irs-plain"
    GUYAN = "guyan"
    CRAIG_BAMPTON = "craig-bampton"
    NONE = "none"


class Format(StrEnum):
    """File type of a figure."""

    PNG = "png"
    PDF = "pdf"
    SVG = "svg"


GivenDepth = Annotated[
    Depth | None,
    typer.Option(
        metavar=DEPTH_CHOICE,
        parser=one_of(Depth, "--depth"),
        help=f"All bearings: {'; '.join(f'{depth.name} {depth.title}' for depth in depths.depths())}.",
    ),
]
FigureFormats = Annotated[
    list[Format] | None,
    typer.Option(
        "--format",
        metavar="TYPE",
        parser=one_of(Format, "--format"),
        help="Of the figures: png (default), pdf, svg; repeatable.",
    ),
]


_Options = TypeVar("_Options")


def command_of(options: type[_Options], work: Callable[[_Options], int]) -> Callable[..., None]:
    """Return a command whose options are the fields of a dataclass.

    Parameters
    ----------
    options : type
        A dataclass; the annotations of its fields are typer's.
    work : callable
        Gets one, and returns the exit status; see `guarded`.
    """

    def command(**given: Any) -> None:
        guarded(lambda: work(options(**given)))

    hints = get_type_hints(options, include_extras=True)
    own = [p.replace(annotation=hints[p.name]) for p in signature(options).parameters.values()]
    command.__signature__ = Signature(own)  # type: ignore[attr-defined]
    command.__annotations__ = hints
    return command


def guarded(work: Callable[[], int]) -> None:
    """Do the work; an error becomes its text on stderr and its exit status."""
    from orchestrator.errors import OrchestratorError, outcome_of
    from orchestrator.master.interrupt import handled, raise_at_once

    text = ""
    try:
        with steadfast_output(), handled(raise_at_once):
            status = work()
    except OrchestratorError as error:
        text, status = error.text, error.exit_status
    except OSError as error:
        text, status = str(error), 1
    except KeyboardInterrupt as error:
        outcome = outcome_of(error)
        text, status = f"{outcome.value}; nothing was written", outcome.status
    except MemoryError:
        text, status = "there is not enough memory; a longer record.interval or fewer --jobs help", 1
    if text:
        with steadfast_output():
            typer.secho(f"error: {text}", err=True, fg="red")
    raise typer.Exit(status)
