"""``bladeloss export-ssp`` on the command line."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from orchestrator.cli.options import Fmus, Trust, guarded

EXPORT_HELP = (
    "Write a scenario as an SSP (SSP 1.0): its system and its start, for other co-simulation tools.\n\n"
    "FILE.ssp connects the affine law, FILE_force.ssp the forces alone. Both hold FMUs, the parameters of "
    "the scenario and the static equilibrium, which is solved here. [bold]bladeloss run FILE.ssp[/bold] runs "
    "it, also after it was edited elsewhere."
)


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command(name="export-ssp", help=EXPORT_HELP)(export_ssp)


def export_ssp(
    scenario: Annotated[
        str, typer.Argument(help="A bundled scenario (see [bold]bladeloss info[/bold]) or a TOML file.")
    ] = "paper",
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="By default <SCENARIO>.ssp in the current folder.")
    ] = None,
    fmus: Fmus = None,
    trust: Trust = False,
) -> None:
    """Export a scenario, see `EXPORT_HELP`."""

    def work() -> int:
        from rich.console import Console

        from orchestrator.commands.export_ssp import export_scenario
        from orchestrator.fmi.folder import fmu_folder

        export_scenario(scenario, out, fmus or fmu_folder(), Console(), trust=trust)
        return 0

    guarded(work)
