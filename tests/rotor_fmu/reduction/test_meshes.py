"""One shaft in 3 to 1600 elements: unreduced against Timoshenko's beam, reduced against the unreduced."""

from __future__ import annotations

from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from rotor_fmu.linear.analysis import unreduced_shaft
from rotor_fmu.linear.free_whirl import free_branches
from rotor_fmu.linear.whirl import LinearBearings, whirl_modes
from rotor_fmu.reduction import reduce as reduction
from rotor_fmu.reduction.irs import ReductionError, irs_iterations
from rotor_fmu.reduction.masters import default_masters
from rotor_fmu.reduction.reduce import METHODS, reduce
from rotor_fmu.shaft.banded import lowest_modes
from rotor_fmu.shaft.matrices import assemble
from rotor_fmu.start_values import default_starts
from rotor_fmu.vibration import prepared as prepared_shaft
from rotor_fmu.vibration.modal_shaft import to_modal
from rotor_fmu.vibration.prepared import prepare_shaft
from tests.rotor_fmu.meshes import exact_frequencies, meshed

MESHES = (3, 4, 12, 56, 80, 200, 800, 1600)
COUNT = 8
ERROR = {"irs": 5e-9, "irs-plain": 5e-9, "craig-bampton": 2e-6, "guyan": 0.08, "none": 5e-9}
"""Largest of the lowest eight frequencies with 220 degrees of freedom; Guyan lacks the disc's tilting."""


def unreduced(elements):
    """Lowest elastic frequencies of one plane [rad/s], up to eight."""
    model = unreduced_shaft(meshed(elements))
    count = min(2 + COUNT, 2 * model.nodes)
    squares, _ = lowest_modes(model.plane_mass, model.plane_stiffness, count, shift=1e4)
    return np.sqrt(squares[2:])


@pytest.fixture(scope="module")
def exact():
    return exact_frequencies(unreduced(200))


def test_the_unreduced_shaft_converges_to_timoshenko_with_the_square_of_the_length(exact):
    error = {elements: unreduced(elements) / exact - 1.0 for elements in MESHES[2:]}
    factor = error[200] * 200.0**2
    assert np.all(factor > 1e-3)
    for elements in MESHES[3:]:
        assert error[elements] == pytest.approx(factor / elements**2, rel=0.03, abs=3e-9)
    assert np.all(error[12] > factor / 12**2) and np.all(error[12] < 1.5 * factor / 12**2)


@pytest.mark.parametrize("elements", MESHES)
@pytest.mark.parametrize("method", [m for m in METHODS if m != "none"])
def test_every_reduction_of_every_mesh(elements, method):
    model = unreduced_shaft(meshed(elements))
    reduced = reduce(model, method)
    omega = to_modal(reduced).omega.reshape(2, -1)
    assert np.all(omega[:, :2] == 0.0) and np.all(omega[:, 2:] > 0.0)  # rigid motions and no others
    full = unreduced(elements)
    if model.size <= 220:
        assert reduced.method == "none" and reduced.size == model.size
        assert reduced.reason == f"the shaft has {model.size} degrees of freedom, 220 may be kept"
    else:
        assert (reduced.method, reduced.reason) == (method, "")
        assert 200 < reduced.size <= 220
    for plane in omega:
        assert plane[2 : 2 + len(full)] == pytest.approx(full, rel=ERROR[reduced.method])


@pytest.mark.parametrize("method", [m for m in METHODS if m != "none"])
@pytest.mark.parametrize("elements", [3, 4, 12, 80, 1600])
@pytest.mark.parametrize("size", [2, 10, 24])
def test_no_size_is_too_small(elements, method, size):
    """Bearings and ends are kept in any case; frequencies are bounds from above."""
    model = unreduced_shaft(meshed(elements))
    omega = to_modal(reduce(model, method, size=size)).omega.reshape(2, -1)[0]
    assert np.all(omega[:2] == 0.0)
    found, full = omega[2:5], unreduced(elements)[: len(omega[2:5])]
    assert len(found) and np.all(found > full * (1.0 - 1e-8))


