"""Bode diagram of a run whose speed changes: orders of a journal, least gap and contact over the speed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.ticker import FuncFormatter

from orchestrator.results import statistics
from orchestrator.results.figures import panels, style
from orchestrator.results.journals import probes_of
from orchestrator.results.revolutions import NAME, order_of
from orchestrator.results.windows import changing_speed

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_ORDERS = {1.0: ("1X", "-"), 0.5: ("\u00bdX", ":"), 2.0: ("2X", "--")}
_PLAIN = FuncFormatter(lambda value, _: f"{value:g}")
_MINUTE = 30.0 / math.pi


def has_speeds(records: Sequence[xr.Dataset]) -> bool:
    """Whether the speed of these runs changes, and they kept their revolutions."""
    return all(NAME in record and changing_speed(record) is not None for record in records)


def over_speed(records: Sequence[xr.Dataset], bearing: str | None = None) -> Figure:
    """Draw, from above: amplitudes of the orders, phase of 1X, least gap, contact force; a colour a run.

    Parameters
    ----------
    records : sequence of xarray.Dataset
        One run or several of the same scenario, of which `has_speeds` holds.
    bearing : str, optional
        By default the analysed bearing of the first record.
    """
    bearing = bearing or statistics.analysed_bearing(records[0])
    title = f"Bode diagram over speed, {bearing}"
    figure = style.new_figure(10.5, 9.6, title, style.caption(records))
    sizes, phase, gaps, contacts = figure.subplots(4, 1, sharex=True, height_ratios=[2.0, 1.0, 1.3, 1.0])
    for record in records:
        colour, run = style.colour_of(style.depth_at(record, bearing)), style.run_name(record, bearing)
        angle = probes_of(record)[0]
        speed = record["revolution_speed"].values * _MINUTE
        for order, (name, dash) in _ORDERS.items():
            amplitude = order_of(record, bearing, order, angle)
            label = f"{run}, {name}" if len(records) > 1 else name
            look = {"color": colour, "linestyle": dash, "linewidth": 1.3 if order == 1.0 else 0.9}
            sizes.semilogy(speed, np.maximum(np.abs(amplitude) * 1e6, 1e-3), label=label, **look)
            if order == 1.0:
                phase.plot(
                    speed,
                    np.degrees(np.angle(amplitude)),
                    color=colour,
                    linestyle="",
                    marker=".",
                    markersize=2,
                )
        of = record.sel(bearing=bearing)
        gap, contact = of["revolution_least_gap"].values * 1e6, of["revolution_contact_force"].values * 1e-3
        gaps.plot(speed, gap, color=colour, linewidth=1.0)
        contacts.plot(speed, contact, color=colour, linewidth=1.0)
        if np.isfinite(gap).any():
            worst = int(np.nanargmin(gap))
            text = f"{gap[worst]:.1f} \u00b5m at {speed[worst]:.0f} rev/min"
            gaps.annotate(text, (speed[worst], gap[worst]), xytext=(6, 6), textcoords="offset points",
                          fontsize=style.FONT - 2, color=colour, bbox=panels.PAPER)  # fmt: skip
            gaps.plot(speed[worst], gap[worst], "o", color=colour, markersize=4)
    degrees = math.degrees(probes_of(records[0])[0])
    sizes.yaxis.set_major_formatter(_PLAIN)
    top = float(sizes.dataLim.ymax)
    if math.isfinite(top):  # else no turn has an order yet
        sizes.set_ylim(max(float(sizes.dataLim.ymin), 1e-4 * top), 2.0 * top)
    sizes.set_ylabel(f"amplitude at {degrees:.0f}\u00b0 [\u00b5m]")
    phase.set_ylabel("phase of 1X [\u00b0]")
    phase.set_ylim(-180.0, 180.0)
    phase.set_yticks([-180, -90, 0, 90, 180])
    gaps.set_ylabel("least gap in a turn [\u00b5m]")
    gaps.axhline(0.0, color=style.CONTACT, linewidth=0.8)
    contacts.set_ylabel("contact force [kN]")
    if any((record["revolution_contact_force"].sel(bearing=bearing) > 0.0).any() for record in records):
        contacts.set_ylim(bottom=0.0)
    else:
        contacts.set_ylim(0.0, 1.0)
        contacts.set_yticks([0.0])
        contacts.text(0.5, 0.5, "no contact", transform=contacts.transAxes, ha="center", va="center")
    contacts.set_xlabel("speed of rotation [rev/min]")
    for axes in (sizes, phase, gaps, contacts):
        style.dress(axes)
    sizes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize=style.FONT - 1)
    return figure
