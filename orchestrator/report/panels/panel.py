"""A panel: one interactive figure, and what its axes have in common with the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from orchestrator.report.source import Result
from orchestrator.scenario.schedule import from_attributes

INK, GRID, EVENT, CONTACT, CALM = "#222222", "#E3E6EA", "#6B7280", "#C8102E", "#8A9099"
Trace = dict[str, Any]
_LETTER = 0.012
"""Width of a note's letter over that of a figure on a small screen."""


@dataclass(frozen=True)
class Panel:
    """One interactive figure.

    Attributes
    ----------
    section : str
        Where it stands on the page.
    title : str
        Above it.
    traces, layout : list, dict
        As the plotting library takes them; arrays may be `orchestrator.report.encode.packed`.
    bearing : str
        Shown only while this bearing is chosen; empty for always.
    height : int
        In pixels.
    moving : dict
        What a slider below it moves, see ``page.js``.
    """

    section: str
    title: str
    traces: list[Trace]
    layout: dict[str, Any]
    bearing: str = ""
    height: int = 320
    moving: dict[str, Any] = field(default_factory=dict)

    def data(self) -> dict[str, Any]:
        """For the page's script."""
        found: dict[str, Any] = {"data": self.traces, "layout": self.layout}
        return found | ({"moving": self.moving} if self.moving else {})


def axis(title: str, **more: Any) -> dict[str, Any]:
    """An axis in the style of the page."""
    look = {"gridcolor": GRID, "zeroline": False, "linecolor": INK, "ticks": "outside", "automargin": True}
    return {"title": {"text": title, "standoff": 6}, **look, **more}


def layout(**more: Any) -> dict[str, Any]:
    """A layout in the style of the page."""
    return {
        "margin": {"l": 62, "r": 14, "t": 32, "b": 44},
        "font": {"family": "system-ui, sans-serif", "size": 12, "color": INK},
        "paper_bgcolor": "white",
        "plot_bgcolor": "white",
        "hovermode": "closest",
        "legend": {"orientation": "h", "yanchor": "bottom", "y": 1.0, "x": 0.0},
        **more,
    }


def rows(count: int, gap: float = 0.06) -> list[tuple[float, float]]:
    """Vertical spans of stacked plots, the first on top."""
    height = (1.0 - gap * (count - 1)) / count
    return [(1.0 - k * (height + gap) - height, 1.0 - k * (height + gap)) for k in range(count)]


@dataclass(frozen=True)
class Place:
    """One of the axes that stand above one another: names of abscissa and ordinate, whether the topmost."""

    x: str
    y: str
    first: bool

    def trace(self, label: str) -> dict[str, Any]:
        """What puts a line there; it is in the legend once."""
        return {"xaxis": self.x, "yaxis": self.y, "showlegend": self.first, "legendgroup": label}


def stacked(
    shown: dict[str, Any],
    abscissa: str,
    ordinates: Sequence[str],
    gap: float = 0.06,
    span: Sequence[float] | None = None,
    **look: Any,
) -> list[Place]:
    """Put axes above one another into a layout; they share the abscissa, which is named below the last.

    Parameters
    ----------
    shown : dict
        The layout.
    abscissa, ordinates : str, sequence of str
        Titles; as many axes as ordinates.
    gap : float
        Between them.
    span : sequence of float, optional
        Ends of the abscissa.
    **look
        Of the ordinates.
    """
    places = []
    for k, (title, domain) in enumerate(zip(ordinates, rows(len(ordinates), gap), strict=True)):
        tail, below = str(k + 1) if k else "", k == len(ordinates) - 1
        place = Place(f"x{tail}", f"y{tail}", k == 0)
        shown[f"yaxis{tail}"] = axis(title, domain=domain, anchor=place.x, **look)
        shown[f"xaxis{tail}"] = axis(abscissa if below else "", anchor=place.y, showticklabels=below)
        if span is not None:
            shown[f"xaxis{tail}"]["range"] = list(span)
        if k:
            shown[f"xaxis{tail}"]["matches"] = "x"
        places.append(place)
    return places


def events_of(results: Sequence[Result]) -> dict[float, str]:
    """What happens in the time that was recorded, by its instant [s], ascending."""
    found: dict[float, list[str]] = {}
    for result in results:
        for event in from_attributes(result.record.attrs).events:
            if event.time <= result.time[-1] and event.text not in found.setdefault(event.time, []):
                found[event.time].append(event.text)
    return {time: ", ".join(found[time]) for time in sorted(found)}


def time_span(results: Sequence[Result]) -> list[float]:
    """The time that was recorded [s], of all results."""
    return [float(min(r.time[0] for r in results)), float(max(r.time[-1] for r in results))]


def event_lines(results: Sequence[Result], bottom: float = 0.0) -> dict[str, Any]:
    """Shapes and a note at each instant at which something happens.

    Notes stand above the topmost axes, those near one another in several lines.
    """
    found = events_of(results)
    start, end = time_span(results)
    line = {"color": EVENT, "width": 1, "dash": "dash"}
    shapes = [
        {"type": "line", "x0": time, "x1": time, "y0": bottom, "y1": 1, "yref": "paper", "line": line}
        for time in found
    ]
    notes, ends = [], list[float]()
    for time, text in found.items():
        share = (time - start) / (end - start) if end > start else 0.0
        # so many notes as still reach to here stand below it
        level = sum(reach > share for reach in ends)
        ends.append(share + _LETTER * len(text))
        notes.append({
            "x": time, "y": 1, "yref": "paper", "text": text, "showarrow": False, "yanchor": "bottom",
            "xanchor": "left" if share < 0.5 else "right", "yshift": 13 * level,
            "font": {"size": 11, "color": EVENT},
        })  # fmt: skip
    return {"shapes": shapes, "annotations": notes}


def line(result: Result, name: str, **more: Any) -> Trace:
    """The beginning of a line of a result."""
    look = {"color": result.colour, "width": 1.3, "dash": result.dash}
    return {"type": "scatter", "mode": "lines", "name": name, "line": look | more.pop("line", {}), **more}
