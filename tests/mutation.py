"""Takes each guard away and requires its test to fail: ``python -m tests.mutation [-k WORD]``.

For every mark of `tests.faults` the text it names is replaced in a copy of the working tree, and the tests
that carry the mark run there.  A line says what came of it:

killed
    The test failed, in its own body, or its process died: it proves the guard.  Its last words are shown,
    for a reader to judge.
hangs
    It did not end within the time limit (``--limit``, seconds); without the guard, that is a failure.
survived
    The test passed all the same: it does not prove what it says.
invalid
    Nothing was shown: the text is not there exactly once, the test does not pass with the guard in place, or
    what failed was an import, the collection or a fixture.

The exit status is 0 where every guard was killed or hangs.  Mutants run in forks of one process that has
imported the libraries, and keep the compiled kernels unless a kernel is what changed: some seconds each.
"""

from __future__ import annotations

import argparse
import importlib
import os
import sys
import tempfile
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from tests.fault_table import Fault, NotOnce
from tests.mutant_tree import Died, Outcomes, Tree

_LIBRARIES = (
    "numba", "scipy.sparse.linalg", "scipy.integrate", "scipy.optimize", "xarray", "h5netcdf", "pydantic",
    "typer", "rich.live", "matplotlib.figure", "fmpy.simulation", "pythonfmu", "lxml.etree",
)  # fmt: skip
_NO_PROOF = ("ImportError", "ModuleNotFoundError", "SyntaxError", "NameError", "IndentationError")


@dataclass(frozen=True)
class Verdict:
    """What came of a mutant: one of the words of the module's page, and the reason."""

    word: str
    reason: str


def verdict_on(tree: Tree, whole: Outcomes, fault: Fault) -> Verdict:
    """Take the guard of a fault away; `whole` is how the tests ended with all guards in place."""
    for test in fault.tests:
        if test not in whole.passed:
            _, why = whole.failed.get(test, ("", "it was skipped or not found"))
            return Verdict("invalid", f"with the guard in place it does not pass: {why}")
    try:
        return judged(tree.without_guard(fault))
    except NotOnce as error:
        return Verdict("invalid", str(error))
    except Died as error:
        return Verdict("killed", " ".join(str(error).split()))
    except TimeoutError as error:
        return Verdict("hangs", str(error))


def judged(outcomes: Outcomes) -> Verdict:
    """Say what the outcomes of a mutant's tests show."""
    proofs = [words for where, words in outcomes.failed.values() if _is_proof(where)]
    if proofs:
        return Verdict("killed", proofs[0])
    if outcomes.failed:
        where, words = next(iter(outcomes.failed.values()))
        return Verdict("invalid", f"what failed was {where}: {words}")
    if not outcomes.passed:
        return Verdict("invalid", "no test ran")
    return Verdict("survived", "the test passed without its guard")


def _is_proof(where: str) -> bool:
    return not where.startswith("its ") and where not in _NO_PROOF


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the mutants that match; return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutation", description=__doc__.partition("\n")[0])
    parser.add_argument("-k", metavar="WORD", default="", help="faults with this in area, case, file, test")
    parser.add_argument("--limit", type=float, default=120.0, help="longest time for a mutant, in seconds")
    options = parser.parse_args(arguments)
    word = options.k.casefold()
    for name in _LIBRARIES:
        with suppress(ImportError):
            importlib.import_module(name)
    verdicts: list[Verdict] = []
    with tempfile.TemporaryDirectory() as folder:
        tree = Tree(Path(folder), options.limit)
        said = ((fault, (fault.broken[0], fault.area, fault.case, *fault.tests)) for fault in tree.faults())
        chosen = [fault for fault, words in said if word in " ".join(words).casefold()]
        whole = tree.baseline(chosen)
        for fault in chosen:
            begin = time.monotonic()
            verdict = verdict_on(tree, whole, fault)
            verdicts.append(verdict)
            seconds = time.monotonic() - begin
            print(f"{verdict.word:8} {seconds:5.1f} s  {fault.test}: {fault.case}")
            print(f"{'':18}{verdict.reason[:160]}", flush=True)
    words = ("killed", "hangs", "survived", "invalid")
    counts = {word: sum(v.word == word for v in verdicts) for word in words}
    print(f"{len(verdicts)} faults: " + ", ".join(f"{count} {word}" for word, count in counts.items()))
    return 1 if counts["survived"] or counts["invalid"] else 0


if __name__ == "__main__":
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    sys.exit(main())
