"""Every coupling of the registry on the linear two-mass oscillator: it converges with its order."""

import numpy as np
import pytest

from orchestrator.master.coupling import SCHEMES, make_scheme
from orchestrator.master.system import Wiring
from tests.orchestrator.oscillator import DISPLACEMENT, exact_motion, motion, released

END = 0.02  # s; the modes have 15.7 and 48 Hz and more
STEPS = END / np.array([80, 160, 320])


@pytest.mark.parametrize("name", SCHEMES)
def test_every_coupling_converges_to_the_exact_motion_with_its_order(name, store, toy_fmus):
    """Second order on the affine law; first order where the rotor holds a force over the step.

    What the order of two steps lacks halves with the step, so three steps give it to a few thousandths.
    """
    scheme, errors = make_scheme(name), []
    for step in STEPS:
        system = released(store, toy_fmus, scheme.wiring)
        times = step * np.arange(round(END / step) + 1)
        errors.append(np.max(np.abs(motion(scheme, system, step, END) - exact_motion(times))) / DISPLACEMENT)
        system.close()
    coarse, fine = np.log2(errors[0] / errors[1]), np.log2(errors[1] / errors[2])
    by_law = scheme.wiring is Wiring.LAW
    assert 2.0 * fine - coarse == pytest.approx(2.0 if by_law else 1.0, abs=3e-3)
    assert errors[-1] < (3e-6 if by_law else 3e-3)
