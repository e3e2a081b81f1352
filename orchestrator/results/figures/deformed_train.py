"""The deformed train with its bearing forces at the worst instant (Figure 5 of the paper)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.patheffects import withStroke

from orchestrator.results import quantities
from orchestrator.results.figures import style
from orchestrator.results.figures.deformation import (
    Scales,
    dynamic_deflection,
    nice,
    scales_of,
    worst_instant,
)
from orchestrator.results.figures.shaft_outline import draw_shaft, draw_wheels
from orchestrator.results.figures.spread import spread

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from rotor_fmu.train.train import Train

LEAST_ARROW = 0.02
"""Shorter arrows than this share of the panel's half height would be nothing but head: they are left out."""
NAME_WIDTH = 0.078
"""Room for a bearing's name, as a share of a panel's width."""
PANEL_WIDTH = 11.5  # inches
_PLANES = (("y", "vertical plane, seen from the side"), ("x", "horizontal plane, seen from above"))


def _bearing_positions(record: xr.Dataset, train: Train | None) -> NDArray[np.float64]:
    """Axial positions of the bearings [m], from the record or from the train."""
    if "bearing_z" in record.coords:
        return np.asarray(record["bearing_z"].values, dtype=float)
    if train is None:
        raise ValueError("the positions of the bearings are neither in the record nor given by a train")
    places = {seat.name: train.z[seat.node] for seat in train.bearings}
    return np.array([places[str(name)] for name in record["bearing"].values])


def _arrow(axes: Axes, tip: tuple[float, float], tail: tuple[float, float], colour: str) -> None:
    """One arrow in data coordinates, set off from what lies below."""
    axes.annotate(
        "",
        tip,
        tail,
        zorder=6,
        annotation_clip=False,
        arrowprops={
            "arrowstyle": "-|>,head_length=0.35,head_width=0.18",
            "color": colour,
            "linewidth": 1.8,
            "shrinkA": 0,
            "shrinkB": 0,
            "path_effects": [withStroke(linewidth=3.4, foreground="white")],
        },
    )


def _key(axes: Axes, scales: Scales) -> None:
    """An arrow of known force, lying in the line of the title."""
    force = nice(scales.largest_force) if scales.largest_force > 0 else 0.0
    if force == 0.0:
        return
    y = scales.limit + 0.011 * scales.width / scales.aspect
    end = 0.5 * (scales.length + scales.width)
    start = end - force * scales.force * scales.aspect
    _arrow(axes, (end, y), (start, y), "#333333")
    axes.annotate(
        f"force on the shaft, {quantities.FORCE.fitting(force).text(force)}",
        (start, y),
        xytext=(-6, 0),
        textcoords="offset points",
        ha="right",
        va="center",
        fontsize=style.FONT - 1,
        annotation_clip=False,
    )


def _names(axes: Axes, record: xr.Dataset, index: int, z: NDArray[np.float64], scales: Scales) -> None:
    """Names and force magnitudes below the panel, with leaders to the bearings."""
    order = np.argsort(z)
    force = record["force"].isel(time=index).transpose("bearing", "axis").values
    size = np.hypot(force[:, 0], force[:, 1])
    shown = quantities.FORCE.fitting(float(size.max()))
    places = spread([float(z[i]) for i in order], NAME_WIDTH * scales.width)
    for place, i in zip(places, order, strict=True):
        axes.annotate(
            f"{record['bearing'].values[i]}\n{shown.text(float(size[i]))}",
            (float(z[i]), -scales.limit),
            (place, -scales.limit - 0.021 * scales.width / scales.aspect),
            ha="center",
            va="top",
            fontsize=style.FONT - 1.5,
            annotation_clip=False,
            arrowprops={"arrowstyle": "-", "color": "#888888", "linewidth": 0.7, "shrinkA": 0, "shrinkB": 0},
        )


