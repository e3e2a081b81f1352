"""From a result to the folder of a run and the exit status of its command."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rich.console import Console
from rich.text import Text

from orchestrator.case.case import Case
from orchestrator.case.certify import certify
from orchestrator.case.request import RunRequest
from orchestrator.errors import NotWrittenError, outcome_of
from orchestrator.outcome import Outcome
from orchestrator.results.certificate import Certificate
from orchestrator.results.files import add, write_all
from orchestrator.results.folder import FIGURES, partial_folder
from orchestrator.results.record import outcome_attributes
from orchestrator.results.record_files import RECORD_FILE
from orchestrator.results.result import Result
from orchestrator.results.summary import summarise
from orchestrator.results.summary_table import SummaryTable
from orchestrator.results.verdicts.limits import ATTRIBUTE, load_limits, own_file, to_text


def conclude(
    case: Case,
    request: RunRequest,
    folder: Path,
    results: tuple[Result, Result | None],
    console: Console,
    errors: Console,
) -> int:
    """Write what a run gave, say what came out, and return the exit status.

    Parameters
    ----------
    case, request : Case, RunRequest
        What was run, and what was asked for.
    folder : Path
        Of the results; what did not finish goes beside it.
    results : tuple of Result
        Of the run, and of the same run at half the step or None: with it a certificate goes into summary
        and record. A run that it does not certify is unresolved; where it failed that is the exit status.
    console, errors : rich.console.Console
        For output and for what went wrong.
    """
    result, half = results
    summary = summarise(result, analysed=request.bearing)
    if half is not None:
        certificate = certify(summary, summarise(half, analysed=request.bearing))
        result = _certified(result, half, certificate)
        summary = replace(summarise(result, analysed=request.bearing), certificate=certificate)
    outcome, message = result.outcome, f"{summary.message}. {summary.advice}"
    place = folder if outcome.ok else partial_folder(folder)
    written, before = False, _written_at(place)
    if outcome.ok or summary.phases:
        try:
            write_all(result, summary, case.scenario, case.train, request.formats, place)
            if request.report and summary.phases:
                from orchestrator.report.source import results_of  # loads much that a run does not need
                from orchestrator.report.write import FILE, write_report

                source = results_of([result.record])
                add(place, "report", lambda fresh: write_report(source, fresh / FILE, request.bearing))
            written = True
        except NotWrittenError as error:
            outcome, message = Outcome.NOT_WRITTEN, error.text
            if request.checkpoint is not None:
                message += " The checkpoint is kept: bladeloss resume goes on from there."
        except KeyboardInterrupt as error:
            outcome = outcome_of(error)
            message = f"the run had ended, and its data are complete in {place}; its figures are not drawn"
            if _written_at(place) == before:
                message = f"the run had ended, but its data are not written in {place}"
    console.print(SummaryTable(summary))  # whatever goes wrong from here on, the results are there
    asked, used = case.scenario.reduction, result.record.attrs.get("reduction_used")
    if used not in (None, asked):
        console.print(f"Reduction: {used}", highlight=False, soft_wrap=True)
    if written:
        kind = "Results" if result.outcome.ok else "Partial results"
        console.print(f"\n{kind} in {place}", highlight=False, soft_wrap=True)
        if request.formats and summary.phases:
            console.print(f"Figures in {place / FIGURES}", highlight=False, soft_wrap=True)
        if request.report and summary.phases:
            console.print(f"Report in {place / FILE}", highlight=False, soft_wrap=True)
    if outcome.ok and half is not None and not half.outcome.ok:
        outcome, message = half.outcome, f"the certificate's run at half the step: {half.message}"
    if not outcome.ok:
        text = f" {outcome.value} (exit status {outcome.status}): {message}"
        errors.print(Text.assemble(("error:", "red"), text), soft_wrap=True)
    return outcome.status


def _written_at(folder: Path) -> int:
    """When the record in a folder was written, in ns; 0 without one."""
    path = folder / RECORD_FILE
    return path.stat().st_mtime_ns if path.is_file() else 0


def completed(case: Case, result: Result) -> Result:
    """The result with the limits of its machine in the record."""
    limits = to_text(load_limits(own_file(case.scenario)))
    return replace(result, record=result.record.assign_attrs({ATTRIBUTE: limits}))


def _certified(result: Result, half: Result, certificate: Certificate) -> Result:
    """Return the result with its certificate, as unresolved where a finished half step contradicts it."""
    record = result.record.assign_attrs(certificate.attributes())
    if not (result.outcome.ok and half.outcome.ok and certificate.doubt):
        return replace(result, record=record)
    outcome, message = Outcome.UNRESOLVED, f"the certificate: {certificate.doubt}"
    record = record.assign_attrs(outcome_attributes(outcome, message))
    return replace(result, record=record, outcome=outcome, message=message)
