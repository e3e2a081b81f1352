"""The deformed train with its bearing forces at the worst instant (Figure 5 of the paper)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.patheffects import withStroke

from orchestrator import quantities
from orchestrator.figures import style
from orchestrator.figures.shaft_outline import draw_shaft, draw_wheels
from orchestrator.figures.spread import spread
from orchestrator.windows import phases

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from rotor_fmu.train import Train

SHOWN_DEFLECTION = 0.038
"""Length of the largest deflection and of the largest force, as a share of the train's length."""
LEAST_ARROW = 0.02
"""Shorter arrows than this share of the panel's half height would be nothing but head: they are left out."""
NAME_WIDTH = 0.078
"""Room for a bearing's name, as a share of the train's length."""
_PLANES = (("y", "vertical plane, seen from the side"), ("x", "horizontal plane, seen from above"))


def worst_instant(record: xr.Dataset) -> int:
    """Index of the sample with the largest force at any bearing, in the last phase of the run."""
    force = record["force"].transpose("time", "bearing", "axis").values
    size = np.hypot(force[..., 0], force[..., 1]).max(axis=1)
    inside = phases(record)[-1].peak.mask(record["time"].values)
    return int(np.argmax(np.where(inside, size, -np.inf)))


def static_line(record: xr.Dataset) -> NDArray[np.float64]:
    """Static deflection, shape (nodes, 2) [m]; without one, the mean over the first phase."""
    if "static_line" in record:
        return np.asarray(record["static_line"].transpose("node", "axis").values, dtype=float)
    inside = phases(record)[0].mean.mask(record["time"].values)
    return np.asarray(record["deflection"].transpose("time", "node", "axis").values[inside].mean(axis=0))


