"""A closed loop of direct feedthrough with a known answer: both units answer within the same instant.

A massless shaft q = q0 + S w on bearings w = -k q, S full and unsymmetric.  The answer is
q = (1 + k S)^-1 q0.  Passing values round the loop once multiplies the error by -k S, so that explicit
coupling reaches the answer where the spectral radius of k S is below one, and leaves it where it is above.
"""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from pythonfmu.builder import FmuBuilder

from orchestrator.fmi.unit import Unit
from orchestrator.master.coupling import SCHEMES, make_scheme
from orchestrator.master.system import System, Wiring
from tests.orchestrator.oscillator import begin

UNITS = Path(__file__).parents[1] / "units"
EXPLICIT = ("jacobi", "gauss-seidel")
SIZE, STIFFNESS, STEP = 8, 2e6, 1e-3
FREE = 1e-4 * np.array([1.0, -2.0, 0.3, 0.0, -0.5, 1.5, 0.0, 0.7])


def compliance(radius):
    """Unsymmetric S with this spectral radius of k S; its eigenvalues are real of both signs and complex."""
    rng = np.random.default_rng(4)
    shape = rng.standard_normal((SIZE, SIZE)) + np.diag(np.arange(SIZE) - 3.0)
    return radius / STIFFNESS * shape / np.abs(np.linalg.eigvals(shape)).max()


@pytest.fixture(scope="module")
def units(toy_fmus, tmp_path_factory):
    folder = tmp_path_factory.mktemp("compliance")
    built = FmuBuilder.build_FMU(
        UNITS / "compliance.py", folder, [UNITS / "port_unit.py"], canGetAndSetFMUstate=True
    )
    return {"rotor": folder / built.name, "bearing": toy_fmus / "spring_damper.fmu"}


@pytest.fixture
def loop(store, units):
    """Maker of the system at its start, where the shaft is free of force."""
    systems = []

    def make(scheme, radius):
        bearings = [Unit(store.open(units["bearing"]), name) for name in ("front", "rear")]
        system = System(Unit(store.open(units["rotor"]), "rotor"), bearings, scheme.wiring)
        matrix = compliance(radius)
        system.rotor.set_parameters({f"free[{i + 1}]": FREE[i] for i in range(SIZE)})
        system.rotor.set_parameters(
            {f"S[{i + 1},{j + 1}]": matrix[i, j] for i in range(SIZE) for j in range(SIZE)}
        )
        for unit in bearings:
            spring = {"spring.stiffness": STIFFNESS, "spring.damping": 0.0}
            unit.set_parameters({**spring, "clearance": 1e300})
        begin(system)
        systems.append(system)
        return system

    yield make
    for system in systems:
        system.close()


def answer(radius):
    return np.linalg.solve(np.eye(SIZE) + STIFFNESS * compliance(radius), FREE)


def march(scheme, system, steps):
    """Positions of all journals after every macro step, (steps, 8)."""
    path = []
    for k in range(steps):
        scheme.advance(system, k * STEP, STEP)
        path.append(system.journals[:, :4].ravel().copy())
    return np.array(path)


@pytest.mark.parametrize("name", SCHEMES)
def test_every_coupling_reaches_the_answer_of_a_contracting_loop(name, loop):
    scheme, exact = make_scheme(name), answer(0.4)
    path = march(scheme, loop(scheme, 0.4), 60)
    np.testing.assert_allclose(path[-1], exact, rtol=0, atol=1e-9 * np.abs(exact).max())


@pytest.mark.parametrize("name", SCHEMES)
def test_the_loop_is_solved_within_a_step_or_lost(name, loop):
    """Of spectral radius 4: explicit coupling grows by it in one or two steps, the others solve the loop."""
    scheme, exact = make_scheme(name), answer(4.0)
    path = march(scheme, loop(scheme, 4.0), 20)
    errors = np.abs(path - exact).max(axis=1) / np.abs(exact).max()
    if name in EXPLICIT:
        assert errors[-1] > 100.0
    else:
        assert errors[-1] < 1e-6


def test_gauss_seidel_contracts_by_the_loop_matrix_exactly(loop):
    scheme, matrix = make_scheme("gauss-seidel"), -STIFFNESS * compliance(0.4)
    exact = answer(0.4)
    errors = march(scheme, loop(scheme, 0.4), 12) - exact
    for before, after in pairwise(errors):
        np.testing.assert_allclose(after, matrix @ before, rtol=0, atol=1e-12 * np.abs(exact).max())


def test_linear_implicit_has_the_answer_after_its_first_step(loop):
    scheme, exact = make_scheme("linear-implicit"), answer(4.0)
    system = loop(scheme, 4.0)
    assert scheme.wiring is Wiring.LAW
    np.testing.assert_allclose(march(scheme, system, 1)[0], exact, rtol=0, atol=1e-12 * np.abs(exact).max())
