"""Benchmark h: corners of accuracy, at the default grid and two doublings.

``python -m tests.benchmarks h``: stiffness of tilted, nearly centred journals, journals that leave the wall
without rotating, and the largest pressure of misaligned journals.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.film import make_film
from bearing_fmu.kernels.axial import axial_basis
from bearing_fmu.kernels.guembel import bearing_part
from tests.bearing_fmu.bearings import force_unit, lever, plain, respond, table
from tests.benchmarks.table import percent, show

Array = NDArray[np.float64]

GRIDS = ((48, 8), (96, 16), (192, 30))
TILTED = (
    (1.0, (0.0, 0.0, 0.5, 0.0)),
    (0.8, (0.0, 0.0, 0.3, 0.4)),
    (0.8, (0.0, 0.0, 0.9, 0.0)),
    (0.6, (0.0, 0.0, 0.95, 0.0)),
    (0.8, (0.005, -0.002, 0.3, 0.4)),
    (0.8, (0.02, -0.01, 0.5, 0.1)),
    (0.8, (0.05, 0.1, 0.6, -0.2)),
    (0.5, (0.1, -0.1, 0.0, 0.5)),
    (0.6, (0.1, 0.02, 0.85, 0.0)),
    (0.8, (0.2, -0.2, 0.5, 0.2)),
)
"""b/d; position, tilts at the edge, over the clearance."""
LEAVING = tuple((aspect, e) for aspect in (0.5, 0.8, 1.0) for e in (0.5, 0.8, 0.9, 0.95, 0.98))
"""b/d and eccentricity."""
MODES = 24


def positive_part(pressure: Array) -> Array:
    """Nodal values that integrate the positive part around each row."""
    part, spare = np.empty_like(pressure), np.empty((3, pressure.shape[1]))
    for row, out in zip(np.ascontiguousarray(pressure), part, strict=True):
        bearing_part(row, row.size, out, *spare)
    return part


def graded(angle: Array, a: complex) -> tuple[Array, Array, Array]:
    """Cos, sin and metric of the Moebius map of a uniform angle."""
    w = np.exp(1j * angle)
    place = (w + a) / (1.0 + np.conj(a) * w)
    return place.real, place.imag, (1.0 - abs(a) ** 2) / np.abs(1.0 + np.conj(a) * w) ** 2


def finely_cut(aspect: float, q: Array, grid: tuple[int, int], *, lines: int = 300, finer: int = 8) -> Array:
    """Wrench of V1's pressure, its positive part cut on many lines and columns between its nodes."""
    columns, rows = grid
    film = make_film("v1", plain(aspect, columns=columns, rows=rows))
    inputs = np.zeros(17)
    inputs[:4], inputs[16] = q * lever(film.parameters), 1.0
    space, data = film.take()
    assert film.solver.kernel(inputs, film.offset, np.zeros(58), *data) == 0
    pressure = data[-2].usual.pressures[0, :rows, :columns].copy()
    film.bring_back(space)
    basis, (t, weight) = axial_basis(rows), np.polynomial.legendre.leggauss(lines)
    z, k = basis.place(t), basis.clustering
    weight = weight * k / np.cosh(k * t) ** 2 / np.tanh(k)
    spectrum = np.fft.rfft(basis.interpolation(z) @ pressure, axis=1)
    part = positive_part(np.fft.irfft(spectrum, columns * finer, axis=1) * finer)
    a = 0j
    for end in (-1.0, 1.0):
        e = complex(q[0] + end * q[3], q[1] - end * q[2])
        most = (1.0 + abs(e) ** 32) ** (-1.0 / 32.0)
        a += 0.5 * e * most / (1.0 + np.sqrt(1.0 - abs(e * most) ** 2))
    count = columns * finer
    cos, sin, metric = graded(2.0 * np.pi * np.arange(count) / count, a)
    cell = 6.0 * 2.0 * np.pi / count
    along, across = (part * metric * cos).sum(axis=1), (part * metric * sin).sum(axis=1)
    return cell * np.array([-weight @ along, -weight @ across, (weight * z) @ across, -(weight * z) @ along])


def finely_cut_stiffness(aspect: float, q: Array, grid: tuple[int, int] = (128, 20)) -> Array:
    """-dF/dq of `finely_cut` by central differences."""
    step = 2e-3
    both = ([finely_cut(aspect, q + sign * step * e, grid) for e in np.eye(4)] for sign in (1.0, -1.0))
    ahead, behind = (np.array(wrench) for wrench in both)
    return -(ahead - behind).T / (2.0 * step)


def stiffness(aspect: float, q: Array, grid: tuple[int, int]) -> Array:
    """K of V1 in the same units."""
    parameters = plain(aspect, columns=grid[0], rows=grid[1])
    units = lever(parameters)
    k = respond(make_film("v1", parameters), q).stiffness
    return k * np.outer(units / units[0], units) / force_unit(parameters)[0]


def leaving_force(aspect: float, eccentricity: float, grid: tuple[int, int], depth: str = "v1") -> float:
    """Force on a journal that leaves the wall at one clearance a second without rotating."""
    parameters = plain(aspect, columns=grid[0], rows=grid[1])
    units, film = lever(parameters), make_film(depth, parameters)
    q, v = np.array([eccentricity, 0.0, 0.0, 0.0]) * units, np.array([-1.0, 0.0, 0.0, 0.0]) * units
    return float(film.respond(q, v, 0.0).wrench[0] / force_unit(parameters)[0])


