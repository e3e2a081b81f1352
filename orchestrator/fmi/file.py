"""FMU files: each extracted once, described once, and shared by all of its instances."""

from __future__ import annotations

import ctypes
import os
import re
import shutil
import sys
import tempfile
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from types import TracebackType
from typing import Any, Protocol

import fmpy
from filelock import FileLock, Timeout

from fmus.build.promises import promises_of
from orchestrator.errors import FmuError
from orchestrator.fmi.archive import LIMITS, ArchiveError, Limits, extract
from orchestrator.fmi.xml import XmlError, read_xml

# Others than these, and of Windows \ and :, make hosts of Python FMUs trip.
_SAFE_PATH = re.compile(r"[A-Za-z0-9_./~-]+" if os.name == "posix" else r"[A-Za-z0-9_./~:\\-]+")
_FALLBACKS = ("/tmp", "/var/tmp")  # where TMPDIR has others; other systems keep their own folder
_PREFIX, _IN_USE = "bladeloss_", "in-use"
_IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
# Both are read by fmpy, which takes what XML can do.
_DESCRIPTION, _SOURCES = "modelDescription.xml", "sources/buildDescription.xml"


Call = list[str]
"""A call to a unit: its C function. Every call is a list of its own, by which it is known."""


class Instance(Protocol):
    """What a watchdog sees of a unit: its name and the call that it is in, None in between."""

    name: str
    call: Call | None


class FmuFile:
    """An extracted FMU 2.0 for co-simulation.

    Attributes
    ----------
    path : Path
        The ``.fmu`` file.
    folder : Path
        Where it is extracted.
    description : fmpy.model_description.ModelDescription
        Its modelDescription.xml.
    variables : dict
        The description's scalar variables by name.
    instances : list of Unit
        Those that live.
    size : int
        Bytes that it holds extracted.
    promises : frozenset of str
        What it says of itself, see `fmus.build.promises`.

    Raises
    ------
    FmuError
        When the file is missing, no FMI 2.0 co-simulation unit, or could do harm when extracted or read.
    """

    def __init__(self, path: Path, folder: Path, limits: Limits = LIMITS) -> None:
        self.path = path
        self.folder = folder
        self.instances: list[Instance] = []
        try:
            self.size = extract(path, folder, "FMU", limits)
            self.promises = promises_of(read_xml(folder / _DESCRIPTION))
            if (folder / _SOURCES).exists():
                read_xml(folder / _SOURCES)
            self.description: Any = fmpy.read_model_description(folder)
        except FileNotFoundError as error:
            if path.exists():
                raise FmuError(f"{path}: not a valid FMU: without {Path(str(error.filename)).name}") from None
            raise FmuError(f"{path}: no such file; `bladeloss build` makes the FMUs") from None
        except ArchiveError as error:
            raise FmuError(str(error)) from None
        except XmlError as error:
            raise FmuError(f"{path}: {error}") from None
        except Exception as error:  # fmpy raises bare exceptions for a description that breaks the schema
            raise FmuError(f"{path}: not a valid FMU: {error}") from None
        if self.description.fmiVersion != "2.0":
            raise FmuError(f"{path}: not an FMI 2.0 co-simulation unit: FMI {self.description.fmiVersion}")
        if self.description.coSimulation is None:
            raise FmuError(f"{path}: not an FMI 2.0 co-simulation unit: for model exchange only")
        identifier = str(self.description.coSimulation.modelIdentifier)
        if not _IDENTIFIER.fullmatch(identifier):  # it names the library that is loaded
            raise FmuError(
                f"{path}: modelIdentifier {identifier!r}; allowed are letters, digits and underscores"
            )
        self.variables: dict[str, Any] = {v.name: v for v in self.description.modelVariables}

    @property
    def is_python(self) -> bool:
        """Whether the unit is Python in a library of pythonfmu, and takes Python's lock by itself."""
        return (self.folder / "resources" / "slavemodule.txt").is_file()

    @cached_property
    def library(self) -> ctypes.CDLL:
        """The FMU's C library.

        Calls of a unit in Python keep Python's lock, which is quicker. Those of other units let go of it,
        so that a watchdog can end a run whose unit does not come back.
        """
        name = f"{self.description.coSimulation.modelIdentifier}{fmpy.sharedLibraryExtension}"
        kind = ctypes.PyDLL if self.is_python else ctypes.CDLL
        return kind(str(self.folder / "binaries" / fmpy.platform / name))

    def end_library(self) -> None:
        """Let the library of an FMU in Python take leave of the interpreter, and unload it.

        Left to the end of the process, libraries of pythonfmu 0.7 do so after their static data are
        gone: they write to freed memory, and one exit in some fifty aborts. A library that stays loaded
        keeps some hundred kilobytes, of every run in a process, for each run extracts its own.
        """
        library = self.__dict__.pop("library", None)
        if library is None:
            return
        if hasattr(library, "finalizePythonInterpreter"):
            library.finalizePythonInterpreter.restype = None
            library.finalizePythonInterpreter()
        if not self.instances:  # one that broke was left alone, and may still be in use
            fmpy.freeLibrary(library._handle)

    def check_steps(self, step: float, end: float, halved: bool) -> None:
        """Refuse steps of unlike length, the last or `halved` ones, for units that cannot take them.

        Raises
        ------
        FmuError
            Naming the flag.
        """
        uneven = abs(end / step - round(end / step)) > 1e-9 * end / step
        if (uneven or halved) and not self.description.coSimulation.canHandleVariableCommunicationStepSize:
            why = f"end = {end!r} s is no multiple of step = {step!r} s"
            why = "a tolerance halves steps" if halved else why
            raise FmuError(f"{self.path}: canHandleVariableCommunicationStepSize is false, but {why}")

    @property
    def can_keep_state(self) -> bool:
        """Whether its state can be got and set, that is, whether a step can be taken back."""
        return bool(self.description.coSimulation.canGetAndSetFMUstate)


