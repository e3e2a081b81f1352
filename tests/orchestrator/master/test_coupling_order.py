"""Every coupling of the registry on the linear two-mass oscillator: it converges with its order."""

import numpy as np
import pytest

from orchestrator.master.coupling import SCHEMES, make_scheme
from orchestrator.master.system import Wiring
from tests.orchestrator.oscillator import DISPLACEMENT, exact_motion, motion, released

END = 0.02  # s; the modes have 15.7 and 48 Hz and more
STEPS = END / np.array([80, 160, 320])
EXPLICIT = ("jacobi", "gauss-seidel")


@pytest.mark.parametrize("name", SCHEMES)
def test_every_coupling_converges_to_the_exact_motion_with_its_order(name, store, toy_fmus):
    """Second order on the affine law; first order where the rotor holds a force over the step."""
    scheme, errors = make_scheme(name), []
    for step in STEPS:
        system = released(store, toy_fmus, scheme.wiring)
        times = step * np.arange(round(END / step) + 1)
        errors.append(np.max(np.abs(motion(scheme, system, step, END) - exact_motion(times))) / DISPLACEMENT)
        system.close()
    order = np.log2(errors[-2] / errors[-1])
    if scheme.wiring is Wiring.LAW:
        assert order == pytest.approx(2.0, abs=0.1)
        assert errors[-1] < 3e-5
    elif name in EXPLICIT:
        assert order == pytest.approx(1.0, abs=0.15)
    else:
        assert order > 0.85
    assert errors[-1] < 0.02
