"""Largest pressure of a tilted journal at rest by plain finite volumes, independent of the film's kernels.

Second order in both directions, on an angle graded to the narrow gap and an axis clustered at its ends.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import spsolve

_CLUSTERING = 2.2


def independent_peak(aspect: float, q: np.ndarray, columns: int, rows: int) -> float:
    """Largest nodal pressure over eta omega R^2 / C^2 at position and tilts `q` over the clearance."""
    x, y, tilt_x, tilt_y = q
    ends = np.array([complex(x + s * tilt_y, y - s * tilt_x) for s in (-1.0, 1.0)])
    a = (0.5 * ends / (1.0 + np.sqrt(1.0 - np.abs(ends) ** 2))).sum()
    w = np.exp(1j * np.pi / columns * np.arange(2 * columns))
    place, metric = (w + a) / (1.0 + np.conj(a) * w), (1.0 - abs(a) ** 2) / np.abs(1.0 + np.conj(a) * w) ** 2
    z = np.tanh(_CLUSTERING * np.linspace(-1.0, 1.0, rows + 1)) / np.tanh(_CLUSTERING)
    middle, cell = 0.5 * (z[1:] + z[:-1]), 2.0 * np.pi / columns

    def gap(at: np.ndarray, angle: np.ndarray) -> np.ndarray:
        ex, ey = x + tilt_y * at, y - tilt_x * at
        return 1.0 - np.outer(ex, angle.real) - np.outer(ey, angle.imag)

    between = gap(middle, place[1::2])
    around = between**3 / (metric[1::2] * cell) * np.diff(z)[:, None]
    along = gap(z, place[::2]) ** 3 * metric[::2] * cell / aspect**2
    along /= np.concatenate(([middle[0] - z[0]], np.diff(middle), [z[-1] - middle[-1]]))[:, None]
    node = np.arange(rows * columns).reshape(rows, columns)
    entries = []
    for i, j, flow in (
        (node, np.roll(node, -1, 1), around),
        (np.roll(node, -1, 1), node, around),
        (node[:-1], node[1:], along[1:-1]),
        (node[1:], node[:-1], along[1:-1]),
    ):
        entries += [(i, j, -flow), (i, i, flow)]
    entries += [(node[0], node[0], along[0]), (node[-1], node[-1], along[-1])]
    i, j, value = (np.concatenate([entry[k].ravel() for entry in entries]) for k in range(3))
    drive = -6.0 * (between - np.roll(between, 1, 1)) * np.diff(z)[:, None]
    return float(spsolve(csc_matrix((value, (i, j))), drive.ravel()).max())
