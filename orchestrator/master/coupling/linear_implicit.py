"""Linear-implicit: the rotor integrates the affine law of each bearing over the step.

The law ``F0 - K q - C v`` is the bearings' wrench expanded about the start of the step
and carried into the rotor's own implicit solve.  This is one Newton step on the
interface equation at the price of an explicit scheme: one evaluation of each bearing,
no rollback.  Second order.  A rotor that lets the wrench run linearly through the step is stable
for any damping, and for a stiffness k against the mass m that rides on it up to
``sqrt(k/m) H = 2 sqrt(3)`` (linear acceleration method).  Films stay far below it; a journal
pressed into its shell reaches it at 1e-4 s.  The rotor of this project then holds part of the
wrench at its mean (`rotor_fmu.vibration.affine_step`), which a mass on a spring of any stiffness
bears; on the turbine train the error then grows smoothly with the step up to 4e-4 s, where before forces
alternated.
"""

from __future__ import annotations

from typing import ClassVar

from orchestrator.master.coupling.base import Sequential
from orchestrator.master.system import Wiring


class LinearImplicit(Sequential):
    """Rotor on the affine law, then the bearings on the rotor's new state."""

    name: ClassVar[str] = "linear-implicit"
    wiring: ClassVar[Wiring] = Wiring.LAW
