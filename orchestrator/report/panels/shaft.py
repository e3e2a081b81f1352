"""The deformed shaft in space, with a slider over time."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from orchestrator.report.encode import packed
from orchestrator.report.panels.panel import CALM, CONTACT, INK, Panel, Trace, layout
from orchestrator.report.source import Result
from orchestrator.results.figures.deformation import nice, static_line, worst_instant

FRAMES, NODES = 120, 120
"""Most instants and most nodes of the film."""
PER_TURN = 12
_FORCE = "#0072B2"


def deformed_shafts(results: Sequence[Result]) -> Iterator[Panel]:
    """A panel for each result; all have the same scales."""
    films = [_Film(result) for result in results if "deflection" in result.record]
    if not films:
        return
    reach = 1.05 * max(film.reach for film in films)
    force = 1.0 * reach / max(film.largest_force for film in films)
    stress = max(film.largest_stress for film in films)
    for film in films:
        title = "Deformed shaft and bearing forces"
        title += f", {film.result.name}" if len(results) > 1 else ""
        yield Panel(
            "shaft3d",
            title,
            film.traces(force, stress),
            film.layout(reach),
            height=520,
            moving=film.moving(force),
        )


class _Film:
    """The motion of one result's shaft from its static line, in mm, at some instants and some nodes."""

    def __init__(self, result: Result) -> None:
        self.result = result
        record = result.record
        z = np.asarray(record["z"].values, dtype=float)
        self.seats = np.asarray(record["bearing_z"].values, dtype=float)
        self.worst = worst_instant(record)
        self.frames, self.nodes = _instants(result, self.worst), _nodes(z, self.seats)
        self.z = z[self.nodes]
        chosen = record.isel(time=self.frames)
        line = chosen["deflection"].transpose("axis", "time", "node").values - static_line(record).T[:, None]
        self.x, self.y = (line[:, :, self.nodes] * 1e3).astype(float)
        self.stress = chosen["stress"].transpose("time", "node").values[:, self.nodes].astype(float) * 1e-6
        self.force = chosen["force"].transpose("axis", "time", "bearing").values * 1e-3
        self.at_seats = np.array([int(np.argmin(abs(self.z - seat))) for seat in self.seats])

    @property
    def reach(self) -> float:
        """Largest deflection in mm."""
        return max(float(np.abs(self.x).max()), float(np.abs(self.y).max()), 1e-6)

    @property
    def largest_force(self) -> float:
        """In kN."""
        return max(float(np.abs(self.force).max()), 1e-9)

    @property
    def largest_stress(self) -> float:
        """In N/mm²."""
        return float(self.stress.max())

    @property
    def start(self) -> int:
        """The frame that is shown first: that of the worst instant."""
        return int(np.argmin(abs(self.frames - self.worst)))

    def traces(self, force: float, stress: float) -> list[Trace]:
        """The shaft, its axis, its bearings and their forces at the first frame."""
        k = self.start
        zero = np.zeros_like(self.z)
        shaft = _line(self.z, self.x[k], self.y[k]) | {
            "name": "shaft", "hovertemplate": "z %{x:.2f} m<br>x %{y:.3f} mm<br>y %{z:.3f} mm<extra></extra>",
            "line": {
                "width": 9, "color": packed(self.stress[k]), "colorscale": "Viridis",
                "cmin": 0, "cmax": stress,
                "colorbar": {
                    "title": {"text": "N/mm²"}, "thickness": 10, "len": 0.6, "orientation": "h", "y": 0.0,
                },
            },
        }  # fmt: skip
        axis = _line(self.z[[0, -1]], zero[[0, -1]], zero[[0, -1]]) | {
            "line": {"width": 2, "color": CALM}, "hoverinfo": "skip", "name": "axis at rest",
        }  # fmt: skip
        fx, fy, fz = _arrows(self, k, force)
        arrows = _line(fz, fx, fy) | {
            "line": {"width": 5, "color": _FORCE},
            "hoverinfo": "skip",
            "name": "force",
        }
        seats = {
            "type": "scatter3d", "mode": "markers+text", "x": self.seats.tolist(),
            "y": [0.0] * self.seats.size, "z": [0.0] * self.seats.size, "text": list(self.result.bearings),
            "textposition": [("bottom center", "top center")[k % 2] for k in range(self.seats.size)],
            "textfont": {"size": 10}, "marker": {"size": 3, "color": INK}, "hoverinfo": "text",
            "name": "bearings",
        }  # fmt: skip
        return [shaft, arrows, axis, seats, *_orbits(self)]

    def layout(self, reach: float) -> dict[str, Any]:
        """Axes in m along the shaft and in mm across it."""
        across = {"range": [-reach, reach], "gridcolor": "#E3E6EA"}
        scene = {
            "xaxis": {"title": {"text": "z [m]"}, "gridcolor": "#E3E6EA"},
            "yaxis": {"title": {"text": "x [mm]"}, **across},
            "zaxis": {"title": {"text": "y [mm]"}, **across},
            "aspectmode": "manual",
            "aspectratio": {"x": 2.6, "y": 0.8, "z": 0.8},
            "camera": {"eye": {"x": 0.35, "y": -1.75, "z": 0.55}, "center": {"x": 0, "y": 0, "z": -0.1}},
        }
        return layout(scene=scene, showlegend=False, margin={"l": 0, "r": 0, "t": 0, "b": 0})

    def moving(self, force: float) -> dict[str, Any]:
        """What the slider moves: the shaft with its stress, and the forces."""
        frames = range(self.frames.size)
        arrows = np.array([_arrows(self, k, force)[:2] for k in frames])
        values = {
            "0.y": self.x,
            "0.z": self.y,
            "0.line.color": self.stress,
            "1.y": arrows[:, 0],
            "1.z": arrows[:, 1],
        }
        errors = {"0.line.color": 0.1}
        moved = {key: packed(value, errors.get(key, 1e-3)) for key, value in values.items()}
        largest = nice(self.largest_force)
        return {
            "time": packed(self.result.time[self.frames]),
            "start": self.start,
            "values": moved,
            "note": f"forces: {largest:g} kN are {largest * force:.3g} mm",
        }


