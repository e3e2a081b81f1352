"""Libraries that xarray and pint look for in vain in a process of the command.

Each asks whether a number is an array of another library, and to ask imports those that are installed: where
there is Dask, half a second of every command.  Only a study draws on it, in this process or in its workers.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

_UNNEEDED = ("cubed", "cupy", "dask", "sparse")


@contextmanager
def hidden() -> Iterator[None]:
    """Let imports of these fail, as where they are not installed."""
    names = [name for name in _UNNEEDED if name not in sys.modules]
    sys.modules |= dict.fromkeys(names)  # type: ignore[arg-type] # None, of which import says that it is missing
    try:
        yield
    finally:
        found(names)


def found(names: list[str] | tuple[str, ...] = _UNNEEDED) -> None:
    """Let them be found again."""
    for name in names:
        if sys.modules.get(name, sys) is None:
            del sys.modules[name]
