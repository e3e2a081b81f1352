"""FMU files: each extracted once, described once, and shared by all of its instances."""

from __future__ import annotations

import ctypes
import re
import shutil
import tempfile
from functools import cached_property
from pathlib import Path
from types import TracebackType
from typing import Any
from zipfile import BadZipFile

import fmpy

from orchestrator.errors import FmuError

_SAFE_PATH = re.compile(r"[A-Za-z0-9_./~-]+")
_FALLBACK = "/tmp"  # where TMPDIR has characters that hosts of Python FMUs trip over


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
    """

    def __init__(self, path: Path, folder: Path) -> None:
        self.path = path
        self.folder = folder
        try:
            fmpy.extract(path, folder)
            self.description: Any = fmpy.read_model_description(folder)
        except FileNotFoundError:
            raise FmuError(f"{path}: no such file; `bladeloss build` makes the FMUs") from None
        except (BadZipFile, OSError) as error:
            raise FmuError(f"{path}: not a readable FMU: {error}") from None
        except Exception as error:  # fmpy raises bare exceptions for a description that breaks the schema
            raise FmuError(f"{path}: not a valid FMU: {error}") from None
        if self.description.fmiVersion != "2.0" or self.description.coSimulation is None:
            raise FmuError(f"{path}: not an FMI 2.0 co-simulation unit")
        self.variables: dict[str, Any] = {v.name: v for v in self.description.modelVariables}

    @cached_property
    def library(self) -> ctypes.PyDLL:
        """The FMU's C library, for calls that hold Python's lock."""
        name = f"{self.description.coSimulation.modelIdentifier}{fmpy.sharedLibraryExtension}"
        return ctypes.PyDLL(str(self.folder / "binaries" / fmpy.platform / name))

    def end_library(self) -> None:
        """Let the library of an FMU in Python take leave of the interpreter; no instance may live any more.

        Left to the end of the process, libraries of pythonfmu 0.7 do so after their static data are
        gone: they write to freed memory, and one exit in some fifty aborts.
        """
        if "library" in self.__dict__ and hasattr(self.library, "finalizePythonInterpreter"):
            self.library.finalizePythonInterpreter.restype = None
            self.library.finalizePythonInterpreter()

    @property
    def can_keep_state(self) -> bool:
        """Whether its state can be got and set, that is, whether a step can be taken back."""
        return bool(self.description.coSimulation.canGetAndSetFMUstate)


class FmuStore:
    """Extracts FMU files on demand into one temporary folder, and removes it at the end."""

    def __init__(self) -> None:
        root = tempfile.gettempdir()
        self._folder = Path(
            tempfile.mkdtemp(prefix="bladeloss_", dir=root if _SAFE_PATH.fullmatch(root) else _FALLBACK)
        )
        self._files: dict[Path, FmuFile] = {}

    def open(self, path: Path) -> FmuFile:
        """Return the extracted FMU at `path`; several calls share one extraction.

        Raises
        ------
        FmuError
            When the file is missing or no FMI 2.0 co-simulation unit.
        """
        key = path.resolve()
        if key not in self._files:
            self._files[key] = FmuFile(path, self._folder / f"fmu{len(self._files)}")
        return self._files[key]

    def close(self) -> None:
        """Remove what was extracted; no instance may live any more."""
        for file in self._files.values():
            file.end_library()
        shutil.rmtree(self._folder, ignore_errors=True)
        self._files.clear()

    def __enter__(self) -> FmuStore:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
