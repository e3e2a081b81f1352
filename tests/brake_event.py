"""A kind of event of its own with an input of the rotor, in one file: a brake that takes hold.

In the packages it would be an entry in `fmus.port.drive`, a class in `orchestrator.scenario.events` and a
term in `rotor_fmu.vibration.drive`.  Importing this makes it known; nothing else names it but its test.
"""

from __future__ import annotations

from collections.abc import Set
from typing import ClassVar, Literal

from fmus import port
from orchestrator.scenario import events
from rotor_fmu.vibration.drive import Braking, Drive

TORQUE = 2e4  # N m
BRAKED = port.switch("drive.braked", "from 0.5 on the brake holds the rotor")


class Brake(events.Switch):
    """The brake takes hold."""

    label: ClassVar[str] = "brake"
    noun: ClassVar[str] = "brake"
    input: ClassVar[str] = BRAKED
    kind: Literal["brake"] = "brake"


events.KINDS["brake"] = Brake
_usual = Drive.braking


def _braking(self: Drive, speed: float, friction: float, on: Set[str] = frozenset()) -> Braking:
    now = _usual(self, speed, friction, on)
    return now._replace(torque=now.torque - TORQUE * (BRAKED in on))


Drive.braking = _braking  # type: ignore[method-assign]