def _panel(
    axes: Axes, record: xr.Dataset, index: int, plane: str, train: Train | None, scales: Scales
) -> ScalarMappable:
    """One plane of one run; the axis counts mm of deflection, the shaft is drawn at the scale of z."""
    component = list(record["axis"].values).index(plane)
    z = np.asarray(record["z"].values, dtype=float)
    line = dynamic_deflection(record, index)[:, component] * 1e3
    stress = np.asarray(record["stress"].isel(time=index).values, dtype=float) * quantities.STRESS.factor
    axes.axhline(0.0, color="#666666", linewidth=0.7, linestyle=(0, (12, 3, 2, 3)), zorder=1)
    if train is not None:
        draw_wheels(axes, train, line, scales.millimetre)
    limit = scales.stress * quantities.STRESS.factor
    shaft = draw_shaft(axes, z, line, stress, scales.millimetre, limit, train)
    at = _bearing_positions(record, train)
    axes.plot(at, np.full(at.size, -0.96 * scales.limit), "^", color="#333333", markersize=6, clip_on=False)
    force = record["force"].isel(time=index).transpose("bearing", "axis").values[:, component]
    for name, place, journal, value in zip(
        record["bearing"].values, at, np.interp(at, z, line), force * scales.force, strict=True
    ):
        if abs(value) > LEAST_ARROW * scales.limit:
            colour = style.colour_of(style.depth_at(record, str(name)))
            _arrow(axes, (float(place), float(journal)), (float(place), float(journal - value)), colour)
    axes.set_aspect(scales.aspect)
    room = 0.5 * (scales.width - scales.length) + 0.01 * scales.width
    axes.set_xlim(z[0] - room, z[-1] + room)
    axes.set_ylim(-scales.limit, scales.limit)
    axes.set_ylabel(f"{plane} [mm]")
    style.dress(axes)
    axes.grid(False)
    return shaft


def deformed_train(records: Sequence[xr.Dataset], train: Train | None = None) -> Figure:
    """Draw the train at the instant of the largest bearing force, deformation and forces to scale.

    Parameters
    ----------
    records : sequence of xarray.Dataset
        One run or several of the same scenario; all are drawn at the same scales.
    train : Train, optional
        Gives shoulder diameters and wheels; without it the shaft is a band of constant width.

    Returns
    -------
    matplotlib.figure.Figure
        For each run the vertical and the horizontal plane: dynamic deflection from the
        static line, shaft coloured by normal stress, forces of the bearings on the shaft.

    Raises
    ------
    ValueError
        When neither the record nor a train tells where the bearings are.
    """
    instants = [worst_instant(record) for record in records]
    scales = scales_of(records, instants, train)
    figure = style.new_figure(
        13.0,
        1.4 + (1.3 + 2 * PANEL_WIDTH * scales.height) * len(records),
        "Deformed train and bearing forces at the worst instant",
        style.caption(records),
    )
    grid = figure.subplots(2 * len(records), 1, squeeze=False)[:, 0]
    for row, (record, index) in enumerate(zip(records, instants, strict=True)):
        instant = float(record["time"].values[index])
        panels = grid[2 * row : 2 * row + 2]
        for axes, (plane, view) in zip(panels, _PLANES, strict=True):
            shaft = _panel(axes, record, index, plane, train, scales)
            name = f"{style.run_name(record)}, " if len(records) > 1 else ""
            title = f"{name}t = {instant:.4f} s, {view}; deflection × {scales.deflection:g}"
            axes.set_title(title, loc="left", fontsize=style.FONT)
        _names(panels[0], record, index, _bearing_positions(record, train), scales)
    _key(grid[0], scales)
    for axes in grid[:-1]:
        axes.tick_params(labelbottom=False)
    grid[-1].set_xlabel("z [m]")
    bar = figure.colorbar(shaft, ax=list(grid), location="right", fraction=0.02, pad=0.01, aspect=40)
    bar.set_label(quantities.STRESS.axis, fontsize=style.FONT)
    bar.ax.tick_params(labelsize=style.FONT - 1)
    return figure
