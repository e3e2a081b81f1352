"""Rotors with published frequencies."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rotor_fmu.linear.whirl import LinearBearings
from rotor_fmu.train.train import BearingSeat, Material, Shoulder, Train, Wheel


def uniform_shaft(length, diameter, elements, material, *, inner_diameter=0.0):
    shoulder = Shoulder(length / elements, diameter, inner_diameter, material)
    return Train("shaft", 100.0, 0.0, 0.0, 2.5e-3, (shoulder,) * elements, (), ())


def seat(node):
    return BearingSeat(f"b{node}", node, 0.1, 0.05, 1e-4, 0.02)


def with_bearings(train, *nodes):
    return replace(train, bearings=tuple(seat(node) for node in nodes))


def springs(kxx, kyy, cxx=0.0, cyy=0.0, count=2):
    K, C = np.zeros((count, 4, 4)), np.zeros((count, 4, 4))
    K[:, 0, 0], K[:, 1, 1], C[:, 0, 0], C[:, 1, 1] = kxx, kyy, cxx, cyy
    return LinearBearings(K, C)


def friswell():
    """Friswell, Penny, Garvey, Lees: Dynamics of Rotating Machines (2010), example 5.9.1."""
    material = Material("steel", 211e9, 211e9 / (2.0 * 81.2e9) - 1.0, 7810.0)
    discs = ((2, 32.58973, 0.178089, 0.329564), (4, 51.52526, 0.423581, 0.805082))
    wheels = tuple(Wheel(f"disc {k}", k, mass, polar, transverse) for k, mass, transverse, polar in discs)
    return replace(with_bearings(uniform_shaft(1.5, 0.05, 6, material), 0, 6), wheels=wheels)


def lalanne_ferraris():
    """Lalanne, Ferraris: Rotordynamics Prediction in Engineering (1998); data as in code_aster V2.02.124."""
    material = Material("steel", 2e11, 0.3, 7800.0)
    shoulders = []
    for length, elements in ((0.2, 2), (0.3, 3), (0.5, 5), (0.3, 3)):
        shoulders += [Shoulder(length / elements, 0.1, 0.0, material)] * elements
    discs = ((14.5801, 0.0646386, 0.123202), (45.9458, 0.497746, 0.976348), (55.135, 0.602349, 1.171618))
    wheels = tuple(
        Wheel(f"disc {k}", k, mass, polar, transverse)
        for k, (mass, transverse, polar) in zip((2, 5, 10), discs, strict=True)
    )
    return Train("three discs", 100.0, 0.0, 0.0, 2.5e-3, tuple(shoulders), wheels, (seat(0), seat(13)))
