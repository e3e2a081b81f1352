"""What a reduction costs in the coupled run: ``python -m tests.benchmarks.reductions [scenario] [FMUs]``.

Runs the fracture with every reduction and without, a tenth of a second before and after it, and compares the
bearing forces: RMS of the difference from the unreduced run over the RMS of its forces, both over all
bearings, and for the bearing that is worst off.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from rich.console import Console

from orchestrator.case.simulate import simulate
from orchestrator.fmi.folder import ensure_fmus
from orchestrator.scenario.file import load_scenario, train_of
from orchestrator.scenario.scenario import REDUCTIONS

WINDOW = 0.1
"""Time before and after the fracture [s]."""

LIMIT = 0.02
"""Of the default reduction."""


def run(source: str, reduction: str, fmus: Path) -> tuple[np.ndarray, np.ndarray, float]:
    """Times (samples,) [s], forces (samples, bearings, 2) [N], and wall time [s]."""
    changes = {
        "reduction": reduction,
        "event": {"time": WINDOW},
        "end": 2.0 * WINDOW,
        "record": {"interval": load_scenario(source).step},
    }
    start = time.perf_counter()
    result = simulate(load_scenario(source, changes), fmus)
    if not result.outcome.ok:
        raise RuntimeError(f"{reduction}: {result.message}")
    force = result.record["force"].transpose("time", "bearing", "axis").values
    return result.record["time"].values, force, time.perf_counter() - start


def differences(force: np.ndarray, exact: np.ndarray) -> tuple[float, float]:
    """RMS of the difference over RMS of the exact: over all bearings, and of the worst single one."""
    wrong, size = (np.mean(np.sum(f**2, axis=2), axis=0) for f in (force - exact, exact))
    return float(np.sqrt(wrong.sum() / size.sum())), float(np.sqrt(wrong / size).max())


def report(source: str, fmus: Path) -> bool:
    """Print a line a reduction; whether the default keeps the limit after the fracture."""
    scenario = load_scenario(source)
    train = train_of(scenario)
    depths = {scenario.depth_of(seat.name) for seat in train.bearings}
    ensure_fmus(fmus, train, depths, Console())
    at, exact, wall = run(source, "none", fmus)
    before, after = at <= WINDOW, at > WINDOW
    steps = f"H = {scenario.step:g} s, tolerance {scenario.tolerance}"
    print(f"{source}, depth {scenario.depth}, {steps}, {WINDOW:g} s either side of the fracture")
    sizes = f"{rms(exact[before]):.3e} N before, {rms(exact[after]):.3e} N after"
    print(f"unreduced: {wall:.0f} s, RMS of the forces {sizes}\n")
    print(
        f"{'RMS difference of':15s}{'before':>10s}{'worst':>10s}{'after':>10s}{'worst':>10s}{'wall [s]':>10s}"
    )
    kept = True
    for reduction in (name for name in REDUCTIONS if name != "none"):
        _, force, wall = run(source, reduction, fmus)
        early, late = (differences(force[part], exact[part]) for part in (before, after))
        print(
            f"{reduction:17s}" + "".join(f"{100 * d:9.4f}%" for d in (*early, *late)) + f"{wall:10.0f}",
            flush=True,
        )
        if reduction == "irs":
            kept = max(*early, *late) <= LIMIT
    print(f"\nirs, the default, {'keeps' if kept else 'misses'} {100 * LIMIT:g} % at every bearing")
    return kept


def rms(force: np.ndarray) -> float:
    """Root of the mean square over time and bearings [N]."""
    return float(np.sqrt(np.mean(np.sum(force**2, axis=2))))


if __name__ == "__main__":
    name = sys.argv[1] if len(sys.argv) > 1 else "inertia"
    with tempfile.TemporaryDirectory() as folder:
        sys.exit(0 if report(name, Path(sys.argv[2] if len(sys.argv) > 2 else folder)) else 1)
