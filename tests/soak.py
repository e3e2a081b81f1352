"""The small train for a million macro steps: ``python -m tests.soak [STEPS]``.

Prints steps, resident memory and processor time a step, for each tenth of the run.  The exit status is 1
where the memory of the last tenth is more than `GROWTH` above that of the first, or its step takes more
than `SLOWDOWN` times as long.  The first step of a tenth is not in its time, the start of the run in none.

The record grows by design, with its instants; here it takes one a thousand steps, all of whose room
is taken before the first step.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from orchestrator.case.progress import Stage
from orchestrator.case.simulate import simulate
from orchestrator.fmi.folder import build
from orchestrator.outcome import Outcome
from orchestrator.scenario.file import load_scenario, train_of

GROWTH = 4 << 20
"""Bytes by which the memory may grow from the end of the first tenth to that of the last."""
SLOWDOWN = 1.5
"""Largest ratio of the times of a step in the last tenth and the first."""
TENTHS = 10
_STEP = 1e-4
_RECORD = 1000  # steps


@dataclass(frozen=True)
class Tenth:
    """A tenth of the run: last step, resident memory at its end [bytes], processor time a step [s]."""

    step: int
    resident: int
    seconds: float


def resident() -> int:
    """Memory of this process that is in use now [bytes]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


Show = Callable[[Tenth], None]


def soak(fmus: Path, steps: int, show: Show = lambda _: None, depth: str = "v1") -> list[Tenth]:
    """Run the small train and watch it.

    Parameters
    ----------
    fmus : Path
        Folder with its FMUs.
    steps : int
        Macro steps.
    show : callable
        Told each tenth as it ends.
    depth : str
        Of the bearings.

    Raises
    ------
    RuntimeError
        If the run does not reach its end.
    """
    end = steps * _STEP
    changes = {
        "depth": depth,
        "step": _STEP,
        "end": end,
        "event": {"time": 0.05 * end},
        "record": {"interval": _RECORD * _STEP},
    }
    tenths: list[Tenth] = []
    done, begin = 0, 0.0

    def progress(stage: Stage, _simulated: float) -> None:
        nonlocal done, begin
        if stage is not Stage.RUN:
            return
        if done % (steps // TENTHS) == 0 and done:
            spent = time.process_time() - begin
            tenths.append(Tenth(done, resident(), spent / (steps // TENTHS - 1)))
            show(tenths[-1])
        done += 1
        if done % (steps // TENTHS) in (1, 2):  # the step after a boundary, and the one before the first
            begin = time.process_time()

    result = simulate(load_scenario("small", changes), fmus, progress)
    if result.outcome is not Outcome.FINISHED:
        raise RuntimeError(f"{result.outcome.value}: {result.message}")
    return tenths


def growth(tenths: Sequence[Tenth]) -> int:
    """Memory at the end over that at the end of the first tenth [bytes]."""
    return tenths[-1].resident - tenths[0].resident


def main(arguments: Sequence[str]) -> int:
    """Soak and print; return the exit status."""
    steps = int(float(arguments[0])) if arguments else 1_000_000
    if steps < 10 * TENTHS:
        print(f"steps = {steps}; allowed are at least {10 * TENTHS}", file=sys.stderr)
        return 2
    print(f"{'step':>9} {'memory':>10} {'a step':>9}")
    with tempfile.TemporaryDirectory() as folder:
        build(Path(folder), [train_of(load_scenario("small"))])
        tenths = soak(Path(folder), steps - steps % TENTHS, _print)
    slowdown = tenths[-1].seconds / tenths[0].seconds
    print(
        f"memory {growth(tenths) / 2**20:+.2f} MiB (at most {GROWTH / 2**20:g}), "
        f"time a step times {slowdown:.2f} (at most {SLOWDOWN:g})"
    )
    return int(growth(tenths) > GROWTH or slowdown > SLOWDOWN)


def _print(tenth: Tenth) -> None:
    print(f"{tenth.step:9d} {tenth.resident / 2**20:6.1f} MiB {1e6 * tenth.seconds:6.0f} us", flush=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
