"""The command ``bladeloss``.

Only the options are declared here; what a command does is imported when it runs, so that
``--help`` answers at once.
"""

from __future__ import annotations

import gc
import sys
from pathlib import Path
from typing import Annotated

import typer

from orchestrator.cli import compare as cli_compare
from orchestrator.cli import export_ssp as cli_ssp
from orchestrator.cli import linear as cli_linear
from orchestrator.cli import report as cli_report
from orchestrator.cli import resume as cli_resume
from orchestrator.cli import run as cli_run
from orchestrator.cli import study as cli_study
from orchestrator.cli.options import guarded
from orchestrator.cli.unneeded import hidden
from orchestrator.cli.wrong_use import Commands

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
cli_report.register(app)
cli_ssp.register(app)
cli_resume.register(app)
cli_run.register(app)
cli_study.register(app)


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


@app.command()
def build(
    out: Annotated[Path, typer.Option(metavar="DIR", help="Folder of the FMUs.")] = Path("bladeloss-fmus"),
    train: Annotated[
        list[str],
        typer.Option(metavar="TRAIN", help="Bundled train or folder with train.toml; repeatable."),
    ] = ["turbine"],  # noqa: B006
    ssp: Annotated[
        bool, typer.Option(help="With the turbine: also bladeloss.ssp, a blade fracture on it.")
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
def info(
    train: Annotated[
        str | None, typer.Argument(help="A bundled train, or a folder with train.toml and shaft.csv.")
    ] = None,
) -> None:
    """List the bundled scenarios and trains; or show a train as it is read: shaft, loads, what sits on it."""

    def work() -> int:
        from rich.console import Console

        from orchestrator.commands.info import show, show_train

        if train is None:
            show(Console())
        else:
            show_train(train, Console())
        return 0

    guarded(work)


def main() -> None:
    """Entry point of the command."""
    from orchestrator.case.watched import command

    # imports make some hundred thousand objects that stay: to look for garbage there takes a tenth of a start
    gc.set_threshold(50_000, 20, 20)
    with command(), hidden():
        sys.exit(app())


if __name__ == "__main__":
    main()
