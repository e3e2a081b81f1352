"""The table of faults in ``README.md``, written from the marks of the tests: ``python -m tests.fault_table``.

With ``--check`` nothing is written, and the exit status is 1 where the page does not say what the marks say,
or where a guard that a mark names does not exist (see `tests.guards`).
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.faults import AREAS
from tests.guards import NoGuard, definition

ROOT = Path(__file__).parents[1]
PAGE = Path(__file__).with_name("README.md")
BEGIN, END = "<!-- faults -->", "<!-- /faults -->"

_TITLES = {
    "input": "Input: scenario, train, command line",
    "archive": "Foreign archives: FMU and SSP",
    "film": "Films",
    "coupling": "Coupling",
    "unit": "Units: the FMUs and what they answer",
    "machine": "The machine: disk, memory, folders",
    "process": "Processes: signals, workers, resuming",
}


@dataclass(frozen=True)
class Fault:
    """A fault and the tests that prove what happens in it.

    Attributes
    ----------
    area, case, outcome, guard : str
        As in `tests.faults.fault`.
    tests : tuple of str
        Node ids of pytest that carry the mark.
    """

    area: str
    case: str
    outcome: str
    guard: str
    tests: tuple[str, ...]

    @property
    def test(self) -> str:
        """Node id without the parameters, or with them where there is but one set."""
        return self.tests[0] if len(self.tests) == 1 else self.tests[0].partition("[")[0]


def faults_of(items: Iterable[pytest.Item]) -> list[Fault]:
    """Group collected tests by what their marks say and by the function."""
    marks: dict[tuple[str, ...], list[str]] = {}
    for item in items:
        for mark in item.iter_markers("fault"):
            said = mark.kwargs
            function = item.nodeid.partition("[")[0]
            key = said["area"], said["case"], said["outcome"], said["guard"], function
            marks.setdefault(key, []).append(item.nodeid)
    return [Fault(*key[:4], tuple(tests)) for key, tests in marks.items()]


class _Collector:
    """The plugin: keeps the faults of all collected tests."""

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        self.faults = faults_of(session.items)


def collect(root: Path = ROOT) -> list[Fault]:
    """Return the faults that the tests below `root` prove, in the order of their collection.

    Raises
    ------
    RuntimeError
        If pytest cannot collect the tests.
    """
    collector = _Collector()
    arguments = ["--collect-only", "-m", "", "-qq", "--no-header", f"--rootdir={root}", str(root / "tests")]
    stdout = os.dup(1)
    try:  # pytest lists every test
        with Path(os.devnull).open("w") as nothing:
            os.dup2(nothing.fileno(), 1)
            status = pytest.main(["-p", "no:cacheprovider", *arguments], plugins=[collector])
    finally:
        sys.stdout.flush()
        os.dup2(stdout, 1)
        os.close(stdout)
    if status != pytest.ExitCode.OK:
        raise RuntimeError(f"pytest could not collect the tests: {status!r}; see pytest --collect-only")
    return collector.faults


def table(faults: Sequence[Fault]) -> str:
    """Return the sections of the page: one for each area, a row for each fault."""
    lines = [f"{len(faults)} faults, {sum(len(f.tests) for f in faults)} tests.", ""]
    for area in AREAS:
        rows = sorted((f for f in faults if f.area == area), key=lambda f: (f.test.partition("[")[0], f.case))
        if not rows:
            continue
        lines += [f"### {_TITLES[area]}", "", "| fault | what happens | test |", "|---|---|---|"]
        for fault in rows:
            file, _, name = fault.test.partition("::")
            link = f"[{_cell(name.partition('[')[0])}]({file.removeprefix('tests/')})"
            lines.append(f"| {_cell(fault.case)} | {_cell(fault.outcome)} | {link} |")
        lines.append("")
    return "\n".join(lines)


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|").replace("_", "\\_")


def page(faults: Sequence[Fault], old: str) -> str:
    """Return the page `old` with the table of these faults between its markers."""
    before, begin, rest = old.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not (begin and end):
        raise ValueError(f"{PAGE.name}: the markers {BEGIN} and {END} are missing")
    return f"{before}{BEGIN}\n{table(faults)}{END}{after}"


def main(arguments: Sequence[str]) -> int:
    """Write or check the page; return the exit status."""
    faults = collect()
    if "--check" not in arguments:
        PAGE.write_text(page(faults, PAGE.read_text(encoding="utf-8")), encoding="utf-8")
        return 0
    problems = problems_of(faults)
    print("\n".join(problems), file=sys.stderr)
    return 1 if problems else 0


def problems_of(faults: Sequence[Fault]) -> list[str]:
    """What the page says otherwise than the marks, and the guards that there are not."""
    old = PAGE.read_text(encoding="utf-8")
    new, problems = page(faults, old), []
    for fault in faults:
        try:
            definition(fault.guard, ROOT)
        except NoGuard as error:
            problems.append(f"{fault.test}: {error}")
    if new != old:
        problems.append(f"{PAGE.name} does not say what the marks say: run python -m tests.fault_table")
    return problems


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
