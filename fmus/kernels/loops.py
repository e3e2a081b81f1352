"""Small loops, compiled: a call of numpy on eleven numbers costs as much as the whole loop.

Each is kept next to its source and compiled anew when that file changes, this one, or that of another such
function that it calls, so that it draws on no others, on numbers of its own file, and on what it is given.
Loops allocate nothing and return no arrays: numba then counts no references, which halves what a call takes.
What is kept carries its digest: a file that is damaged counts as missing.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numba import njit
from numpy.typing import NDArray

from fmus.kernels.kept import keep_safely

_Function = TypeVar("_Function", bound=Callable[..., Any])
_OPTIONS: dict[str, Any] = {"error_model": "numpy", "no_cfunc_wrapper": True, "_nrt": False}


def compiled(function: _Function) -> _Function:
    """Compile a function at its first call; as it stands it is ``py_func``."""
    return _compile(function, _OPTIONS)


def fused(function: _Function) -> _Function:
    """The same, with sums in any order and fused with products; not to the bit what numpy makes of it."""
    return _compile(function, _OPTIONS | {"fastmath": {"contract", "reassoc"}})


def _compile(function: _Function, options: dict[str, Any]) -> _Function:
    try:
        dispatcher: Any = njit(cache=True, **options)(function)
    except RuntimeError:  # no folder to keep compiled code in: compile in every process
        return njit(**options)(function)  # type: ignore[no-any-return]
    files = sorted({Path(__file__), *_sources(function)})
    stamp = "".join(hashlib.sha256(path.read_bytes()).hexdigest() for path in files)
    keep_safely(dispatcher, stamp)
    return dispatcher  # type: ignore[no-any-return]


def _sources(function: Callable[..., Any]) -> Iterator[Path]:
    """Files of a function and of the compiled ones that it names, and so on."""
    yield Path(function.__code__.co_filename)
    for name in function.__code__.co_names:
        called = getattr(function.__globals__.get(name), "py_func", None)
        if called is not None:
            yield from _sources(called)


def inlined(function: _Function) -> _Function:
    """Compile a function as a part of those that call it, which are in its file."""
    return njit(inline="always", **_OPTIONS)(function)  # type: ignore[no-any-return]


@inlined
def copy(source: NDArray[np.float64], target: NDArray[np.float64]) -> None:
    """Copy numbers; nobody checks that there are as many."""
    for i in range(len(source)):
        target[i] = source[i]


@inlined
def dot(row: NDArray[np.float64], vector: NDArray[np.float64]) -> float:
    """Product of four numbers each, added up in the order in which numpy multiplies matrices of that size."""
    return (row[0] * vector[0] + row[2] * vector[2]) + (row[1] * vector[1] + row[3] * vector[3])  # type: ignore[no-any-return]
