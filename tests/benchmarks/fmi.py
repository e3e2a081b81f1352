"""What FMI costs beside the physics: ``python -m tests.benchmarks.fmi [train]``.

One macro step of a train on bearings of depth v3, whose film takes next to nothing: set and get the
affine laws and the journals, step every unit.  By prepared calls, as the master does it, and by fmpy's lists.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from bearing_fmu.recipe import bearing_recipe
from fmus import port
from fmus.build.builder import write
from orchestrator.fmi.block import Block
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.unit import Unit
from rotor_fmu.recipe import rotor_recipe
from rotor_fmu.train.file import load_train

H = 1e-4


def least_time(call: Callable[[], object], repeats: int = 200) -> float:
    """Least mean time of `repeats` calls over five rounds [s]: what is left when nobody disturbs."""
    best = float("inf")
    for _ in range(5):
        start = time.perf_counter()
        for _ in range(repeats):
            call()
        best = min(best, (time.perf_counter() - start) / repeats)
    return best


def state_cycle(unit: Unit) -> None:
    """Get, set and free a state."""
    state = unit.get_state()
    unit.set_state(state)
    unit.free_state(state)


def lists(unit: Unit, names: list[str]) -> tuple[Callable[[], object], Callable[[], object]]:
    """Get and set by fmpy's lists."""
    references = [unit.variable(name).valueReference for name in names]
    values = unit._slave.getReal(references)
    return lambda: unit._slave.getReal(references), lambda: unit._slave.setReal(references, values)


def main(train_name: str = "turbine") -> None:
    """Print the table of times in microseconds."""
    train = load_train(train_name)
    count = len(train.bearings)
    rows: list[tuple[str, int, float]] = []
    with tempfile.TemporaryDirectory() as folder, FmuStore() as store:
        files = [store.open(write(r, Path(folder))) for r in (rotor_recipe(train), bearing_recipe("v3"))]
        begin = time.perf_counter()
        rotor, bearing = Unit(files[0], "rotor"), Unit(files[1], "bearing")
        for unit in (rotor, bearing):
            unit.enter_initialization()
            unit.exit_initialization()
        rows.append(("load, compile and start both, ms", 1, 1e-3 * (time.perf_counter() - begin)))
        laws = [port.at_bearing(i, name) for i in range(1, count + 1) for name in port.LAW]
        journals = [port.at_bearing(i, name) for i in range(1, count + 1) for name in port.JOURNAL]
        sets = {
            "rotor: laws": (rotor, laws, 1),
            "rotor: journals": (rotor, journals, 1),
            "bearing: journal": (bearing, list(port.JOURNAL), count),
            "bearing: law": (bearing, list(port.LAW), count),
            "bearing: all outputs": (bearing, [v.name for v in port.BEARING_OUTPUTS], count),
        }
        for text, (unit, names, times) in sets.items():
            values = np.zeros(len(names))
            block = Block(unit, names, values)
            block.get()
            inputs = {v.name for v in unit.file.description.modelVariables if v.causality == "input"}
            way = "set" if names[0] in inputs else "get"
            by_list = lists(unit, names)[way == "set"]
            call = block.set if way == "set" else block.get
            rows.append((f"{text}, {way} {len(names)}", times, least_time(call)))
            rows.append((f"{text}, {way} {len(names)}, fmpy's lists", times, least_time(by_list)))
        rows.append(("rotor: step", 1, least_time(lambda: rotor.do_step(0.0, H))))
        rows.append(("bearing: step", count, least_time(lambda: bearing.do_step(0.0, H))))
        extremes = Block(rotor, ["amplitude.max", "stress.max"], np.zeros(2))

        def observed_step() -> None:
            rotor.do_step(0.0, H)
            extremes.get()

        rows.append(("rotor: step and extremes", 1, least_time(observed_step)))
        rows.append(("rotor: get, set, free state", 1, least_time(lambda: state_cycle(rotor))))
        rows.append(("bearing: get, set, free state", count, least_time(lambda: state_cycle(bearing))))
        rotor.close()
        bearing.close()
    print(f"{'call':44} {'a call':>9} {'times':>6} {'a macro step':>13}   us")
    for text, times, seconds in rows:
        print(f"{text:44} {1e6 * seconds:9.2f} {times:6d} {1e6 * seconds * times:13.1f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
