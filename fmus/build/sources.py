"""Which files of its packages a unit needs: what its facade imports, directly or not."""

from __future__ import annotations

import ast
import importlib.util
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from pathlib import Path

_BLOCKS = ("body", "orelse", "handlers", "finalbody", "cases")
"""Where the statements inside a statement are."""


def package_folder(package: str) -> Path:
    """Return the folder of an importable package.

    A folder of the same name in the working folder, such as that of built FMUs, is none: it has no module.

    Raises
    ------
    ModuleNotFoundError
        If there is no such package.
    """
    spec = importlib.util.find_spec(f"{package}.__init__")
    if spec is None or spec.origin is None:
        raise ModuleNotFoundError(f"package {package!r} cannot be found")
    return Path(spec.origin).parent


def source_files(modules: Iterable[str], packages: Sequence[str]) -> dict[str, dict[str, bytes]]:
    """Return the files that modules need, by package and by name within the package.

    Parameters
    ----------
    modules : iterable of str
        Where to begin, such as ``bearing_fmu.facade``.
    packages : sequence of str
        Packages to look into; other imports are the host's affair.

    Returns
    -------
    dict
        The modules reached by imports, and the tables (``*.csv``) beside them.
    """
    folders = {package: package_folder(package) for package in packages}
    found: dict[str, Path] = {}
    seen: set[str] = set()
    waiting = list(modules)
    while waiting:
        module = waiting.pop()
        if module in seen:
            continue
        seen.add(module)
        path = _file_of(module, folders)
        if path is None:
            continue
        found[module] = path
        waiting.extend(_imports(path, path.stat().st_mtime_ns))
        waiting.append(module.rpartition(".")[0])
    files: dict[str, dict[str, bytes]] = {package: {} for package in packages}
    for module, path in found.items():
        package = module.partition(".")[0]
        for file in (path, *path.parent.glob("*.csv")):
            files[package][file.relative_to(folders[package]).as_posix()] = file.read_bytes()
    return files


def _file_of(module: str, folders: dict[str, Path]) -> Path | None:
    package, _, rest = module.partition(".")
    if package not in folders:
        return None
    stem = folders[package].joinpath(*rest.split(".")) if rest else folders[package]
    candidates = stem.with_suffix(".py") if rest else stem / "__init__.py", stem / "__init__.py"
    return next((path for path in candidates if path.is_file()), None)


@cache
def _imports(path: Path, _changed: int) -> tuple[str, ...]:
    """The modules that a file, as of the time of its last change, may import; see `_imported`."""
    return tuple(_imported(path))


def _imported(path: Path) -> Iterator[str]:
    """Yield the modules that a file may import, names imported from a package among them."""
    waiting: list[ast.AST] = [ast.parse(path.read_text(encoding="utf-8"), str(path))]
    while waiting:  # statements and what holds statements: expressions, most of a file, import nothing
        node = waiting.pop()
        for block in _BLOCKS:
            waiting.extend(getattr(node, block, ()))
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