def leaving_reference(aspect: float, eccentricity: float, columns: int = 720, lines: int = 64) -> float:
    """The same by cosines along the axis and finite volumes on a mildly graded grid (Guembel's condition)."""
    cell = 2.0 * np.pi / columns
    uniform = cell * np.arange(columns)
    a = 0.7 * eccentricity / (1.0 + np.sqrt(1.0 - eccentricity**2))
    cos, _, metric = graded(uniform, a)
    cos_f, sin_f, metric_f = graded(uniform + 0.5 * cell, a)
    around = (1.0 - eccentricity * cos_f) ** 3 / (metric_f * cell)
    i = np.arange(columns)
    fixed = np.diag(around + np.roll(around, 1))
    fixed[i, (i + 1) % columns] -= around
    fixed[(i + 1) % columns, i] -= around
    drive = -2.0 * (sin_f - np.roll(sin_f, 1))
    z, weight = np.polynomial.legendre.leggauss(lines)
    pressure = np.zeros((lines, columns))
    for mode in range(MODES):
        wave = (mode + 0.5) * np.pi
        matrix = fixed + np.diag((wave / aspect) ** 2 * (1.0 - eccentricity * cos) ** 3 * metric * cell)
        column = np.linalg.solve(matrix, drive * 2.0 * (-1.0) ** mode / wave)
        pressure += np.outer(np.cos(wave * z), column)
    return float(-6.0 * cell * weight @ (positive_part(pressure) * metric * cos).sum(axis=1))


def survey(states: int = 40) -> list[tuple[float, float, Array, Array]]:
    """Aspect, least gap, position and velocity of random misaligned states."""
    random = np.random.default_rng(5)
    found = []
    for _ in range(states):
        aspect, phi = random.choice([0.5, 0.8, 1.0]), random.uniform(0.0, 2.0 * np.pi)
        least, size, way = random.choice([0.01, 0.02, 0.05, 0.1]), *random.uniform((0.02, 0.0), (0.6, 6.3))
        tilt = size * np.array([np.cos(way), np.sin(way)])
        low, high = 0.0, 1.2
        for _ in range(60):
            e = 0.5 * (low + high)
            place = e * np.array([np.cos(phi), np.sin(phi)])
            ends = (np.hypot(place[0] + s * tilt[1], place[1] - s * tilt[0]) for s in (-1.0, 1.0))
            low, high = (e, high) if 1.0 - max(ends) > least else (low, e)
        found.append((aspect, least, np.append(place, tilt), random.uniform(-0.2, 0.2, 4)))
    return found


def _peaks() -> None:
    rows = []
    for row in table("misaligned_guembel.csv"):
        q, v = (
            [float(row[k]) for k in keys] for keys in (("x", "y", "tx", "ty"), ("xd", "yd", "txd", "tyd"))
        )
        cells = []
        for columns, lines in GRIDS:
            parameters = plain(float(row["L_over_D"]), columns=columns, rows=lines)
            unit = parameters.viscosity * (parameters.radius / parameters.clearance) ** 2
            cells.append(
                percent(abs(respond(make_film("v1", parameters), q, v).p_max / unit / float(row["Pmax"]) - 1))
            )
        rows.append((f"{row['case']}, least gap {row['hmin_over_C']} C", *cells))
    errors: dict[float, list[list[float]]] = {}
    for aspect, least, q, v in survey():
        found = [
            respond(make_film("v1", plain(aspect, columns=c, rows=r)), q, v).p_max
            for c, r in (*GRIDS, (384, 30))
        ]
        errors.setdefault(least, []).append([abs(p / found[-1] - 1.0) for p in found[:-1]])
    for least, those in sorted(errors.items()):
        part = np.array(those)
        middle, worst = np.median(part, axis=0), part.max(axis=0)
        cells = [f"{percent(a)} / {percent(b)}" for a, b in zip(middle, worst, strict=True)]
        rows.append((f"{len(those)} random, least gap {least:g} C: median / worst", *cells))
    show(
        "h. Largest pressure of misaligned journals, deviation from the reference (random: from 384 x 30)",
        ("state", *(f"{c} x {r}" for c, r in GRIDS)),
        rows,
    )


def main() -> None:
    """Print the three tables."""
    heads = [f"{c} x {r}" for c, r in GRIDS]
    rows: list[tuple[object, ...]] = []
    for aspect, state in TILTED:
        q = np.array(state)
        exact = finely_cut_stiffness(aspect, q)
        errors = [np.abs(stiffness(aspect, q, grid) - exact).max() / np.abs(exact).max() for grid in GRIDS]
        rows.append((f"{aspect:g}  {state}", *(percent(error) for error in errors)))
    show(
        "h. Stiffness of tilted journals, deviation over the largest entry (positive part finely cut)",
        ("b/d  x, y, tilts", *heads),
        rows,
    )
    rows = []
    for aspect, e in LEAVING:
        exact_force = leaving_reference(aspect, e)
        forces = [leaving_force(aspect, e, grid) for grid in GRIDS]
        forces.append(leaving_force(aspect, e, GRIDS[0], "v2"))
        rows.append((f"{aspect:g}  {e:g}", *(percent(abs(force / exact_force - 1.0)) for force in forces)))
    show(
        "h. Force on a journal that leaves the wall without rotating, deviation from a converged solution",
        ("b/d  eccentricity", *heads, "V2 48 x 8"),
        rows,
    )
    _peaks()


if __name__ == "__main__":
    main()
