"""A copy of the working tree in which one mutant after the other lives; see `tests.mutation`."""

from __future__ import annotations

import ast
import importlib
import multiprocessing
import os
import shutil
import signal
import sys
import tempfile
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import astuple
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import pytest

from tests.fault_table import ROOT, Fault, collect
from tests.guards import Mutant, mutants

COMPILING = 240.0
"""Time to compile all kernels anew [s]."""

_COPIED = ("bearing_fmu", "rotor_fmu", "fmus", "orchestrator", "tests", "pyproject.toml", "README.md")


class Died(RuntimeError):
    """The process of the tests ended before they did."""


class Outcomes:
    """A plugin of pytest: keeps how each test ended.

    Attributes
    ----------
    passed : dict
        Node id and time that a test took [s].
    failed : dict
        Node id and the phase or the type of the exception, with its words.
    """

    def __init__(
        self, passed: dict[str, float] | None = None, failed: dict[str, tuple[str, str]] | None = None
    ) -> None:
        self.passed = passed or {}
        self.failed = failed or {}
        self._seconds = 0.0

    def of(self, tests: Iterable[str]) -> Outcomes:
        """Return what concerns these tests: their own outcomes, and what befell the run as a whole."""
        passed = {test: self.passed[test] for test in tests if test in self.passed}
        failed = {name: said for name, said in self.failed.items() if name in tests or "::" not in name}
        return Outcomes(passed, failed)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Note what a phase of a test came to."""
        self._seconds = report.duration + (self._seconds if report.when != "setup" else 0.0)
        if report.failed:
            crash = getattr(report.longrepr, "reprcrash", None)
            words = crash.message if crash else str(report.longrepr)
            where = words.partition(":")[0] if report.when == "call" else f"its {report.when}"
            self.failed[report.nodeid] = where.strip(), " ".join(words.split())
        elif report.passed and report.when == "call":
            self.passed[report.nodeid] = self._seconds

    def pytest_keyboard_interrupt(self, excinfo: pytest.ExceptionInfo[BaseException]) -> None:
        """Note an interrupt that no guard kept from the test."""
        self.failed["interrupt"] = excinfo.typename, f"{excinfo.typename} ended the tests"

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        """Note what could not be collected."""
        if report.failed:
            self.failed[report.nodeid] = "its collection", " ".join(str(report.longrepr).split())[-200:]


class Tree:
    """A copy of the working tree in which mutants live.

    Parameters
    ----------
    folder : Path
        Where it is made; it must exist.
    limit : float
        Time for the tests of a mutant beside what they usually take [s].
    """

    def __init__(self, folder: Path, limit: float) -> None:
        self.root, self.limit = folder / "tree", limit
        self._base, self._log = folder / "base", folder / "log"
        self._kernels, self._stamp = folder / "kernels", ""
        self.root.mkdir()
        for name in _COPIED:
            source = ROOT / name
            if source.is_dir():
                shutil.copytree(source, self.root / name, ignore=shutil.ignore_patterns("*.fmu", "*.ssp"))
            else:
                shutil.copy2(source, self.root / name)

    def faults(self) -> list[Fault]:
        """Return the marks of the tests."""
        return [Fault(*fields) for fields in self._in_child(_collect)]

    def mutants(self, guard: str) -> list[Mutant]:
        """Return the mutants of a guard of this tree."""
        return mutants(guard, self.root)

    def baseline(self, tests: Iterable[str]) -> Outcomes:
        """Run the tests with all guards in place; the kernels are compiled after that."""
        chosen = sorted(set(tests))
        limit = COMPILING + self.limit * len(chosen)
        outcomes = Outcomes(*self._in_child(_run_tests, chosen, "", False, limit=limit))
        for folder in self._caches():
            shutil.copytree(folder, self._kernels / folder.relative_to(self.root), dirs_exist_ok=True)
        self._stamp = self._in_child(_stamp)
        return outcomes

    def with_mutant(self, mutant: Mutant, tests: Sequence[str], seconds: float) -> Outcomes:
        """Run tests with a mutant; where there is but one, up to its failure.

        Parameters
        ----------
        mutant : Mutant
            One of `mutants`.
        tests : sequence of str
            Node ids.
        seconds : float
            What they take without the mutant [s]; they are given four times that, and `limit`.

        Raises
        ------
        TimeoutError
            If the tests do not end within the limit.
        Died
            If they take their process with them.
        """
        path = self.root / mutant.file
        path.rename(path.with_suffix(".whole"))  # keeps its time, which tells Python that its bytecode holds
        try:
            path.write_text(mutant.text, encoding="utf-8")
            compiled = mutant.file in kernel_modules(self.root)
            stamp, limit = ("", self.limit + COMPILING) if compiled else (self._stamp, self.limit)
            return Outcomes(*self._in_child(_run_tests, tests, stamp, True, limit=limit + 4.0 * seconds))
        finally:
            path.with_suffix(".whole").replace(path)
            if mutant.file.startswith("bearing_fmu/"):
                for folder in self._caches():
                    shutil.rmtree(folder)
                shutil.copytree(self._kernels, self.root, dirs_exist_ok=True)

    def _caches(self) -> list[Path]:
        return list((self.root / "bearing_fmu").rglob("__pycache__"))

    def _in_child(self, work: Callable[..., Any], *arguments: Any, limit: float | None = None) -> Any:
        """Return what `work` returns, plain data, in a fork of this process that lives in the tree."""
        limit = limit or self.limit
        context = multiprocessing.get_context("fork")
        here, there = context.Pipe(duplex=False)
        target = (there, self.root, self._base, self._log, work, arguments)
        process = context.Process(target=_child, args=target)
        process.start()
        there.close()
        try:
            if not here.poll(limit):
                raise TimeoutError(f"no end after {limit:.0f} s")
            return here.recv()
        except EOFError:
            log = self._log.read_text(errors="replace")[-2000:]
            raise Died(f"the process of the tests died\n{log}") from None
        finally:
            with suppress(ProcessLookupError):
                os.killpg(process.pid or 0, signal.SIGKILL)
            process.join()


def _child(to: Connection, root: Path, base: Path, log: Path, work: Callable[..., Any], given: Any) -> None:
    """Run `work` as if Python had been started in the tree."""
    os.setsid()  # so that it can be ended with all that it starts
    with log.open("w") as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)
    os.chdir(root)
    os.environ |= {"PYTHONPATH": str(root), "TMPDIR": str(root.parent), "PYTHONDONTWRITEBYTECODE": "1"}
    tempfile.tempdir = None
    sys.dont_write_bytecode = True  # two mutants of a second and a size would share theirs
    own = (Path.cwd(), ROOT)
    sys.path[:] = [str(root), *(p for p in sys.path if Path(p or ".").resolve() not in own)]
    for name in [n for n in sys.modules if n.partition(".")[0] == "tests"]:
        del sys.modules[name]
    os.environ["HYPOTHESIS_PROFILE"] = "mutant"  # see tests/properties/conftest.py
    os.environ["PYTEST_ADDOPTS"] = f"--basetemp={base} -p no:cacheprovider"
    to.send(work(*given))


def _collect() -> list[tuple[Any, ...]]:
    return [astuple(fault) for fault in collect(Path.cwd())]


def _stamp() -> str:
    """Digest by which the compiled kernels know their sources."""
    return str(importlib.import_module("bearing_fmu.kernels.compiled")._SOURCES)


def _run_tests(tests: Sequence[str], stamp: str, stop: bool) -> tuple[Any, ...]:
    if stamp:  # no kernel changed: take those that are there
        importlib.import_module("bearing_fmu.kernels.compiled")._SOURCES = stamp  # type: ignore[attr-defined]
    outcomes = Outcomes()
    first = ["-x"] if stop and len(tests) == 1 else []
    pytest.main(["-m", "", *first, *tests], plugins=[outcomes])
    return outcomes.passed, outcomes.failed


def kernel_modules(root: Path) -> set[str]:
    """Modules with kernels, and those that they take constants or functions from; classes stay outside."""
    found = set()
    for path in (root / "bearing_fmu").rglob("*.py"):
        imports = [n for n in ast.parse(path.read_text()).body if isinstance(n, ast.ImportFrom) and n.module]
        if "bearing_fmu.kernels.compiled" in [node.module for node in imports]:
            found |= {path.relative_to(root).as_posix()}
            for node in imports:
                names = [alias.name for alias in node.names]
                if any(name.isupper() or name.islower() for name in names):
                    found |= {f"{(node.module or '').replace('.', '/')}.py"}
    return {name for name in found if (root / name).is_file()}
