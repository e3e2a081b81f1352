"""What a run leaves on disk: record, summary, scenario and figures, whole or marked as partial."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from orchestrator.errors import NotWrittenError
from orchestrator.master.interrupt import held_back
from orchestrator.results.folder import FIGURES, PARTIAL, free_room
from orchestrator.results.record_files import write_record
from orchestrator.results.replacing import result_folder
from orchestrator.results.summary_table import to_text
from orchestrator.scenario.file import scenario_toml

if TYPE_CHECKING:
    import xarray as xr

    from orchestrator.results.result import Result
    from orchestrator.results.summary import RunSummary
    from orchestrator.scenario.scenario import Scenario
    from rotor_fmu.train.train import Train

NO_FIGURES = "The figures are not written; record and summary are complete.\n"


def write_data(result: Result, summary: RunSummary, scenario: Scenario, folder: Path) -> None:
    """Write record, summary and scenario of a run, and the mark of a partial one."""
    write_record(result.record, folder)
    (folder / "summary.txt").write_text(to_text(summary), encoding="utf-8")
    (folder / "summary.json").write_text(summary.to_json(), encoding="utf-8")
    (folder / "scenario.toml").write_text(scenario_toml(scenario), encoding="utf-8")
    if not summary.finished:
        reason = f"{summary.outcome} at t = {summary.simulated:.6g} s\n{summary.message}\n{summary.advice}\n"
        (folder / PARTIAL).write_text(reason, encoding="utf-8")


def write_all(
    result: Result,
    summary: RunSummary,
    scenario: Scenario,
    train: Train,
    formats: Sequence[str],
    folder: Path,
) -> None:
    """Write what a run leaves behind: first the data, all or nothing, then the figures likewise.

    Raises
    ------
    NotWrittenError
        When the disk is full, or cannot be written to.
    """

    def draw(fresh: Path) -> None:
        add_figures([result.record], fresh, train, summary.analysed, formats)

    with room_for([result.record], folder):
        data_then_figures(
            folder,
            lambda fresh: write_data(result, summary, scenario, fresh),
            draw if formats and summary.phases else None,
        )


def data_then_figures(
    folder: Path, write: Callable[[Path], None], draw: Callable[[Path], None] | None
) -> None:
    """Write the data, all or nothing, then the figures likewise; the folder is marked as partial till then.

    One signal to end is held back until the data are in their place.

    Parameters
    ----------
    folder : Path
        Where the results go.
    write : callable
        Fills a new folder with the data; may mark it as partial itself.
    draw : callable or None
        Writes the figures into a folder, if there are any to be.

    Raises
    ------
    NotWrittenError
        When the data are in their place and the figures are not, whatever the reason.
    """
    with held_back(), result_folder(folder) as fresh:
        write(fresh)
        finished = not (fresh / PARTIAL).exists()
        if draw is not None and finished:
            (fresh / PARTIAL).write_text(NO_FIGURES, encoding="utf-8")
    if draw is None:
        return
    add(folder, "figures", draw, (PARTIAL,) if finished else ())


def add(folder: Path, what: str, draw: Callable[[Path], object], without: Sequence[str] = ()) -> None:
    """Add what is drawn into a folder to results that are complete.

    Raises
    ------
    NotWrittenError
        When it is not drawn, whatever it stumbled over: it is not worth the results.
    """
    try:
        with result_folder(folder, adding=True, without=without) as fresh:
            draw(fresh)
    except (OSError, NotWrittenError):
        raise
    except Exception as error:
        reason = " ".join(f"{type(error).__name__}: {error}".split())
        text = f"{folder}: the data are complete, the {what} not drawn: {reason}"
        raise NotWrittenError(text) from error


def add_figures(
    records: Sequence[xr.Dataset], folder: Path, train: Train, bearing: str | None, formats: Sequence[str]
) -> None:
    """Write the figures of one or several runs into a folder of results."""
    from orchestrator.results.figures.write import write_figures  # matplotlib loads for half a second

    write_figures(records, folder / FIGURES, train=train, bearing=bearing, formats=formats)


@contextmanager
def room_for(records: Sequence[xr.Dataset], folder: Path) -> Iterator[None]:
    """Say what is missing when results cannot be written to a folder."""
    try:
        yield
    except OSError as error:
        needed = sum(record.nbytes for record in records) / 1e6
        raise NotWrittenError(
            f"{folder}: results not written: {error.strerror or error}; about {needed:.3g} MB are needed, "
            f"{free_room(folder) / 1e6:.3g} MB are free"
        ) from None
