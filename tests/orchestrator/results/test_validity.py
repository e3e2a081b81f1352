"""A run whose coupling failed, or whose model no longer holds, does not pass for a finished one."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from orchestrator.outcome import Outcome
from orchestrator.results.model_limits import CASING, OVERLAP, SLOPE, STRENGTH, beyond_model
from orchestrator.results.quantities import GAP
from orchestrator.results.validity import ALLOWED, RUINED, error_estimate, judge, unresolved
from tests.faults import fault
from tests.orchestrator.results import synthetic_record

TRAIN = synthetic_record.train()


def _record(defect, force=1.0, of_length=None):
    """Forces of one size, of two bearings."""
    defect = np.asarray(defect, dtype=float)
    dims = ("time", "bearing")
    of_length = np.zeros_like(defect) if of_length is None else np.asarray(of_length, dtype=float)
    return xr.Dataset(
        {
            "defect_max": (dims, defect),
            "step_error_max": (dims, of_length),
            "force_magnitude_max": (dims, np.full(defect.shape, force)),
        },
        coords={"time": np.arange(len(defect)) * 1e-3, "bearing": [f"b{i}" for i in range(defect.shape[1])]},
    )


@fault(
    "coupling",
    "an explicit coupling that is unstable and yet reaches its end",
    "unresolved, exit 10; share of the forces missed, the worst bearing, when and in which state",
    guard="orchestrator.results.validity:unresolved",
)
@pytest.mark.parametrize(("share", "fails"), [(0.99 * ALLOWED, False), (1.01 * ALLOWED, True)])
def test_the_limit_is_a_share_of_the_forces(share, fails):
    """On both sides of the limit; scaling forces and defects alike changes nothing."""
    assert bool(unresolved(_record([[share, share]] * 2))) is fails
    assert bool(unresolved(_record([[1e6 * share, 1e6 * share]] * 2, force=1e6))) is fails


@fault(
    "coupling",
    "steps so long that the motion goes on between their ends, with an iteration that leaves no defect",
    "unresolved, exit 10: the estimate sees the length of the step besides the interface",
    guard="orchestrator.master.step_error:error_of_step",
)
def test_the_length_of_the_step_counts_as_the_defect_does():
    nothing = np.zeros((3, 2))
    assert not unresolved(_record(nothing))
    long = _record(nothing, of_length=[[0.0, 0.0], [0.0, 1.5 * ALLOWED], [0.0, 0.0]])
    assert "of the largest force of b1" in unresolved(long)
    assert error_estimate(long).largest == pytest.approx(1.5 * ALLOWED)


@fault(
    "coupling",
    "one peak of the force far too high in a run that is accurate for the rest of its time",
    "unresolved, exit 10: the largest error counts beside that over the run",
    guard="orchestrator.results.validity:error_estimate",
)
def test_one_wrong_peak_in_a_long_run_is_enough():
    defect = np.zeros((1000, 2))
    defect[500, 0] = 1.2 * ALLOWED
    found = error_estimate(_record(defect))
    assert found.rms < 0.1 * ALLOWED and not found.resolved
    assert (found.bearing, found.time) == ("b0", 0.5)


def test_a_bearing_that_hardly_carries_counts_by_the_load_of_the_train():
    record = _record([[0.0, 0.0], [0.0, 1.0]]).assign(
        force_magnitude_max=(("time", "bearing"), [[100.0, 1.0], [100.0, 1.0]]),
        static_force=(("bearing", "axis"), [[0.0, 99.0], [0.0, 1.0]]),
    )
    assert error_estimate(record).largest == pytest.approx(1.0 / 50.0)


def test_the_worst_bearing_is_named():
    assert "b1" in unresolved(_record([[0.0, 0.8], [0.1, 0.9]]))


def test_the_worst_instant_is_given_with_the_state_of_the_journal():
    record = _record([[0.1, 0.2], [0.1, 0.9], [0.0, 0.3]])
    dims = ("time", "bearing")
    record = record.assign_coords(time=[0.0, 0.5, 1.0]).assign(
        eccentricity=(dims, np.full((3, 2), 0.75)),
        least_gap=(dims, np.full((3, 2), 2.5e-5)),
        tilt=((*dims, "axis"), np.full((3, 2, 2), 3e-5)),
        offset_tilt=(("bearing", "axis"), np.tile([1e-5, -1e-5], (2, 1))),
    )
    state = "b1, worst at t = 0.5 s (eccentricity ratio 0.75, tilts 20 and 40 urad, least gap 25 um)"
    assert state in unresolved(record)


def test_the_outcome_is_no_success():
    assert not Outcome.UNRESOLVED.ok
    assert Outcome.UNRESOLVED.status == 10


def test_a_first_instant_without_defect_counts_not():
    """Nothing was coupled yet: the record has NaN there."""
    assert not unresolved(_record([[np.nan, np.nan], [0.0, 0.0]]))


def test_a_bearing_without_a_bore_has_no_gap_to_judge():
    """Its least film is a dash, not a number and no reason to stop."""
    assert GAP.number(math.nan) == "-" and GAP.text(math.nan) == f"- {GAP.unit}"


def _beyond(name, factor, sample):
    """A record that passes the limit of a quantity by a factor at a sample, and at no other place."""
    record = synthetic_record.record(end=1.2).drop_vars(("stress", "amplitude", "least_gap_min"))
    times, nodes, bearings = (record.sizes[key] for key in ("time", "node", "bearing"))
    shape = {"tilt": (times, bearings, 2), "least_gap_min": (times, bearings)}.get(name, (times, nodes))
    dims = {"tilt": ("time", "bearing", "axis"), "least_gap_min": ("time", "bearing")}
    values = np.zeros(shape)
    wheel = TRAIN.wheels[3]
    place, limit = {
        "stress": ((57,), STRENGTH),
        "amplitude": ((wheel.node,), CASING * wheel.mean_diameter),
        "tilt": ((4, 1), -SLOPE),
        "least_gap_min": ((4,), -OVERLAP * TRAIN.bearings[4].clearance),
    }[name]
    values[(sample, *place)] = factor * limit
    return record.assign({name: (dims.get(name, ("time", "node")), values)})


@fault(
    "machine",
    "a motion that breaks the shaft, runs into the casing, or is no small one",
    "beyond-model, exit 15; the first instant, what passed which limit, and where",
    guard="orchestrator.results.model_limits:beyond_model",
)
@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("stress", "stress 1010 N/mm2 at z = 13.94 m, above the strength of the shaft, 1000 N/mm2"),
        ("amplitude", "at wheel 'HP-4', more than 1 % of its mean diameter"),
        ("tilt", "slope 0.0505 rad of the journal at LP2-front, beyond small motion"),
        ("least_gap_min", "um deep in the bore at LP2-front, more than 10 % of the clearance"),
    ],
)
def test_a_run_beyond_its_model_says_when_and_why(name, said):
    assert judge(_beyond(name, 0.99, 700), TRAIN) == (Outcome.FINISHED, "")
    outcome, message = judge(_beyond(name, 1.01, 700), TRAIN)
    assert outcome is Outcome.BEYOND_MODEL
    assert message.startswith("the model no longer holds from t = 0.7 s on: ") and said in message


def test_the_material_s_own_strength_counts_where_it_is_given():
    shoulders = [
        replace(s, material=replace(s.material, yield_strength=6e8)) if k == 57 else s
        for k, s in enumerate(TRAIN.shoulders)
    ]
    soft = replace(TRAIN, shoulders=tuple(shoulders))
    assert beyond_model(_beyond("stress", 0.7, 700), TRAIN) is None
    assert (
        "above the strength of the shaft, 600 N/mm2" in beyond_model(_beyond("stress", 0.7, 700), soft).text
    )


def test_an_unstable_coupling_is_no_broken_shaft():
    """What it throws out of the bearings says nothing of the machine; a merely coarse one may be right."""
    record = _beyond("stress", 2.0, 700)
    for share, outcome in ((1.1 * RUINED, Outcome.UNRESOLVED), (2.0 * ALLOWED, Outcome.BEYOND_MODEL)):
        found, message = judge(record.assign(defect_max=share * record["force_magnitude_max"]), TRAIN)
        assert found is outcome
        assert "the coupling missed" in message and "the model no longer holds from t = 0.7 s" in message
