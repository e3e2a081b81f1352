"""Energies of the rotor and works done on it, as variables of the port."""

from __future__ import annotations

from fmus.port.variable import Variable

ENERGY = ("energy.kinetic", "energy.strain", "energy.gravity", "energy.rotation")
VIBRATION = 3
"""How many of the energies, and of the works, are of the vibration."""
WORK = ("work.bearings", "work.unbalance", "work.damping", "work.drive", "work.friction", "work.windage")

_TEXTS = (
    "kinetic energy of the vibration, rotation left out",
    "strain energy of the shaft",
    "potential in gravity, 0 in the undeformed shaft",
    "kinetic energy of the rotation of drive.inertia, and of unbalance and vibration together",
    "work of the bearings on the shaft since the start; 0 unless track_work",
    "work of the unbalance on the shaft since the start; 0 unless track_work",
    "energy lost in the shaft's damping since the start; 0 unless track_work",
    "work of the drive on the rotation since the start; 0 unless track_work",
    "energy that friction took from the rotation since the start; 0 unless track_work",
    "energy that windage took from the rotation since the start; 0 unless track_work",
)

BALANCE = tuple(
    Variable(name, "output", "J", text, nominal=1e3, lazy=name.partition(".")[0])
    for name, text in zip((*ENERGY, *WORK), _TEXTS, strict=True)
)
"""Outputs of the rotor: energies of the vibration change by the works of bearings and unbalance less damping,
that of the rotation by the work of the drive less friction, windage and the work of the unbalance."""

TRACK_WORK = Variable(
    "track_work",
    "parameter",
    description="keep account of work.*; a step of the rotor then costs three to six times as much",
    start=False,
    kind="Boolean",
)
