"""Pressure and gap of the film of one bearing at its worst instants, unwrapped."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import BoundaryNorm
from numpy.typing import NDArray

from orchestrator.results import quantities, statistics
from orchestrator.results.figures import style
from orchestrator.results.worst_film import WorstFilm, worst_films

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SMALL = 0.004
"""Share of the largest pressure from which colours differ."""


def film_maps(records: Sequence[xr.Dataset], bearing: str | None = None) -> Figure | None:
    """Draw pressure (left) and gap (right) at the worst instants of each run, in the same scales.

    Of mass-conserving films a third column shows which share of the gap oil fills.

    Parameters
    ----------
    records : sequence of xarray.Dataset
        One run or several of the same scenario.
    bearing : str, optional
        By default the analysed bearing of the first record.

    Returns
    -------
    matplotlib.figure.Figure or None
        None where no film can be drawn: of units of another maker, or of earlier versions.
    """
    bearing = bearing or statistics.analysed_bearing(records[0])
    rows = [(record, worst) for record in records for worst in worst_films(record, bearing, rows=41)]
    if not rows:
        return None
    title = f"Film at the worst instants, {bearing}"
    figure = style.new_figure(12.0, 1.3 + 2.2 * len(rows), title, style.caption(records))
    contents = [worst.film.content for _, worst in rows]
    full = any(content is not None for content in contents)
    grid = figure.subplots(len(rows), 2 + full, sharex=True, sharey=True, squeeze=False)
    top = max(float(worst.film.pressure.max()) for _, worst in rows)
    gaps = [worst.film.gap for _, worst in rows]
    scales = (
        (quantities.PRESSURE, "cividis", steps(top, _SMALL * top, quantities.PRESSURE.factor)),
        (quantities.GAP, "viridis_r", _gap_steps(gaps)),
    )
    for column, (quantity, colours, levels) in enumerate(scales):
        look: dict[str, Any] = {"levels": levels, "cmap": colours, "norm": BoundaryNorm(levels, 256)}
        for row, (_, worst) in enumerate(rows):
            values = (worst.film.pressure, worst.film.gap)[column] * quantity.factor
            drawn = grid[row, column].contourf(
                np.degrees(worst.film.angle), worst.film.z * 1e3, values, **look
            )
            _mark(grid[row, column], worst)
        bar = figure.colorbar(drawn, ax=list(grid[:, column]), pad=0.015, aspect=14 * len(rows))
        bar.set_ticks(levels, labels=[f"{level:.3g}" for level in levels])
        bar.set_label(f"{quantity.label} [{quantity.unit}]".removeprefix("least "), fontsize=style.FONT)
        bar.ax.tick_params(labelsize=style.FONT - 2)
    if full:
        _draw_contents(figure, list(grid[:, 2]), [worst for _, worst in rows])
    for row, (record, worst) in enumerate(rows):
        words = f"{worst.name}: {worst.text} at {worst.time:.4f} s"
        prefix = style.row_prefix(records, record, bearing)
        for axes in grid[row]:
            axes.tick_params(labelsize=style.FONT - 1)
        grid[row, 0].set_title(prefix + words, loc="left", fontsize=style.FONT)
        grid[row, 0].set_ylabel("z [mm]", fontsize=style.FONT)
    for axes in grid[-1]:
        axes.set_xlabel("angle from x towards y [°]", fontsize=style.FONT)
        axes.set_xticks(np.arange(0.0, 361.0, 90.0 if full else 45.0))
    return figure


def _draw_contents(figure: Figure, column: Sequence[Axes], found: Sequence[WorstFilm]) -> None:
    """The share of the gap that oil fills; nothing for a film that does not know it."""
    drawn = None
    for axes, worst in zip(column, found, strict=True):
        film = worst.film
        if film.content is not None:
            look: dict[str, Any] = {"levels": np.linspace(0.0, 1.0, 11), "cmap": "Blues"}
            drawn = axes.contourf(np.degrees(film.angle), film.z * 1e3, film.content.clip(0.0, 1.0), **look)
    if drawn is not None:
        bar = figure.colorbar(drawn, ax=list(column), pad=0.015, aspect=14 * len(found))
        bar.set_label("share of the gap that oil fills", fontsize=style.FONT)
        bar.ax.tick_params(labelsize=style.FONT - 2)


def steps(largest: float, smallest: float, factor: float) -> list[float]:
    """Zero and the steps 1, 2, 5 times powers of ten that lead to a largest value, times a factor."""
    power = 10.0 ** math.floor(math.log10(max(smallest * factor, 1e-12)))
    found = [0.0]
    while found[-1] < largest * factor:
        found += [k * power for k in (1.0, 2.0, 5.0)]
        power *= 10.0
    beyond = next((k for k, value in enumerate(found) if value >= largest * factor), len(found) - 1)
    return [value for value in found[: max(beyond, 1) + 1] if value == 0.0 or value >= smallest * factor]


def _gap_steps(gaps: Sequence[NDArray[np.float64]]) -> list[float]:
    """In µm, finer where it is narrow; one step for what is below zero."""
    least, widest = (float(f([f(gap) for gap in gaps])) for f in (np.nanmin, np.nanmax))
    found = steps(widest, 0.005 * widest, quantities.GAP.factor)
    return [min(least * quantities.GAP.factor, 0.0), *found[1:]] if least < 0.0 else found


def _mark(axes: Axes, worst: WorstFilm) -> None:
    """Cross at the least gap; a line around where asperities are flattened."""
    film = worst.film
    j, i = np.unravel_index(int(np.nanargmin(film.gap)), film.gap.shape)
    place = [math.degrees(film.angle[i])], [film.z[j] * 1e3]
    for colour, size, width in (("white", 7.0, 3.0), (style.CONTACT, 6.0, 1.2)):
        cross: dict[str, Any] = {"marker": "x", "markersize": size, "markeredgewidth": width}
        axes.plot(*place, color=colour, clip_on=False, zorder=5, **cross)
    if np.nanmin(film.gap) < 0.0 < np.nanmax(film.gap):
        line: dict[str, Any] = {"levels": [0.0], "colors": [style.CONTACT], "linewidths": 1.4}
        axes.contour(np.degrees(film.angle), film.z * 1e3, film.gap, **line)
