"""The balance of a tilted film with its memory: cells, flows and their solution.

With the scaling of `films.tilted.reynolds` and the open gap T the content theta of the gap obeys ::

    2 d(theta T)/dt + d/dphi(speed theta T - T^3 dp/dphi) - (2R/b)^2 d/dz(T^3 dp/dz) = 0
    p >= 0,  theta <= 1,  p (1 - theta) = 0

p over the cavity's pressure; at the ends the ambient one, in grooves the feed pressure, or, where the supply
is starved, their content.  Finite volumes on the grid of the columns, in time implicit Euler with the rate of
the gap from the port's velocity ::

    d(theta T)/dt  ->  T (theta - theta_then) / dt + T' dH/dt theta*

theta* is the content now where the gap opens and that of then where it closes, so that the content stays
positive.  In a film that is full and stays so this is T' dH/dt alone, whatever the step.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.bore.bore import Bore, fill_gap, land, least_gap
from bearing_fmu.bore.gap import ROUGH_LIMIT, flow_gaps
from bearing_fmu.films.jfo.content import begin_full, bring_over, face_angles, remember
from bearing_fmu.films.jfo.network import FREE, PRESSURE
from bearing_fmu.films.jfo.workspace import (
    ENDS,
    FEED,
    FULL,
    GROOVE,
    OWED,
    PAID,
    RATE,
    STEP,
    VOID,
    VOLUME,
    JfoFilm,
)
from bearing_fmu.films.tilted.grooves import pressure_drag
from bearing_fmu.films.tilted.lines import wrench_of
from bearing_fmu.films.tilted.reynolds import shape_gap
from bearing_fmu.films.turbulence import ALONG, AROUND, LAMINAR_POWER, drag, slow_down
from bearing_fmu.kernels.compiled import kernel, stage
from bearing_fmu.kernels.grid import COS, METRIC, SIN
from bearing_fmu.kernels.summit import summit_of_ring
from bearing_fmu.result import (
    ABSOLUTE,
    CONDUCTANCE,
    DRAG,
    GAP,
    OPEN,
    OPEN_1,
    OPEN_2,
    PEAK,
    POWER,
    SHEAR,
)

Floats = NDArray[np.float64]

_LONG = 1e6  # revolutions, or seconds at standstill, in which a film comes to its balance
_BRIM = 1e-9


@stage
def _shape(jfo: JfoFilm, bore: Bore, q: Floats, sigma: float, reynolds: float) -> None:
    """Grid, gap and conductances at columns, faces and axial faces, and the volumes."""
    film, across = jfo.film, jfo.across
    n, m = jfo.volumes.shape
    cell = 2.0 * np.pi / m
    shape_gap(film, bore, q, sigma, 1.0)
    rough = least_gap(bore, q)[0] < ROUGH_LIMIT * sigma
    metric = film.rings[0, METRIC]
    across[POWER] = LAMINAR_POWER
    for j in range(n + 1):
        ex, ey = q[0] + q[3] * jfo.heights[j], q[1] - q[2] * jfo.heights[j]
        gap, t = across[GAP, j], across[OPEN, j]
        fill_gap(bore, 0, ex, ey, film.rings[0], gap)
        flow_gaps(gap[:m], sigma, rough, t, across[OPEN_1, j], across[OPEN_2, j])
        for i in range(m):
            across[CONDUCTANCE, j, i] = cell * metric[i] / jfo.spans[j] * t[i] ** 3
    if reynolds > 0.0:
        for j in range(n + 1):
            slow_down(reynolds, m, ALONG, across[:, j])
        for j in range(n):
            slow_down(reynolds, m, AROUND, film.face[:, j])
    for j in range(n):
        for i in range(m):
            jfo.volumes[j, i] = film.weights[j] * cell * metric[i] * film.column[OPEN, j, i]


@stage
def _set_flows(jfo: JfoFilm, v: Floats, speed: float, ambient: float, feed: float) -> None:
    """Write the network."""
    film, net = jfo.film, jfo.net
    n, m = jfo.volumes.shape
    cell = 2.0 * np.pi / m
    cos, sin, metric = film.rings[0, COS], film.rings[0, SIN], film.rings[0, METRIC]
    net.ends[0] = ambient
    rate, paying = jfo.time[RATE], jfo.time[RATE] * jfo.time[PAID]
    for j in range(n):
        weight = film.weights[j]
        t, along = film.face[OPEN, j], film.face[CONDUCTANCE, j]
        t1, held = film.column[OPEN_1, j], net.held[j]
        volume, void, owed = jfo.before[VOLUME, j], jfo.before[VOID, j], jfo.before[OWED, j]
        ux, uy = v[0] + v[3] * film.nodes[j], v[1] - v[2] * film.nodes[j]
        for i in range(m):
            net.around[j, i] = along[i]
            net.carried[j, i] = weight * speed * t[i]
            had = 1.0 - void[i] / volume[i]
            opens = -weight * cell * metric[i] * t1[i] * (ux * cos[i] + uy * sin[i])
            jfo.rates[j, i] = opens
            net.stored[j, i] = rate * jfo.volumes[j, i] + 2.0 * max(opens, 0.0)
            net.gained[j, i] = (rate * jfo.volumes[j, i] + 2.0 * max(-opens, 0.0)) * had
            net.gained[j, i] += paying * owed[i]
            net.full[j, i] = 1.0 if had > 1.0 - _BRIM else 0.0
            if held[i] != FREE:
                net.given[j, i] = feed if held[i] == PRESSURE else jfo.supply[0]
    for j in range(n + 1):
        for i in range(m):
            net.axial[j, i] = jfo.across[CONDUCTANCE, j, i]


@stage
def _integrate(jfo: JfoFilm, bore: Bore, reynolds: float, result: Floats) -> None:
    """Wrench, largest pressure, shear and drag."""
    film, net = jfo.film, jfo.net
    n, m = jfo.volumes.shape
    cell = 2.0 * np.pi / m
    peak = 0.0
    for j in range(n):
        pressure = net.pressure[j]
        for i in range(m):
            film.nodal[0, j, i] = pressure[i]
            film.column[ABSOLUTE, j, i] = pressure[i]
        peak = max(peak, summit_of_ring(pressure, m))
    wrench_of(film, film.nodal[0], result)
    shear, metric = 0.0, land(bore, film.rings[0])
    for j in range(n + 2):
        row = j if j < n else (0 if j == n else n - 1)
        t, content = film.column[OPEN, j], net.content[row]
        total = 0.0
        for i in range(m):
            slow = drag(reynolds * t[i]) if reynolds > 0.0 else 1.0
            total += metric[i] / t[i] * slow * min(content[i], 1.0)
        shear += film.weights[j] * cell * total
    result[PEAK] = peak
    result[SHEAR] = shear
    result[DRAG] = pressure_drag(film, bore)


@stage
def _count_flows(jfo: JfoFilm) -> None:
    """Flows over the ends and from the grooves, which are closed at their ends; share of full cells.

    Where the flow into the grooves is given, their content after the step is what it and the oil that returns
    fill of the flow that the wall carries away; beyond that they overflow.
    """
    film, net = jfo.film, jfo.net
    n, m = jfo.volumes.shape
    ends, fed, carried, full, area = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(n):
        pressure, content, held = net.pressure[j], net.content[j], net.held[j]
        for i in range(m):
            fore = i + 1 if i + 1 < m else 0
            part = film.weights[j] * film.rings[0, METRIC, i]
            area += part
            full += part * net.full[j, i]
            here, there = held[i] != FREE, held[fore] != FREE
            if here != there:
                wall = net.carried[j, i]
                flow = -net.around[j, i] * (pressure[fore] - pressure[i])
                flow += wall * (content[i] if wall > 0.0 else content[fore])
                fed += flow if here else -flow
                if here == (wall > 0.0):
                    carried += abs(wall)
            if not here and j == 0:
                ends += net.axial[0, i] * (pressure[i] - net.ends[0])
            if not here and j == n - 1:
                ends += net.axial[n, i] * (pressure[i] - net.ends[0])
    jfo.flows[ENDS], jfo.flows[FEED], jfo.flows[FULL] = ends, fed, full / area
    filled = jfo.supply[0]
    if jfo.supply[1] > 0.0 and carried > 0.0:
        back = jfo.supply[0] * carried - fed
        filled = min(max((jfo.supply[1] + back) / carried, 0.0), 1.0)
    jfo.now[GROOVE] = filled


@kernel
def set_up(
    jfo: JfoFilm, bore: Bore, q: Floats, v: Floats, speed: float, ambient: float, feed: float, sigma: float,
    reynolds: float,
) -> None:  # fmt: skip
    """Write the network for the state at the end of a step.

    Parameters
    ----------
    jfo : JfoFilm
        With the step and what is remembered from before.
    bore, q, v, speed, ambient, feed, sigma, reynolds
        As in `films.tilted.reynolds.solve_pressure`.
    """
    _shape(jfo, bore, q, sigma, reynolds)
    face_angles(jfo)
    dt = jfo.time[STEP]
    if dt > 0.0:
        jfo.time[PAID] = dt / (dt + 2.0 * np.pi / abs(speed)) if speed != 0.0 else 0.0
        jfo.time[RATE] = 2.0 / dt
        bring_over(jfo)
    else:
        jfo.time[PAID] = 0.0
        jfo.time[RATE] = 2.0 * max(abs(speed), 1.0) / _LONG
        begin_full(jfo)
    _set_flows(jfo, v, speed, ambient, feed)


@kernel
def conclude(jfo: JfoFilm, bore: Bore, reynolds: float, result: Floats) -> None:
    """Integrate what `network.balance` found, and note what is remembered."""
    n, m = jfo.volumes.shape
    for j in range(n):
        for i in range(m):
            had = 1.0 - jfo.before[VOID, j, i] / jfo.before[VOLUME, j, i]
            jfo.share[j, i] = jfo.net.content[j, i] if jfo.rates[j, i] > 0.0 else had
    _integrate(jfo, bore, reynolds, result)
    _count_flows(jfo)
    remember(jfo)
