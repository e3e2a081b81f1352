"""Benchmark j: a macro step while the speed changes against one at constant speed.

``python -m tests.benchmarks j``, or ``python -m tests.benchmarks.turning small v2 v3``.
"""

from __future__ import annotations

import sys

from orchestrator.scenario.file import train_of
from tests.benchmarks.runs import Case, prepare, run
from tests.benchmarks.table import show

WAYS = {
    "constant": {},
    "constant, through a course": {"rotation": {"course": [[0.0, "speed"]]}},
    "prescribed, falling": {"rotation": {"course": [[0.0, "speed"], [10.0, "half"]]}},
    "free, after a trip": {"rotation": {"haste": 100.0}, "events": [{"kind": "trip", "time": 0.0}]},
}
"""Rotation and events of each, beside a lost blade."""
ROUNDS = 3
"""Runs of each, one after the other, of which the quickest counts."""


def _changes(case: Case, way: dict[str, object], speed: float) -> dict[str, object]:
    words = {"speed": speed, "half": 0.5 * speed}
    scenario = case.scenario()
    lost = scenario.events[0].model_dump(exclude_none=True, include={"wheel", "unbalance", "phase"})
    lost["time"] = 0.5 * scenario.end
    rotation = dict(way.get("rotation", {}))  # type: ignore[call-overload]
    if "course" in rotation:
        rotation["course"] = [[at, words[word]] for at, word in rotation["course"]]
    events = [lost, *way.get("events", [])]  # type: ignore[misc]
    return {"events": events} | ({"rotation": rotation} if rotation else {})


def main(source: str = "inertia", depths: tuple[str, ...] = ("v1", "v2", "v3"), end: float = 0.03) -> None:
    """Print processor time of a macro step and its ratio to that at constant speed, for each depth."""
    rows, ends = [], {"v1": end}
    for depth in depths:
        case = prepare(
            source,
            depth=depth,
            end=ends.get(depth, 4.0 * end),
            event={"time": 0.5 * end},
            coupling="linear-implicit",
        )
        speed = abs(case.scenario().start_speed(_speed(case)))
        plain = {"event": None, "tolerance": None}
        given = {name: {**plain, **_changes(case, way, speed)} for name, way in WAYS.items()}
        found: dict[str, list[tuple[float, float]]] = {name: [] for name in WAYS}
        for turn in range(ROUNDS + 1):
            for name, changes in given.items():
                timed = run(case, **changes)
                if turn:  # the first compiles, and fills the caches of the rotor's maps
                    steps = timed.result.steps
                    found[name].append((timed.cpu / steps, timed.result.timing.rotor / steps))
        best = {name: min(times) for name, times in found.items()}
        base = best["constant"][0]
        rows += [
            (f"{depth}, {name}", f"{1e3 * cpu:.3f}", f"{1e3 * rotor:.3f}", f"{cpu / base:.2f}")
            for name, (cpu, rotor) in best.items()
        ]
    show(
        f"j. Macro step at changing speed: {source}, linear-implicit, fixed step, least of {ROUNDS} runs",
        ("depth, speed", "ms a step", "rotor ms, wall", "ratio"),
        rows,
    )


def _speed(case: Case) -> float:
    return train_of(case.scenario()).speed


if __name__ == "__main__":
    main(*sys.argv[1:2], **({"depths": tuple(sys.argv[2:])} if sys.argv[2:] else {}))
