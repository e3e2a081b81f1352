"""The film on a soft layer by other means: finite volumes, sparse factors, a wall that slowly gives way.

Nothing of the package but the parameters: another grid in both directions, Greenwood and Tripp's integral by
quadrature, the asperities' balance with the layer by bisection. Slow.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.sparse as sp
from scipy.interpolate import CubicSpline
from scipy.sparse.linalg import splu

from bearing_fmu.parameters import BearingParameters

REACH, DEEPEST = 7.0, -60.0


class Solution(NamedTuple):
    """Film force (2,) and load of the asperities, N; largest pressure, Pa; pressure of the cells, scaled."""

    film_force: np.ndarray
    contact_force: float
    p_max: float
    pressure: np.ndarray


class Wall(NamedTuple):
    """Pressure of the cells before a step, on the same grid, and its length, s."""

    pressure: np.ndarray
    step: float


class Asperities:
    """Gap over s, the gap without them, both in roughnesses, and their pressure, Pa."""

    def __init__(self, p: BearingParameters) -> None:
        h = np.linspace(DEEPEST, REACH, 6001)
        height = np.linspace(DEEPEST, 9.0, 12001)
        density = np.exp(-0.5 * height**2) / np.sqrt(2.0 * np.pi) * (height[1] - height[0])
        rigid = p.contact_modulus * np.array([(np.maximum(height - x, 0.0) ** 2.5) @ density for x in h])
        self.h, self.hardness = h, p.layer_hardness
        self.pressure = rigid / (1.0 + (rigid / self.hardness) ** 4) ** 0.25
        self.s = h - p.layer_compliance / p.roughness * self.pressure
        self._gap, self._load = CubicSpline(self.s, h), CubicSpline(self.s, self.pressure)

    def gap(self, s: np.ndarray) -> np.ndarray:
        """Gap in roughnesses."""
        return np.where(s < self.s[-1], self._gap(np.minimum(s, self.s[-1])), s)

    def load(self, s: np.ndarray) -> np.ndarray:
        """Pressure, Pa."""
        return np.where(s < self.s[-1], self._load(np.minimum(s, self.s[-1])), 0.0)


def _flow(u: np.ndarray) -> np.ndarray:
    """Patir and Cheng's flow over the cube of the roughness; exponential below their range."""
    at, factor = 0.5, 0.9 * np.exp(-0.28)
    rate = 3.0 / at + 0.56 * factor / (1.0 - factor)
    inside = np.maximum(u, at)
    flow = (1.0 - 0.9 * np.exp(-0.56 * inside)) * inside**3
    return np.where(u < at, (1.0 - factor) * at**3 * np.exp(rate * (np.minimum(u, at) - at)), flow)


def _open(u: np.ndarray) -> np.ndarray:
    """Average gap of heights after Christensen with valleys of 0.1, by quadrature; in roughnesses."""
    x, w = np.polynomial.legendre.leggauss(40)
    height = 35.0 / 96.0 * (1.0 - x**2) ** 3 * 3.0 * w
    mean = 0.1 + (np.maximum(u[..., None] - 0.1 + 3.0 * x, 0.0) * height).sum(axis=-1)
    return np.where(u > 3.2, u, mean)


