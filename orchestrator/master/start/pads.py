"""Bearings with tilting pads at the start: for which motion their stiffness and damping hold."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fmus import port

if TYPE_CHECKING:
    from orchestrator.fmi.unit import Unit
    from orchestrator.master.system import System


def set_whirl(system: System, ratio: float) -> bool:
    """Say for which whirl, as its frequency over the speed, tilting pads give stiffness and damping.

    0 is for searches of a position, 1 for the motion under unbalance and for tables.

    Returns
    -------
    bool
        Whether there are any.
    """
    units = [unit for unit in system.bearings if tilts(unit)]
    for unit in units:
        unit.set_parameters({port.WHIRL.name: ratio})
    return bool(units)


def tilts(unit: Unit) -> bool:
    """Whether a bearing has tilting pads, as far as it says."""
    bore = port.BEARING_KEYS["bore"]
    if port.WHIRL.name not in unit.file.variables or bore not in unit.file.variables:
        return False
    return port.pads_in(unit.get_string(bore)) > 0
