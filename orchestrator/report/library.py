"""The libraries of reports, from the packages plotly and pypdf."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable

from orchestrator.errors import OrchestratorError


class LibraryMissingError(OrchestratorError):
    """The page cannot be drawn without the package plotly, nor printed without pypdf."""

    @property
    def exit_status(self) -> int:
        """That of an internal or file error."""
        return 1


def require_library() -> Callable[[], str]:
    """Return what reads the script that draws the figures.

    Raises
    ------
    LibraryMissingError
        Where the package is not installed; names what is to be done.
    """
    try:
        from plotly.offline import get_plotlyjs
    except ImportError:
        raise LibraryMissingError(
            "the report needs the package plotly: pip install 'bladeloss[report]', or pip install plotly"
        ) from None
    read: Callable[[], str] = get_plotlyjs
    return read


def require_paper() -> None:
    """Raise `LibraryMissingError` where the package is not installed that puts figures on sheets."""
    if importlib.util.find_spec("pypdf") is None:
        raise LibraryMissingError(
            "a report's PDF needs the package pypdf: pip install 'bladeloss[report]', or pip install pypdf"
        )