def _line(z: NDArray[np.float64], x: NDArray[np.float64], y: NDArray[np.float64]) -> Trace:
    return {"type": "scatter3d", "mode": "lines", "x": packed(z), "y": packed(x, 1e-3), "z": packed(y, 1e-3)}


def _arrows(film: _Film, frame: int, force: float) -> tuple[NDArray[np.float64], ...]:
    """Lines from each journal along the force on it, parted by nan."""
    count = film.seats.size
    x, y, z = (np.full((count, 3), math.nan) for _ in range(3))
    for k, lines in enumerate((x, y)):
        start = (film.x, film.y)[k][frame, film.at_seats]
        lines[:, 0] = start
        lines[:, 1] = start + film.force[k, frame] * force
    z[:, :2] = film.seats[:, None]
    return x.ravel(), y.ravel(), z.ravel()


def _orbits(film: _Film) -> Iterator[Trace]:
    """Paths of the journals over the revolution around the worst instant."""
    record, worst = film.result.record, film.worst
    turn = 2.0 * math.pi / abs(film.result.speed)
    time = film.result.time
    inside = np.flatnonzero(abs(time - time[worst]) <= turn / 2.0)
    node = [int(np.argmin(abs(record["z"].values - seat))) for seat in film.seats]
    line = record["deflection"].isel(time=inside, node=node).transpose("axis", "node", "time").values
    line = (line - static_line(record).T[:, node, None]) * 1e3
    gap = np.full((len(node), 1), math.nan)
    x, y = (np.hstack([part, gap]).ravel() for part in line)
    z = np.repeat(film.seats, inside.size + 1)
    yield _line(z, x, y) | {"line": {"width": 2, "color": CONTACT}, "hoverinfo": "skip", "name": "orbits"}


def _instants(result: Result, worst: int) -> NDArray[np.intp]:
    """Samples of the film: a revolution before the event, six behind it, two around the worst, the last."""
    turn, time = 2.0 * math.pi / abs(result.speed), result.time
    last = result.phases[-1].span
    spans = [(last.start - turn, last.start + 6.0 * turn), (time[worst] - turn, time[worst] + turn)]
    spans.append((time[-1] - turn, time[-1]))
    step = (time[-1] - time[0]) / (time.size - 1)
    stride = max(1, round(turn / PER_TURN / step))
    chosen = np.any([(time >= a - 1e-9) & (time <= b + 1e-9) for a, b in spans], axis=0)
    found = np.flatnonzero(chosen)
    found = found[(found - worst) % stride == 0]
    return found[:: max(1, -(-found.size // FRAMES))]


def _nodes(z: NDArray[np.float64], seats: NDArray[np.float64]) -> NDArray[np.intp]:
    """Nodes that draw the shaft: evenly spread, with the bearings'."""
    even = np.linspace(0, z.size - 1, min(z.size, NODES)).round().astype(int)
    own = [int(np.argmin(abs(z - seat))) for seat in seats]
    return np.unique(np.concatenate([even, own]))
