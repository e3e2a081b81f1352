"""Shoulders: what lies between two neighbouring nodes of the shaft, as plain frozen data."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np

BOTH, STIFFNESS, MASS = "both", "stiffness", "mass"
COUNTS = (BOTH, STIFFNESS, MASS)
"""What a ring counts for."""

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(3)
_OVER_LENGTH = 0.5 * (_POINTS + 1.0), 0.5 * _WEIGHTS  # exact to degree 5; the inertia of a cone has 4


@dataclass(frozen=True)
class Material:
    """An isotropic, linear elastic material.

    Attributes
    ----------
    name : str
        The name by which shoulders refer to it.
    youngs_modulus : float
        E [Pa].
    poisson_ratio : float
        nu.
    density : float
        rho [kg/m3]; 0 for one without mass.
    yield_strength : float or None
        Stress from which it yields [Pa]; None: unknown.
    """

    name: str
    youngs_modulus: float
    poisson_ratio: float
    density: float
    yield_strength: float | None = None

    @property
    def shear_modulus(self) -> float:
        """G = E / (2 (1 + nu)) [Pa]."""
        return self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))

    @property
    def properties(self) -> dict[str, str | float]:
        """What is known of it, by name."""
        return {key: value for key, value in asdict(self).items() if value is not None}


@dataclass(frozen=True)
class Ring:
    """A hollow cylinder or cone over the length of a shoulder.

    Attributes
    ----------
    outer_diameter, inner_diameter : float
        At the front end [m].
    material : Material
        What it is made of.
    rear_outer_diameter, rear_inner_diameter : float or None
        At the rear end, with straight lines between; None: as in front.
    counts : str
        both, stiffness or mass.
    """

    outer_diameter: float
    inner_diameter: float
    material: Material
    rear_outer_diameter: float | None = None
    rear_inner_diameter: float | None = None
    counts: str = BOTH

    @property
    def stiff(self) -> bool:
        """Whether it bends with the shaft."""
        return self.counts != MASS

    @property
    def heavy(self) -> bool:
        """Whether it has mass."""
        return self.counts != STIFFNESS and self.material.density > 0.0

    @property
    def tapers(self) -> bool:
        """Whether its diameters change along its length."""
        return (self.outer(0.0), self.inner(0.0)) != (self.outer(1.0), self.inner(1.0))

    def outer(self, share: float) -> float:
        """Outer diameter at a share of the length [m]."""
        return _between(self.outer_diameter, self.rear_outer_diameter, share)

    def inner(self, share: float) -> float:
        """Inner diameter at a share of the length [m]."""
        return _between(self.inner_diameter, self.rear_inner_diameter, share)

    def part(self, front: float, rear: float) -> Ring:
        """The piece between two shares of the length."""
        if not self.tapers:
            return self
        ends = [f(share) for share in (front, rear) for f in (self.outer, self.inner)]
        return Ring(ends[0], ends[1], self.material, ends[2], ends[3], self.counts)

    def moments_of_mass(self, length: float) -> tuple[float, float]:
        """Mass [kg], and its first moment about the front end [kg m]."""
        mass = moment = 0.0
        for sign, a, b in ((1.0, self.outer(0.0), self.outer(1.0)), (-1.0, self.inner(0.0), self.inner(1.0))):
            mass += sign * (a * a + a * b + b * b) / 3.0
            moment += sign * (a * a + 2.0 * a * b + 3.0 * b * b) / 12.0
        scale = self.material.density * math.pi / 4.0 * length if self.heavy else 0.0
        return scale * mass, scale * length * moment


@dataclass(frozen=True)
class Joint:
    """Springs and dampers of an elastic coupling between two nodes at one place.

    Attributes
    ----------
    translational_stiffness, angular_stiffness : float
        Against a radial offset [N/m] and an angle [N m/rad]; an angular stiffness of 0 is a hinge.
    translational_damping, angular_damping : float
        [N s/m], [N m s/rad].
    """

    translational_stiffness: float
    angular_stiffness: float
    translational_damping: float = 0.0
    angular_damping: float = 0.0


@dataclass(frozen=True)
class Shoulder:
    """What lies between two neighbouring nodes, one finite element.

    Attributes
    ----------
    length : float
        [m]; 0 for the joint of an elastic coupling.
    outer_diameter, inner_diameter, material, rear_outer_diameter, rear_inner_diameter, counts
        The first ring, see `Ring`; an inner diameter of 0 means a solid section.
    layers : tuple of Ring
        What lies over, or in, the first ring: sleeves, windings, linings.
    joint : Joint or None
        Springs in place of a section; the diameters are then for drawings only.
    """

    length: float
    outer_diameter: float
    inner_diameter: float
    material: Material
    rear_outer_diameter: float | None = None
    rear_inner_diameter: float | None = None
    counts: str = BOTH
    layers: tuple[Ring, ...] = ()
    joint: Joint | None = None

    @cached_property
    def rings(self) -> tuple[Ring, ...]:
        """All rings, in the order of the table; none of a joint."""
        if self.joint is not None:
            return ()
        first = Ring(**{field.name: getattr(self, field.name) for field in fields(Ring)})
        return first, *self.layers

    @cached_property
    def plain(self) -> bool:
        """Whether it is one cylinder that counts for stiffness and mass."""
        return self.joint is None and not self.layers and self.counts == BOTH and not self.rings[0].tapers

    @property
    def area(self) -> float:
        """Cross-section A of the first ring in front [m2]."""
        return math.pi / 4.0 * (self.outer_diameter**2 - self.inner_diameter**2)

    @property
    def second_moment(self) -> float:
        """Second moment of area I about a diameter of the first ring in front [m4]."""
        return math.pi / 64.0 * (self.outer_diameter**4 - self.inner_diameter**4)

    @property
    def section_moduli(self) -> tuple[float, float]:
        """W in front and behind [m3]: the largest bending stress of any ring is M / W there."""
        if self.plain:
            modulus = 2.0 * self.second_moment / self.outer_diameter
            return modulus, modulus
        front, rear = (self._modulus(share) for share in (0.0, 1.0))
        return front, rear

    def _modulus(self, share: float) -> float:
        stiff = [(r.material.youngs_modulus, r.outer(share), r.inner(share)) for r in self.rings if r.stiff]
        if not stiff:
            return math.inf  # a joint
        bending = math.fsum(E * math.pi / 64.0 * (outer**4 - inner**4) for E, outer, inner in stiff)
        return bending / max(E * outer / 2.0 for E, outer, _ in stiff)

    @property
    def mass(self) -> float:
        """Mass [kg]."""
        if self.plain:
            return self.material.density * self.area * self.length
        return math.fsum(ring.moments_of_mass(self.length)[0] for ring in self.rings)

    @property
    def polar_inertia(self) -> float:
        """About the axis [kg m2]; cones exactly, by Gauss's rule."""
        fourth = sum(
            weight * ring.material.density * (ring.outer(share) ** 4 - ring.inner(share) ** 4)
            for ring in self.rings
            if ring.heavy
            for share, weight in zip(*_OVER_LENGTH, strict=True)
        )
        return float(math.pi / 32.0 * fourth * self.length)

    @property
    def centroid(self) -> float:
        """Distance of the centre of mass from the front end [m]."""
        if self.plain or not (mass := self.mass):
            return self.length / 2.0
        return math.fsum(ring.moments_of_mass(self.length)[1] for ring in self.rings) / mass

    @property
    def widest(self) -> float:
        """Largest diameter [m]."""
        return max(self.surface(0.0), self.surface(1.0))

    def surface(self, share: float) -> float:
        """Diameter of the outermost ring at a share of the length [m]."""
        return max((r.outer(share) for r in self.rings), default=self.outer_diameter)

    def to_data(self) -> list[Any]:
        """As lists and numbers for JSON, the materials by their names; see `from_data`."""
        data: list[Any] = [self.length, self.outer_diameter, self.inner_diameter, self.material.name]
        if not self.plain:
            data.append(
                [list((vars(ring) | {"material": ring.material.name}).values()) for ring in self.rings]
            )
            data.append(asdict(self.joint) if self.joint else None)
        return data

    @classmethod
    def from_data(cls, data: list[Any], materials: Mapping[str, Material]) -> Shoulder:
        """Read what `to_data` gives."""
        length, outer, inner, material, *more = data
        if not more:
            return cls(length, outer, inner, materials[material])
        rings = [Ring(o, i, materials[name], *rest) for o, i, name, *rest in more[0]]
        if more[1] is not None:
            return cls(length, outer, inner, materials[material], joint=Joint(**more[1]))
        return cls.of_rings(length, rings)

    @classmethod
    def of_rings(cls, length: float, rings: list[Ring]) -> Shoulder:
        """A shoulder of rings in the order of the table."""
        first, *others = rings
        return cls(length, **vars(first), layers=tuple(others))


def _between(front: float, rear: float | None, share: float) -> float:
    return front if rear is None else (1.0 - share) * front + share * rear
