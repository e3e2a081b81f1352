"""Finds the guard that a mark names, and the changes that would take it away; see `tests.mutation`.

A guard is a definition: ``module:name``, with a dotted name for what stands in a class.  Functions, classes,
constants and fields count.  Its mutants differ from it in one place each: a ``raise`` is gone, a condition
never or always holds, an exception is not caught, a call is left out.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

_STATEMENTS = ast.AugAssign | ast.Expr | ast.Continue | ast.Return
_Function = ast.FunctionDef | ast.AsyncFunctionDef


class NoGuard(ValueError):
    """A mark names a guard that is not there."""


@dataclass(frozen=True)
class Mutant:
    """One change of a guard.

    Attributes
    ----------
    file : str
        The module's path from the root of the tree.
    line : int
        Where the change is.
    change : str
        What is changed, in a line.
    text : str
        The whole file with the change.
    """

    file: str
    line: int
    change: str
    text: str


def file_of(guard: str, root: Path) -> str:
    """Return the path from `root` of the module that a guard stands in."""
    stem = guard.partition(":")[0].replace(".", "/")
    return next((f for f in (f"{stem}.py", f"{stem}/__init__.py") if (root / f).is_file()), f"{stem}.py")


def definition(guard: str, root: Path) -> ast.stmt:
    """Return the definition that a guard's name stands for.

    Raises
    ------
    NoGuard
        If there is none.
    """
    path = root / file_of(guard, root)
    if not path.is_file():
        raise NoGuard(f"{guard}: there is no {path.relative_to(root)}")
    found: ast.AST = ast.parse(path.read_text(encoding="utf-8"))
    for name in guard.partition(":")[2].split("."):
        inside = (node for node in getattr(found, "body", []) if name in _names(node))
        found = next(inside, None)  # type: ignore[assignment]
        if found is None:
            raise NoGuard(f"{guard}: {path.relative_to(root)} does not define {name!r}")
    return found  # type: ignore[return-value]


def _names(node: ast.stmt) -> set[str]:
    if isinstance(node, _Function | ast.ClassDef):
        return {node.name}
    targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
    return {target.id for target in targets if isinstance(target, ast.Name)}


def mutants(guard: str, root: Path) -> list[Mutant]:
    """Return the mutants of a guard, those first that take away what a guard usually is.

    Raises
    ------
    NoGuard
        If the guard is not there.
    """
    node, file = definition(guard, root), file_of(guard, root)
    text = (root / file).read_bytes()
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))

    def place(part: ast.expr | ast.stmt | ast.keyword) -> slice:
        end = starts[(part.end_lineno or part.lineno) - 1] + (part.end_col_offset or 0)
        return slice(starts[part.lineno - 1] + part.col_offset, end)

    found: dict[str, Mutant] = {}
    for _, part, new in sorted(_changes(node), key=lambda change: (change[0], change[1].lineno)):
        where = place(part)
        old = text[where].decode()
        if not new and text[where.stop :].lstrip().startswith(b","):
            where = slice(where.start, text.index(b",", where.stop) + 1)
        try:
            changed = (text[: where.start] + new.encode() + text[where.stop :]).decode()
            ast.parse(changed)
        except SyntaxError:  # such as the only element of a set display, left out
            continue
        said = f"{' '.join(old.split())[:70]} -> {new or 'nothing'}"
        found.setdefault(changed, Mutant(file, part.lineno, said, changed))
    return list(found.values())


_Change = tuple[int, ast.expr | ast.stmt | ast.keyword, str]


def _changes(guard: ast.stmt) -> Iterator[_Change]:
    """Yield rank, what is replaced, and by what; what usually is the guard has the lowest rank."""
    constant = not isinstance(guard, _Function)
    last = guard.body[-1] if isinstance(guard, _Function) else None
    for node in _code(guard):
        if isinstance(node, ast.Raise):
            yield 0, node, "pass"
        elif isinstance(node, ast.If | ast.IfExp | ast.While):
            yield 0, node.test, "False"
            yield 2, node.test, "True"
        elif isinstance(node, ast.ExceptHandler) and node.type is not None:
            yield 0, node.type, "()"
        elif isinstance(node, ast.comprehension):
            yield from ((1, test, "True") for test in node.ifs)
        elif isinstance(node, ast.BoolOp):
            neutral, other = ("True", "False") if isinstance(node.op, ast.And) else ("False", "True")
            yield from ((1, value, neutral) for value in node.values)
            yield from ((2, value, other) for value in node.values)
        elif isinstance(node, ast.Compare):
            yield 2, node, "True"
            yield 2, node, "False"
        elif isinstance(node, _STATEMENTS) and node is not last and not _is_text(node):
            yield 1, node, "pass"
        elif isinstance(node, ast.With):
            nothing = "__import__('contextlib').nullcontext()"
            yield from ((1, item.context_expr, nothing) for item in node.items)
        elif isinstance(node, ast.Call | ast.ClassDef):
            yield from _calls(node)
        elif isinstance(node, ast.JoinedStr):
            yield 4, node, "'?'"
        elif isinstance(node, ast.Dict) and constant:
            pairs = zip(node.keys, node.values, strict=True)
            yield from ((1, _span(key, value), "") for key, value in pairs if key is not None)
        elif isinstance(node, ast.Constant) and constant:
            yield from _constants(node)


def _calls(node: ast.Call | ast.ClassDef) -> Iterator[_Change]:
    """Leave out or invert a keyword; put the first argument, or the object, in place of the call."""
    for keyword in node.keywords:
        if isinstance(keyword.value, ast.Constant) and isinstance(keyword.value.value, bool):
            yield 1, keyword.value, str(not keyword.value.value)
        elif keyword.arg:
            yield 3, keyword, ""
    if isinstance(node, ast.Call) and node.args:
        yield 3, node, ast.unparse(node.args[0])
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        yield 3, node, ast.unparse(node.func.value)


def _constants(node: ast.Constant) -> Iterator[_Change]:
    if isinstance(node.value, str):
        yield 4, node, repr(node.value + "?")
    elif isinstance(node.value, int | float) and not isinstance(node.value, bool):
        yield 4, node, repr(node.value * 10**9 or 10**9)


def _span(first: ast.expr, last: ast.expr) -> ast.expr:
    """Return a node that reaches from one to the other."""
    span = ast.Name("", ast.Load())
    span.lineno, span.col_offset = first.lineno, first.col_offset
    span.end_lineno, span.end_col_offset = last.end_lineno, last.end_col_offset
    return span


def _code(node: ast.AST) -> Iterator[ast.AST]:
    """Walk through the code, but not into f-strings, where Python 3.11 does not know its place."""
    yield node
    if not isinstance(node, ast.JoinedStr):
        for child in ast.iter_child_nodes(node):
            yield from _code(child)


def _is_text(node: ast.stmt) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
