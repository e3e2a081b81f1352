"""Whose native code runs: that of FMUs which this installation built, and of others where the user agrees."""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Callable, Collection, Mapping
from pathlib import Path

import typer

from orchestrator.errors import OrchestratorError
from orchestrator.fmi.own import is_own
from orchestrator.scenario.scenario import Scenario, is_fmu

_WHAT = "holds native code that bladeloss did not build and that runs with all your rights"


class UntrustedError(OrchestratorError):
    """An FMU of somebody else that the user has not agreed to run."""


def own_bearings(scenario: Scenario) -> dict[str, Path]:
    """Return the FMUs that a scenario names for its bearings, by the name to show."""
    depths = {scenario.depth, *scenario.depth_at.values()}
    paths = [scenario.folder / depth for depth in sorted(depths) if is_fmu(depth)]
    return {str(path): path for path in paths}


def require_trust(
    files: Mapping[str, Path],
    *,
    trust: bool = False,
    known: Collection[str] = (),
    ask: Callable[[str], bool] | None = None,
) -> list[str]:
    """Make sure that no code of somebody else runs unless the user agrees.

    Parameters
    ----------
    files : mapping
        FMUs that are about to run, by the name to show.
    trust : bool
        The user agreed beforehand (``--trust``).
    known : collection of str
        Digests of files to which the user agreed earlier.
    ask : callable, optional
        Puts a question to the user; by default on the terminal, if there is one.

    Returns
    -------
    list of str
        Digests of the files of others, to which the user has agreed by now.

    Raises
    ------
    UntrustedError
        Naming the file and ``--trust``.
    """
    agreed = []
    for name, path in files.items():
        if not path.is_file() or is_own(path):  # a file that is missing is said when it is opened
            continue
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        if not (trust or digest in known or _agrees(f"{name} {_WHAT}. Run it?", ask)):
            raise UntrustedError(f"{name}: {_WHAT}; to run it all the same, say --trust")
        agreed.append(digest)
    return agreed


def _agrees(question: str, ask: Callable[[str], bool] | None) -> bool:
    if ask is None:
        return sys.stdin.isatty() and typer.confirm(question, err=True)
    return ask(question)
