"""Where journals float on tilting pads: any number, loads in any direction, pads that lose their hold."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearing_fmu.static.equilibrium import carried
from fmus.port.bore import tilting, to_text
from tests.bearing_fmu.bearings import force_unit
from tests.bearing_fmu.tilting.independent_pad import settled
from tests.bearing_fmu.tilting.pads import DEG, at_rest, film


@pytest.mark.parametrize(("eps", "inverse"), [(0.1, 5.76), (0.5, 0.756)])
def test_light_loads_between_pads_are_those_of_another_solution(eps, inverse):
    """Finite differences: within 1.5 % of this film at both, of Someya's number at the second only."""
    bearing = film(columns=96, rows=12)
    p = bearing.parameters
    out, _ = at_rest(bearing, [0.0, -eps, 0.0, 0.0])
    share = math.cos(45.0 * DEG)
    _, force = settled(80.0 * DEG, 0.5, eps * share, 0.5)
    other = 2.0 * share * 12.0 * force_unit(p)[0] * force
    assert out[1] == pytest.approx(other, rel=0.015)
    load = p.viscosity / (2.0 * math.pi) * p.width * p.diameter * (p.radius / p.clearance) ** 2 / inverse
    assert (abs(other / load - 1.0) < 0.015) == (eps == 0.5)


def carries(bearing, sommerfeld, angle):
    """Position over the clearance, attitude in degrees and response under a load in a direction."""
    p = bearing.parameters
    load = sommerfeld * p.viscosity * p.width * p.diameter * (p.radius / p.clearance) ** 2
    found = carried(bearing, (load * math.cos(angle), load * math.sin(angle)), 1.0)
    return found.position / p.clearance, found


@pytest.mark.parametrize(
    ("pads", "preload", "offset"),
    [(3, 0.2, 0.5), (3, 0.5, 0.6), (4, 0.0, 0.5), (5, 0.0, 0.5), (5, 0.3, 0.55), (6, 0.5, 0.6)],
)
def test_pads_of_any_number_carry_loads_in_any_direction(pads, preload, offset):
    """Turned by a pad's share, load and bearing are the same.

    Without preload one of three pads may carry alone, and nothing holds the journal beside it.
    """
    share = 2.0 * math.pi / pads
    for compliance in (0.0, 1e-9):
        bearing = film(bore=to_text(tilting(pads, share - 0.2, preload, offset, 0.3, compliance)))
        for sommerfeld in (0.1, 0.8):
            for angle in (-1.4, -0.6, 0.5):
                here, found = carries(bearing, sommerfeld, angle)
                there, _ = carries(bearing, sommerfeld, angle + share)
                c, s = math.cos(share), math.sin(share)
                np.testing.assert_allclose(there, [[c, -s], [s, c]] @ here, atol=1e-4)
                assert found.response.h_min > 0.0


def test_the_force_goes_on_where_a_pad_loses_its_hold():
    """Behind the fold of its balance a pad counts in part: no step, and a stiffness near the slope."""
    bearing = film(bore=to_text(tilting(4, 80.0 * DEG, 0.3, 0.55)), aspect=0.6)
    places = np.arange(0.42, 0.62, 0.004)
    outs = np.array([at_rest(bearing, [0.0, -e, 0.0, 0.0])[0] for e in places])
    slopes = np.diff(outs[:, 1]) / np.diff(places) / bearing.parameters.clearance
    middle = 0.5 * (outs[1:, 13] + outs[:-1, 13])
    rough = np.abs(slopes / middle - 1.0)
    assert np.median(rough) < 1e-3 and rough.max() < 0.06
    lost = [at_rest(bearing, [0.0, -e, 0.0, 0.0])[1].reshape(4, 2, 2)[0, 0, 0] for e in places[[0, -1]]]
    assert abs(lost[0] - lost[1]) > 0.1 * bearing.parameters.clearance  # the fold lies between