def _remove_rests(root: Path) -> None:
    """Remove what this user's processes extracted that were killed: their locks are free."""
    for rest in root.glob(f"{_PREFIX}????????"):
        mark = rest / _IN_USE
        with suppress(OSError, Timeout):
            ours = not hasattr(os, "getuid") or rest.lstat().st_uid == os.getuid()
            if ours and not rest.is_symlink() and mark.is_file() and not mark.is_symlink():
                with FileLock(mark, timeout=0):
                    shutil.rmtree(rest, ignore_errors=True)


def _folder_in_use(root: str | None) -> tuple[Path, FileLock]:
    """Make a folder and lock it; another one where a process that starts just then took it for a rest."""
    while True:
        folder = Path(tempfile.mkdtemp(prefix=_PREFIX, dir=root))
        lock = FileLock(folder / _IN_USE)
        with suppress(FileNotFoundError):
            lock.acquire()
            return folder, lock


class FmuStore:
    """Extracts FMU files on demand into one temporary folder, and removes it at the end.

    Attributes
    ----------
    folder : Path
        The temporary folder.
    """

    def __init__(self) -> None:
        roots = (tempfile.gettempdir(), *_FALLBACKS)
        root = next((r for r in roots if _SAFE_PATH.fullmatch(r) and os.access(r, os.W_OK)), None)
        _remove_rests(Path(root or tempfile.gettempdir()))
        self.folder, self._lock = _folder_in_use(root)
        self._files: dict[Path, FmuFile] = {}
        self._left = LIMITS.total  # for all FMUs together, since an SSP may hold any number

    def open(self, path: Path) -> FmuFile:
        """Return the extracted FMU at `path`; several calls share one extraction.

        Raises
        ------
        FmuError
            As `FmuFile`.
        """
        key = path.resolve()
        if key not in self._files:
            limits = replace(LIMITS, total=self._left)
            self._files[key] = FmuFile(path, self.folder / f"fmu{len(self._files)}", limits)
            self._left -= self._files[key].size
        return self._files[key]

    def instances(self) -> list[Instance]:
        """Return the units that live, of all FMUs."""
        return [unit for file in list(self._files.values()) for unit in list(file.instances)]

    def close(self) -> None:
        """Remove what was extracted; no instance may live any more."""
        for file in self._files.values():
            file.end_library()
        self.remove()
        self._files.clear()

    def remove(self) -> None:
        """Remove the files alone, where a unit is still in a call that does not end."""
        self._lock.release()
        inside = f"{self.folder}{os.sep}"
        sys.path[:] = [path for path in sys.path if not path.startswith(inside)]  # put there by pythonfmu
        shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self) -> FmuStore:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
