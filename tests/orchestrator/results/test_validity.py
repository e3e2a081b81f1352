"""A run whose coupling failed does not pass for a finished one."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr

from orchestrator.outcome import Outcome
from orchestrator.results.quantities import GAP
from orchestrator.results.validity import UNRESOLVED, unresolved
from tests.faults import fault


def _record(defect, force=1.0):
    defect = np.asarray(defect, dtype=float)
    dims = ("time", "bearing")
    return xr.Dataset(
        {"defect_max": (dims, defect), "force_magnitude_max": (dims, np.full(defect.shape, force))},
        coords={"bearing": [f"b{i}" for i in range(defect.shape[1])]},
    )


@fault(
    "coupling",
    "an explicit coupling that is unstable and yet reaches its end",
    "unresolved, exit 10; share of the forces missed, the worst bearing, when and in which state",
    guard="orchestrator.results.validity:unresolved",
)
@pytest.mark.parametrize(("share", "fails"), [(0.99 * UNRESOLVED, False), (1.01 * UNRESOLVED, True)])
def test_the_limit_is_a_share_of_the_forces(share, fails):
    """On both sides of the limit; scaling forces and defects alike changes nothing."""
    assert bool(unresolved(_record([[share, share]]))) is fails
    assert bool(unresolved(_record([[1e6 * share, 1e6 * share]], force=1e6))) is fails


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
