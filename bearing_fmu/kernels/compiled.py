"""How the kernels of this package are compiled.

Division follows IEEE 754 (results are checked for NaN once, at the end), sums may be reordered and
products fused, nothing else is relaxed.  Kernels allocate nothing and return no arrays, so that numba need
not count references, which would be a sixth of the time in which they compile (see `copied.copy`).

numba keeps compiled code next to the sources and renews it when the file of a function changes, but
not when a function it calls changes in another file.  Here the whole package is the unit: any
change of a module renews all its kernels, and those of other packages that draw on them; a kernel of
another package is renewed by its own file, too.  What is kept carries its digest: a file that is damaged,
as after a power loss, counts as missing, and is written anew.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from numba import config, njit

from fmus.kernels.kept import keep_safely

try:
    from bearing_fmu.kernels.inlined import PARTS, read_as_parts
except (ImportError, AttributeError):  # a numba with other inner parts: every kernel gets its machine code
    PARTS = {}

# Kernels read records by the names of their fields, which they can do compiled only.
config.DISABLE_JIT = 0  # type: ignore[attr-defined]

_Function = TypeVar("_Function", bound=Callable[..., Any])
_OPTIONS: dict[str, Any] = {
    "cache": True,
    "nogil": True,
    "error_model": "numpy",
    "fastmath": {"contract", "reassoc", "arcp"},
    "_nrt": False,
}


_PACKAGE = Path(__file__).parents[1]


def _digest() -> str:
    """Digest of the sources of this package."""
    digest = hashlib.sha256()
    for path in sorted(_PACKAGE.rglob("*.py")):
        digest.update(path.relative_to(_PACKAGE).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


_SOURCES = _digest()


def _stamp(function: Callable[..., Any]) -> str:
    """Digest of all that the code of `function` follows from: this package, and files outside it.

    These are its own, and those of the kernels that the function around it was given, see `variant`.
    """
    given = (cell.cell_contents for cell in function.__closure__ or ())
    drawn_on = (function, *(kernel.py_func for kernel in given if hasattr(kernel, "py_func")))
    files = {Path(one.__code__.co_filename) for one in drawn_on}
    outside = sorted(path for path in files if not path.is_relative_to(_PACKAGE))
    return _SOURCES + "".join(hashlib.sha256(path.read_bytes()).hexdigest() for path in outside)


def kernel(function: _Function) -> _Function:
    """Compile `function`, callable from Python and from other kernels."""
    return _compile(function, {"no_cfunc_wrapper": True})


def variant(name: str, function: _Function) -> _Function:
    """Compile a `kernel` of which there are several, made by one function around other kernels.

    Parameters
    ----------
    name : str
        Tells its compiled code from that of the others.
    function : callable
        Draws on kernels of the function around it.
    """
    function.__qualname__ = f"{function.__name__}_{name}"
    return kernel(function)


def inner_kernel(function: _Function) -> _Function:
    """Compile `function` for use in other kernels only, which compiles faster.

    It is always inlined: a kernel that was compiled beside it in this process, and one that comes from
    the cache, then run the same code, and give the same numbers to the bit.
    """
    alone = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True, "forceinline": True}
    return _compile(function, alone | PARTS)


def stage(function: _Function) -> _Function:
    """Compile `function` as a part of the one kernel that calls it.

    A kernel is optimised again in each of its callers; a stage, which does little but call other
    kernels, is not compiled on its own, and takes one level out of that chain.
    """
    return _compile(function, {"inline": "always"})


def _compile(function: _Function, more: dict[str, Any]) -> _Function:
    try:
        dispatcher: Any = njit(**_OPTIONS, **more)(function)
    except RuntimeError:  # no folder to keep compiled code in: compile in every process
        return njit(**{**_OPTIONS, "cache": False}, **more)(function)  # type: ignore[no-any-return]
    cache = keep_safely(dispatcher, _stamp(function))
    # numba's own key holds what a function draws on, which is another object in every process
    cache._index_key = lambda signature, codegen: (signature, codegen.magic_tuple())
    if PARTS and PARTS.items() <= more.items():
        read_as_parts(cache)
    return dispatcher  # type: ignore[no-any-return]
