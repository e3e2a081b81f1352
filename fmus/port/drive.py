"""What turns the rotor, as variables of the port."""

from __future__ import annotations

from fmus.port.connector import NOMINAL_SPEED
from fmus.port.variable import Variable

SWITCHES: dict[str, str] = {}
"""Inputs of the rotor that an event switches on: name and meaning, see `switch`."""


def switch(name: str, text: str) -> str:
    """Declare an input of the rotor that an event switches on; return its name.

    A new one is declared here, has its event in `orchestrator.scenario.events`, and does what it does in
    `rotor_fmu.vibration.drive`: master, SSP and the pages of the FMU go by this list.
    """
    SWITCHES[name] = text
    return name


RELEASED = switch("drive.released", "from 0.5 on nothing drives the rotor: it slows down by itself")
VACUUM_BROKEN = switch("drive.vacuum_broken", "from 0.5 on drive.windage_broken counts")
LOST = "losses.come"
FRICTION_POWER = "friction_power"
"""Of a bearing; of the rotor the input ``bearing[i].friction_power``."""
ROTATION = "rotation.speed"
COURSE, LOSSES, TORQUE = "speed.course", "losses", "drive.torque"


def drive_inputs() -> tuple[Variable, ...]:
    """What events set: the switches, and last which losses have come."""
    come = "sum of 2^k of those losses without an instant that have come, k from 0"
    return tuple(Variable(name, "input", "", text, 0.0) for name, text in {**SWITCHES, LOST: come}.items())


ROTATION_OUTPUT = Variable(
    ROTATION,
    "output",
    "rad/s",
    "speed of rotation now; it may be connected to the speed of the bearings",
    nominal=NOMINAL_SPEED,
    starts_on=("speed",),
)
DRIVE_PARAMETERS = (
    Variable(
        COURSE,
        "parameter",
        "",
        "speed over time as [[s, rad/s], ...], linear in between; empty: as the input",
        "",
        kind="String",
    ),
    Variable(
        LOSSES,
        "parameter",
        "",
        "more lost blades as [[s, number of the wheel, kg m, rad], ...]; null for s: by losses.come",
        "",
        kind="String",
    ),
    Variable(
        TORQUE,
        "parameter",
        "",
        "torque of the drive over speed as [[rad/s, N.m], ...], until released; empty: it holds the speed",
        "",
        kind="String",
    ),
    Variable(
        "drive.inertia", "parameter", "kg.m2", "of the train about its axis, for a free rotor", 0.0,
        minimum=0.0, nominal=1e4,
    ),
    Variable(
        "drive.windage", "parameter", "N.m.s2", "torque of the windage over the square of the speed", 0.0,
        minimum=0.0, nominal=1.0,
    ),
    Variable(
        "drive.windage_broken", "parameter", "N.m.s2", "the same with the vacuum broken", 0.0,
        minimum=0.0, nominal=1.0,
    ),
)  # fmt: skip
