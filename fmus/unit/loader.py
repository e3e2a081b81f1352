"""Finds a unit's packages when the FMU is loaded: the host's, if they are the same, or its own.

This file travels in each FMU's resources, next to the entry script that
pythonfmu runs, under a name of its own; it imports nothing of bladeloss.

- A package the process has loaded already must have the sources the FMU was built
  from, or the FMU is refused: one process can hold one version only.
- A package installed in the host is taken if its sources are the same.
- Otherwise the FMU's copy is put in the user's cache folder, once per version:
  compiled kernels stay with it, whereas each tool extracts an FMU to a new folder.
  It is used only as long as it holds these files and no others.
  Where nothing can be written there, the copy in the resources serves.
"""

from __future__ import annotations

import atexit
import ctypes
import hashlib
import importlib
import importlib.util
import math
import os
import shutil
import sys
import tempfile
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any

from pythonfmu import Fmi2Slave
from pythonfmu.enums import Fmi2Status

# Of the process, for what they make up for is done to the process; each FMU version has a loader of its own.
_kept: list[dict[str, Any]] = []  # see `keep`
_let_go: set[Path] = set()  # libraries that `_let_go_at_exit` has seen to
_CHECKED = "__bladeloss_digest__"  # set on a package once its sources are known


def keep(scope: dict[str, Any]) -> None:
    """Hold a reference to the globals of an entry script, one at each call.

    pythonfmu runs the script for each instance and drops one reference to its
    globals too many; without this they are freed while in use.
    """
    _kept.append(scope)


def _let_go_at_exit(entry: str) -> None:
    """Make pythonfmu's library give up its state while that is still possible.

    At the end of a process its destructors run in the wrong order: the state is freed twice, and now
    and then the process aborts with "corrupted double-linked list". Given up before, it is freed once.
    """
    for library in Path(entry).resolve().parents[1].glob("binaries/*/*.so"):
        if library not in _let_go:
            _let_go.add(library)
            atexit.register(_finalize, library)


def _finalize(library: Path) -> None:
    with suppress(OSError, AttributeError):  # not this platform's, or gone
        ctypes.CDLL(str(library), mode=os.RTLD_NOLOAD | os.RTLD_NOW).finalizePythonInterpreter()


