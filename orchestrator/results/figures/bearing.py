"""One bearing on its own: static curves, coefficients, pressure; every depth in its colour."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.patches import Rectangle
from matplotlib.ticker import LogFormatter

from orchestrator.results.figures import style

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from fmus.port import Bore

_CURVES = (
    ("sommerfeld", 1.0, "Sommerfeld number [1]", True),
    ("attitude", 1.0, "angle from load to journal [deg]", False),
    ("side_flow", 1e3, "oil pressed out at the ends [l/s]", False),
    ("friction", 1.0, "friction coefficient / psi [1]", True),
    ("temperature_rise", 1.0, "temperature rise of this oil [K]", True),
    ("p_max", 1e-6, "largest pressure [MPa]", True),
)
_ENTRIES = (("Fx", "x", "-"), ("Fx", "y", "--"), ("Fy", "x", ":"), ("Fy", "y", "-."))
_WIDEST = 3.4
_MARK = "#D9D9D9"
"""Of what belongs to the bore, on the dark ground of no pressure."""
MARGIN = 1e-6
"""In degrees, up to which two arcs meet."""


def _lines(data: xr.Dataset) -> list[tuple[str, str, float]]:
    """Depths with colour and width: where they coincide, the later lies narrower on the earlier."""
    names = [str(name) for name in data["depth"].values]
    return [(name, style.colour_of(name), max(_WIDEST - 0.8 * k, 0.9)) for k, name in enumerate(names)]


def curves_figure(curves: xr.Dataset, title: str, sommerfeld: float) -> Figure:
    """Figures of the bearing over the eccentricity.

    Parameters
    ----------
    curves : xarray.Dataset
        From `orchestrator.linear.bearing`.
    title : str
        The bearing.
    sommerfeld : float
        Of its load, which is marked.
    """
    figure = style.new_figure(13.0, 7.4, "Bearing under static load", title)
    panels = figure.subplots(2, 3).ravel()
    # pads on springs recede, and the journal goes further than the clearance
    furthest = max(1.0, float(curves["eccentricity"].max(skipna=True)))
    for axes, (name, scale, label, logarithmic) in zip(panels, _CURVES, strict=True):
        for depth, colour, width in _lines(curves):
            line = curves.sel(depth=depth)
            over = line["eccentricity"].values
            values = np.broadcast_to(scale * line[name].values, over.shape)
            axes.plot(over, values, color=colour, linewidth=width, label=style.depth_name(depth))
            at = np.interp(np.log(sommerfeld), np.log(line["sommerfeld"].values), np.arange(len(over)))
            place = [np.interp(at, np.arange(len(over)), x) for x in (over, values)]
            axes.plot(*place, "o", color=colour, markersize=5.0, markeredgecolor="#222222")
        if logarithmic:
            axes.set_yscale("log")
        axes.set_xlim(0.0, furthest)
        axes.set_xlabel("relative eccentricity [1]")
        axes.set_ylabel(label)
        style.dress(axes)
    figure.legend(
        *panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4, frameon=False,
        fontsize=style.FONT, title="dots: under the load of the bearing", title_fontsize=style.FONT,
    )  # fmt: skip
    return figure


def coefficients_figure(curves: xr.Dataset, over_speed: xr.Dataset, title: str, sommerfeld: float) -> Figure:
    """Stiffness, damping and threshold over the Sommerfeld number and over the speed under the load."""
    figure = style.new_figure(13.0, 8.6, "Stiffness and damping of the film", title)
    panels = figure.subplots(2, 3)
    clearance, speed = float(curves.attrs["clearance"]), float(curves.attrs["speed"])
    so = curves["sommerfeld"].values
    for axes, name, factor in ((panels[0, 0], "stiffness", 1.0), (panels[0, 1], "damping", speed)):
        _entries(axes, curves, name, "sommerfeld", factor * clearance / (so * curves.attrs["unit_load"]))
        symbol = "K C / W" if name == "stiffness" else "C C ω / W"
        axes.set_ylabel(f"{symbol} [1]")
    for axes, name, factor, unit in (
        (panels[1, 0], "stiffness", 1e-9, "stiffness [GN/m]"),
        (panels[1, 1], "damping", 1e-6, "damping [MN s/m]"),
    ):
        _entries(axes, over_speed, name, "rotation", np.full(over_speed.sizes["rotation"], factor))
        axes.set_ylabel(unit)
    for depth, colour, width in _lines(curves):
        values = curves["threshold"].sel(depth=depth).values
        shown = np.where(np.isfinite(values), values, np.nan)
        panels[0, 2].loglog(so, shown, color=colour, linewidth=width, label=style.depth_name(depth))
        line = over_speed.sel(depth=depth)
        panels[1, 2].plot(line["rotation"].values, 1e6 * line["h_min"].values, color=colour, linewidth=width)
    for formatter in (panels[0, 2].yaxis.set_major_formatter, panels[0, 2].yaxis.set_minor_formatter):
        formatter(LogFormatter(minor_thresholds=(1.0, 0.5)))  # 3 and 6, not powers of ten
    panels[0, 2].tick_params(axis="y", which="both", labelsize=style.FONT - 1)
    panels[0, 2].set_ylabel("threshold of a rigid rotor, ω √(C/g) [1]")
    bounded = bool(np.isfinite(curves["threshold"].values).any())
    words = "stable below; above the last point stable at any speed" if bounded else "stable at any speed"
    panels[0, 2].set_title(words, fontsize=style.FONT, loc="left")
    panels[1, 2].set_ylabel("least gap [µm]")
    for axes in panels[0]:
        axes.axvline(sommerfeld, color=style.EVENT, linewidth=0.9, linestyle=":")
        axes.set_xlabel("Sommerfeld number [1]")
        axes.set_xlim(so[0], so[-1])
        style.dress(axes)
    for axes in panels[1]:
        axes.set_xlabel("speed of rotation [Hz], under the load of the bearing")
        style.dress(axes)
    depths = panels[0, 2].get_legend_handles_labels()
    figure.legend(*depths, loc="outside lower center", ncols=4, frameon=False, fontsize=style.FONT)
    return figure


def _entries(axes: Axes, data: xr.Dataset, name: str, over: str, scale: np.ndarray) -> None:
    """The four entries of a matrix at every depth."""
    for depth, colour, width in _lines(data):
        for wrench, move, dashes in _ENTRIES:
            values = scale * data[name].sel(depth=depth, wrench=wrench, displacement=move).values
            axes.plot(
                data[over].values, values, color=colour, linewidth=max(width - 1.2, 0.8), linestyle=dashes
            )
    if over == "sommerfeld":
        axes.set_xscale("log")
        axes.set_yscale("symlog", linthresh=1.0)
    for wrench, move, dashes in _ENTRIES:
        axes.plot([], [], color="#444444", linestyle=dashes, label=f"{wrench[1]}{move}")
    # over the panel: in it there are lines everywhere
    axes.legend(
        frameon=False, fontsize=style.FONT - 1, ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0),
        borderaxespad=0.1,
    )  # fmt: skip


def pressure_figure(pressure: xr.Dataset, title: str, load: np.ndarray, bore: Bore = ()) -> Figure:
    """The film unrolled, with its bore: pressure over angle and width, and what fills films with cavities."""
    both = "content" in pressure
    figure = style.new_figure(
        11.0, 8.0 if both else 4.6, "Pressure over the film, as V1 solves it, under the load", title
    )
    panels = figure.subplots(2 if both else 1, squeeze=False)[:, 0]
    values = 1e-6 * pressure["pressure"].values
    top = max(float(values.max()), 1e-9)
    _unroll(panels[0], pressure, values, top, "pressure [MPa]", "viridis")
    if both:
        text = "share of the gap that oil fills [1]"
        _unroll(panels[1], pressure, np.clip(pressure["content"].values, 0.0, 1.0), 1.0, text, "cividis")
    for axes in panels:
        direction = np.degrees(np.arctan2(load[1], load[0]))
        axes.axvline(direction, color=style.EVENT, linewidth=1.2, linestyle=":")
        kinds = _mark_bore(axes, bore)
    panels[0].set_title("; ".join(["dotted: direction of the load", *kinds]), fontsize=style.FONT, loc="left")
    panels[-1].set_xlabel("angle from x (sideways) to y (up) [deg]")
    return figure


def _mark_bore(axes: Axes, bore: Bore) -> list[str]:
    """Mark ends of arcs, grooves between them and pockets on them; returns what the marks mean."""
    low, high = axes.get_ylim()
    found = {}
    for arc, after in zip(bore, (*bore[1:], *bore[:1]), strict=True):
        start, end = np.degrees(arc.start), np.degrees(arc.end)
        free = np.degrees((after.start - arc.end) % (2.0 * np.pi))
        for turn in (-720.0, -360.0, 0.0, 360.0):  # whichever of them lies in the figure
            if arc.share > 0.0:
                found["pocket"] = "framed: pockets"
                place, height = 0.5 * (low + high), arc.share * (high - low)
                frame = (start + turn, place - 0.5 * height), end - start, height
                axes.add_patch(Rectangle(*frame, fill=False, edgecolor=_MARK, linewidth=1.2))
            if MARGIN < free < 360.0 - MARGIN:
                found["groove"] = "hatched: grooves"
                span = end + turn, end + free + turn
                axes.axvspan(*span, facecolor="none", edgecolor=_MARK, hatch="////", linewidth=0.8)
            elif len(bore) > 1:
                found["end"] = "dashed: ends of arcs"
                axes.axvline(end + turn, color=_MARK, linewidth=0.9, linestyle="--")
    return list(found.values())


def _unroll(axes: Axes, data: xr.Dataset, values: np.ndarray, top: float, label: str, colours: str) -> None:
    """Values over angle and width."""
    angle, z = data["angle"].values, 1e3 * data["z"].values
    # the ring is closed, so that nothing is missing where the angle begins anew
    around = np.concatenate((angle[-1:] - 360.0, angle, angle[:1] + 360.0))
    values = values[np.r_[-1, : angle.size, 0]]
    levels = np.linspace(0.0, top, 25)
    filled = axes.contourf(around, z, values.T, levels=levels, cmap=colours)
    axes.contour(around, z, values.T, levels=levels[4::4], colors="#FFFFFF", linewidths=0.5)
    axes.figure.colorbar(filled, ax=axes, label=label, ticks=np.linspace(0.0, top, 6), format="%.3g")
    axes.set_xlim(-180.0, 180.0)
    axes.set_xticks(np.arange(-180, 181, 45))
    axes.set_ylabel("axial position [mm]")