def _nice(value: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above a value."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(step * power for step in (1.0, 2.0, 5.0) if step * power <= value))


def _bearing_positions(record: xr.Dataset, train: Train | None) -> NDArray[np.float64]:
    """Axial positions of the bearings [m], from the record or from the train."""
    for name in ("bearing_z", "z_bearing"):
        if name in record.coords:
            return np.asarray(record[name].values, dtype=float)
    if train is None:
        raise ValueError("the positions of the bearings are neither in the record nor given by a train")
    places = {seat.name: train.z[seat.node] for seat in train.bearings}
    return np.array([places[str(name)] for name in record["bearing"].values])


def _arrows(
    axes: Axes,
    z: NDArray[np.float64],
    at: NDArray[np.float64],
    force: NDArray[np.float64],
    scale: float,
    colours: Sequence[str],
    least: float = 0.0,
) -> None:
    """Force on the shaft at each bearing, the tip at the journal; `scale` in mm shown per N."""
    for place, journal, value, colour in zip(z, at, force, colours, strict=True):
        if abs(value) * scale > least:
            axes.annotate(
                "",
                (place, journal),
                (place, journal - value * scale),
                zorder=6,
                arrowprops={
                    "arrowstyle": "-|>,head_length=0.35,head_width=0.18",
                    "color": colour,
                    "linewidth": 1.8,
                    "shrinkA": 0,
                    "shrinkB": 0,
                    "path_effects": [withStroke(linewidth=3.4, foreground="white")],
                },
            )


def _names(
    axes: Axes, record: xr.Dataset, index: int, z: NDArray[np.float64], length: float, level: float
) -> None:
    """Names and force magnitudes below the train, with leaders to the bearings."""
    order = np.argsort(z)
    force = record["force"].isel(time=index).transpose("bearing", "axis").values
    shown = quantities.FORCE.fitting(float(np.hypot(force[:, 0], force[:, 1]).max()))
    places = spread([float(z[i]) for i in order], NAME_WIDTH * length)
    for place, i in zip(places, order, strict=True):
        axes.annotate(
            f"{record['bearing'].values[i]}\n{shown.text(float(np.hypot(*force[i])))}",
            (float(z[i]), level),
            (place, level * 1.32),
            ha="center",
            va="top",
            fontsize=style.FONT - 1.5,
            annotation_clip=False,
            arrowprops={"arrowstyle": "-", "color": "#888888", "linewidth": 0.7, "shrinkA": 0, "shrinkB": 0},
        )


def _panel(
    axes: Axes,
    record: xr.Dataset,
    index: int,
    plane: str,
    title: str,
    train: Train | None,
    scale: float,
    force_scale: float,
    limit: float,
    stress_limit: float,
) -> ScalarMappable:
    """One plane of one run; the axis counts mm of deflection, the shaft is drawn at the scale of z."""
    millimetre = 1e3 / scale  # shown mm of deflection for one metre of geometry
    component = list(record["axis"].values).index(plane)
    z = np.asarray(record["z"].values, dtype=float)
    dynamic = record["deflection"].isel(time=index).transpose("node", "axis").values - static_line(record)
    line = dynamic[:, component] * 1e3
    stress = np.asarray(record["stress"].isel(time=index).values, dtype=float) * quantities.STRESS.factor
    axes.axhline(0.0, color="#666666", linewidth=0.7, linestyle=(0, (12, 3, 2, 3)), zorder=1)
    if train is not None:
        draw_wheels(axes, train, line, millimetre)
    shaft = draw_shaft(axes, z, line, stress, millimetre, stress_limit, train)
    at_bearing = _bearing_positions(record, train)
    axes.plot(
        at_bearing,
        np.full(at_bearing.size, -limit * 0.93),
        marker="^",
        linestyle="none",
        color="#333333",
        markersize=6,
        zorder=2,
        clip_on=False,
    )
    force = record["force"].isel(time=index).transpose("bearing", "axis").values[:, component]
    colours = [style.colour_of(style.depth_at(record, str(name))) for name in record["bearing"].values]
    _arrows(
        axes, at_bearing, np.interp(at_bearing, z, line), force, force_scale, colours, LEAST_ARROW * limit
    )
    axes.set_aspect(scale * 1e-3)
    axes.set_xlim(z[0] - 0.01 * z[-1], z[-1] * 1.01)
    axes.set_ylim(-limit, limit)
    axes.set_ylabel(f"{plane} [mm]")
    axes.set_title(title, loc="left", fontsize=style.FONT)
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
    """
    instants = [worst_instant(record) for record in records]
    length = float(records[0]["z"].values[-1])
    deflection = max(
        float(np.abs(r["deflection"].isel(time=i).transpose("node", "axis").values - static_line(r)).max())
        for r, i in zip(records, instants, strict=True)
    )
    forces = [np.abs(r["force"].isel(time=i).values).max() for r, i in zip(records, instants, strict=True)]
    stress = max(float(r["stress"].isel(time=i).max()) for r, i in zip(records, instants, strict=True))
    scale = _nice(1.4 * SHOWN_DEFLECTION * length / max(deflection, 1e-9))
    limit = 2.6 * SHOWN_DEFLECTION * length * 1e3 / scale
    force_scale = SHOWN_DEFLECTION * 1.6 * length * 1e3 / scale / max(float(max(forces)), 1e-9)
    figure = style.new_figure(
        13.0,
        1.7 + 5.0 * len(records),
        "Deformed train and bearing forces at the worst instant",
        style.run_caption(records[0]) if len(records) == 1 else str(records[0].attrs.get("title", "")),
    )
    grid = figure.subplots(2 * len(records), 1, squeeze=False)[:, 0]
    for row, (record, index) in enumerate(zip(records, instants, strict=True)):
        instant = float(record["time"].values[index])
        for axes, (plane, view) in zip(grid[2 * row : 2 * row + 2], _PLANES, strict=True):
            name = f"{style.run_name(record)}, " if len(records) > 1 else ""
            title = f"{name}t = {instant:.4f} s, {view}; deflection × {scale:g}"
            shaft = _panel(
                axes,
                record,
                index,
                plane,
                title,
                train,
                scale,
                force_scale,
                limit,
                stress * quantities.STRESS.factor,
            )
        _names(grid[2 * row], record, index, _bearing_positions(record, train), length, -limit * 0.95)
    for axes in grid[:-1]:
        axes.tick_params(labelbottom=False)
    grid[-1].set_xlabel("z [m]")
    unit = _nice(float(max(forces)))
    axes = grid[1]
    start = 0.5 * (np.diff(axes.get_xlim())[0])
    axes.annotate(
        f"{quantities.FORCE.fitting(unit).text(unit)}  force on the shaft",
        (start, -limit * 0.62),
        fontsize=style.FONT - 1,
        va="center",
        xytext=(6, 0),
        textcoords="offset points",
    )
    _arrows(
        axes,
        np.array([start]),
        np.array([-limit * 0.62 + unit * force_scale / 2]),
        np.array([unit]),
        force_scale,
        ["#333333"],
    )
    bar = figure.colorbar(shaft, ax=list(grid), location="right", fraction=0.02, pad=0.01, aspect=40)
    bar.set_label(quantities.STRESS.axis, fontsize=style.FONT)
    bar.ax.tick_params(labelsize=style.FONT - 1)
    return figure
