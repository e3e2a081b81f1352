"""``bladeloss report``: from folders of results to a page that says what they mean."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from orchestrator.report.ensemble.page import write_study_report
from orchestrator.report.facts import conclusion
from orchestrator.report.library import require_library, require_paper
from orchestrator.report.source import ReportError, load_results
from orchestrator.report.write import FILE, write_print, write_report
from orchestrator.results import manifest
from orchestrator.results.ensemble.files import is_study, read_study
from orchestrator.results.files import add
from orchestrator.results.verdicts.limits import load_limits


@dataclass(frozen=True)
class ReportRequest:
    """What the command line asks for.

    Attributes
    ----------
    results : sequence of Path
        Folders of runs, or that of a study.
    out : Path or None
        The page; None: ``report.html`` in the folder of a single run, or else in the current one.
    bearing : str or None
        That the page opens with; None: the one with the worst verdict.
    limits : Path or None
        Limits in place of those that the runs were given.
    pdf : bool
        Write the same to be printed beside it.
    """

    results: Sequence[Path]
    out: Path | None = None
    bearing: str | None = None
    limits: Path | None = None
    pdf: bool = False

    @property
    def file(self) -> Path:
        """Where the page goes."""
        if self.out is not None:
            return self.out
        first = self.results[0]
        folder = first if first.is_dir() else first.parent
        return folder / FILE if len(self.results) == 1 else Path(FILE)


def run(request: ReportRequest, console: Console) -> int:
    """Write the report and say what it concludes.

    Raises
    ------
    OrchestratorError
        Results that are none, limits that cannot be read, no plotting library.
    """
    require_library()
    if request.pdf:
        require_paper()
    if any(is_study(path) for path in request.results):
        return _of_a_study(request, console)
    if request.file.is_dir():
        raise ReportError(f"{request.file}: is a folder; --out takes the file of the page, such as {FILE}")
    if request.file.suffix.casefold() == ".pdf":
        raise ReportError(
            f"{request.file}: --out takes the file of the page, such as {FILE}; --pdf prints beside it"
        )
    limits = None if request.limits is None else load_limits(request.limits)
    results = load_results(request.results, limits)
    path = request.file
    bearing, paper = request.bearing, path.with_suffix(".pdf")
    own = path.name == FILE and bool(manifest.read(path.parent))  # a part of these results, listed with them

    def write(folder: Path) -> None:
        write_report(results, folder / path.name, bearing)
        if request.pdf:
            write_print(results, folder / paper.name, bearing)

    if own:
        add(path.parent, "report", write)
    else:
        write(path.parent)
    for result in results:
        said = conclusion(result).sentence(result.name)
        console.print(said, highlight=False, markup=False, soft_wrap=True)
    said = ", ".join(
        f"{file} ({file.stat().st_size / 1e6:.1f} MB)" for file in (path, paper)[: 1 + request.pdf]
    )
    console.print(f"\nReport in {said}", highlight=False, markup=False, soft_wrap=True)
    return 0


def _of_a_study(request: ReportRequest, console: Console) -> int:
    """Write the page of a study."""
    folder = request.results[0]
    given = {"--bearing": request.bearing, "--limits": request.limits, "--pdf": request.pdf or None}
    others = [name for name, value in given.items() if value is not None]
    if others or len(request.results) > 1:
        what = f"{', '.join(others)} is" if others else "several are"
        raise ReportError(f"{folder}: a study, of which {what} not shown; allowed is one, with --out")
    path = write_study_report(read_study(folder), folder, request.file)
    said = f"Report in {path} ({path.stat().st_size / 1e6:.1f} MB)"
    console.print(said, highlight=False, markup=False, soft_wrap=True)
    return 0
