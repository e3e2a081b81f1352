"""Linear-implicit: the rotor integrates the affine law of each bearing over the step.

The law ``F0 - K q - C v`` is the bearings' wrench expanded about the start of the step
and carried into the rotor's own implicit solve.  This is one Newton step on the
interface equation at the price of an explicit scheme: one evaluation of each bearing,
no rollback.  Second order.  A rotor that holds the wrench linear over the step is stable
for any damping, and for a stiffness k against the mass m that rides on it up to
``sqrt(k/m) H = 2 sqrt(3)`` (linear acceleration method).  Films stay far below it.  A journal
pressed into its shell can reach it at 1e-4 s: forces then alternate from step to step for some
milliseconds, the defect tells, and a tolerance (`orchestrator.stepping`) shortens those steps.
"""

from __future__ import annotations

from orchestrator.coupling.base import Sequential
from orchestrator.system import Wiring


class LinearImplicit(Sequential):
    """Rotor on the affine law, then the bearings on the rotor's new state."""

    name = "linear-implicit"
    wiring = Wiring.LAW
