"""Mode shapes of the supported train: envelope of the orbits along the shaft."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from orchestrator.results.figures import style
from rotor_fmu.linear.analysis import NOISE, half_axes

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from rotor_fmu.train.train import Train

    Array = NDArray[np.float64]

OUTLINE = 0.45
"""Largest radius of shaft or wheel as drawn; the largest deflection is 1."""


def mode_shapes_figure(data: xr.Dataset, train: Train) -> Figure:
    """One panel a mode: the band is the orbits' largest half axis, its colour their direction.

    Parameters
    ----------
    data : xarray.Dataset
        From `orchestrator.commands.modes.mode_data`.
    train : Train
        For the outline of shaft and wheels and the bearings.
    """
    count = data.sizes["mode"]
    columns = 1 if count == 1 else 2
    rows = math.ceil(count / columns)
    figure = style.new_figure(
        13.0,
        1.9 + 1.45 * rows,
        f"Modes of the supported train at {float(data.attrs['rotation']):g} Hz of rotation",
        f"{train.name}  ·  {data.attrs['films']}  ·  largest half axis 1",
    )
    grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel(order="F")
    for axes, mode in zip(grid, data["mode"].values, strict=False):
        _panel(axes, data.sel(mode=mode), train)
    for axes in grid[count:]:
        axes.set_axis_off()
    for column in range(columns):
        grid[min(count, rows * (column + 1)) - 1].set_xlabel("z [m]")
        grid[min(count, rows * (column + 1)) - 1].tick_params(labelbottom=True)
    figure.supylabel("deflection [1]", fontsize=style.FONT)
    handles = [
        Patch(facecolor=style.WHIRL_COLOURS["forward"], alpha=0.45, label="orbits, forward whirl"),
        Patch(facecolor=style.WHIRL_COLOURS["backward"], alpha=0.45, label="orbits, backward whirl"),
        Patch(facecolor=style.WHIRL_MAP(0.5), alpha=0.45, label="orbits in a plane"),
        Line2D([], [], color="#000000", linewidth=1.4, label="vertical y"),
        Line2D([], [], color="#000000", linewidth=1.2, linestyle=(0, (3, 2)), label="horizontal x"),
        Line2D([], [], color="#333333", marker="^", linestyle="none", label="bearing"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=6, frameon=False, fontsize=style.FONT)
    return figure


def _panel(axes: Axes, mode: xr.Dataset, train: Train) -> None:
    z = mode["z"].values
    x, y = (mode[f"{axis}_real"].values + 1j * mode[f"{axis}_imaginary"].values for axis in ("x", "y"))
    major, _, direction = half_axes(x, y)
    _outline(axes, train)
    _band(axes, z, major, direction)
    turn = np.exp(-1j * _phase(x, y))
    axes.plot(z, (y * turn).real, color="#000000", linewidth=1.4)
    axes.plot(z, (x * turn).real, color="#000000", linewidth=1.2, linestyle=(0, (3, 2)))
    at = [train.z[seat.node] for seat in train.bearings]
    axes.plot(at, np.full(len(at), -1.12), "^", color="#333333", markersize=5, clip_on=False)
    ratio, whirl = float(mode["damping_ratio"]), float(mode["whirl_direction"])
    sense = "planar" if abs(whirl) < style.PLANAR else "forward" if whirl > 0.0 else "backward"
    axes.set_title(
        f"{int(mode['mode'])}:  {float(mode['frequency']):.2f} Hz,  damping ratio {ratio:.3f},  "
        f"shaft bends {float(mode['bending']):.0%},  {sense} {whirl:+.2f}"
        + ("  unstable" if ratio < -NOISE else ""),
        loc="left",
        fontsize=style.FONT,
        color="#CC0000" if ratio < -NOISE else "#000000",
    )
    axes.set_xlim(z[0] - 0.01 * z[-1], 1.01 * z[-1])
    axes.set_ylim(-1.2, 1.1)
    style.dress(axes)
    axes.grid(False)
    axes.set_yticks([-1, 0, 1])


def _phase(x: NDArray[np.complex128], y: NDArray[np.complex128]) -> float:
    """Phase at which the sum of squared deflections is largest."""
    return float(0.5 * np.angle(np.sum(x**2) + np.sum(y**2)))


def _band(axes: Axes, z: Array, major: Array, direction: Array) -> None:
    """Both sides of the centre line up to the largest half axis."""
    corners = [
        [(z[k], -major[k]), (z[k + 1], -major[k + 1]), (z[k + 1], major[k + 1]), (z[k], major[k])]
        for k in range(len(z) - 1)
    ]
    middle = (direction[:-1] + direction[1:]) / 2.0
    band = PolyCollection(corners, cmap=style.WHIRL_MAP, alpha=0.45, linewidths=0.0, zorder=2)
    band.set_array(middle)
    band.set_clim(-1.0, 1.0)
    axes.add_collection(band)


def _outline(axes: Axes, train: Train) -> None:
    """Shaft and wheels, lightly, radii to a scale of their own."""
    largest = max(
        max(shoulder.widest for shoulder in train.shoulders),
        max((wheel.mean_diameter for wheel in train.wheels), default=0.0),
    )
    scale = OUTLINE / largest
    shaft = [
        [(left, -r), (right, -r), (right, r), (left, r)]
        for left, right, r in zip(
            train.z, train.z[1:], (s.widest * scale for s in train.shoulders), strict=False
        )
    ]
    half = 0.003 * train.length
    wheels = [
        [
            (train.z[w.node] + a * half, b * w.mean_diameter * scale)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))
        ]
        for w in train.wheels
        if w.mean_diameter > 0.0
    ]
    axes.add_collection(
        PolyCollection(wheels, facecolors="#EEF0F2", edgecolors="#C9CED4", linewidths=0.4, zorder=0)
    )
    axes.add_collection(PolyCollection(shaft, facecolors="#DDE1E6", edgecolors="none", zorder=1))
