"""All samples of a study held against the schema of scenario and train, before anything runs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from orchestrator.study.ensemble.running.subject import Sample, Subject
from orchestrator.study.ensemble.sampling.file import StudyFile
from rotor_fmu.train.toml_source import Problem


def sample_problems(
    file: StudyFile, subject: Subject, samples: Sequence[Sample], depths: Sequence[str]
) -> Iterator[Problem]:
    """Yield what is wrong with samples, at the line of the parameter to which it is due.

    Parameters
    ----------
    file : StudyFile
        For the names of parameters.
    subject : Subject
        Says what is wrong.
    samples : sequence of mapping
        All of them.
    depths : sequence of str
        At which they are to be run.
    """
    found: dict[tuple[str, str], list[Any]] = {}
    for index, sample in enumerate(samples):
        for depth in depths:
            problems = subject.problems(sample, depth)
            if not problems:
                continue
            alone = [n for n in sample if subject.problems({n: sample[n]}, depth)] if len(found) < 20 else []
            for name in alone or [""]:
                key = (name, depth if not name else "")
                first = subject.problems({name: sample[name]}, depth) if name else problems
                found.setdefault(key, [index, sample, first, set()])[3].add(index)
    for (name, depth), (index, sample, problems, which) in found.items():
        others = f", and {len(which) - 1} more" if len(which) > 1 else ""
        where = (
            f"parameters.{name} = {sample[name]!r}" if name else f"parameters {dict(sample)} at depth {depth}"
        )
        at = ("parameters", name) if name else ("parameters",)
        for text in problems:
            yield at, f"{where} (sample {index}{others}): {text}"
