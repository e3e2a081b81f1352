"""Make the report of one or several results, and write it whole or not at all."""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from orchestrator.errors import NotWrittenError
from orchestrator.report.library import require_paper
from orchestrator.report.page import page
from orchestrator.report.panels.bode import bode
from orchestrator.report.panels.orbits import orbits
from orchestrator.report.panels.panel import Panel
from orchestrator.report.panels.pressure import film_pressures
from orchestrator.report.panels.series import bearing_series, shaft_series
from orchestrator.report.panels.shaft import deformed_shafts
from orchestrator.report.panels.spectra import spectra, waterfalls
from orchestrator.report.source import ReportError, Result, shown_bearing
from orchestrator.results.replacing import umask

FILE = "report.html"
_SIGN = 83
"""Letters of the line behind what is written, by which it is known as written here."""


def report_text(results: Sequence[Result], bearing: str | None = None) -> str:
    """The page of the results; it opens with the named bearing, or the one with the worst verdict.

    Raises
    ------
    ReportError, LibraryMissingError
        No such bearing; no plotting library.
    """
    return page(results, tuple(_panels(results)), shown_bearing(results, bearing))


def write_report(results: Sequence[Result], path: Path, bearing: str | None = None) -> Path:
    """Write the page; otherwise see `report_text`.

    Raises
    ------
    ReportError
        When something that this program did not write, or that was changed since, is in its place.
    NotWrittenError
        When it cannot be written; an earlier one stays as it is.
    """
    return write_whole(path, lambda: report_text(results, bearing).encode())


def write_print(results: Sequence[Result], path: Path, bearing: str | None = None) -> Path:
    """Write the same to be printed, as a PDF; raises as `write_report`, and without pypdf."""
    require_paper()
    from orchestrator.report.print import printed  # matplotlib loads for half a second

    return write_whole(path, lambda: printed(results, shown_bearing(results, bearing)))


def write_whole(path: Path, make: Callable[[], bytes]) -> Path:
    """Write a file signed at its end, whole or not at all; raises as `write_report`."""
    if (path.exists() or path.is_symlink()) and not _as_written(path):
        raise ReportError(
            f"{path}: is no report, or was changed since, and is left as it is; --out takes another file"
        )
    content = make()
    content += _sign(content)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(prefix=".report_", suffix=path.suffix, dir=path.parent)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(content)
            Path(name).chmod(0o666 & ~umask())
            Path(name).replace(path)
        finally:
            Path(name).unlink(missing_ok=True)
    except OSError as error:
        raise NotWrittenError(f"{path}: report not written: {error.strerror or error}") from None
    return path


def _sign(content: bytes) -> bytes:
    """A comment behind the end of a page, or of a PDF."""
    digest = hashlib.sha256(content).hexdigest()
    text = "% bladeloss {}" if content.startswith(b"%PDF") else "<!-- bladeloss {} -->"
    return f"{text.format(digest):<{_SIGN}}\n".encode()


def _as_written(path: Path) -> bool:
    """Whether a file is a page, or a PDF, as it was written here."""
    if path.is_symlink() or not path.is_file():
        return False
    try:
        content = path.read_bytes()
    except OSError:
        return False
    return content.endswith(_sign(content[: -len(_sign(b""))]))


def _panels(results: Sequence[Result]) -> Iterator[Panel]:
    yield from orbits(results)
    yield from bearing_series(results)
    yield from spectra(results)
    yield from waterfalls(results)
    yield from bode(results)
    yield from film_pressures(results)
    yield from shaft_series(results)
    yield from deformed_shafts(results)
