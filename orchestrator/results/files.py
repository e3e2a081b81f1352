"""What a run leaves on disk: record, summary, scenario and figures, whole or marked as partial."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from orchestrator.errors import NotWrittenError
from orchestrator.results.folder import FIGURES, PARTIAL, RUN_FILES, free_room, result_folder
from orchestrator.results.record_files import write_record
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

    def draw() -> None:
        add_figures([result.record], folder, train, summary.analysed, formats)

    with room_for([result.record], folder):
        data_then_figures(
            folder,
            lambda fresh: write_data(result, summary, scenario, fresh),
            draw if formats and summary.phases else None,
        )


def data_then_figures(
    folder: Path,
    write: Callable[[Path], None],
    draw: Callable[[], None] | None,
    ours: Sequence[str] = RUN_FILES,
) -> None:
    """Write the data, all or nothing, then the figures likewise; the folder is marked as partial till then.

    Parameters
    ----------
    folder : Path
        Where the results go.
    write : callable
        Fills a new folder with the data; may mark it as partial itself.
    draw : callable or None
        Adds the figures to `folder`, if there are any to be.
    ours : sequence of str
        See `result_folder`.
    """
    with result_folder(folder, ours) as fresh:
        write(fresh)
        finished = not (fresh / PARTIAL).exists()
        if draw is not None and finished:
            (fresh / PARTIAL).write_text(NO_FIGURES, encoding="utf-8")
    if draw is not None:
        draw()
        if finished:
            (folder / PARTIAL).unlink()


def add_figures(
    records: Sequence[xr.Dataset], folder: Path, train: Train, bearing: str | None, formats: Sequence[str]
) -> None:
    """Write the figures of one or several runs into the folder of their results."""
    from orchestrator.results.figures.write import write_figures  # matplotlib loads for half a second

    with result_folder(folder / FIGURES) as fresh:
        write_figures(records, fresh, train=train, bearing=bearing, formats=formats)


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
