"""Lines are counted by probes in the code of the packages, in place of tracing, before Python 3.12.

Tracing calls coverage at every line that the process runs, also of other libraries, which takes half as long
again. A probe is a call that SlipCover writes into the code of a line of ours as its module is imported.
What the probes saw goes into coverage's data, which makes the report; processes that tests start, where they
are counted at all, are traced.
"""

from __future__ import annotations

from pathlib import Path
from types import CodeType
from typing import Any

from numba.core.dispatcher import Dispatcher
from slipcover import ImportManager, Slipcover

PACKAGES = {"bearing_fmu", "rotor_fmu", "fmus", "orchestrator"}
NEVER = -1
"""Probes stay in the code: one that has been seen takes some nanoseconds."""


class Ours:
    """Tells files of the packages, or of an FMU's copy of them, from those of tests and libraries."""

    def matches(self, path: str | Path) -> bool:
        """Tell whether lines of this file are counted."""
        return any(
            folder.name in PACKAGES
            and (folder / "__init__.py").exists()
            and not (folder.parent / "__init__.py").exists()
            for folder in Path(path).parents
        )


class Probes(Slipcover):
    """All probes of this process; `newly_seen` has the lines of each file that they saw."""

    def __init__(self) -> None:
        super().__init__(d_miss_threshold=NEVER)
        self.without: dict[int, tuple[CodeType, CodeType]] = {}

    def instrument(self, co: CodeType, parent: CodeType | None = None) -> CodeType:
        """Write probes into code, and keep the code without them by the identity of what has them."""
        probed = super().instrument(co, parent)
        self.without[id(probed)] = probed, co
        return probed


def start() -> Probes:
    """Write probes into all modules of the packages that are imported from now on.

    Kernels are compiled from code without them, and their lines are not counted, as with tracing.
    """
    probes = Probes()
    ImportManager(probes, Ours()).__enter__()
    begin = Dispatcher.__init__

    def begin_without(self: Dispatcher, py_func: Any, *arguments: Any, **options: Any) -> None:
        _, py_func.__code__ = probes.without.get(id(py_func.__code__), (None, py_func.__code__))
        begin(self, py_func, *arguments, **options)

    Dispatcher.__init__ = begin_without
    return probes
