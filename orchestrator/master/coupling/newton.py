"""Interface Newton: the step is repeated with the affine law at its end until the defect vanishes.

The rotor integrates the affine law itself, so that one repetition is one Newton step on the
interface equation with the rotor's own response: no response has to be identified.  The
first pass is the linear-implicit step.  The wrench at the start stays that of the accepted
state; see `secant_law`.  What is left of the error is how the rotor lets the wrench run within the step.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from orchestrator.master.coupling.base import Advance, Memoryless, NotConverged
from orchestrator.master.coupling.secant_law import secant_laws
from orchestrator.master.system import System, Wiring


@dataclass
class Newton(Memoryless):
    """Newton's method on the wrenches at the end of each step, by rollback.

    Parameters
    ----------
    tolerance : float
        Defect at which the iteration ends, see `System.relative`.
    limit : int
        Passes over a step before it is given up.
    """

    tolerance: float = 1e-6
    limit: int = 12

    name: ClassVar[str] = "newton"
    wiring: ClassVar[Wiring] = Wiring.LAW
    iterates: ClassVar[bool] = True  # type: ignore[misc]

    def advance(self, system: System, time: float, step: float, common: bool = True) -> Advance:
        """Repeat the step until the defect is within the tolerance."""
        system.rollback.mark()
        start = system.motion.copy(), system.forces.copy()
        rotor, bearings = system.rotor_group, system.bearing_group
        rotor.feed()
        for iteration in range(1, self.limit + 1):
            rotor.step(time, step)
            rotor.fetch()
            bearings.feed()
            bearings.step(time, step)
            bearings.fetch()
            defect = system.defect()
            size = system.relative(defect)
            if size <= self.tolerance:
                return Advance(iteration, defect)
            if size != size:
                break
            if iteration < self.limit:
                end = system.motion, system.forces
                secant_laws(start, end, system.tangents, system.scale(), system.laws)
                system.rollback.rewind()
                rotor.push()
        raise NotConverged(
            f"newton: defect {size:.3g} after {iteration} passes, allowed is {self.tolerance:.3g}"
        )
