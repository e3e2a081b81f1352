"""Trains as they come: matrices, reductions, statics and steps keep what physics keeps."""

import math

import numpy as np
import scipy.linalg as sl
from hypothesis import given
from hypothesis import strategies as st

from rotor_fmu.reduction.reduce import reduce
from rotor_fmu.shaft.matrices import assemble
from rotor_fmu.shaft.statics import target_loads
from rotor_fmu.train.file import load_train
from rotor_fmu.train.train import Train
from rotor_fmu.train.writer import write_train
from rotor_fmu.vibration.rotor import Rotor
from tests.properties.examples import examples
from tests.properties.shafts import laws, trains

METHODS = st.sampled_from(["irs", "irs-plain", "guyan", "craig-bampton"])
GRAVITY = 9.80665


def rigid_modes(model):
    """Shifts along x and y and turns about them, (n, 4)."""
    modes = np.zeros((model.size, 4))
    modes[0::4, 0] = modes[1::4, 1] = 1.0
    modes[1::4, 2], modes[2::4, 2] = -model.z, 1.0
    modes[0::4, 3], modes[3::4, 3] = model.z, 1.0
    return modes


@given(trains())
def test_matrices_are_symmetric_and_free_of_forces_in_rigid_motion(train):
    model = assemble(train)
    M, K, G = (matrix.toarray() for matrix in (model.M, model.K, model.G))
    for matrix, sign in ((M, 1.0), (K, 1.0), (G, -1.0)):
        np.testing.assert_allclose(matrix, sign * matrix.T, atol=1e-13 * np.abs(matrix).max())
    assert np.linalg.eigvalsh(M / np.sqrt(np.outer(M.diagonal(), M.diagonal())))[0] > 0.0
    modes = rigid_modes(model)
    assert np.abs(K @ modes).max() < 1e-9 * np.abs(K).max() * train.length
    np.testing.assert_allclose((modes.T @ M @ modes).diagonal()[:2], train.mass, rtol=1e-9)
    np.testing.assert_allclose(modes[:, 1] @ model.gravity, -train.mass, rtol=1e-9)


@given(trains(), METHODS)
@examples(25)
def test_a_reduction_is_symmetric_and_never_softer(train, method):
    """Galerkin: rigid motion stays free, and no natural frequency falls below that of the full shaft."""
    model = assemble(train)
    reduced = reduce(model, method)
    for matrix, sign in ((reduced.M, 1.0), (reduced.K, 1.0), (reduced.D, 1.0), (reduced.G, -1.0)):
        np.testing.assert_allclose(matrix, sign * matrix.T, atol=1e-12 * np.abs(matrix).max())
    assert np.linalg.eigvalsh(reduced.M)[0] > 0.0
    full = sl.eigh(model.K.toarray(), model.M.toarray(), eigvals_only=True)
    own = sl.eigh(reduced.K, reduced.M, eigvals_only=True)
    noise = 1e-9 * full[-1]
    assert np.all(np.abs(own[:4]) < noise)
    count = min(own.size, 12)
    assert np.all(own[4:count] > full[4:count] * (1.0 - 1e-6) - noise)
    if method.startswith("irs"):
        np.testing.assert_allclose(own[4:8], full[4:8], rtol=1e-4)


@given(trains())
def test_loads_of_the_bearings_balance_the_weight(train):
    model, loads = assemble(train), target_loads(train)
    weight = GRAVITY * train.mass
    assert abs(loads.sum() - weight) < 1e-9 * weight
    moment = loads @ [train.z[b.node] for b in train.bearings]
    of_weight = GRAVITY * model.gravity @ rigid_modes(model)[:, 2]
    assert abs(moment - of_weight) < 1e-9 * weight * train.length


@given(trains(), st.data())
@examples(15)
def test_rest_in_equilibrium_stays_rest(train, data):
    """Static wrenches balance the weight, and steps of any length leave the shaft where it is."""
    law = data.draw(laws(train))
    rotor = Rotor.of_train(train, reduction="guyan", unbalance=np.zeros(len(train.wheels)))
    rotor.start_from_law(*law, orbit=False)
    weight = GRAVITY * train.mass
    force = rotor.static_wrench().sum(axis=0)
    assert abs(force[0]) < 1e-7 * weight and abs(force[1] - weight) < 1e-7 * weight
    before, step = rotor.kinematics(), data.draw(st.floats(1e-5, 0.1))
    size = np.abs(before[:, :4]).max()
    for k in range(5):
        rotor.step(k * step, step, *law, train.speed)
    after = rotor.kinematics()
    np.testing.assert_allclose(after[:, :4], before[:, :4], atol=1e-6 * size)
    np.testing.assert_allclose(after[:, 4:], 0.0, atol=1e-6 * size * (1.0 / step + train.speed))


@given(trains(), st.data())
@examples(15)
def test_energy_after_a_push_stays_bounded(train, data):
    """Of shaft, weight and springs, through steps far longer than the period of most modes.

    The law is exact at the ends of a step and linear within: a step may gain, but the gains do not pile up
    below the limit of the linear acceleration method, sqrt(k/m) H = 2 sqrt(3), of the stiffest journal.
    """
    F0, K, C = data.draw(laws(train))
    rotor = Rotor.of_train(train, reduction="guyan", unbalance=np.zeros(len(train.wheels)))
    rotor.start_from_law(F0, K, C, orbit=False)

    def energy():
        q = rotor.kinematics()[:, :4]
        springs = 0.5 * np.einsum("bi,bij,bj->", q, K, q) - np.sum(F0 * q)
        return sum(rotor.energy()) + springs

    rest = energy()
    push = F0 + np.array([1.0, -1.0, 0.0, 0.0]) * GRAVITY * train.mass / len(train.bearings)
    mobility = rotor.shaft.bearing @ rotor.shaft.bearing.T  # of the journals; modes have unit mass
    stiffest = math.sqrt(np.abs(np.linalg.eigvals(mobility @ sl.block_diag(*K))).max())
    step = min(data.draw(st.floats(1e-5, 1e-3)), 3.0 / stiffest)
    # the method conserves the energy less a share (k/m) H^2 / 12 of that in the spring
    growth = max(3.0, 1.0 / (1.0 - (step * stiffest) ** 2 / 12.0))
    rotor.step(0.0, step, push, K, C, train.speed)
    pushed = energy() - rest
    assert pushed > 0.0
    for k in range(1, 100):
        rotor.step(k * step, step, F0, K, C, train.speed)
        assert energy() - rest < growth * pushed
    assert energy() > rest - 1e-6 * pushed


@given(trains())
@examples(30)
def test_trains_survive_files_and_json(tmp_path_factory, train):
    assert Train.from_json(train.to_json()) == train
    folder = tmp_path_factory.mktemp("train")
    write_train(train, folder)
    assert load_train(folder) == train
