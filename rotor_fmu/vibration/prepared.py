"""A shaft with all that is derived from it once and for all."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from rotor_fmu.foundation.foundation import Foundation
from rotor_fmu.reduction.reduce import Method, ReducedShaft, reduce
from rotor_fmu.shaft.matrices import ShaftModel, assemble
from rotor_fmu.shaft.stress import BendingStress, bending_stress
from rotor_fmu.train.train import Train
from rotor_fmu.vibration.modal_shaft import ModalShaft, to_modal


@dataclass(frozen=True, eq=False)
class PreparedShaft:
    """Unreduced, reduced and modal shaft, and its bending moments; arrays are not to be changed."""

    model: ShaftModel
    reduced: ReducedShaft
    modal: ModalShaft
    bending: BendingStress

    @property
    def foundation(self) -> Foundation | None:
        """What its bearings stand on, where that moves."""
        return self.model.foundation


@lru_cache(maxsize=4)
def prepare_shaft(train: Train, method: Method) -> PreparedShaft:
    """The shaft of a train under a reduction; rotors that differ in their loads only share it.

    Raises
    ------
    ValueError
        As `reduce`.
    """
    model = assemble(train)
    reduced = reduce(model, method)
    return PreparedShaft(model, reduced, to_modal(reduced), bending_stress(train))
