"""What the commands share: choices of options, and how a command ends."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from typing import Annotated

import typer

from orchestrator.cli.wrong_use import one_of

Trust = Annotated[
    bool,
    typer.Option("--trust", help="Run FMUs that bladeloss did not build: native code, with all your rights."),
]

Budget = Annotated[
    float,
    typer.Option(min=0.0, metavar="SECONDS", help="Give up a unit that takes longer for a call; 0: never."),
]


class Depth(StrEnum):
    """Modelling depth of a bearing."""

    V1 = "v1"
    V2 = "v2"
    V3 = "v3"


class Coupling(StrEnum):
    """How rotor and bearings exchange values."""

    LINEAR_IMPLICIT = "linear-implicit"
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
        metavar="v1|v2|v3",
        parser=one_of(Depth, "--depth"),
        help="All bearings: v1 Reynolds with misalignment, v2 aligned, v3 short bearing.",
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


def guarded(work: Callable[[], int]) -> None:
    """Do the work; an error becomes its text on stderr and its exit status."""
    from orchestrator.errors import OrchestratorError, outcome_of
    from orchestrator.master.interrupt import handled, raise_at_once

    text = ""
    try:
        with handled(raise_at_once):
            status = work()
    except OrchestratorError as error:
        text, status = error.text, error.exit_status
    except OSError as error:
        text, status = str(error), 1
    except KeyboardInterrupt as error:
        outcome = outcome_of(error)
        text, status = f"{outcome.value}; nothing was written", outcome.status
    if text:
        typer.secho(f"error: {text}", err=True, fg="red")
    raise typer.Exit(status)
