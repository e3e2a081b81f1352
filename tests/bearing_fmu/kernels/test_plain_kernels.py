"""What numba makes of the kernels against the same kernels run as plain Python, in a process of their own."""

import json
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

import numba
import numpy as np
import pytest

from bearing_fmu.film import make_film
from bearing_fmu.kernels import vector
from tests.bearing_fmu.bearings import lever, plain
from tests.bearing_fmu.plain import OPERATIONS, told

pytestmark = pytest.mark.usefixtures("counted")
ROUGH = {"roughness": 4e-6, "contact_modulus": 1e9, "friction": 0.1}
LAYER = {"layer_thickness": 5e-3}
SMALL = {"columns": 18, "rows": 4}
# Position over the clearance, tilts over those that take all of it; rates over the speed.
STATES = {
    "tilted": (SMALL | {"ambient_pressure": 3e4}, (0.3, -0.5, 0.2, 0.1), (0.1, 0.2, -0.1, 0.05)),
    "empty film": (SMALL, (0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)),
    "aligned contact": (SMALL | ROUGH, (0.1, -0.995, 0.0, 0.0), (0.1, 0.0, 0.0, 0.0)),
    "one edge in contact": (SMALL | ROUGH, (0.2, -0.9, 0.09, 0.02), (0.0, 0.1, 0.0, 0.1)),
    "both edges in contact": (SMALL | ROUGH, (0.0, -0.02, 0.995, 0.01), (0.0, 0.0, 0.0, 0.0)),
    "whole width in contact": (SMALL | ROUGH, (0.1, -1.02, 0.001, 0.002), (0.0, 0.0, 0.0, 0.0)),
    "pressed flat": (SMALL | ROUGH, (0.05, -1.05, 0.02, 0.0), (0.0, 0.0, 0.0, 0.0)),
    "leaving": (SMALL, (0.3, 0.6, 0.05, -0.2), (-0.4, -0.5, 0.1, 0.1)),
    "flooded": (SMALL | {"ambient_pressure": 1e9}, (0.3, 0.6, 0.05, -0.2), (0.0, 0.1, 0.0, 0.0)),
    "turned end for end": (SMALL, (-0.3, 0.4, -0.3, -0.1), (0.0, 0.0, 0.0, 0.0)),
    "closed": (SMALL, (0.9, 0.9, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)),
    "not a number": (SMALL, (np.nan, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)),
    "overflow": (SMALL, (0.3, 0.1, 0.0, 0.0), (1e308, 0.0, 0.0, 0.0)),
    "after Reynolds": (
        SMALL | {"boundary": "reynolds"},
        (0.6, 0.36, 0.3, 0.3),
        (0.1, 0.0, 0.0, 0.0),
    ),
    "on a layer": (SMALL | ROUGH | LAYER, (0.2, -0.9, 0.09, 0.02), (0.0, 0.1, 0.0, 0.1)),
    "mass-conserving": (
        SMALL | {"boundary": "jfo", "ambient_pressure": 3e4},
        (0.5, -0.5, 0.1, 0.02),
        (0.1, 0.1, 0.0, 0.0),
    ),
}
REMEMBER = ("on a layer", "mass-conserving")
LONG = pytest.mark.slow  # these kernels compile for a minute; as plain Python they run in any case
STEP = 0.05
"""In s, of the films that remember."""
ONLY_V1 = {"boundary", "layer_thickness"}
CASES = [(state, depth) for state in STATES for depth in ("v1", "v2", "v3")]
CASES = [case for case in CASES if case[1] == "v1" or not ONLY_V1 & set(STATES[case[0]][0])]


def step_of(settings):
    return STEP if "layer_thickness" in settings or settings.get("boundary") == "jfo" else None


def port_inputs(parameters, q, v):
    inputs = np.zeros(17)
    inputs[:4], inputs[4:8] = np.array(q) * lever(parameters), np.array(v) * lever(parameters)
    inputs[16] = 1.5
    return inputs


@pytest.fixture(scope="module")
def plain_results(tmp_path_factory):
    """Status and outputs of all cases, from one process."""
    folder = tmp_path_factory.mktemp("plain")
    cases = []
    for state, depth in CASES:
        settings, q, v = STATES[state]
        parameters = plain(0.7, **settings)
        inputs = port_inputs(parameters, q, v).tolist()
        cases.append({"depth": depth, "parameters": asdict(parameters), "inputs": inputs})
        cases[-1]["step"] = step_of(settings)
    (folder / "states.json").write_text(json.dumps(cases))
    command = [
        sys.executable,
        "-m",
        "tests.bearing_fmu.plain",
        folder / "states.json",
        folder / "out.npy",
    ]
    subprocess.run(command, cwd=Path(__file__).parents[3], check=True)
    return dict(zip(CASES, np.load(folder / "out.npy"), strict=True))


@pytest.mark.parametrize(
    "case", [pytest.param(case, id=" ".join(case), marks=[LONG] * (case[0] in REMEMBER)) for case in CASES]
)
def test_compiled_kernels_are_the_python_they_are_written_in(case, plain_results):
    state, depth = case
    settings, q, v = STATES[state]
    parameters = plain(0.7, **settings)
    status, out = told(make_film(depth, parameters), port_inputs(parameters, q, v), step_of(settings))
    expected = plain_results[case]
    assert status == expected[0]
    groups = ("wrench", 0, 4), ("F0", 4, 8), ("K", 8, 24), ("C", 24, 40), ("contact", 45, 49)
    for name, first, end in (*groups, *((f"scalar {k}", k, k + 1) for k in (40, 41, 42, 43, 44, 49, 50, 51))):
        compiled, python = out[first:end], expected[1:][first:end]
        np.testing.assert_allclose(python, compiled, atol=1e-9 * np.abs(compiled).max(), err_msg=name)


@pytest.mark.parametrize("name", OPERATIONS)
def test_vector_operations_against_numpy(name):
    """Compiled afresh, not taken from the cache."""
    operation = getattr(vector, name)
    rng = np.random.default_rng(4)
    y, a, b = rng.normal(size=(3, 100))
    if "tile" in name:
        arguments = (9, 10, b, 40, a, 3, 2, 9, b, 1, 5, 4)
        compiled = numba.njit(lambda y, a, b: operation(y, 9, 10, b, 40, a, 3, 2, 9, b, 1, 5, 4))
    elif "rows" in name:
        arguments = (9, a, 3, 2, b, 1, 5, 4)
        compiled = numba.njit(lambda y, a, b: operation(y, 9, a, 3, 2, b, 1, 5, 4))
    else:
        arguments = (9, a, 3, b, 17)
        compiled = numba.njit(lambda y, a, b: operation(y, 9, a, 3, b, 17))
    expected, result = y.copy(), y.copy()
    OPERATIONS[name](expected, *arguments)
    compiled(result, a, b)
    np.testing.assert_allclose(result, expected, rtol=1e-14, atol=1e-14)
