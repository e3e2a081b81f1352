"""Read, judge and report results."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from orchestrator.report.facts import conclusion as conclusion_of
from orchestrator.report.source import load_results, results_of
from orchestrator.report.write import FILE, write_report
from orchestrator.results.verdicts.judge import judge, own_limits
from orchestrator.results.verdicts.limits import load_limits

Run = xr.Dataset | str | Path


def load(result: str | Path) -> xr.Dataset:
    """The record of a run, from its folder or ``record.nc``; of a checkpoint's folder, the record so far.

    Raises
    ------
    Error
        When there is none.
    """
    return load_results([Path(result)])[0].record


def verdicts(run: Run, *, limits: str | Path | None = None) -> xr.Dataset:
    """What a run is held against: one row a limit, phase and bearing (dimension ``verdict``).

    Parameters
    ----------
    run : xarray.Dataset, str or Path
        A record, or where it lies.
    limits : str or Path, optional
        A file of limits in place of those of the run.
    """
    record = run if isinstance(run, xr.Dataset) else load(run)
    found = judge(record, own_limits(record) if limits is None else load_limits(Path(limits)))
    columns = {
        "limit": [v.limit for v in found],
        "phase": [v.phase for v in found],
        "place": [v.place for v in found],
        "value": [v.value for v in found],
        "bound": [v.bound for v in found],
        "share": [v.share for v in found],
        "grade": [str(v.grade) for v in found],
        "instant": [float("nan") if v.instant is None else v.instant for v in found],
        "note": [v.note for v in found],
        "source": [v.source_text() for v in found],
    }
    return xr.Dataset({name: ("verdict", values) for name, values in columns.items()})


def conclusion(run: Run) -> str:
    """What an engineer would conclude from a run, and from which figures, in a line."""
    record = run if isinstance(run, xr.Dataset) else load(run)
    found = conclusion_of(results_of([record])[0])
    return f"{found.action}; {found.grounds}"


def report(*runs: Run, out: str | Path = FILE, bearing: str | None = None) -> Path:
    """Make the page of one or several runs, side by side; needs the extra ``report``.

    Parameters
    ----------
    *runs : xarray.Dataset, str or Path
        Records, or folders of results.
    out : str or Path
        The page.
    bearing : str, optional
        That it opens with; by default the one with the worst verdict.

    Returns
    -------
    Path
        The page.
    """
    records = [run if isinstance(run, xr.Dataset) else load(run) for run in runs]
    places = [Path(run) for run in runs if not isinstance(run, xr.Dataset)]
    results = results_of(records, (), places if len(places) == len(runs) else ())
    return write_report(results, Path(out), bearing)
