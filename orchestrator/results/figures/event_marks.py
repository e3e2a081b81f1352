"""Marks of the events in panels over time."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from orchestrator.results.figures import panels, style
from orchestrator.results.windows import instants
from orchestrator.scenario.schedule import from_attributes

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

_SIDE_BY_SIDE = 2
"""Events that are named beside one another."""
_LINE = 0.15  # inches of a line of text


def draw_events(axes: Axes, view: panels.View, record: xr.Dataset, *, named: bool = True) -> None:
    """Mark the events; names that would lie over an axis or one another stand upright, or are joined."""
    schedule = from_attributes(record.attrs)
    words: dict[float, str] = {}
    for event in instants(record):
        if view.start <= event <= view.end:
            axes.axvline(
                view.shown(event), color=style.EVENT, linewidth=1.0, linestyle=(0, (4, 2)), zorder=1.5
            )
            labels = dict.fromkeys(one.label for one in schedule.events if one.time == event)
            words[event] = ", ".join(labels)
    if not named or not words:
        return
    figure = axes.get_figure(root=True)
    assert figure is not None
    inch = (view.end - view.start) / (axes.get_position().width * float(figure.get_size_inches()[0]))  # s
    starts = [view.start, *words]
    crowded = any(
        panels.LETTER * len(text) * inch > at - start
        for start, (at, text) in zip(starts, words.items(), strict=False)
    )
    upright = len(words) > _SIDE_BY_SIDE or crowded
    joined: list[tuple[float, list[str]]] = []
    last = -math.inf
    for event, text in words.items():
        if upright and event - last < _LINE * inch:
            joined[-1][1].append(text)
        else:
            joined.append((event, [text]))
        last = event
    for event, texts in joined:
        axes.annotate(
            ", ".join(texts),
            (view.shown(event), 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(-3, -2),
            textcoords="offset points",
            ha="right",
            va="top",
            fontsize=style.FONT - 1.5,
            color=style.EVENT,
            rotation=90.0 if upright else 0.0,
            bbox=panels.PAPER,
            zorder=5.5,
        )
