"""The bundled turbine train as a function of a few design figures.

The drawing of a real half-speed set is not public.  `turbine_train` draws a plausible one: HP, three LP,
generator and exciter, 278 shoulders of 450 to 1600 mm on 68 m.  ``data/turbine`` holds its result for the
default `TurbineDesign`, see `rotor_fmu.train.turbine_designs`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fmus import port
from rotor_fmu.train.train import BearingSeat, Coupling, Material, Shoulder, Train, Wheel

ROTORS = ("HP", "LP1", "LP2", "LP3", "GEN", "EXC")
STEEL = Material("steel", youngs_modulus=2.1e11, poisson_ratio=0.3, density=7850.0)


@dataclass(frozen=True)
class JournalDesign:
    """Journal diameter d [m], width over diameter b/d, relative clearance psi, residual tilt [rad]."""

    diameter: float
    width_ratio: float
    relative_clearance: float
    residual_tilt: float = 0.0


@dataclass(frozen=True)
class TurbineDesign:
    """What the train's behaviour hinges on; lengths [m], masses [kg], viscosity [Pa s].

    Attributes
    ----------
    lp_core_diameter, lp_wheel_mass : float
        Nominal diameter between the glands (seats 35 to 55 mm more, reliefs 60 mm less) and mass of each of
        nine wheels of an LP rotor: they set its first bending mode, bending stress and bearing loads.
    hp_core_diameter, hp_wheel_mass : float
        The same for the five wheels of the HP rotor.
    generator_winding_mass : float
        Mass of each of five rigid bodies: windings, wedges and retaining rings.
    hp, lp, generator, exciter : JournalDesign
        Journals of each kind of rotor.
    viscosity, ambient_pressure, roughness, contact_modulus, friction : float
        Of all bearings.
    hp_balance, lp_balance, generator_balance, exciter_balance : float
        Nominal unbalance as a multiple of the balance grade. That of an LP rotor is a couple: the wheels
        of one flow against those of the other, the middle wheel without.
    rayleigh_alpha : float
        Damping of the mass [1/s].
    turned : float
        Angle by which the nominal unbalance of the whole train is turned [degrees].
    """

    lp_core_diameter: float = 1.11
    lp_wheel_mass: float = 32.1e3
    hp_core_diameter: float = 0.95
    hp_wheel_mass: float = 5.0e3
    generator_winding_mass: float = 8.0e3
    hp: JournalDesign = JournalDesign(0.50, 0.80, 2.0e-3)
    lp: JournalDesign = JournalDesign(0.80, 0.80, 2.155e-3, 5.8e-5)
    generator: JournalDesign = JournalDesign(0.70, 0.80, 2.0e-3)
    exciter: JournalDesign = JournalDesign(0.45, 0.60, 2.5e-3)
    viscosity: float = 0.02415
    ambient_pressure: float = 0.0
    roughness: float = port.default_of("roughness")
    contact_modulus: float = port.default_of("contact_modulus")
    friction: float = port.default_of("friction")
    hp_balance: float = 0.3
    lp_balance: float = 0.95
    generator_balance: float = 10.2
    exciter_balance: float = 1.0
    rayleigh_alpha: float = 1.5
    turned: float = 0.0


class _Lathe:
    """Turns shoulders one behind the other and remembers what sits at their boundaries."""

    def __init__(self, turned: float) -> None:
        self.turned = turned
        self.shoulders: list[Shoulder] = []
        self.wheels: list[Wheel] = []
        self.bearings: list[BearingSeat] = []
        self.couplings: list[Coupling] = []

    @property
    def node(self) -> int:
        return len(self.shoulders)

    def turn(self, diameter: float, *lengths: float, bore: float = 0.0) -> None:
        """Add shoulders of one diameter; lengths in millimetres, as on a drawing."""
        self.shoulders.extend(Shoulder(mm / 1000.0, round(diameter, 6), bore, STEEL) for mm in lengths)

    def wheel(
        self, name: str, mass: float, diameter: float, width: float, balance: float, phase: float
    ) -> None:
        """Add a rigid body with a radius of gyration of 3/8 of its mean diameter."""
        polar = mass * (0.375 * diameter) ** 2
        transverse = polar / 2.0 + mass * width**2 / 12.0
        self.wheels.append(
            Wheel(
                name,
                self.node,
                mass,
                polar_inertia=round(polar, 1),
                transverse_inertia=round(transverse, 1),
                mean_diameter=round(diameter, 6),
                balance_factor=balance,
                unbalance_phase=phase + self.turned,
            )
        )

    def bearing(self, name: str, journal: JournalDesign, design: TurbineDesign) -> None:
        """Add a bearing whose mid-plane lies here."""
        self.bearings.append(
            BearingSeat(
                name,
                self.node,
                diameter=journal.diameter,
                width=round(journal.width_ratio * journal.diameter, 6),
                clearance=round(journal.relative_clearance * journal.diameter / 2.0, 9),
                viscosity=design.viscosity,
                ambient_pressure=design.ambient_pressure,
                roughness=design.roughness,
                contact_modulus=design.contact_modulus,
                friction=design.friction,
                residual_tilt_x=journal.residual_tilt,
            )
        )


def turbine_train(design: TurbineDesign | None = None) -> Train:
    """Turn the train.

    Parameters
    ----------
    design : TurbineDesign, optional

    Returns
    -------
    Train
        278 shoulders, 68.0 m.
    """
    design = design or TurbineDesign()
    lathe = _Lathe(math.radians(design.turned))
    _high_pressure(lathe, design)
    for number, phase in ((1, 0.0), (2, 90.0), (3, 180.0)):
        lathe.couplings.append(Coupling(f"{ROTORS[number - 1]}-{ROTORS[number]}", lathe.node))
        _low_pressure(lathe, design, f"LP{number}", math.radians(phase))
    lathe.couplings.append(Coupling("LP3-GEN", lathe.node))
    _generator(lathe, design, math.radians(270.0))
    lathe.couplings.append(Coupling("GEN-EXC", lathe.node))
    _exciter(lathe, design)
    return Train(
        name="turbine",
        speed=2.0 * math.pi * 25.0,
        rayleigh_alpha=design.rayleigh_alpha,
        rayleigh_beta=2e-5,
        balance_grade=2.5e-3,
        shoulders=tuple(lathe.shoulders),
        wheels=tuple(lathe.wheels),
        bearings=tuple(lathe.bearings),
        couplings=tuple(lathe.couplings),
    )


def _high_pressure(lathe: _Lathe, design: TurbineDesign) -> None:
    """8.0 m, 37 shoulders, double flow, five wheels; the front end is free."""
    journal, core = design.hp, design.hp_core_diameter
    lathe.turn(0.46, 300)
    lathe.turn(0.54, 350)
    lathe.turn(journal.diameter, 200)
    lathe.bearing("HP-front", journal, design)
    lathe.turn(journal.diameter, 200)
    lathe.turn(0.58, 150)
    lathe.turn(0.66, 200)
    for diameter in (0.74, 0.72, 0.74):
        lathe.turn(diameter, 150)
    lathe.turn(core - 0.08, 430)
    for number, step in enumerate((-0.01, 0.0, 0.02, 0.0, -0.01), 1):
        lathe.turn(core + step - 0.02, 250)
        lathe.turn(core + step, 150)
        lathe.wheel(f"HP-{number}", design.hp_wheel_mass, 1.5, 0.3, design.hp_balance, 0.0)
        lathe.turn(core + step, 150)
    lathe.turn(core - 0.03, 250)
    lathe.turn(core - 0.08, 420)
    for diameter in (0.74, 0.72, 0.74):
        lathe.turn(diameter, 150)
    lathe.turn(0.66, 250)
    lathe.turn(journal.diameter + 0.05, 200)
    lathe.turn(journal.diameter, 200)
    lathe.bearing("HP-rear", journal, design)
    lathe.turn(journal.diameter, 200)
    lathe.turn(journal.diameter + 0.08, 350)
    lathe.turn(journal.diameter + 0.06, 450)
    lathe.turn(1.10, 200)


def _low_pressure(lathe: _Lathe, design: TurbineDesign, name: str, phase: float) -> None:
    """12.4 m, 60 shoulders, double flow, nine wheels, symmetric; 9.3 m between the bearings."""
    journal, core = design.lp, design.lp_core_diameter
    d = journal.diameter
    # of the journal, which carries the bearing
    if (half := max(320.0, math.ceil(500.0 * journal.width_ratio * d))) >= 460.0:
        raise ValueError(f"lp: a journal {journal.width_ratio * d:g} m wide; there is room for 0.918 m")
    outwards = (
        (1.06, (145,)),
        (0.98, (140,)),
        (0.96, (140,)),
        (0.98, (140,)),
        (0.92, (250,)),
        (d + 0.06, (460 - half,)),
        (d, (half,)),
        None,
        (d, (half,)),
        (d + 0.06, (700 - half,)),
        (d + 0.04, (275, 275)),
        (1.30, (300,)),
    )
    for part in reversed(outwards):
        if part is None:
            lathe.bearing(f"{name}-front", journal, design)
        else:
            lathe.turn(part[0], *part[1])
    for number in range(1, 10):
        flow = abs(number - 5)
        seat = core + (0.055, 0.050, 0.045, 0.040, 0.035)[flow]
        lathe.turn(core - 0.060, 175)  # relief between the seats
        lathe.turn(seat, 200)
        diameter = 2.4 + 0.3 * flow
        balance = design.lp_balance if flow else 0.0
        side = phase if number <= 5 else phase + math.pi
        lathe.wheel(f"{name}-{number}", design.lp_wheel_mass, diameter, 0.5, balance, side)
        lathe.turn(seat, 200)
        lathe.turn(core - 0.060, 175)
    for part in outwards:
        if part is None:
            lathe.bearing(f"{name}-rear", journal, design)
        else:
            lathe.turn(part[0], *part[1])


def _generator(lathe: _Lathe, design: TurbineDesign, phase: float) -> None:
    """16.5 m, 47 shoulders, four-pole body with five bodies of winding; 13.85 m between the bearings."""
    journal, d = design.generator, design.generator.diameter
    ends = ((d + 0.04, (160,)), (0.90, (350, 350)), (1.02, (375, 375)), (1.10, (390, 395)))
    lathe.turn(1.30, 200)
    lathe.turn(d + 0.06, 250, 250, 250)
    lathe.turn(d + 0.02, 220)
    lathe.turn(d, 280)
    lathe.bearing("GEN-front", journal, design)
    lathe.turn(d, 280)
    for diameter, lengths in ends:
        lathe.turn(diameter, *lengths)
    for number in range(1, 6):
        front, rear = (1.40 if number == edge else 1.60 for edge in (1, 5))
        lathe.turn(front, 425)
        lathe.turn(1.60, 425)
        lathe.wheel(f"GEN-{number}", design.generator_winding_mass, 1.7, 1.2, design.generator_balance, phase)
        lathe.turn(1.60, 425)
        lathe.turn(rear, 425)
    for diameter, lengths in reversed(ends):
        lathe.turn(diameter, *lengths)
    lathe.turn(d, 280)
    lathe.bearing("GEN-rear", journal, design)
    lathe.turn(d, 280)
    lathe.turn(d + 0.02, 220)
    lathe.turn(d + 0.06, 250, 250)
    lathe.turn(0.95, 200)


def _exciter(lathe: _Lathe, design: TurbineDesign) -> None:
    """6.3 m, 14 shoulders, carried by the generator in front and one bearing behind."""
    journal, d = design.exciter, design.exciter.diameter
    lathe.turn(0.95, 200)
    lathe.turn(0.62, 450)
    lathe.turn(0.60, 450)
    lathe.turn(0.70, 300)
    lathe.turn(0.80, 600, 600)
    lathe.wheel("EXC-armature", 5.0e3, 1.3, 0.8, design.exciter_balance, 0.0)
    lathe.turn(0.80, 600, 600)
    lathe.wheel("EXC-rectifier", 1.5e3, 1.2, 0.4, design.exciter_balance, 0.0)
    lathe.turn(0.80, 600)
    lathe.turn(0.64, 600)
    lathe.turn(0.56, 450)
    lathe.turn(d, 200)
    lathe.bearing("EXC", journal, design)
    lathe.turn(d, 200)
    lathe.turn(d + 0.01, 450)
