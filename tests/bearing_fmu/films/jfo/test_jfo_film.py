"""The mass-conserving film of a bearing: published bearing, tangent, mass, memory."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_fmu.film import make_film
from bearing_fmu.films.jfo.network import FREE, balance
from bearing_fmu.films.jfo.reynolds import conclude, set_up
from bearing_fmu.films.jfo.workspace import (
    ENDS,
    FACES,
    FEED,
    FULL,
    GROOVE,
    KEPT,
    OWED,
    STEP,
    VOID,
    VOLUME,
    axial_faces,
)
from bearing_fmu.kernels.grid import COS, SIN
from bearing_fmu.outputs import OUT_C, OUT_K, OUTPUTS
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.result import RESULTS

GROOVED = "[[0.2, 2.94, 0, 0], [3.34, 6.08, 0, 0]]"
BORES = [GROOVED, "plain"]
pytestmark = pytest.mark.slow  # the kernel compiles for a minute, for either kind of bore
SPEED, STEP_LENGTH = 157.0, 1e-4


def bearing(**changes):
    values = {
        "diameter": 0.8, "width": 0.64, "clearance": 8.62e-4, "viscosity": 0.0242, "ambient_pressure": 1e5,
        "feed_pressure": 1.5e5, "roughness": 3e-6, "contact_modulus": 1e9, "friction": 0.1, "boundary": "jfo",
        "bore": GROOVED,
    }  # fmt: skip
    return make_film("v1", BearingParameters(**values | changes))


def along(t: float) -> np.ndarray:
    """Inputs of a journal that moves and tilts, at an instant."""
    c, swing, rate = 8.62e-4, np.array([0.05, 0.1, 0.02, 0.03]) * 8.62e-4, 300.0
    inputs = np.zeros(17)
    inputs[:4] = np.array([0.3 * c, -0.6 * c, 2e-4, -3e-4]) + swing * (1.0 - np.cos(rate * t))
    inputs[4:8], inputs[16] = swing * rate * np.sin(rate * t), SPEED
    return inputs


def after(film, steps, dt=STEP_LENGTH):
    """State after some steps."""
    _, state = film.evaluate(film.rest(), along(0.0), 0.0)
    for k in range(1, steps + 1):
        _, state = film.evaluate(state, along(k * dt), dt)
    return state


def cells_of(film, state):
    n, m = film.parameters.rows, film.parameters.columns
    return state[FACES + m :].reshape(KEPT, n, m)


def test_a_parabola_is_met_exactly_by_the_axial_faces():
    heights, spans = axial_faces(8)
    film = bearing()
    space, data = film.take()
    z = np.concatenate(([-1.0], data[3].film.nodes[:8], [1.0]))
    film.bring_back(space)
    flux = -np.diff(0.5 * (1.0 - z**2)) / spans
    np.testing.assert_allclose(flux, heights, rtol=0, atol=1e-14)


@pytest.mark.parametrize("bore", BORES)
@pytest.mark.parametrize("steps", [0, 30])
def test_the_tangent_is_that_of_the_step(bore, steps):
    """Against central differences of a step from what is remembered, grid and fronts in motion.

    Positions differ by what the velocities that differ make of the step, so that moving faces bring the same
    whether it counts as stiffness or as damping.
    """
    film = bearing(bore=bore)
    state, now = after(film, steps), along((steps + 1) * STEP_LENGTH)
    now[2:4] *= 1.02
    out, _ = film.evaluate(state, now, STEP_LENGTH)
    stiffness, damping = (out[place : place + 16].reshape(4, 4) for place in (OUT_K, OUT_C))
    told = STEP_LENGTH * stiffness + damping
    for k in range(4):
        moved, size = np.zeros(17), (1e-5, 3e-5)[k // 2]
        moved[k], moved[4 + k] = STEP_LENGTH * size, size
        up, down = (film.evaluate(state, now + s * moved, STEP_LENGTH)[0][:4] for s in (1.0, -1.0))
        found = (down - up) / (2.0 * size)
        np.testing.assert_allclose(found, told[:, k], rtol=0, atol=1e-6 * np.abs(told).max(axis=1).max())


@pytest.mark.parametrize(("bore", "left"), [(GROOVED, 0.15), ("plain", 0.35)])
def test_the_law_of_a_step_holds_in_the_next(bore, left):
    """What it misses goes with the step at least, on a moving grid too: here a quarter of the step.

    Where fronts go over cells without a groove between them, first order is what implicit Euler leaves.
    """
    film, missed = bearing(bore=bore), []
    for part in (1, 4):
        step, sizes = STEP_LENGTH / part, []
        last, state = film.evaluate(film.rest(), along(0.0), 0.0)
        for k in range(1, 12 * part):
            out, state = film.evaluate(state, along(k * step), step)
            moved = along(k * step) - along((k - 1) * step)
            stiffness, damping = (last[place : place + 16].reshape(4, 4) for place in (OUT_K, OUT_C))
            law = last[:4] - stiffness @ moved[:4] - damping @ moved[4:8]
            if k > 6 * part:
                sizes.append(np.linalg.norm(out[:2] - law[:2]))
            last = out
        missed.append(np.median(sizes))
    assert missed[1] < left * missed[0]


@pytest.mark.parametrize("bore", BORES)
def test_no_oil_is_lost(bore):
    """Content and what is owed change by the flow over ends and grooves, to 1e-12 of it, each step."""
    film = bearing(bore=bore)
    state = after(film, 5)
    space, data = film.take()
    jfo = data[3]
    film.bring_back(space)
    free = jfo.net.held[0] == 0.0
    for k in range(6, 40):
        before = np.array(state)
        _, state = film.evaluate(before, along(k * STEP_LENGTH), STEP_LENGTH)
        net, kept, had = jfo.net, cells_of(film, state), jfo.before
        oil = (kept[VOLUME] - kept[VOID] + kept[OWED])[:, free].sum()
        oil -= (had[VOLUME] - had[VOID] + had[OWED])[:, free].sum()
        p, ahead = net.pressure, np.roll(net.pressure, -1, axis=1)
        around = net.carried * net.content - net.around * (ahead - p)
        out = (net.axial[0] * (p[0] - net.ends) + net.axial[-1] * (p[-1] - net.ends))[free].sum()
        out += (around - np.roll(around, 1, axis=1))[:, free].sum()
        total = kept[VOLUME].sum()
        assert abs(oil + 0.5 * STEP_LENGTH * out) < 1e-12 * total
        # brought over to another grid it is the same, and what is owed stays a trifle
        old = cells_of(film, before)
        rows = [(of[VOLUME] - of[VOID] + of[OWED]).sum(axis=1) for of in (had, old)]
        np.testing.assert_allclose(rows[0], rows[1], rtol=0, atol=1e-12 * total)
        assert np.abs(kept[OWED]).sum() < 1e-2 * total
        assert kept[VOID].min() > -1e-9 * kept[VOLUME].max()
    assert 0.5 < jfo.net.full.mean() < 0.95


def test_a_sealed_bearing_keeps_its_oil():
    """Without flow over the ends, to 1e-10 a step; and what is owed stays small."""
    film, most = bearing(bore="plain"), []
    space, data = film.take()
    data[3].spans[[0, -1]] = np.inf
    film.bring_back(space)
    for step in (STEP_LENGTH, 0.5 * STEP_LENGTH):
        state = after(film, 0)
        cells_of(film, state)[VOID] = 0.2 * cells_of(film, state)[VOLUME]
        oil, owed = None, 0.0
        for k in range(1, round(0.02 / step)):
            _, state = film.evaluate(state, along(k * step), step)
            kept = cells_of(film, state)
            now = (kept[VOLUME] - kept[VOID] + kept[OWED]).sum()
            assert oil is None or abs(now - oil) < 1e-10 * now
            oil, owed = now, max(owed, np.abs(kept[OWED]).sum() / now)
        most.append(owed)
    assert max(most) < 0.02


def test_a_film_in_balance_stays_as_it_is():
    film = bearing()
    first, state = film.evaluate(film.rest(), along(0.0), 0.0)
    for _ in range(50):
        later, state = film.evaluate(state, along(0.0), STEP_LENGTH)
    np.testing.assert_allclose(later[:4], first[:4], rtol=2e-6)
    reynolds = bearing(boundary="reynolds")
    steady, _ = reynolds.evaluate(reynolds.rest(), along(0.0), 0.0)
    assert np.hypot(*first[:2]) == pytest.approx(np.hypot(*steady[:2]), rel=0.03)


def flows(film):
    """Flows over the ends and from the grooves, m3/s, share of full cells, force, content of the grooves."""
    out, state = film.evaluate(film.rest(), along(0.0), 0.0)
    space, data = film.take()
    film.bring_back(space)
    unit = 0.25 * film.parameters.clearance * film.parameters.radius * film.parameters.width
    found = data[3].flows
    np.testing.assert_allclose(out[OUTPUTS:], (found[FULL], found[FEED] * unit), rtol=1e-12)  # is told, too
    return found[ENDS] * unit, found[FEED] * unit, found[FULL], np.hypot(*out[:2]), state[GROOVE]


def test_what_the_grooves_feed_leaves_over_the_ends():
    """In balance; and a starved film lets less out, is full in less of the bore, and bears less."""
    full = flows(bearing())
    assert full[0] == pytest.approx(full[1], rel=1e-4)
    starved = flows(bearing(ambient_pressure=0.0, feed_content=0.5))
    assert starved[0] == pytest.approx(starved[1], rel=1e-4)
    flooded = flows(bearing(ambient_pressure=0.0))
    assert all(less < more for less, more in zip(starved[:4], flooded[:4], strict=True))


def test_a_given_flow_is_what_the_grooves_feed():
    """Until they are full and overflow; in steps their content follows, and stays in balance."""
    taken = flows(bearing(ambient_pressure=0.0, feed_pressure=0.0))[1]
    film = bearing(ambient_pressure=0.0, feed_flow=0.5 * taken)
    ends, fed, _, force, content = flows(film)
    assert fed == pytest.approx(0.5 * taken, rel=1e-6)
    assert ends == pytest.approx(fed, rel=1e-4)
    assert 0.0 < content < 1.0
    _, state = film.evaluate(film.rest(), along(0.0), 0.0)
    for _ in range(20):
        out, state = film.evaluate(state, along(0.0), STEP_LENGTH)
    assert np.hypot(*out[:2]) == pytest.approx(force, rel=1e-5)
    assert state[GROOVE] == pytest.approx(content, rel=1e-6)
    plenty = flows(bearing(ambient_pressure=0.0, feed_flow=2.0 * taken))
    assert plenty[4] == 1.0
    assert plenty[1] == pytest.approx(taken, rel=1e-6)


def test_the_film_remembers():
    """The same state a little later, after the film was torn or not, is not the same film."""
    film = bearing()
    still = after(film, 0)
    torn = after(film, 60)
    here = film.evaluate(still, along(0.0), STEP_LENGTH)[0]
    there = film.evaluate(torn, along(0.0), STEP_LENGTH)[0]
    assert abs(np.hypot(*there[:2]) / np.hypot(*here[:2]) - 1.0) > 1e-3
    again = film.evaluate(torn, along(0.0), STEP_LENGTH)[0]
    assert again.tobytes() == there.tobytes()


def test_a_starved_supply_needs_grooves_and_a_film_that_knows_it():
    for changes in ({"boundary": "guembel"}, {"bore": "plain"}):
        with pytest.raises(ValueError, match="feed_content < 1 and feed_flow > 0: allowed with"):
            bearing(feed_content=0.5, **changes)


def test_a_bearing_without_oil_is_refused():
    with pytest.raises(ValueError, match="boundary = 'jfo': oil must come from somewhere"):
        bearing(ambient_pressure=0.0, bore="plain")


def test_an_elrod_bearing_with_a_groove_of_part_of_its_width():
    """Stored fields of an independent program on 100 x 26 cells, quasi-static: within a few per cent.

    Its ends hold full cells, which feed the film: full share and least content, 64.3 % and 0.55, are not
    compared, since nothing comes in over the ends here.
    """
    diameter, width, clearance, viscosity, speed = 0.1, 0.08, 1.5e-4, 0.01, 100.0 * np.pi
    groove = 90.0 + np.array([-7.5, 7.5])
    arcs = f"[[{np.radians(groove[1])}, {np.radians(groove[0]) + 2.0 * np.pi}, 0, 0]]"
    parameters = BearingParameters(
        diameter, width, clearance, viscosity, columns=96, rows=24, boundary="jfo", bore=arcs
    )
    film = make_film("v1", parameters)
    space, data = film.take()
    bore, jfo, unit = data[2], data[3], float(data[0][0]["pressure"])
    q, v, result = np.array([0.5, 0.0, 0.0, 0.0]), np.zeros(4), np.zeros(RESULTS)
    jfo.time[STEP] = 0.0
    # beyond its length the groove is bore: the gap across it is the clearance in both
    jfo.net.held[np.abs(jfo.film.nodes[:24]) > 0.75] = FREE

    def solve():
        set_up(jfo, bore, q, v, speed, 0.0, 7e4 / unit, 0.0, 0.0)
        return balance(jfo.net)

    status, _ = solve()
    assert status == 0
    conclude(jfo, bore, 0.0, result)
    angle = np.degrees(np.arctan2(jfo.film.rings[0, SIN], jfo.film.rings[0, COS]))
    film.bring_back(space)
    force = result[:2] * float(data[0][0]["force"])
    pressure = jfo.net.pressure * unit
    share = jfo.volumes / (jfo.film.column[1, :24, :96])
    mean = (share * jfo.net.content).sum() / share.sum()
    peak = np.unravel_index(pressure.argmax(), pressure.shape)
    np.testing.assert_allclose(-force, (1055.4, -1383.3), rtol=0.05)  # that on the bearing
    assert pressure.max() == pytest.approx(523.4e3, rel=0.05)
    assert angle[peak[1]] % 360.0 == pytest.approx(320.4, abs=4.0)
    assert mean == pytest.approx(0.943, rel=0.05)
    assert np.hypot(*force) == pytest.approx(1739.9, rel=0.05)
