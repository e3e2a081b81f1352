"""Benchmark d: how cost grows with bearings, film resolution and degrees of freedom.

``python -m tests.benchmarks d``
"""

from __future__ import annotations

import tempfile
from functools import partial
from pathlib import Path

import numpy as np

from bearing_fmu.film import make_film
from bearing_fmu.recipe import bearing_recipe
from fmus import port
from fmus.build.builder import write
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.unit import Unit
from orchestrator.master.graph import Graph
from rotor_fmu.reduction.reduce import reduce
from rotor_fmu.train.file import load_train
from rotor_fmu.vibration.modal_shaft import to_modal
from rotor_fmu.vibration.prepared import PreparedShaft, prepare_shaft
from rotor_fmu.vibration.rotor import Rotor
from rotor_fmu.vibration.unbalance import Unbalance
from tests.bearing_fmu.bearings import lever, plain
from tests.benchmarks.rotor import oil_films
from tests.benchmarks.table import least_time, show

BEARINGS = (1, 2, 4, 11, 22, 44, 88)
RESOLUTIONS = ((32, 8), (48, 8), (64, 8), (96, 8), (128, 8), (48, 6), (48, 12), (48, 16))
SIZES = (50, 100, 160, 250, 500, 1000)
STEP = 1e-4


def bearings() -> None:
    """Step and exchange of many bearing FMUs of depth V1."""
    inputs = [v.name for v in port.BEARING_INPUTS]
    outputs = [v.name for v in port.BEARING_OUTPUTS]
    rows = []
    with tempfile.TemporaryDirectory() as folder, FmuStore() as store:
        file = store.open(write(bearing_recipe("v1"), Path(folder)))
        for count in BEARINGS:
            units = [Unit(file, f"bearing-{k}") for k in range(count)]
            for unit in units:
                unit.enter_initialization()
                unit.exit_initialization()
            group = Graph([(unit, inputs, outputs) for unit in units], []).group(u.name for u in units)
            repeats = max(3, 200 // count)
            step = least_time(partial(group.step, 0.0, STEP), repeats=repeats)
            exchange = least_time(group.push, repeats=repeats) + least_time(group.fetch, repeats=repeats)
            each = 1e6 * (step + exchange) / count
            rows.append((count, f"{1e3 * step:.3f}", f"{1e3 * exchange:.3f}", f"{each:.1f}"))
            for unit in units:
                unit.close()
    show(
        "d. Growth with the bearings: V1 at half eccentricity through FMI, a macro step",
        ("bearings", "step ms", "set and get ms", "us a bearing"),
        rows,
    )


def resolutions() -> None:
    """Wrench and tangent of one film."""
    rows = []
    for columns, count in RESOLUTIONS:
        parameters = plain(0.8, columns=columns, rows=count)
        film = make_film("v1", parameters)
        inputs, out = np.zeros(17), np.zeros(58)
        inputs[:4], inputs[16] = np.array([0.3, -0.8, 0.02, 0.05]) * lever(parameters), 1.0
        seconds = least_time(partial(film.evaluate, inputs, np.zeros(4), out), repeats=200)
        rows.append((f"{columns} x {count}", f"{1e6 * seconds:.1f}"))
    show("d. Growth with the film's resolution: wrench and tangent", ("columns x rows", "us"), rows)


def degrees_of_freedom() -> None:
    """Step of the big train's rotor."""
    train = load_train("turbine")
    shaft = prepare_shaft(train, "craig-bampton")
    excitation = Unbalance.of_train(train, None, None, None, None, np.inf)
    law = oil_films(train)
    rows = []
    for size in SIZES:
        reduced = reduce(shaft.model, "craig-bampton", size=size)
        prepared = PreparedShaft(shaft.model, reduced, to_modal(reduced), shaft.bending)
        rotor = Rotor(prepared, excitation, gravity=9.80665, speed=train.speed)
        rotor.start_from_law(*law, orbit=True)
        seconds = least_time(partial(rotor.step, 0.0, STEP, *law, train.speed), repeats=50, rounds=5)
        rows.append((rotor.shaft.size, f"{1e3 * seconds:.3f}"))
    show(
        "d. Growth with the rotor's reduced degrees of freedom: a step, 11 bearings",
        ("degrees of freedom", "ms"),
        rows,
    )


def main() -> None:
    """Print the three tables."""
    bearings()
    resolutions()
    degrees_of_freedom()


if __name__ == "__main__":
    main()
