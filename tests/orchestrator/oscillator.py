"""Oscillators of two masses on a spring-damper each: as a system of three FMUs, and integrated as a whole."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

from orchestrator.fmi.unit import Unit
from orchestrator.master.system import System, Wiring

JOURNAL_MASS, INNER_MASS, SHAFT_STIFFNESS, SHAFT_DAMPING = 100.0, 400.0, 4e6, 1e3
DISPLACEMENT = 1e-3


def make_system(store, folder, wiring=Wiring.LAW, rotor=None, bearing=None):
    """Units with their parameters, instantiated and connected."""
    system = System(
        Unit(store.open(folder / "two_masses.fmu"), "rotor"),
        [Unit(store.open(folder / "spring_damper.fmu"), name) for name in ("front", "rear")],
        wiring,
    )
    system.rotor.set_parameters({"gravity": 0.0, **(rotor or {})})
    soft = {"spring.stiffness": 1e6, "spring.damping": 1e3, "clearance": 1e300}
    for unit in system.bearings:
        unit.set_parameters({**soft, **(bearing or {})})
    return system


def released(store, folder, wiring=Wiring.LAW, **bearing):
    """Both masses over the front bearing held at `DISPLACEMENT` in x and let go at t = 0."""
    start = {"bearing[1].start.x": DISPLACEMENT, "start.orbit": False}
    system = make_system(store, folder, wiring, start, {f"spring.{k}": v for k, v in bearing.items()})
    begin(system)
    return system


def begin(system):
    """Initialize all units and read their first outputs."""
    for unit in system.units:
        unit.enter_initialization()
    for group in system.groups:
        group.push()
        group.feed()
        group.fetch()
    for unit in system.units:
        unit.exit_initialization()
    for group in system.groups:
        group.fetch()


def motion(scheme, system, step, end):
    """Return x of the front journal after every macro step."""
    path = [system.journals[0, 0]]
    for k in range(round(end / step)):
        scheme.advance(system, k * step, step)
        path.append(system.journals[0, 0])
    return np.array(path)


def exact_motion(times, stiffness=1e6, damping=1e3, cubic=0.0):
    """Return x of the front journal by an independent integration of the whole oscillator, to 1e-12."""

    def rates(_t, z):
        x1, x2, v1, v2 = z
        link = SHAFT_STIFFNESS * (x2 - x1) + SHAFT_DAMPING * (v2 - v1)
        film = -stiffness * x1 - damping * v1 - cubic * x1**3
        return [v1, v2, (link + film) / JOURNAL_MASS, -link / INNER_MASS]

    z0 = [DISPLACEMENT, DISPLACEMENT, 0.0, 0.0]
    solution = solve_ivp(rates, (0.0, times[-1]), z0, "DOP853", times, rtol=1e-12, atol=1e-16)
    return solution.y[0]
