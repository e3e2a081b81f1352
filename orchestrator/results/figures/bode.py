"""Bode diagram: amplitude and phase of the unbalance response at the probes of the bearings."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results.figures import style
from orchestrator.results.quantities import HERTZ

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from rotor_fmu.train.train import Train

DECADES = 3e3
"""Largest over smallest amplitude of the axis."""

_DASHES = ("-", (0, (5, 1.5)), (0, (1.5, 1.2)), (0, (5, 1.2, 1.2, 1.2)))


def bode_figure(probes: xr.Dataset, train: Train) -> Figure:
    """Two panels over speed, a colour a bearing, dashes a probe.

    Parameters
    ----------
    probes : xarray.Dataset
        From `orchestrator.commands.harmonic.probe_data`.
    train : Train
        For name and rated speed.
    """
    figure = style.new_figure(
        13.0,
        7.6,
        "Bode diagram of the unbalance response at the bearings",
        f"{train.name}  ·  {probes.attrs['films']}  ·  nominal unbalance, unreduced shaft",
    )
    amplitude, phase = figure.subplots(2, 1, sharex=True)
    rotation = probes["rotation"].values
    names = [str(name) for name in probes["bearing"].values]
    shown = [str(name) for name in probes["probe"].values][2:] or ["x", "y"]
    for name, colour in zip(names, style.along_the_shaft(len(names)), strict=True):
        for k, probe in enumerate(shown):
            line = probes.sel(bearing=name, probe=probe)
            look = {"color": colour, "linewidth": 1.2, "linestyle": _DASHES[k % len(_DASHES)]}
            amplitude.semilogy(rotation, 1e6 * line["amplitude"].values, label=f"{name}, {probe}", **look)
            phase.plot(rotation, np.degrees(np.unwrap(line["phase"].values)), **look)
    top = 1e6 * float(probes["amplitude"].max())
    amplitude.set_ylim(top / DECADES, 2.0 * top)
    amplitude.set_ylabel("amplitude [µm]")
    amplitude.set_title("amplitude along the probes", loc="left", fontsize=style.FONT + 1)
    phase.set_ylabel("phase [degrees]")
    phase.set_title("phase; falls by 180 degrees through a resonance", loc="left", fontsize=style.FONT + 1)
    phase.set_xlabel("speed of rotation [Hz]")
    phase.set_xlim(rotation[0], rotation[-1])
    for axes in (amplitude, phase):
        if train.speed / HERTZ <= rotation[-1]:
            axes.axvline(train.speed / HERTZ, color=style.EVENT, linewidth=0.9, linestyle=":", zorder=1)
        style.dress(axes)
    columns = 1 + len(names) * len(shown) // 20
    amplitude.legend(
        loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize=style.FONT - 1, ncols=columns
    )
    return figure
