"""What hypothesis draws for rotors: trains that stand on their bearings."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import strategies as st

from rotor_fmu.train.train import BearingSeat, Coupling, Material, Shoulder, Train, Wheel
from tests.properties.journals import logarithmic

STEEL = Material("steel", 2.05e11, 0.3, 7850.0)
_PIECE = 4  # shoulders from one bearing to the next


@st.composite
def trains(draw) -> Train:
    """A train of up to three rotors, each on two bearings, from 5 cm to 1 m in diameter; steel."""
    rotors = draw(st.integers(1, 3))
    base = draw(logarithmic(0.05, 1.0))
    shoulders: list[Shoulder] = []
    bearings, couplings, wheels = [], [], []
    for rotor in range(rotors):
        journal = base * draw(st.floats(0.7, 1.0))
        start = len(shoulders)
        kinds = ["end", "journal", "journal", *["body"] * _PIECE, "journal", "journal", "end"]
        for kind in kinds:
            outer = {"end": 0.9 * journal, "journal": journal, "body": base * draw(st.floats(1.0, 2.0))}[kind]
            inner = outer * draw(st.sampled_from([0.0, 0.0, 0.3]))
            shoulders.append(Shoulder(base * draw(st.floats(0.4, 1.5)), outer, inner, STEEL))
        for k, node in enumerate((start + 2, start + len(kinds) - 2)):
            bearings.append(BearingSeat(f"b{rotor}{k}", node, journal, 0.7 * journal, 1e-3 * journal, 0.02))
        for node in sorted(draw(st.sets(st.integers(start + 4, start + 6), min_size=1))):
            mass = 7850.0 * math.pi * base**3 * draw(st.floats(0.1, 1.0))
            inertia = mass * base**2
            wheels.append(Wheel(f"w{node}", node, mass, inertia, 0.6 * inertia, 3.0 * base))
        if rotor:
            couplings.append(Coupling(f"c{rotor}", start))
    return Train(
        name="drawn",
        speed=draw(logarithmic(20.0, 600.0)),
        rayleigh_alpha=draw(st.floats(0.0, 2.0)),
        rayleigh_beta=draw(st.floats(0.0, 1e-5)),
        balance_grade=2.5e-3,
        shoulders=tuple(shoulders),
        wheels=tuple(wheels),
        bearings=tuple(bearings),
        couplings=tuple(couplings),
    )


@st.composite
def laws(draw, train: Train) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Affine laws F0, K, C of springs and dampers, symmetric, that carry the weight at some deflection."""
    count = len(train.bearings)
    weight = 9.80665 * train.mass
    rate = weight / count / (1e-3 * train.bearings[0].diameter) * draw(logarithmic(0.3, 10.0))
    lever = 0.3 * train.bearings[0].diameter
    unit = np.diag([1.0, 1.0, lever**2, lever**2])
    skew = draw(st.floats(-0.3, 0.3))
    unit[0, 1] = unit[1, 0] = skew
    K = np.tile(rate * unit, (count, 1, 1))
    C = np.tile(rate / train.speed * draw(st.floats(0.1, 2.0)) * unit, (count, 1, 1))
    F0 = np.zeros((count, 4))
    F0[:, 1] = draw(st.floats(-1.0, 1.0)) * weight / count
    return F0, K, C
