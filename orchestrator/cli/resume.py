"""``bladeloss resume``: its options."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from orchestrator.cli.options import Fmus, Trust, guarded


def register(app: typer.Typer) -> None:
    """Add the command to the application."""
    app.command()(resume)


def resume(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="The --out of the run, or its checkpoint.")],
    fmus: Fmus = None,
    trust: Trust = False,
) -> None:
    """Go on with a run that was killed, from its last checkpoint.

    The run must have been started with [bold]--checkpoint EVERY[/bold]. Its record is that of an
    uninterrupted run, bit for bit.
    """

    def work() -> int:
        from rich.console import Console

        from orchestrator.commands.resume import resume as resume_run
        from orchestrator.fmi.folder import fmu_folder

        return resume_run(folder, fmus or fmu_folder(), Console(), Console(stderr=True), trust=trust)

    guarded(work)
