"""Stability and critical speeds: decrements over speed, response at the bearings, the critical speed map."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results.figures import style
from orchestrator.results.quantities import HERTZ
from rotor_fmu.linear.analysis import LEAST_DECREMENT, REACH

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from rotor_fmu.train.train import Train


def stability_figure(
    modes: xr.Dataset, chart: xr.Dataset, bearings: xr.Dataset, response: xr.Dataset | None, train: Train
) -> Figure:
    """Three panels.

    Parameters
    ----------
    modes, chart, bearings, response : xarray.Dataset
        From `orchestrator.linear.stability`.
    train : Train
        For name and rated speed.
    """
    figure = style.new_figure(
        14.0, 7.6, "Stability and critical speeds", f"{train.name}  ·  {modes.attrs['films']}"
    )
    panels = figure.subplot_mosaic([["decrement", "map"], ["response", "map"]], width_ratios=[1.15, 1.0])
    _decrements(panels["decrement"], modes, train)
    if response is None:
        panels["response"].set_axis_off()
    else:
        _response(panels["response"], response, train)
    _map(panels["map"], chart, bearings, train)
    return figure


def _decrements(axes: Axes, modes: xr.Dataset, train: Train) -> None:
    rotation, names = modes["rotation"].values, modes["mode"].values
    rated = int(np.argmin(np.abs(rotation - train.speed / HERTZ)))
    for mode, colour in zip(names, style.along_the_shaft(len(names)), strict=True):
        line = modes.sel(mode=mode)
        hertz = float(line["frequency"][rated])
        label = f"{hertz:.4g} Hz at rated speed" if np.isfinite(hertz) else "not at rated speed"
        values = line["log_decrement"].values
        counts = (line["frequency"].values <= REACH * rotation) | (values < 0.0)
        axes.plot(rotation, values, color=colour, linewidth=0.6, alpha=0.6)
        axes.plot(rotation, np.where(counts, values, np.nan), color=colour, linewidth=1.6, label=label)
    axes.axhline(0.0, color="#CC0000", linewidth=1.0)
    axes.axhline(
        LEAST_DECREMENT, color="#CC0000", linewidth=0.9, linestyle=":", label=f"{LEAST_DECREMENT:g}, API 617"
    )
    axes.set_yscale("symlog", linthresh=LEAST_DECREMENT)
    _rated(axes, rotation, train)
    axes.set_ylabel("logarithmic decrement [1]")
    axes.set_title(
        f"least damped modes, thin above {REACH:g} × speed; below 0: unstable",
        loc="left", fontsize=style.FONT + 1,
    )  # fmt: skip
    axes.set_xlabel("speed of rotation [Hz]")
    _legend(axes)


def _response(axes: Axes, response: xr.Dataset, train: Train) -> None:
    rotation = response["rotation"].values
    names = [str(name) for name in response["bearing"].values]
    for name, colour in zip(names, style.along_the_shaft(len(names)), strict=True):
        values = 1e6 * response["amplitude"].sel(bearing=name).values
        axes.semilogy(rotation, values, color=colour, linewidth=1.3, label=name)
    top = 1e6 * float(response["amplitude"].max())
    axes.set_ylim(top / 3e3, 2.0 * top)
    _rated(axes, rotation, train)
    axes.set_xlabel("speed of rotation [Hz]")
    axes.set_ylabel("amplitude [µm]")
    axes.set_title("unbalance response at the bearings", loc="left", fontsize=style.FONT + 1)
    _legend(axes)


def _map(axes: Axes, chart: xr.Dataset, bearings: xr.Dataset, train: Train) -> None:
    stiffness = chart["stiffness"].values
    for mode in chart["mode"].values:
        axes.loglog(stiffness, chart["critical_speed"].sel(mode=mode).values, color="#222222", linewidth=1.3)
    speed = bearings["rotation"].values
    turning = speed > 0.0
    on_pedestals = "stiffness_on_pedestal" in bearings
    stands = "bearings on pedestals" if on_pedestals else "bearings"
    name = "stiffness_on_pedestal" if on_pedestals else "stiffness"
    for wrench, move, colour in (("Fx", "x", "#0072B2"), ("Fy", "y", "#D55E00")):
        direct = bearings[name].sel(wrench=wrench, displacement=move).values[turning]
        shown = np.where(direct > 0.0, direct, np.nan)
        label = f"{stands}, K{move}{move} over speed"
        for k in range(shown.shape[1]):
            axes.loglog(
                shown[:, k], speed[turning], color=colour, linewidth=0.9, label=label if k == 0 else None
            )
    axes.axhline(train.speed / HERTZ, color=style.EVENT, linewidth=0.9, linestyle=":", label="rated speed")
    axes.set_xlim(stiffness[0], stiffness[-1])
    low, high = float(chart["critical_speed"].min()), float(chart["critical_speed"].max())
    axes.set_ylim(0.7 * min(low, train.speed / HERTZ), 1.4 * max(high, train.speed / HERTZ))
    axes.set_xlabel("stiffness of each bearing [N/m]")
    axes.set_ylabel("undamped critical speed, forward whirl [Hz]")
    axes.set_title("map of undamped critical speeds", loc="left", fontsize=style.FONT + 1)
    style.dress(axes)
    axes.legend(
        loc="upper center", bbox_to_anchor=(0.5, -0.09), ncols=2, frameon=False, fontsize=style.FONT - 1
    )


def _rated(axes: Axes, rotation: np.ndarray, train: Train) -> None:
    rated = train.speed / HERTZ
    if rated <= rotation[-1]:
        axes.axvline(rated, color=style.EVENT, linewidth=0.9, linestyle=":", zorder=1)
    axes.set_xlim(rotation[0], rotation[-1])
    style.dress(axes)


def _legend(axes: Axes) -> None:
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=style.FONT - 1)
