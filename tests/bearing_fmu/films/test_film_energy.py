"""Energy of a film: what drive and lateral motion put in is what shear and pressure flow lose.

For a film in a fixed bore, with p the pressure over the ends, U = speed R and F, v wrench and rate of the
journal, Reynolds' equation times p and integrated over the film gives

    T speed - F.v = integral of (eta U^2 / h + h^3 / (12 eta) |grad p|^2) dA,

T the torque of shear on the journal.  Where the film is ruptured (p = 0, Gümbel) the flow of pressure is
none, so that the balance holds there, too.  `friction_power` is T speed: the power that the drive supplies.
The right-hand side is computed here from the pressures of a solution of its own.
"""

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from bearing_fmu.film import make_film
from bearing_fmu.parameters import BearingParameters

BEARING = BearingParameters(diameter=0.22, width=0.11, clearance=2.2e-4, viscosity=0.012, rows=10)
SPEED = 314.0


def gap(phi, z, q, clearance):
    x, y, tx, ty = q
    return clearance - (x + ty * z) * np.cos(phi) - (y - tx * z) * np.sin(phi)


def reynolds_losses(bearing, q, v, speed, columns=288, rows=48):
    """Power lost in shear and in pressure flow, W: finite volumes on a uniform grid."""
    radius, eta = bearing.radius, bearing.viscosity
    width, height = 2.0 * np.pi / columns, bearing.width / rows
    phi = width * np.arange(columns)[:, None]
    edges = np.linspace(-0.5, 0.5, rows + 1)[None, :] * bearing.width
    z = 0.5 * (edges[:, 1:] + edges[:, :-1])
    around = gap(phi + 0.5 * width, z, q, bearing.clearance) ** 3 * height / (radius * width) / (12.0 * eta)
    along = gap(phi, edges, q, bearing.clearance) ** 3 * radius * width / height / (12.0 * eta)
    along[:, [0, -1]] *= 2.0  # the end of the bearing is half a cell away
    index = np.arange(columns * rows).reshape(columns, rows)
    after, inner = np.roll(index, -1, axis=0), along[:, 1:-1]
    pairs = [(index, after, around), (index[:, :-1], index[:, 1:], inner)]
    diagonal = around + np.roll(around, 1, axis=0) + along[:, :-1] + along[:, 1:]
    row = np.concatenate([index.ravel(), *(a.ravel() for i, j, _ in pairs for a in (i, j))])
    column = np.concatenate([index.ravel(), *(a.ravel() for i, j, _ in pairs for a in (j, i))])
    value = np.concatenate([diagonal.ravel(), *(-g.ravel() for _, _, g in pairs for _ in range(2))])
    ahead, behind = (gap(phi + s * width, z, q, bearing.clearance) for s in (0.5, -0.5))
    wedge = 0.5 * speed * radius * (ahead - behind) * height
    squeeze = gap(phi, z, v, 0.0) * radius * width * height
    solution = splu(sp.csc_matrix((value, (row, column)))).solve(-(wedge + squeeze).ravel())
    p = np.maximum(solution, 0.0).reshape(columns, rows)
    flow = np.sum(around * (np.roll(p, -1, axis=0) - p) ** 2) + np.sum(inner * np.diff(p, axis=1) ** 2)
    flow += np.sum(along[:, 0] * p[:, 0] ** 2) + np.sum(along[:, -1] * p[:, -1] ** 2)
    shear = eta * (speed * radius) ** 2 / gap(phi, z, q, bearing.clearance) * radius * width * height
    return float(np.sum(shear)), float(flow)


def short_losses(bearing, q, v, speed, columns=2880):
    """The same of the short bearing, whose pressure flows along the axis only; parabolic pressure."""
    radius, eta = bearing.radius, bearing.viscosity
    phi = 2.0 * np.pi / columns * np.arange(columns)
    aligned, rate = (np.array([s[0], s[1], 0.0, 0.0]) for s in (q, v))
    h = gap(phi, 0.0, aligned, bearing.clearance)
    slope = aligned[0] * np.sin(phi) - aligned[1] * np.cos(phi)  # dh/dphi
    source = np.minimum(0.5 * speed * slope + gap(phi, 0.0, rate, 0.0), 0.0)
    # dp/dz = 12 eta source z / h^3, so that h^3/(12 eta) (dp/dz)^2 integrates to eta source^2 b^3 / h^3
    flow = np.mean(eta * source**2 * bearing.width**3 / h**3) * 2.0 * np.pi * radius
    shear = np.mean(eta * (speed * radius) ** 2 / h) * 2.0 * np.pi * radius * bearing.width
    return float(shear), float(flow)


# Position over the clearance, tilts over those that take all of it, and their rates over the speed.
STATES = [
    ((0.45, -0.70, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)),
    ((0.45, -0.70, 0.08, -0.05), (0.3, -0.4, 0.0, 0.0)),
    ((0.20, -0.50, 0.20, 0.15), (-0.5, 0.2, 0.3, -0.4)),
    ((-0.30, 0.40, -0.1, 0.25), (0.6, 0.5, -0.2, 0.3)),
]


def state(relative, rates):
    lever = np.array([1.0, 1.0, 2.0 / BEARING.width, 2.0 / BEARING.width]) * BEARING.clearance
    return np.array(relative) * lever, np.array(rates) * lever * SPEED


def put_in(depth, q, v, speed):
    """Power of the drive and of the lateral motion into the film, W."""
    response = make_film(depth, BEARING).respond(q, v, speed)
    return response.friction_power, -float(response.wrench @ v)


@pytest.mark.parametrize(("relative", "rates"), STATES)
@pytest.mark.parametrize("depth", ["v1", "v2"])
def test_power_into_a_film_is_lost_in_shear_and_pressure_flow(depth, relative, rates):
    q, v = state(relative, rates)
    if depth == "v2":
        q[2:], v[2:] = 0.0, 0.0
    drive, lateral = put_in(depth, q, v, SPEED)
    shear, flow = reynolds_losses(BEARING, q, v, SPEED)
    # The parts, not only the sum: beside the shear, all that the film takes is lost in pressure flow.
    assert drive + lateral - shear == pytest.approx(flow, rel=5e-3)
    assert flow > 0.05 * shear
    if any(rates):
        assert abs(lateral) > 0.5 * flow


@pytest.mark.parametrize(("relative", "rates"), STATES)
def test_power_into_a_short_bearing_is_lost_in_shear_and_pressure_flow(relative, rates):
    q, v = state(relative, rates)
    drive, lateral = put_in("v3", q, v, SPEED)
    shear, flow = short_losses(BEARING, q, v, SPEED)
    assert drive + lateral == pytest.approx(shear + flow, rel=1e-6)


def test_a_journal_driven_backwards_takes_the_same_power():
    q, v = state(*STATES[0])
    mirrored = q * np.array([-1.0, 1.0, 1.0, -1.0])
    for depth in ("v1", "v2", "v3"):
        forward, backward = put_in(depth, q, v, SPEED)[0], put_in(depth, mirrored, v, -SPEED)[0]
        assert backward == pytest.approx(forward, rel=1e-9)
        assert forward > 0.0
