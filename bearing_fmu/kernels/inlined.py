"""Kernels that are only parts of others: compiled to code that goes into those, not to code of their own.

numba makes every function ready to be called, which takes as long as all its optimisation. A function that is
always inlined is called by nobody, and its machine code is not made here.  That takes inner parts of numba;
where another numba lacks one, the import fails, and `compiled` does without.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba.core.caching import CompileResultCacheImpl
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler

_TAKEN = (
    (JITCodeLibrary, ("_finalize_final_module", "_finalize_dynamic_globals", "_verify_declare_only_symbols")),
    (JITCodeLibrary, ("_ensure_finalized", "get_pointer_to_function", "enable_object_caching")),
    (JITCodeLibrary, ("serialize_using_bitcode", "serialize_using_object_code", "codegen")),
    (Compiler, ("compile_extra",)),
    (CompileResultCacheImpl, ("rebuild",)),
)
for _owner, _names in _TAKEN:
    for _name in _names:
        getattr(_owner, _name)  # AttributeError where it is missing


class _Parts:
    """A codegen for whose functions there is no environment to set, since none is called."""

    def __init__(self, codegen: Any) -> None:
        self._codegen = codegen

    def __getattr__(self, name: str) -> Any:
        return getattr(self._codegen, name)

    def set_env(self, name: str, environment: Any) -> None:
        """Nothing is told to code that is not there."""


class PartLibrary(JITCodeLibrary):  # type: ignore[misc]
    """The optimised code of one part, for linking; there is no pointer to it."""

    @property
    def codegen(self) -> Any:
        """What makes it."""
        return _Parts(self._codegen)

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._verify_declare_only_symbols()
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        """None, as of a function that is not defined."""
        self._ensure_finalized()
        return 0

    def serialize_using_object_code(self) -> tuple[str, str, bytes]:
        """What is kept on disk."""
        return self.serialize_using_bitcode()  # type: ignore[no-any-return]


class PartCompiler(Compiler):  # type: ignore[misc]
    """numba's own, but into a `PartLibrary`."""

    def compile_extra(self, func: Callable[..., Any]) -> Any:
        """Compile one function."""
        self.state.library = PartLibrary(self.state.targetctx.codegen(), func.__qualname__)
        self.state.library.enable_object_caching()
        return super().compile_extra(func)


def read_as_parts(cache: Any) -> None:
    """Let the cache of a function that `PartCompiler` compiles read it so, too."""
    rebuild = cache._impl.rebuild

    def rebuild_part(target_context: Any, payload: Any) -> Any:
        codegen = target_context.codegen()
        usual, codegen._library_class = codegen._library_class, PartLibrary
        try:
            return rebuild(target_context, payload)
        finally:
            codegen._library_class = usual

    cache._impl.rebuild = rebuild_part


PARTS: dict[str, Any] = {"pipeline_class": PartCompiler}
"""What makes numba compile a part."""
