"""Where journals float on tilting pads: any number, loads in any direction, pads that lose their hold."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearing_fmu.film import FilmFailure, make_film
from bearing_fmu.static.equilibrium import carried
from fmus import port
from fmus.port.bore import tilting, to_text
from tests.bearing_fmu.bearings import force_unit
from tests.bearing_fmu.published_rows import load_of
from tests.bearing_fmu.tilting.independent_pad import settled
from tests.bearing_fmu.tilting.pads import DEG, ROUGH, at_rest, film


@pytest.mark.parametrize(
    ("first", "pads", "eps", "inverse", "met"),
    [
        (0.0, 2, 0.1, 5.76, False),
        (0.0, 2, 0.5, 0.756, True),
        (45.0, 1, 0.2, 1.42, False),
        (45.0, 1, 0.4, 0.507, False),
    ],
)
def test_loads_on_pads_are_those_of_another_solution(first, pads, eps, inverse, met):
    """Between two pads and on one.  Finite differences: within 1.5 % of this film in each, of Someya's number
    in one only.  His loads on a pad contradict those between pads: by them one pad carries 1.6 times what
    each of two does at the same gap.
    """
    bearing = film(bore=to_text(tilting(4, 80.0 * DEG, 0.0, first=first * DEG)), columns=96, rows=12)
    p = bearing.parameters
    out, _ = at_rest(bearing, [0.0, -eps, 0.0, 0.0])
    share = math.cos(45.0 * DEG) if pads == 2 else 1.0
    _, force = settled(80.0 * DEG, 0.5, eps * share, 0.5)
    other = pads * share * 12.0 * force_unit(p)[0] * force
    assert out[1] == pytest.approx(other, rel=0.015)
    assert (abs(other / load_of(p, inverse) - 1.0) < 0.015) == met


@pytest.mark.parametrize("eps", [0.2, 0.4])
def test_beside_a_load_on_a_pad_the_stiffness_across_is_another(eps):
    """The pads at its sides carry nothing there and take hold beside it: no Kyy to hold to a table."""
    bore = to_text(tilting(4, 80.0 * DEG, 0.0, first=45.0 * DEG))
    bearing = film(bore=bore, columns=96, rows=12, whirl=1.0)
    here, near = (at_rest(bearing, [beside, -eps, 0.0, 0.0])[0] for beside in (0.0, 1e-4))
    assert near[8] > 50.0 * abs(here[8])
    assert near[1] == pytest.approx(here[1], rel=1e-4)


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


def behind_its_fold(place, whirl=0.0):
    """One pad of which a share counts: its bearing's answer, and what its film gives where it stands."""
    bearing = film(
        bore=to_text(tilting(4, 80.0 * DEG, 0.3, 0.55)[:1]), aspect=0.6, whirl=whirl, columns=96, **ROUGH
    )
    out, state = at_rest(bearing, place)
    clearance = bearing.parameters.clearance
    seen = np.array(place) * clearance
    seen[:2] += state.reshape(2, 2)[0] @ bearing.axes[0]
    alone = make_film("v2", bearing.pads[0]).respond(seen, np.zeros(4), 1.0)
    return out, alone, bearing.axes[0], clearance


def test_of_a_pad_that_counts_in_part_all_counts_in_part():
    """Oil and peak as the force; its oil is sheared whole."""
    shares = []
    for e in np.linspace(0.5, 0.6, 11):
        out, alone, *_ = behind_its_fold([0.0, -e, 0.0, 0.0])
        share = out[1] / alone.wrench[1]
        if 0.01 < share < 0.99:
            shares.append(share)
            told = dict(zip((v.name for v in port.BEARING_OUTPUTS), out, strict=False))
            assert told["oil_flow"] == pytest.approx(share * alone.oil_flow, rel=1e-3)
            assert told["friction_power"] == pytest.approx(alone.friction_power, rel=1e-3)
            assert told["p_max"] == pytest.approx(share * alone.p_max, rel=1e-3)
    assert len(shares) >= 2


def test_a_pad_that_has_lost_its_hold_gives_nothing_but_friction():
    """Force, stiffness and flow go to none where the share does; what is sheared goes on without a jump."""
    held, last, lost = (behind_its_fold([0.0, -e, 0.0, 0.0])[0] for e in (0.5, 0.6, 0.606))
    names = [v.name for v in port.BEARING_OUTPUTS]
    flow, rubs = names.index("oil_flow"), names.index("friction_power")
    for i in (1, flow):
        assert abs(last[i]) < 5e-3 * abs(held[i])
    assert np.hypot(*lost[:2]) < 1e-12 * np.hypot(*held[:2])
    assert 0.0 <= lost[flow] < 1e-4 * held[flow]
    assert np.abs(lost[8:24]).max() < 1e-9 * np.abs(held[8:24]).max()
    assert last[rubs] == pytest.approx(lost[rubs], rel=0.01)
    assert 0.9 * held[rubs] < lost[rubs] < held[rubs]


@pytest.mark.parametrize("place", [0.49, 0.51, 0.55, 0.59])
def test_where_a_pad_loses_its_hold_does_not_depend_on_asperities_that_do_not_touch(place):
    """Before the fold and behind it; rough pads are pressed deeper, so the search has further bounds."""
    bore = to_text(tilting(4, 80.0 * DEG, 0.3, 0.55)[:1])
    smooth, rough = (
        at_rest(film(bore=bore, aspect=0.6, **(ROUGH | {"roughness": sigma})), [0.0, -place, 0.0, 0.0])
        for sigma in (3e-6, 3e-5)
    )
    assert abs(smooth[0][1]) > 1.0
    np.testing.assert_allclose(rough[1][0], smooth[1][0], rtol=1e-4)
    np.testing.assert_allclose(rough[0][1], smooth[0][1], rtol=1e-4)


def test_a_whirl_sees_how_the_share_of_a_pad_changes():
    """Synchronous stiffness: the pad's own, its motion condensed, and what its share loses."""
    checked = 0
    for e in np.linspace(0.5, 0.6, 11):
        place = np.array([0.05, -e, 0.0, 0.0])
        out, alone, axes, clearance = behind_its_fold(place, whirl=1.0)
        share = out[1] / alone.wrench[1]
        if not 0.05 < share < 0.95:
            continue
        checked += 1
        whole, a = alone.stiffness[:2, :2] + 1j * alone.damping[:2, :2], axes[0]
        freed = whole - np.outer(whole @ a, a @ whole) / (a @ whole @ a)
        steps = 1e-5 * np.eye(4)[:2]
        ends = [[_share(place + s * step) for s in (1.0, -1.0)] for step in steps]
        changes = np.array([(up - down) / (2e-5 * clearance) for up, down in ends])
        lost = -np.outer(alone.wrench[:2], changes)
        expected = share * freed.real + lost
        assert np.linalg.norm(lost) > 0.1 * np.linalg.norm(expected)
        found = out[8:24].reshape(4, 4)[:2, :2]
        assert np.linalg.norm(found - expected) < 5e-3 * np.linalg.norm(expected)
    assert checked >= 2


def _share(place):
    out, alone, *_ = behind_its_fold(place)
    return out[1] / alone.wrench[1]


def test_what_is_no_number_is_called_so():
    with pytest.raises(FilmFailure, match="NOT_FINITE"):
        at_rest(film(), [np.nan, -0.5, 0.0, 0.0])
    with pytest.raises(FilmFailure, match="NOT_FINITE"):
        at_rest(film(), [0.0, -0.5, 0.0, 0.0], speed=np.nan)
