"""The balance of full and ruptured cells against problems in one dimension with known answers."""

from __future__ import annotations

import numpy as np
import pytest

from bearing_fmu.films.jfo.network import PRESSURE, balance, network
from bearing_fmu.status import FilmStatus

EDGE, KAPPA = 0.025, 2.0
CLOSES = 0.732390
# Front of the full film between oscillating plates, problem of Ausas, Jai and Buscaglia (2009), J. Tribol.
# 131, 031702; fronts and closing time from the differential equations of its two fronts.
FRONT = (
    (0.26627, 0.28245, 0.29864, 0.36702, 0.41922, 0.47141, 0.52361, 0.57580, 0.62800, 0.68019),
    (0.03555, 0.02660, 0.02371, 0.02447, 0.02856, 0.03481, 0.04315, 0.05494, 0.07560, 0.12776),
)


def plates(cells: int) -> tuple[np.ndarray, np.ndarray, float]:
    """Instants, void and worst defect of the mass (over the mass) of the film between the plates."""
    net, dx, dt = network(cells + 2, 1), 1.0 / cells, 0.25 / cells
    net.full[:] = net.content[:] = 1.0
    net.held[0, [0, -1]], net.given[0, [0, -1]] = PRESSURE, EDGE
    times, worst, before = dt * np.arange(1, int(0.75 / dt)), 0.0, 0.5
    void = np.zeros((times.size, cells))
    for k, t in enumerate(times):
        gap = 0.375 + 0.125 * np.cos(4.0 * np.pi * t)
        flow = gap**3 / dx
        net.around[0, :-1] = flow
        net.around[0, [0, -2]] = 2.0 * flow  # half a cell to the edge
        net.stored[:] = KAPPA * dx * gap / dt
        net.gained[:] = KAPPA * dx * before * net.content / dt
        had = net.gained[0, 1:-1].sum()
        status, _ = balance(net)
        assert status == FilmStatus.OK
        p, content = net.pressure[0], net.content[0]
        inflow = 2.0 * flow * (p[0] - p[1] + p[-1] - p[-2])
        worst = max(worst, abs(net.stored[0, 1:-1] @ content[1:-1] - had - inflow) / had)
        assert p.min() >= -1e-12
        assert content.max() <= 1.0 + 1e-9
        assert np.max(np.abs(p * (1.0 - content))) < 1e-12
        void[k], before = 1.0 - content[1:-1], gap
    return times, void, worst


def test_a_cavity_between_oscillating_plates_closes_when_its_oil_is_back():
    """First order in the mesh; Guembel's condition closes it at 0.5."""
    errors = []
    for cells in (50, 100, 200):
        times, void, worst = plates(cells)
        assert worst < 1e-13
        full = 0.5 * np.mean(void < 1e-9, axis=1)
        np.testing.assert_allclose(np.interp(FRONT[0], times, full), FRONT[1], atol=1.0 / cells)
        # the last cells fill evenly: when they are full follows from how their void shrinks
        left = void.sum(axis=1)
        last = np.flatnonzero(left > 0.0)[-1]
        rate = left[last - 1] - left[last]
        errors.append(abs(times[last] + left[last] / rate * (times[1] - times[0]) - CLOSES))
    assert errors[-1] < 1.2e-3
    assert errors[2] < 0.6 * errors[1] < 0.36 * errors[0] + 1e-3


def test_a_sealed_ring_keeps_its_oil():
    """Carried around and squeezed, ruptured and filled again, without a feed: to 1e-12 of it a step."""
    m, n, dt = 40, 3, 0.02
    net = network(m, n)
    angle = 2.0 * np.pi / m * np.arange(m)
    shape = 1.0 + 0.3 * np.arange(n)[:, None] * np.cos(angle)[None, :] / n
    gap = 1.0 - 0.6 * np.cos(angle)[None, :] * shape
    content = np.full((n, m), 0.8)
    mass, shares = (content * gap).sum(), set()
    for k in range(200):
        now = (1.0 - 0.6 * np.cos(angle - 0.01 * k)[None, :] * shape) * (1.0 + 0.1 * np.sin(0.1 * k))
        net.around[:] = 30.0 * now**3
        net.carried[:] = 5.0 * (1.0 if k % 80 < 60 else -1.0)
        net.axial[1:-1] = 10.0
        net.stored[:], net.gained[:] = now / dt, gap * content / dt
        status, _ = balance(net)
        assert status == FilmStatus.OK
        content, gap = net.content.copy(), now
        assert abs((content * gap).sum() - mass) < 1e-12 * mass
        shares.add(float(net.full.mean()))
    assert len(shares) > 10  # fronts moved


@pytest.mark.parametrize(("cells", "tolerance"), [(10, 4e-5), (20, 2e-5)])
def test_a_pocketed_slider_draws_in_what_the_closed_form_says(cells, tolerance):
    """Inlet suction: Fowell, Olver, Gosman, Spikes and Pegg (2007), J. Tribol. 129, 336."""
    length, high, low, pocket, ambient, viscosity, speed = 0.01, 1.05e-6, 1e-6, 1e-6, 1e5, 0.01, 1.0
    m = 10 * cells
    faces = np.linspace(0.0, length, m + 1)
    middle = 0.5 * (faces[1:] + faces[:-1])

    def gap(x):
        return high - (high - low) * x / length + pocket * ((x > 0.002) & (x < 0.005))

    halves = 6.0 * viscosity * (length / m) / gap(middle) ** 3
    net = network(m + 2, 1)
    net.around[0, :-1] = 1.0 / (np.append(halves, 0.0) + np.append(0.0, halves))
    net.carried[0, :-1] = 0.5 * speed * gap(faces - 1e-12)
    net.full[:] = 1.0
    net.held[0, [0, -1]], net.given[0, [0, -1]] = PRESSURE, ambient
    status, _ = balance(net)
    assert status == FilmStatus.OK
    drawn = net.carried[0, 0] - net.around[0, 0] * (net.pressure[0, 1] - ambient)
    assert drawn == pytest.approx(5.229635023923445e-07, rel=tolerance)
    assert net.pressure.max() == pytest.approx(9808818.753932089, rel=0.08 / cells)
    ruptured = middle[net.full[0, 1:-1] == 0.0]
    assert ruptured.size
    assert ruptured.min() > 0.0019
    assert ruptured.max() < 0.005
