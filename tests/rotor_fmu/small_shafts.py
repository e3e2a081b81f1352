"""Small shafts for the tests of the step: given matrices, nothing reduced."""

from __future__ import annotations

import math

import numpy as np
import scipy.sparse as sp

from rotor_fmu.reduction.reduce import ReducedShaft
from rotor_fmu.shaft.matrices import ShaftModel
from rotor_fmu.shaft.stress import BendingStress
from rotor_fmu.vibration.modal_shaft import to_modal
from rotor_fmu.vibration.prepared import PreparedShaft
from rotor_fmu.vibration.rotor import Rotor
from rotor_fmu.vibration.unbalance import Unbalance


def unreduced(M, D, G, K, *, bearings=(0,), wheels=(0,), gravity=None):
    """A model of given matrices, nodes 1 m apart, and itself as its reduction."""
    n = len(M)
    eye = np.eye(n)
    bearing_dofs = np.array([[4 * k + i for i in range(4)] for k in bearings])
    wheel_dofs = np.array([[4 * k, 4 * k + 1] for k in wheels])
    load = np.zeros(n) if gravity is None else gravity
    none = sp.csr_array((0, 0))
    model = ShaftModel(
        M=sp.csr_array(M), D=sp.csr_array(D), G=sp.csr_array(G), K=sp.csr_array(K),
        plane_mass=none, plane_stiffness=none, plane_polar=none, stiffness_root=none,
        z=np.arange(n // 4, dtype=float), bearing_dofs=bearing_dofs, wheel_dofs=wheel_dofs,
        gravity=load, rayleigh=(0.0, 0.0), plane_gravity=np.zeros(0),
    )  # fmt: skip
    reduced = ReducedShaft(
        M=M, D=D, G=G, K=K, T=eye, bearing=eye[bearing_dofs.ravel()], wheels=eye[wheel_dofs.ravel()],
        gravity=load, method="none",
    )  # fmt: skip
    return model, reduced


def matrix_rotor(model, reduced, excitation, *, gravity, speed, **more):
    """A rotor of matrices; they do not tell of bending moments, which here are none."""
    n = model.size
    bending = BendingStress(sp.csr_array((n, n)), np.zeros(n), np.ones((2, n // 4)))
    shaft = PreparedShaft(model, reduced, to_modal(reduced), bending)
    return Rotor(shaft, excitation, gravity=gravity, speed=speed, **more)


def gyroscopic(seed=1, nodes=3):
    """Random positive definite mass, stiffness with four rigid-body modes, damping, gyroscopic coupling."""
    rng = np.random.default_rng(seed)
    n = 4 * nodes
    basis = rng.normal(size=(n, n))
    M = np.eye(n) + 0.1 * basis @ basis.T / n
    free, _ = np.linalg.qr(rng.normal(size=(n, n)))
    K = (free[:, 4:] * np.geomspace(20.0, 5e4, n - 4)) @ free[:, 4:].T
    D = 0.3 * M + 1e-4 * K
    G = rng.normal(size=(n, n)) / 4
    return M, D, G - G.T, (K + K.T) / 2


def unbalance(amount, phase, blade=None, blade_phase=None, fracture_time=math.inf):
    nothing = np.zeros(len(amount))
    blades = [nothing if v is None else v for v in (blade, blade_phase)]
    return Unbalance(*(np.asarray(v, dtype=float) for v in (amount, phase, *blades)), fracture_time)


def small_rotor(*, speed=12.0, excitation=None, ground=0.0, gravity=0.0, seed=1, track_work=False):
    """The random gyroscopic shaft of three nodes, two bearings, two wheels; `ground` adds springs to K."""
    M, D, G, K = gyroscopic(seed)
    load = np.zeros(len(M))
    load[1::4] = -1.0
    model, reduced = unreduced(
        M, D, G, K + ground * np.eye(len(M)), bearings=(0, 2), wheels=(0, 1), gravity=load
    )
    excitation = excitation or unbalance([0.02, 0.01], [0.3, -1.0])
    return matrix_rotor(model, reduced, excitation, gravity=gravity, speed=speed, track_work=track_work)


def linear_bearings(count=2, seed=5):
    """F0, K, C of stable, unsymmetric linear bearings."""
    rng = np.random.default_rng(seed)
    K = np.tile(np.diag([900.0, 1400.0, 300.0, 500.0]), (count, 1, 1)) + 80.0 * rng.normal(size=(count, 4, 4))
    C = np.tile(np.diag([12.0, 15.0, 5.0, 6.0]), (count, 1, 1)) + rng.normal(size=(count, 4, 4))
    return rng.normal(size=(count, 4)), K, C


def no_law(count=2):
    return np.zeros((count, 4)), np.zeros((count, 4, 4)), np.zeros((count, 4, 4))


def run(rotor, law, H, steps, *, start=0, speed=12.0):
    for k in range(start, start + steps):
        rotor.step(k * H, H, *law, speed)
    return rotor


OMEGA = 100.0
"""Natural frequency of `jeffcott` [rad/s]."""


def jeffcott(zeta, speed, **more):
    """A unit mass on an isotropic spring, its law, and a rotor at a speed with unit eccentricity."""
    nothing = np.zeros((4, 4))
    model, reduced = unreduced(np.eye(4), nothing, nothing, nothing, bearings=(0,), wheels=(0,))
    rotor = matrix_rotor(model, reduced, unbalance([1.0], [0.0]), gravity=0.0, speed=speed, **more)
    return rotor, (np.zeros((1, 4)), OMEGA**2 * np.eye(4)[None], 2.0 * zeta * OMEGA * np.eye(4)[None])