def solve(
    p: BearingParameters,
    q: np.ndarray,
    v: np.ndarray,
    speed: float,
    cells: tuple[int, int],
    wall: Wall | None = None,
) -> Solution:
    """Solve on cells around and along; q, v in m, rad, m/s, rad/s; positive speed; no wall: at rest."""
    m, n = cells
    half, c, sigma = 0.5 * p.width, p.clearance, p.roughness / p.clearance
    unit = 6.0 * p.viscosity * (p.radius / c) ** 2
    soft = p.layer_compliance * unit / c
    lever = np.array([1.0, 1.0, half, half]) / c
    (x, y, tx, ty), (xd, yd, txd, tyd) = q * lever, v * lever
    # faces: in phi dense where the journal is near an end, in z dense at the ends
    z_end = 1.0 if np.hypot(x + ty, y - tx) > np.hypot(x - ty, y + tx) else -1.0
    near = np.arctan2(y - tx * z_end, x + ty * z_end)
    t = np.linspace(-np.pi, np.pi, m + 1)
    phi_f = near + 2.0 * np.arctan(0.15 * np.tan(0.5 * t[:-1]))
    phi_f = np.append(phi_f, phi_f[0] + 2.0 * np.pi)
    z_f = np.tanh(2.2 * np.linspace(-1.0, 1.0, n + 1)) / np.tanh(2.2)
    phi, z = 0.5 * (phi_f[:-1] + phi_f[1:]), 0.5 * (z_f[:-1] + z_f[1:])
    d_phi, d_z = np.diff(phi_f), np.diff(z_f)
    ahead = np.append(phi[1:], phi[0] + 2.0 * np.pi) - phi
    z_all = np.concatenate(([-1.0], z, [1.0]))
    asperities = Asperities(p)

    def rigid(angle: np.ndarray, place: np.ndarray) -> np.ndarray:
        """Gap (m, n)."""
        ex, ey = x + ty * place, y - tx * place
        return 1.0 - ex * np.cos(angle)[:, None] - ey * np.sin(angle)[:, None]

    gap, gap_f = rigid(phi, z), rigid(phi_f[1:], z)
    gap_z = rigid(phi, z_f)
    squeeze = -(xd + tyd * z) * np.cos(phi)[:, None] - (yd - txd * z) * np.sin(phi)[:, None]
    area = d_phi[:, None] * d_z
    aspect = (p.diameter / p.width) ** 2

    def residual(pressure: np.ndarray) -> np.ndarray:
        """What flows out of each cell, less what is pressed out of it."""
        back = soft * np.maximum(pressure, 0.0)
        after = np.roll(back, -1, axis=0)
        flow = _flow(asperities.gap((gap_f + 0.5 * (back + after)) / sigma)) * sigma**3
        wedge = sigma * _open(asperities.gap((gap_f + 0.75 * back + 0.25 * after) / sigma))
        around = d_z * (speed * wedge - flow * (np.roll(pressure, -1, axis=0) - pressure) / ahead[:, None])
        edge = np.zeros((m, 1))
        along = np.concatenate((edge, pressure, edge), axis=1)
        press = np.concatenate((edge, back, edge), axis=1)
        flow_z = _flow(asperities.gap((gap_z + 0.5 * (press[:, 1:] + press[:, :-1])) / sigma)) * sigma**3
        axial = -aspect * d_phi[:, None] * flow_z * np.diff(along, axis=1) / np.diff(z_all)
        u, step = asperities.gap((gap + back) / sigma), 1e-5
        opening = (_open(asperities.gap((gap + back) / sigma + step)) - _open(u)) / step
        rate = squeeze
        if wall:
            rate = squeeze + (back - soft * np.maximum(wall.pressure, 0.0)) / wall.step
        return around - np.roll(around, 1, axis=0) + np.diff(axial, axis=1) + 2.0 * area * opening * rate

    pressure = wall.pressure if wall else np.maximum(-gap, 0.0) / soft
    pattern = _neighbours(m, n)
    rate = 2.0 * speed * soft
    for _ in range(120):
        now = residual(pressure)
        jacobian = _jacobian(residual, pressure, now, pattern, m, n)
        step = splu((jacobian + sp.diags(rate * area.ravel())).tocsc()).solve(-now.ravel()).reshape(m, n)
        before, moved = (
            np.abs(now).max(),
            np.minimum(pressure + step, np.maximum(pressure, 0.0) + 3.0 * sigma / soft),
        )
        done = np.abs(np.maximum(moved, 0.0) - np.maximum(pressure, 0.0)).max() < 1e-4 * moved.max()
        pressure = moved
        if done and rate < 1e-2 * speed * soft:
            break
        rate *= min(max(np.abs(residual(pressure)).max() / before, 0.1), 2.0)
    else:
        raise ArithmeticError("no solution")
    film = np.maximum(pressure, 0.0)
    scale = p.radius * half
    force = -unit * scale * np.array([(film * area * f(phi)[:, None]).sum() for f in (np.cos, np.sin)])
    load = scale * (asperities.load((gap + soft * film) / sigma) * area).sum()
    return Solution(force, float(load), float(unit * film.max()), pressure)


def _neighbours(m: int, n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Colours of cells (m, n), so that no two of a colour meet in a residual; m a multiple of three."""
    i, j = np.meshgrid(np.arange(m), np.arange(n), indexing="ij")
    return i, j, (i % 3) + 3 * (j % 3)


def _jacobian(residual, pressure, now, pattern, m, n) -> sp.csr_matrix:
    """By differences, nine evaluations."""
    i, j, colour = pattern
    rows, columns, values = [], [], []
    step = 1e-6 * max(np.abs(pressure).max(), 1e-3)
    for k in range(9):
        moved = (residual(pressure + step * (colour == k)) - now) / step
        for di, dj in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)):
            at_i, at_j = (i + di) % m, j + dj
            inside = (at_j >= 0) & (at_j < n)
            own = np.where(inside, (at_i % 3) + 3 * (at_j % 3), -1) == k
            rows.append((i * n + j)[own])
            columns.append((at_i * n + at_j)[own])
            values.append(moved[own])
    entries = np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))
    return sp.csr_matrix(entries, shape=(m * n, m * n))
