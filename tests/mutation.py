"""Changes each guard and requires its tests to fail: ``python -m tests.mutation [-k WORD] [--sample N]``.

For every mark of `tests.faults` the mutants of the guard it names (`tests.guards`) live one by one in a copy
of the working tree, and the tests that carry the mark run there, until one mutant makes each of them fail.  A
line says what came of the mark:

killed
    The test failed with a mutant, in its own body, or its process died: it proves the guard.  Mutant and last
    words are shown, for a reader to judge.
hangs
    It did not end within the time limit (``--limit``, seconds); with the guard gone, that is a failure.
survived
    The test passed with every mutant: it does not prove what it says.
invalid
    Nothing was shown: there is no such guard, the test does not pass with the guard in place, or what failed
    was an import, the collection or a fixture.
not tried
    The time (``--time``, seconds) was over.

With ``--all`` every mutant of every guard lives, and those that no marked test kills are listed: what a guard
does and nothing proves.  The exit status is 0 where every mark's guard was killed or hangs, or was not tried.
Mutants run in forks of one process that has imported the libraries, and keep the compiled kernels unless a
kernel is what changed: some seconds each.
"""

from __future__ import annotations

import argparse
import importlib
import os
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from tests.fault_table import Fault
from tests.guards import Mutant, NoGuard
from tests.mutant_tree import Died, Outcomes, Tree

_LIBRARIES = (
    "numba", "scipy.sparse.linalg", "scipy.integrate", "scipy.optimize", "xarray", "h5netcdf", "pydantic",
    "typer", "rich.live", "matplotlib.figure", "fmpy.simulation", "pythonfmu", "lxml.etree",
)  # fmt: skip
_NO_PROOF = ("ImportError", "ModuleNotFoundError", "SyntaxError", "NameError", "UnboundLocalError")
_WORDS = ("killed", "hangs", "survived", "invalid", "not tried")


@dataclass(frozen=True)
class Verdict:
    """What came of a mark or a mutant: one of the words of the module's page, and the reason."""

    word: str
    reason: str

    @property
    def is_proof(self) -> bool:
        """Whether the guard is proven by it."""
        return self.word in ("killed", "hangs")


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
    return Verdict("survived", "the test passed with every mutant")


def _is_proof(where: str) -> bool:
    return not where.startswith("its ") and where not in _NO_PROOF


class Guard:
    """A guard and the marks that name it.

    Parameters
    ----------
    tree : Tree
        Where mutants live.
    whole : Outcomes
        How the tests ended with all guards in place.
    faults : sequence of Fault
        The marks.
    """

    def __init__(self, tree: Tree, whole: Outcomes, faults: Sequence[Fault]) -> None:
        self._tree, self._whole = tree, whole
        self.verdicts = {fault: _of_baseline(whole, fault) for fault in faults}
        self.survivors: list[Mutant] = []
        try:
            self.mutants = tree.mutants(faults[0].guard)
            if not self.mutants:
                raise NoGuard(f"{faults[0].guard} has no mutants")
        except NoGuard as error:
            self.mutants = []
            self.verdicts = dict.fromkeys(faults, Verdict("invalid", str(error)))

    def prove(self, end: float, every: bool) -> None:
        """Let mutants live until each mark is proven, or `every` one of them, up to a time."""
        sound = [fault for fault, verdict in self.verdicts.items() if verdict.word == "not tried"]
        for mutant in self.mutants:
            tried = sound if every else [fault for fault in sound if not self.verdicts[fault].is_proof]
            if not tried or time.monotonic() > end:
                break
            found = dict(self._trial(mutant, tried))
            for fault, verdict in found.items():
                if not self.verdicts[fault].is_proof:
                    said = f"line {mutant.line}: {mutant.change}: {verdict.reason}"
                    self.verdicts[fault] = Verdict(verdict.word, said if verdict.is_proof else verdict.reason)
            if every and not any(verdict.is_proof for verdict in found.values()):
                self.survivors.append(mutant)
        else:
            return
        for fault in sound:  # the time was over
            if not self.verdicts[fault].is_proof:
                self.verdicts[fault] = Verdict("not tried", "no time was left")

    def _trial(self, mutant: Mutant, faults: Sequence[Fault]) -> Iterator[tuple[Fault, Verdict]]:
        tests = list(dict.fromkeys(test for fault in faults for test in fault.tests))
        try:
            outcomes = self._tree.with_mutant(mutant, tests, sum(self._whole.passed[test] for test in tests))
        except (Died, TimeoutError) as error:
            if len(faults) == 1:
                word = "killed" if isinstance(error, Died) else "hangs"
                yield faults[0], Verdict(word, " ".join(str(error).split()))
            else:  # whose test was it?
                for fault in faults:
                    yield from self._trial(mutant, [fault])
        else:
            yield from ((fault, judged(outcomes.of(fault.tests))) for fault in faults)


def _of_baseline(whole: Outcomes, fault: Fault) -> Verdict:
    for test in fault.tests:
        if test not in whole.passed:
            _, why = whole.failed.get(test, ("", "it was skipped or not found"))
            return Verdict("invalid", f"with the guard in place it does not pass: {why}")
    return Verdict("not tried", "no time was left")


def chosen(faults: Sequence[Fault], word: str, sample: int) -> list[Fault]:
    """Return the faults that hold the word, or that many of them, spread evenly."""
    said = ((fault, (fault.guard, fault.area, fault.case, *fault.tests)) for fault in faults)
    found = [fault for fault, words in said if word.casefold() in " ".join(words).casefold()]
    return found[:: max(1, len(found) // sample)][:sample] if sample else found


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the mutants that match; return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutation", description=__doc__.partition("\n")[0])
    parser.add_argument("-k", metavar="WORD", default="", help="faults with this in area, case, guard, test")
    parser.add_argument("--sample", type=int, default=0, metavar="N", help="only so many, of all areas")
    parser.add_argument("--all", action="store_true", help="list the mutants that no test kills, too")
    parser.add_argument("--limit", type=float, default=30.0, help="more time than usual for a mutant [s]")
    parser.add_argument("--time", type=float, default=float("inf"), help="time for all mutants together [s]")
    options = parser.parse_args(arguments)
    for name in _LIBRARIES:
        with suppress(ImportError):
            importlib.import_module(name)
    verdicts: list[Verdict] = []
    with tempfile.TemporaryDirectory() as folder:
        tree = Tree(Path(folder), options.limit)
        faults = chosen(tree.faults(), options.k, options.sample)
        whole = tree.baseline(test for fault in faults for test in fault.tests)
        end = time.monotonic() + options.time
        for name in dict.fromkeys(fault.guard for fault in faults):
            begin = time.monotonic()
            guard = Guard(tree, whole, [fault for fault in faults if fault.guard == name])
            guard.prove(end, options.all)
            print(f"{name}  {len(guard.mutants)} mutants, {time.monotonic() - begin:.1f} s")
            for fault, verdict in guard.verdicts.items():
                print(f"  {verdict.word:9} {fault.test}: {fault.case}\n{'':12}{verdict.reason[:160]}")
            for mutant in guard.survivors:
                print(f"  nothing kills {mutant.file}:{mutant.line}: {mutant.change}")
            sys.stdout.flush()
            verdicts += guard.verdicts.values()
    counts = {word: sum(v.word == word for v in verdicts) for word in _WORDS}
    print(f"{len(verdicts)} faults: " + ", ".join(f"{count} {word}" for word, count in counts.items()))
    return 1 if counts["survived"] or counts["invalid"] else 0


if __name__ == "__main__":
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    sys.exit(main())
