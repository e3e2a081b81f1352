"""Which runs a study consists of: each sample at each depth, then at deeper ones where a rule says so."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from orchestrator.results.ensemble.figures import one_number
from orchestrator.results.ensemble.files import RUNS
from orchestrator.study.ensemble.gathering.gather import Rows, dataset_of
from orchestrator.study.ensemble.running.bench import Work
from orchestrator.study.ensemble.running.crowd import Crowd
from orchestrator.study.ensemble.running.row import TRIED_AGAIN, Row, read_row, write_row
from orchestrator.study.ensemble.running.subject import Subject
from orchestrator.study.ensemble.sampling.samples import Samples
from orchestrator.study.ensemble.sampling.schema import Study

Runs = list[tuple[int, str]]
"""Sample and depth of each."""


@dataclass
class Store:
    """What is kept of the runs, a file each in a folder; this process alone writes there.

    Attributes
    ----------
    folder : Path
        Of the study.
    retry : bool
        Whether runs that died, hung or took too long are done again.
    """

    folder: Path
    retry: bool = False
    rows: dict[str, Row] = field(default_factory=dict)

    def path(self, digest: str) -> Path:
        """The file of a run."""
        return self.folder / RUNS / f"{digest}.json"

    def find(self, digest: str) -> Row | None:
        """The row of a run that is done."""
        if digest not in self.rows:
            row = read_row(self.path(digest))
            if row is None or (self.retry and row.outcome in TRIED_AGAIN):
                return None
            self.rows[digest] = row
        return self.rows[digest]

    def put(self, digest: str, row: Row) -> None:
        """Keep a row."""
        write_row(row, self.path(digest))
        self.rows[digest] = row


@dataclass(frozen=True)
class Plan:
    """What there is to do.

    Attributes
    ----------
    study, subject, samples : Study, Subject, Samples
        What is asked for.
    """

    study: Study
    subject: Subject
    samples: Samples

    @property
    def depths(self) -> list[str]:
        """Of both stages."""
        return [*self.subject.depths, *(self.study.refine.depths if self.study.refine else ())]

    def first(self) -> Runs:
        """The runs of the first stage, those of one sample side by side."""
        return [(index, depth) for index in range(len(self.samples)) for depth in self.subject.depths]

    def second(self, rows: Mapping[tuple[int, str], Row]) -> Runs:
        """The runs that follow from the rows of the first stage."""
        refine = self.study.refine
        if refine is None:
            return []
        data = dataset_of(self.study, self.samples, Rows(self.subject.depths, rows))
        depth = refine.depth or self.subject.depths[0]
        if refine.figure in data:
            values = one_number(data, refine.figure).sel(depth=depth).values
        else:
            values = np.full(len(self.samples), np.nan)
        asked = values < refine.below if refine.below is not None else values > refine.above
        chosen = np.flatnonzero(asked | np.isnan(values))
        return [(int(index), depth) for index in chosen for depth in refine.depths]

    def digests(self, runs: Runs) -> dict[tuple[int, str], str]:
        """What each run is known by."""
        return {(i, depth): self.subject.digest(self.samples[i], depth) for i, depth in runs}


def carry_out(
    plan: Plan,
    digests: Mapping[tuple[int, str], str],
    store: Store,
    crowd: Crowd,
    done: Callable[[Row], None],
) -> None:
    """Do the runs that are missing, equal ones once; each is kept as soon as it has ended."""
    missing: dict[str, tuple[int, str]] = {}
    for run, digest in digests.items():
        if digest not in missing and store.find(digest) is None:
            missing[digest] = run

    def works() -> Iterator[tuple[str, Callable[[], Work]]]:
        for digest, (index, depth) in missing.items():
            yield digest, lambda i=index, d=depth: plan.subject.work(plan.samples[i], d)  # type: ignore[misc]

    def keep(digest: str, row: Row) -> None:
        store.put(digest, row)
        done(row)

    crowd.carry_out(works(), keep)


def missing_of(digests: Mapping[tuple[int, str], str], store: Store) -> int:
    """How many runs are still to be done."""
    return len({digest for digest in digests.values() if store.find(digest) is None})


def rows_of(digests: Mapping[tuple[int, str], str], store: Store) -> dict[tuple[int, str], Row]:
    """The rows of runs that are done."""
    found = {run: store.find(digest) for run, digest in digests.items()}
    return {run: row for run, row in found.items() if row is not None}


def loops(rows: Sequence[Row]) -> tuple[float, float]:
    """Of runs that were simulated: median of the time loop, and of what there was besides, wall time in s."""
    timed = [row.timing for row in rows if "loop" in row.timing]
    if not timed:
        return 0.0, 0.0
    rest = float(np.median([one["run"] - one["loop"] for one in timed]))
    return float(np.median([one["loop"] for one in timed])), rest