@pytest.mark.parametrize("elements", [80, 1600])
def test_the_reduced_shaft_on_bearings_turns_as_the_unreduced(elements):
    train = meshed(elements)
    model = unreduced_shaft(train)
    stiffness = np.tile(np.diag([2e8, 3e8, 1e5, 1e5]), (2, 1, 1))
    bearings = LinearBearings(stiffness, 1e-4 * stiffness)
    full, own = (whirl_modes(shaft, 300.0, 12, bearings=bearings) for shaft in (model, reduce(model, "irs")))
    assert own.eigenvalues == pytest.approx(full.eigenvalues, rel=2e-6)


def test_overdamped_modes_of_a_fine_mesh_are_no_whirl():
    """Damped as the stiffness is, the highest modes of a fine mesh do not oscillate but creep."""
    train = replace(meshed(80), rayleigh_alpha=0.2, rayleigh_beta=2e-5)
    model = assemble(train)
    shaft = reduce(model, "irs")
    full, own = (free_branches(s, model.z, [0.0, 300.0], COUNT) for s in (model, shaft))
    assert full.forward[0] == pytest.approx(unreduced(80), rel=5e-3)
    assert np.all(full.backward[1] < full.backward[0]) and np.all(full.forward[1] > full.forward[0])
    assert np.abs(own.error(full)).max() < 1e-6


def test_the_published_iteration_creeps_where_a_disc_tilts_on_a_slave():
    """With the masters held the disc tilts at a frequency among those wanted; as a master it does not."""
    model = unreduced_shaft(meshed(200))
    masters = default_masters(model, 40)
    slope_of_disc = 1
    assert slope_of_disc not in masters

    def errors(kept, last):
        histories = [basis.history[-1][:COUNT] for basis in islice(irs_iterations(M, R, kept), last + 1)]
        return np.abs(np.array(histories) / unreduced(200) - 1.0).max(axis=1)

    M, R = model.plane_mass, model.stiffness_root
    slow = errors(masters, 40)
    assert slow[0] > 0.05 and slow[40] > 1e-6
    assert 1.5 < slow[20] / slow[40] < 6.0  # as a power of the number of iterations, not geometrically
    assert errors(np.union1d(masters, [slope_of_disc]), 4)[4] < 1e-8
    formulated = reduce(model, "irs-plain", size=80)
    assert len(formulated.history) <= 7
    assert np.abs(np.array(formulated.history[-1][:COUNT]) / unreduced(200) - 1.0).max() < 1e-8


def test_craig_bampton_takes_the_place_of_irs_that_does_not_converge():
    model = unreduced_shaft(meshed(80))
    reduced, instead = reduce(model, "irs", max_iterations=1), reduce(model, "craig-bampton")
    assert reduced.method == "craig-bampton" and reduced.size == instead.size
    np.testing.assert_array_equal(reduced.K, instead.K)
    assert reduced.reason.startswith("IRS with 110 masters: after 1 iterations the lowest 16 frequencies")
    assert "\n" not in reduced.reason
    assert reduced.carried_out == f"craig-bampton; {reduced.reason}"
    assert instead.carried_out == "craig-bampton"


@pytest.mark.parametrize("method", ["none", "guyan", "craig-bampton"])
def test_only_the_chosen_reduction_is_carried_out(monkeypatch, method):
    """Nor any by the builder, whose start values are of the unreduced shaft."""

    def refuse(*_, **__):
        raise ReductionError("not asked for")

    for name in ("improved_reduced_system", "guyan", "craig_bampton"):
        if name != method.replace("-", "_"):
            monkeypatch.setattr(reduction, name, refuse)
    train = meshed(57)
    assert prepare_shaft(train, method).reduced.carried_out == method
    monkeypatch.setattr(prepared_shaft, "reduce", refuse)
    assert default_starts(train)["bearing[1].F0.Fy"] > 0.0
