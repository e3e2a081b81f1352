"""Campbell diagrams: free-free (Figure 2 of the paper) and on linearised films."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D

from orchestrator.results.figures import style
from orchestrator.results.quantities import HERTZ

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from rotor_fmu.train.train import Train

MARKS_EVERY = 4
"""Reduced shafts are marked at every so many speeds, so that the lines below stay visible."""
HIGHEST_ORDER, LOWEST = 4.0, 6
"""A diagram on films reaches up to this multiple of the highest speed, and so many modes at least."""
LEAST = 1e-9
"""Lower end of the axis of errors: below is rounding."""
_ARROW = {"forward": "▲", "backward": "▼"}


def free_figure(data: xr.Dataset, iterations: xr.Dataset, train: Train) -> Figure:
    """Frequencies over speed, the errors of the reductions, and those of IRS over its iterations.

    Parameters
    ----------
    data, iterations : xarray.Dataset
        From `orchestrator.linear.campbell.free_data`.
    train : Train
        For name and rated speed.
    """
    count = data.sizes["mode"]
    caption = (
        f"{train.name}  ·  first {count} bending frequencies in each direction of whirl  ·  "
        f"reduced to {data.attrs['degrees_of_freedom']} degrees of freedom"
    )
    figure = style.new_figure(13.0, 7.2, "Campbell diagram, free-free: unreduced and reduced shaft", caption)
    panels = figure.subplot_mosaic([["diagram", "error"], ["diagram", "iteration"]], width_ratios=[1.25, 1.0])
    _diagram(panels["diagram"], data, train)
    _errors(panels["error"], data)
    _iterations(panels["iteration"], data, iterations)
    return figure


def _diagram(axes: Axes, data: xr.Dataset, train: Train) -> None:
    rotation = data["rotation"].values
    for direction, colour in style.WHIRL_COLOURS.items():
        full = data["frequency"].sel(shaft="unreduced", direction=direction).values
        axes.plot(rotation, full, color=colour, linewidth=1.3)
        for name, (_, marker, size) in style.REDUCTION_LOOKS.items():
            marks = data["frequency"].sel(shaft=name, direction=direction).values[::MARKS_EVERY]
            axes.plot(
                rotation[::MARKS_EVERY],
                marks,
                linestyle="none",
                marker=marker,
                markersize=size,
                markerfacecolor="none",
                markeredgecolor=style.REDUCTION_LOOKS[name][0],
                markeredgewidth=0.9,
                clip_on=False,
                zorder=3,
            )
    _speed_lines(axes, rotation, float(data["frequency"].max()), train)
    handles = [
        Line2D([], [], color=colour, label=f"unreduced, {direction} whirl {_ARROW[direction]}")
        for direction, colour in style.WHIRL_COLOURS.items()
    ]
    handles += [_mark(name) for name in style.REDUCTION_LOOKS]
    axes.legend(
        handles=handles,
        loc="upper center",
        bbox_to_anchor=(0.5, -0.09),
        ncols=3,
        frameon=False,
        fontsize=style.FONT - 0.5,
    )
    axes.set_ylabel("frequency [Hz]")
    axes.set_title("bending frequencies", loc="left", fontsize=style.FONT + 1)


def _mark(name: str) -> Line2D:
    """The mark of a reduction, for a legend."""
    colour, marker, size = style.reduction_look(name)
    return Line2D(
        [], [], linestyle="none", marker=marker, markersize=size, markerfacecolor="none", color=colour,
        label=style.reduction_name(name).replace("\n", " "),
    )  # fmt: skip


def _speed_lines(axes: Axes, rotation: np.ndarray, top: float, train: Train) -> None:
    """Rated speed, and where whirl and rotation are synchronous."""
    rated = train.speed / HERTZ
    limit = 1.06 * top
    end = min(rotation[-1], limit)
    axes.plot([0.0, end], [0.0, end], color="#555555", linewidth=1.0, linestyle=(0, (5, 3)))
    axes.annotate(
        "1 × rotation", (0.55 * end, 0.55 * end), xytext=(5, -2), textcoords="offset points",
        fontsize=style.FONT - 1.5, color="#555555", va="top", zorder=4,
        bbox={"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.85},
    )  # fmt: skip
    if rated <= rotation[-1]:
        axes.axvline(rated, color=style.EVENT, linewidth=0.9, linestyle=":")
        axes.annotate(
            f"rated {rated:g} Hz", (rated, 1.0), xycoords=("data", "axes fraction"), xytext=(3, -2),
            textcoords="offset points", fontsize=style.FONT - 1.5, va="top",
        )  # fmt: skip
    axes.set_xlim(0.0, rotation[-1])
    axes.set_ylim(0.0, limit)
    axes.set_xlabel("speed of rotation [Hz]")
    style.dress(axes)


def _top(frequency: np.ndarray, rotation: np.ndarray) -> float:
    """Highest frequency of the diagram: where modes lie far above the rotation, it shows the lower ones."""
    lowest = np.sort(np.nanmax(frequency, axis=0))[:LOWEST]
    return min(float(np.nanmax(frequency)), max(HIGHEST_ORDER * float(rotation[-1]), float(lowest[-1])))


def _errors(axes: Axes, data: xr.Dataset) -> None:
    """Largest error of the frequencies over speed, on a logarithmic axis."""
    rotation = data["rotation"].values
    worst = abs(data["error"]).max([d for d in ("direction", "mode") if d in data["error"].dims])
    for name in (str(m) for m in data["shaft"].values[1:]):
        colour, marker, size = style.reduction_look(name)
        values = np.maximum(worst.sel(shaft=name).values, LEAST)
        line = "-" if name in style.REDUCTION_LOOKS else (0, (4, 2))
        axes.semilogy(
            rotation, values, color=colour, linestyle=line, marker=marker, markersize=0.8 * size,
            markerfacecolor="white", markevery=MARKS_EVERY, linewidth=1.2,
            label=style.reduction_name(name),
        )  # fmt: skip
    _target(axes)
    axes.set_xlim(0.0, rotation[-1])
    axes.set_xlabel("speed of rotation [Hz]")
    axes.set_ylabel("relative error [1]")
    axes.set_title("largest error of these frequencies", loc="left", fontsize=style.FONT + 1)
    style.dress(axes)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=style.FONT - 1)


def _iterations(axes: Axes, data: xr.Dataset, iterations: xr.Dataset) -> None:
    """Largest error of plain IRS over its iterations, and the floor at the highest speed."""
    worst = abs(iterations["error"]).max(["direction", "mode"])
    shades = ("#BBBBBB", "#888888", "#222222")
    for speed, shade in zip(iterations["rotation"].values, shades, strict=True):
        values = np.maximum(worst.sel(rotation=speed).values, LEAST)
        axes.semilogy(
            iterations["iteration"], values, color=shade, linewidth=1.4, label=f"at {speed:g} Hz of rotation"
        )
    floor = float(abs(data["error"].sel(shaft="modal truncation")).isel(rotation=-1).max())
    axes.axhline(
        floor,
        color="#222222",
        linewidth=1.0,
        linestyle=(0, (4, 2)),
        label="floor at the last speed:\nG left out of the basis",
    )
    _target(axes)
    axes.set_xlim(0, int(iterations["iteration"][-1]))
    axes.set_xlabel("iteration of plain IRS (0: Guyan)")
    axes.set_ylabel("relative error [1]")
    axes.set_title("convergence of plain IRS", loc="left", fontsize=style.FONT + 1)
    style.dress(axes)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=style.FONT - 1)


def _target(axes: Axes) -> None:
    axes.axhline(1e-4, color="#CC0000", linewidth=0.8, linestyle=":")


def supported_figure(data: xr.Dataset, train: Train) -> Figure:
    """Frequencies and damping ratios on the films over speed, coloured by whirl direction; errors.

    Parameters
    ----------
    data : xarray.Dataset
        From `orchestrator.linear.campbell.supported_data`.
    train : Train
        For name and rated speed.
    """
    caption = f"{train.name}  ·  {data.attrs['films']}"
    figure = style.new_figure(13.0, 7.2, "Campbell diagram on linearised films", caption)
    panels = figure.subplot_mosaic([["diagram", "damping"], ["diagram", "error"]], width_ratios=[1.25, 1.0])
    rotation = data["rotation"].values
    speeds = np.repeat(rotation, data.sizes["mode"])
    direction = data["whirl_direction"].values.ravel()
    full = data.sel(shaft="unreduced")
    ratio = full["damping_ratio"].values.ravel()
    axes = panels["diagram"]
    look: dict[str, Any] = {
        "c": direction,
        "cmap": style.WHIRL_MAP,
        "vmin": -1.0,
        "vmax": 1.0,
        "linewidths": 0.0,
    }
    shown = axes.scatter(speeds, full["frequency"].values.ravel(), s=np.where(ratio > 0.3, 4.0, 13.0), **look)
    reduced = data["frequency"].sel(shaft="irs").values[::MARKS_EVERY]
    axes.plot(
        np.repeat(rotation[::MARKS_EVERY], data.sizes["mode"]), reduced.ravel(), linestyle="none", marker="o",
        markersize=5.0, markerfacecolor="none", markeredgecolor="#222222", markeredgewidth=0.6, zorder=3,
    )  # fmt: skip
    top = _top(full["frequency"].values, rotation)
    _speed_lines(axes, rotation, top, train)
    axes.set_ylabel("damped frequency [Hz]")
    words = "dots: unreduced shaft, small where damping ratio > 0.3;  rings: reduced by IRS (default)"
    above = int(np.sum(np.nanmin(full["frequency"].values, axis=0) > 1.06 * top))
    words += f"\n{above} modes above: in the table" if above else ""
    axes.set_title(words, loc="left", fontsize=style.FONT)
    bar = axes.figure.colorbar(shown, ax=axes, location="bottom", fraction=0.02, pad=0.02, ticks=[-1, 0, 1])
    bar.ax.set_xticklabels(["backward whirl", "in a plane", "forward whirl"], fontsize=style.FONT - 1)
    axes = panels["damping"]
    axes.scatter(speeds, ratio, s=8.0, **look)
    axes.set_yscale("symlog", linthresh=0.01)
    axes.axhline(0.0, color="#CC0000", linewidth=0.8)
    axes.set_xlim(0.0, rotation[-1])
    axes.set_ylabel("damping ratio [1]")
    axes.set_title("damping ratio; negative: unstable", loc="left", fontsize=style.FONT + 1)
    style.dress(axes)
    _errors(panels["error"], data)
    panels["error"].set_title("largest error of an eigenvalue", loc="left", fontsize=style.FONT + 1)
    return figure