def digest_of(files: Iterable[tuple[str, bytes]]) -> str:
    """Return the digest of named contents, 32 hexadecimal digits."""
    digest = hashlib.sha256()
    for name, content in sorted(files):
        digest.update(f"{name}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()[:32]


def unit_class(entry: str, facade: str, name: str, packages: dict[str, str]) -> type[Fmi2Slave]:
    """Return the class `name` of the module `facade`, or one that refuses each step with the reason.

    Parameters
    ----------
    entry : str
        Path of the entry script, in the FMU's resources.
    facade, name : str
        Module and class of the facade.
    packages : dict
        Digest of each package the facade needs.
    """
    try:
        if sys.platform == "linux":
            _let_go_at_exit(entry)
        for package, digest in packages.items():
            _provide(package, digest, Path(entry).parent / "packages")
        return getattr(importlib.import_module(facade), name)
    except Exception as error:  # any: nothing may cross the C boundary
        return _refusing(str(error) if isinstance(error, ImportError) else f"{type(error).__name__}: {error}")


def _provide(package: str, digest: str, own: Path) -> None:
    """Make `package` importable with the sources of `digest`."""
    names = sorted(p.relative_to(own / package).as_posix() for p in _sources(own / package))
    loaded = sys.modules.get(package)
    if loaded is not None:
        if not hasattr(loaded, _CHECKED):
            setattr(loaded, _CHECKED, {})
        checked = getattr(loaded, _CHECKED)  # per list of files: units may carry different parts
        key = tuple(names)
        if key not in checked:
            checked[key] = _digest(_folder_of(package), names)
        if checked[key] != digest:
            raise ImportError(
                f"the package {package} loaded in this process ({_folder_of(package)}) differs from the one "
                "this FMU was built from; rebuild the FMU, or run it in a process of its own"
            )
        return
    host = importlib.util.find_spec(package)
    if (
        host is None
        or not host.submodule_search_locations
        or (_digest(Path(host.submodule_search_locations[0]), names) != digest)
    ):
        module = _import_from(_cached(package, digest, own, names), package)
    else:
        module = importlib.import_module(package)
    setattr(module, _CHECKED, {tuple(names): digest})


def _import_from(folder: Path, package: str) -> Any:
    """Import a package from a folder that does not get on `sys.path`: nothing else there counts."""
    place = folder / package
    spec = importlib.util.spec_from_file_location(
        package, place / "__init__.py", submodule_search_locations=[str(place)]
    )
    if spec is None or spec.loader is None:
        raise ImportError(f"the package {package} cannot be imported from {folder}")
    module = importlib.util.module_from_spec(spec)
    sys.modules[package] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[package]
        raise
    return module


def _folder_of(package: str) -> Path:
    """Return the folder of a loaded package; a mere folder of its name, first on the path, is none."""
    spec = importlib.util.find_spec(f"{package}.__init__")
    return Path(spec.origin).parent if spec is not None and spec.origin else Path()


def _sources(folder: Path) -> list[Path]:
    return [p for p in folder.rglob("*") if p.is_file() and "__pycache__" not in p.parts]


def _digest(folder: Path, names: list[str]) -> str:
    """Return the digest of these files in `folder`, empty if one is missing."""
    try:
        return digest_of((name, (folder / name).read_bytes()) for name in names)
    except OSError:
        return ""


def cache_folder() -> Path:
    """Return the user's cache folder of bladeloss."""
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local"
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches"
    else:
        base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "bladeloss"


def _cached(package: str, digest: str, own: Path, names: list[str]) -> Path:
    """Return a lasting folder that holds `package`, or `own` if there is none to be had."""
    try:
        target = cache_folder() / f"{package}-{digest}"
        if not _holds(target, package, digest, names):
            target.parent.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryDirectory(dir=target.parent) as temporary:
                whole = Path(temporary) / "whole"
                shutil.copytree(own / package, whole / package)
                with suppress(OSError):  # damaged, or of another; or there is none yet
                    target.rename(Path(temporary) / "before")
                with suppress(OSError):  # another process may have been first
                    whole.rename(target)
        if _holds(target, package, digest, names):
            os.utime(target)  # in use: bladeloss removes what has not been for a month
            return target
    except (OSError, RuntimeError):  # no home, no space, no permission
        pass
    return own


def _holds(folder: Path, package: str, digest: str, names: list[str]) -> bool:
    """Tell whether a folder that is the user's own holds a package with these files and no others."""
    place = folder / package
    if not place.is_dir():
        return False
    about = folder.stat()
    if hasattr(os, "getuid") and (about.st_uid != os.getuid() or about.st_mode & 0o002):
        return False
    found = sorted(p.relative_to(place).as_posix() for p in _sources(place))
    return found == names and _digest(place, names) == digest


def for_log(unit: Fmi2Slave, text: str) -> str:
    """Return a text of a unit as it may be logged: it passes through printf on its way out."""
    return f"{unit.instance_name}: {text}".replace("%", "%%")


class Refusal(Exception):
    """A call that fails: the one exception that may leave a callback, where FMI wants an error.

    pythonfmu's library (0.7.0, PySlaveInstance.cpp) makes ``fmi2Fatal`` of any exception, logs its
    `repr`, and in ``handle_py_exception`` gives up its references to the unit, the unit's class and log,
    which it uses again until ``fmi2FreeInstance`` gives them up once more.  So it is given one more of each.

    The reason takes along what waits for the log: no host is to be called with an error set.

    Parameters
    ----------
    reason : str
        For the log.
    unit : Fmi2Slave
        The unit that refuses.
    """

    def __init__(self, reason: str, unit: Fmi2Slave) -> None:
        said = [message.msg for message in unit.log_queue]
        unit.log_queue.clear()
        super().__init__("\n".join([*said, for_log(unit, reason)]))
        for each in (unit, type(unit), unit.log_queue):
            ctypes.pythonapi.Py_IncRef(ctypes.py_object(each))

    def __repr__(self) -> str:
        return str(self)


def _refusing(reason: str) -> type[Fmi2Slave]:
    """Return a slave that can be instantiated and asked, but never steps."""

    class Refusing(Fmi2Slave):
        def enter_initialization_mode(self) -> None:
            self._say(Fmi2Status.warning)  # the first that a host asks are the outputs of the start

        def exit_initialization_mode(self) -> None:
            raise Refusal(f"FMU refused: {reason}", self)

        def do_step(self, current_time: float, step_size: float) -> bool:
            self._say(Fmi2Status.discard)
            return False

        def _say(self, status: Fmi2Status) -> None:
            self.log(for_log(self, f"FMU refused: {reason}"), status)

        def get_real(self, vrs: list[int]) -> list[float]:
            return [math.nan] * len(vrs)

        def get_integer(self, vrs: list[int]) -> list[int]:
            return [0] * len(vrs)

        def get_boolean(self, vrs: list[int]) -> list[bool]:
            return [False] * len(vrs)

        def get_string(self, vrs: list[int]) -> list[str]:
            return [""] * len(vrs)

        def _ignore(self, vrs: list[int], values: list[Any]) -> None:
            return

        set_real = set_integer = set_boolean = set_string = _ignore

    return Refusing
