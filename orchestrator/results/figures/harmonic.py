"""Unbalance response over speed: largest amplitude, bearings, wheels, bearing forces."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestrator.results.figures import style
from orchestrator.results.quantities import HERTZ

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from rotor_fmu.train.train import Train

DECADES = 3e3
"""Largest over smallest value of an axis."""

_DASHES = ("-", (0, (5, 1.5)), (0, (1.5, 1.2)))


def harmonic_figure(shaft: xr.Dataset, places: xr.Dataset, forces: xr.Dataset, train: Train) -> Figure:
    """Four panels over speed; the first compares the reductions, the others show the unreduced shaft.

    Parameters
    ----------
    shaft, places, forces : xarray.Dataset
        From `orchestrator.commands.harmonic.harmonic_data`.
    train : Train
        For name, rated speed and rotors.
    """
    figure = style.new_figure(
        14.0,
        7.6,
        "Unbalance response over the speed of rotation",
        f"{train.name}  ·  {shaft.attrs['films']}  ·  nominal unbalance",
    )
    largest, bearings, wheels, force = figure.subplots(2, 2, sharex=True).ravel()
    rotation = shaft["rotation"].values
    for name in (str(item) for item in shaft["shaft"].values):
        values = shaft["amplitude"].sel(shaft=name).values * 1e6
        if name == "unreduced":
            largest.plot(rotation, values, color=style.UNREDUCED, linewidth=2.2, label="unreduced")
        else:
            colour, marker, size = style.reduction_look(name)
            largest.plot(
                rotation, values, color=colour, linewidth=1.0, marker=marker, markersize=size,
                markerfacecolor="none", markevery=(0, max(1, rotation.size // 20)),
                label=style.reduction_name(name),
            )  # fmt: skip
    _dress(largest, "largest amplitude of the shaft", "amplitude [µm]", shaft, train)
    full = places["amplitude"].sel(shaft="unreduced") * 1e6
    _lines(bearings, full, [seat.name for seat in train.bearings])
    _dress(bearings, "amplitude at the bearings", "amplitude [µm]", shaft, train)
    _lines(wheels, full, _liveliest_wheels(full, train))
    _dress(wheels, "amplitude at the wheels: the liveliest of each rotor", "amplitude [µm]", shaft, train)
    pull = (forces["force"].sel(shaft="unreduced") * 1e-3).rename(bearing="place")
    _lines(force, pull, [seat.name for seat in train.bearings])
    _dress(force, "bearing forces from unbalance", "force [kN]", shaft, train)
    for axes in (wheels, force):
        axes.set_xlabel("speed of rotation [Hz]")
    return figure


def _liveliest_wheels(amplitude: xr.DataArray, train: Train) -> list[str]:
    """Of each rotor the wheel with the largest amplitude at any speed."""
    best: dict[int, tuple[float, str]] = {}
    for wheel in train.wheels:
        peak = float(amplitude.sel(place=wheel.name).max())
        section = train.section_of(wheel.node)
        best[section] = max(best.get(section, (0.0, "")), (peak, wheel.name))
    return [best[section][1] for section in sorted(best)]


def _lines(axes: Axes, values: xr.DataArray, names: list[str]) -> None:
    """One line a place, colours and dashes along the shaft."""
    colours = style.along_the_shaft(len(names))
    for k, (name, colour) in enumerate(zip(names, colours, strict=True)):
        axes.plot(
            values["rotation"].values,
            values.sel(place=name).values,
            color=colour,
            linewidth=1.3,
            linestyle=_DASHES[k % len(_DASHES)],
            label=name,
        )


def _dress(axes: Axes, title: str, label: str, shaft: xr.Dataset, train: Train) -> None:
    rotation = shaft["rotation"].values
    rated = train.speed / HERTZ
    if rated <= rotation[-1]:
        axes.axvline(rated, color=style.EVENT, linewidth=0.9, linestyle=":", zorder=1)
        axes.annotate(
            f"rated {rated:g} Hz", (rated, 1.0), xycoords=("data", "axes fraction"), xytext=(3, -2),
            textcoords="offset points", fontsize=style.FONT - 1.5, va="top",
        )  # fmt: skip
    axes.set_xlim(0.0, rotation[-1])
    axes.set_yscale("log")
    axes.set_ylim(axes.dataLim.ymax / DECADES, 2.0 * axes.dataLim.ymax)
    axes.set_ylabel(label)
    axes.set_title(title, loc="left", fontsize=style.FONT + 1)
    style.dress(axes)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=style.FONT - 1)
