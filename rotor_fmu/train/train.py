"""The train: geometry, wheels, bearings and couplings of a rotor, as plain frozen data.

Only the standard library is used here, so that the FMU and the master share the
type without sharing anything else.  SI units and rad throughout.  Nodes lie at the
boundaries of the shoulders: node 0 at the front end, node k behind shoulder k - 1,
``len(shoulders) + 1`` nodes in all.
"""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass
from functools import cached_property

from rotor_fmu.train.seat import BearingSeat, FoundationMode
from rotor_fmu.train.shoulder import Joint, Material, Ring, Shoulder

__all__ = ["BearingSeat", "Coupling", "Joint", "LumpedMass", "Material", "Ring", "Shoulder", "Train", "Wheel"]


@dataclass(frozen=True)
class Wheel:
    """A rigid body on the shaft: a turbine wheel, or a part of a generator rotor.

    Attributes
    ----------
    name : str
        Unique in the train.
    node : int
        Node that carries it.
    mass : float
        [kg].
    polar_inertia, transverse_inertia : float
        About the shaft axis and about a diameter through the node [kg m2].
    mean_diameter : float
        Mean diameter of the blading, or of the body [m]; for drawings and reports.
    balance_factor : float
        Nominal unbalance as a multiple of this wheel's share in what the balance grade permits its rotor.
    unbalance_phase : float
        Angle of the nominal unbalance at t = 0, from x to y [rad].
    """

    name: str
    node: int
    mass: float
    polar_inertia: float
    transverse_inertia: float
    mean_diameter: float = 0.0
    balance_factor: float = 1.0
    unbalance_phase: float = 0.0


@dataclass(frozen=True)
class LumpedMass:
    """A rigid body on the shaft that is no wheel: half a coupling, a thrust collar, a ring.

    Attributes are those of `Wheel`; it has no unbalance of its own.
    """

    name: str
    node: int
    mass: float
    polar_inertia: float = 0.0
    transverse_inertia: float = 0.0


@dataclass(frozen=True)
class Coupling:
    """A coupling, aligned free of moment: the first node of the rotor behind it.

    Rotors joined rigidly share the node. Those of an elastic coupling do not: the shoulder in front of the
    node is then a `Joint`, without length.
    """

    name: str
    node: int


@dataclass(frozen=True)
class Train:
    """A turbine train.

    Attributes
    ----------
    name : str
        Its name, also that of its FMU.
    speed : float
        Rated speed [rad/s], positive from x to y.
    rayleigh_alpha, rayleigh_beta : float
        Structural damping D = alpha M + beta K [1/s], [s].
    balance_grade : float
        Permissible e_per omega of ISO 21940-11 [m/s]; G2.5 is 2.5e-3.
    shoulders, wheels, bearings, couplings : tuple
        From front to rear.
    masses : tuple
        Rigid bodies without unbalance.
    gravity : tuple of float
        In x and y [m/s2]; (0, 0) for a train that stands upright.
    foundation : tuple of FoundationMode
        Modes of what all bearings stand on, in place of pedestals.
    """

    name: str
    speed: float
    rayleigh_alpha: float
    rayleigh_beta: float
    balance_grade: float
    shoulders: tuple[Shoulder, ...]
    wheels: tuple[Wheel, ...]
    bearings: tuple[BearingSeat, ...]
    couplings: tuple[Coupling, ...] = ()
    masses: tuple[LumpedMass, ...] = ()
    gravity: tuple[float, float] = (0.0, -9.80665)
    foundation: tuple[FoundationMode, ...] = ()

    @cached_property
    def z(self) -> tuple[float, ...]:
        """Axial positions of the nodes [m], exactly rounded so that they do not drift."""
        lengths = [s.length for s in self.shoulders]
        return tuple(math.fsum(lengths[:k]) for k in range(len(lengths) + 1))

    @property
    def nodes(self) -> int:
        """Number of nodes."""
        return len(self.shoulders) + 1

    @property
    def length(self) -> float:
        """Length of the shaft [m]."""
        return self.z[-1]

    @property
    def mass(self) -> float:
        """Mass of shaft, wheels and lumped masses [kg]."""
        return math.fsum(s.mass for s in self.shoulders) + math.fsum(body.mass for body in self.bodies)

    @property
    def polar_inertia(self) -> float:
        """Of the whole train about its axis [kg m2]."""
        return sum(s.polar_inertia for s in self.shoulders) + sum(b.polar_inertia for b in self.bodies)

    @property
    def bodies(self) -> tuple[Wheel | LumpedMass, ...]:
        """All rigid bodies."""
        return (*self.wheels, *self.masses)

    @property
    def weight(self) -> float:
        """Size of the gravity across the shaft [m/s2]."""
        return math.hypot(*self.gravity)

    @property
    def upwards(self) -> tuple[float, float]:
        """Unit vector in x and y against gravity; y where there is none."""
        g = self.weight
        return ((0.0 - self.gravity[0]) / g, (0.0 - self.gravity[1]) / g) if g else (0.0, 1.0)

    @property
    def sections(self) -> tuple[tuple[int, int], ...]:
        """First and last node of each rotor between couplings, front to rear."""
        first = [0, *(c.node for c in self.couplings)]
        last = [*(c.node - (self.joint_of(c) is not None) for c in self.couplings), self.nodes - 1]
        return tuple(zip(first, last, strict=True))

    def joint_of(self, coupling: Coupling) -> Joint | None:
        """Springs of a coupling, or None of a rigid one."""
        return self.shoulders[coupling.node - 1].joint if coupling.node else None

    def section_of(self, node: int) -> int:
        """Index of the rotor that a node belongs to; a coupling's node belongs to the rotor behind it."""
        return sum(c.node <= node for c in self.couplings)

    @property
    def section_masses(self) -> tuple[float, ...]:
        """Mass of each rotor between couplings, shaft and bodies [kg]."""
        parts: list[list[float]] = [[] for _ in self.sections]
        for k, shoulder in enumerate(self.shoulders):
            parts[self.section_of(k)].append(shoulder.mass)
        for body in self.bodies:
            parts[self.section_of(body.node)].append(body.mass)
        return tuple(math.fsum(masses) for masses in parts)

    @property
    def nominal_unbalance(self) -> tuple[float, ...]:
        """Nominal unbalance of each wheel [kg m].

        The balance grade permits a rotor of mass m the unbalance (balance_grade / speed) m (ISO 21940-11);
        the wheels of a rotor share it by their masses, each times its balance_factor.
        """
        eccentricity = self.balance_grade / self.speed
        at = [self.section_of(w.node) for w in self.wheels]
        carried = [0.0] * len(self.sections)
        for wheel, section in zip(self.wheels, at, strict=True):
            carried[section] += wheel.mass
        masses = self.section_masses
        return tuple(
            w.balance_factor * eccentricity * masses[s] * w.mass / carried[s]
            for w, s in zip(self.wheels, at, strict=True)
        )

    @property
    def has_moving_housings(self) -> bool:
        """Whether its bearings stand on pedestals, or on a foundation that vibrates."""
        return bool(self.foundation) or any(seat.pedestal is not None for seat in self.bearings)

    @property
    def materials(self) -> tuple[Material, ...]:
        """Materials of the shaft, in the order in which they occur."""
        used = (m for s in self.shoulders for m in (s.material, *(ring.material for ring in s.rings)))
        return tuple({material.name: material for material in used}.values())

    def to_json(self) -> str:
        """Write as JSON; floats survive the round trip bit by bit."""
        data = {key: value for key, value in asdict(self).items() if key != "shoulders"}
        data["materials"] = [material.properties for material in self.materials]
        data["shoulders"] = [shoulder.to_data() for shoulder in self.shoulders]
        return json.dumps(data, allow_nan=False)

    @classmethod
    def from_json(cls, text: str) -> Train:
        """Read what `to_json` wrote.

        Raises
        ------
        ValueError, KeyError, TypeError
            If the text is not a train.
        """
        data = json.loads(text)
        materials = {m["name"]: Material(**m) for m in data.pop("materials")}
        data["shoulders"] = tuple(Shoulder.from_data(shoulder, materials) for shoulder in data["shoulders"])
        data["wheels"] = tuple(Wheel(**w) for w in data["wheels"])
        data["bearings"] = tuple(BearingSeat.of_data(seat) for seat in data["bearings"])
        data["foundation"] = tuple(FoundationMode.of_data(mode) for mode in data["foundation"])
        data["couplings"] = tuple(Coupling(**c) for c in data["couplings"])
        data["masses"] = tuple(LumpedMass(**m) for m in data["masses"])
        data["gravity"] = tuple(data["gravity"])
        return cls(**data)
