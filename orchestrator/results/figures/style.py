"""How every figure looks: one colour per modelling depth, units, captions.

The colours are those of Okabe and Ito (2008), which stay apart for the colour-blind
and in grey print.  Figures show MN, kN m, um, mm and N/mm² of what the record holds in SI.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle
from typing import TYPE_CHECKING

from matplotlib import colormaps
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

from bearing_fmu import depths

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

_FREE = ("#D55E00", "#0072B2", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")
"""For depths that bring no colour of their own, in turn."""
_DASHES: tuple[str | tuple[int, tuple[float, ...]], ...] = (
    "-", (0, (5, 1.2)), (0, (4, 1, 1, 1)), (0, (1.2, 1)), (0, (7, 1, 1, 1, 1, 1)),
)  # fmt: skip
"""Line styles of the depths in their order."""
OTHER_COLOUR = "#7B4F9E"
CENTRE_LINE = "#4D4D4D"
EVENT = "#000000"
MEAN = "#000000"
CONTACT = "#AA0055"
PLANAR = 0.2
"""Whirl direction below which a mode is called planar."""

WHIRL_COLOURS = {"forward": "#0072B2", "backward": "#E69F00"}
WHIRL_MAP = LinearSegmentedColormap.from_list("whirl", ["#E69F00", "#999999", "#0072B2"])
"""From backward over planar to forward."""
UNREDUCED = "#000000"
REDUCTION_LOOKS = {
    "irs": ("#D55E00", "o", 5.0),
    "irs-plain": ("#CC79A7", "D", 4.5),
    "guyan": ("#009E73", "^", 5.5),
    "craig-bampton": ("#56B4E9", "s", 7.5),
}
"""Colour, marker and its size in points of each reduction."""
REDUCTION_NAMES = {
    "irs": "IRS complemented\n(default)",
    "irs-plain": "IRS plain",
    "guyan": "Guyan",
    "craig-bampton": "CMS\n(Craig-Bampton)",
}
FONT = 9.0
DPI = 150


def depth_at(record: xr.Dataset, bearing: str | None = None) -> str:
    """Depth of one bearing; of all bearings when none is named, ``mixed`` when they differ."""
    depths = record["depth"]
    if bearing is not None:
        return str(depths.sel(bearing=bearing).values)
    found = sorted({str(value) for value in depths.values})
    return found[0] if len(found) == 1 else "mixed"


def colour_of(depth: str) -> str:
    """The colour of a modelling depth, the same in every figure."""
    known = depths.depths()
    own = {each.colour for each in known}
    free = cycle(colour for colour in _FREE if colour not in own)
    return {each.name: each.colour or next(free) for each in known}.get(depth, OTHER_COLOUR)


def dash_of(depth: str) -> str | tuple[int, tuple[float, ...]]:
    """The line style of a modelling depth, which tells it from others in grey print."""
    known = [each.name for each in depths.depths()]
    return _DASHES[known.index(depth) % len(_DASHES)] if depth in known else "-"


def reduction_look(name: str) -> tuple[str, str, float]:
    """Colour, marker and its size of a reduction; variants of one share its colour and have no marker."""
    if name in REDUCTION_LOOKS:
        return REDUCTION_LOOKS[name]
    kind = name.partition(",")[0]
    return REDUCTION_LOOKS.get(kind, ("#222222", "", 0.0))[0], "", 0.0


def reduction_name(name: str) -> str:
    """A reduction as figures and tables name it, in one or two lines; other names as they are."""
    kind, comma, variant = name.partition(",")
    return REDUCTION_NAMES.get(kind, kind) + (f"\n({variant.strip()})" if comma else "")


def along_the_shaft(count: int) -> list[tuple[float, ...]]:
    """Colours of places in their order along the shaft."""
    return [colormaps["turbo"](0.05 + 0.9 * k / max(count - 1, 1)) for k in range(count)]


def depth_name(depth: str) -> str:
    """Depth and what it stands for."""
    titles = {each.name: each.title for each in depths.depths()}
    return f"{depth.upper()}: {titles[depth]}" if depth in titles else depth


def run_name(record: xr.Dataset, bearing: str | None = None) -> str:
    """What tells a run from others of the same scenario: its depth, and that of the bearing shown."""
    depth = depth_at(record)
    if depth != "mixed":
        return depth_name(depth)
    here = f", here {depth_name(depth_at(record, bearing))}" if bearing is not None else ""
    return f"mixed depths{here}"


def row_prefix(records: Sequence[xr.Dataset], record: xr.Dataset, bearing: str | None = None) -> str:
    """What a panel's title begins with when a figure shows several runs."""
    return f"{run_name(record, bearing).partition(':')[0]}:  " if len(records) > 1 else ""


def run_caption(record: xr.Dataset) -> str:
    """Scenario, depth, coupling and macro step of a run in one line."""
    attributes = record.attrs
    parts = [str(attributes.get("title", "")), run_name(record), str(attributes.get("coupling", ""))]
    if "macro_step" in attributes:
        parts.append(f"H = {float(attributes['macro_step']) * 1e3:.3g} ms")
    if str(attributes.get("status", "finished")) != "finished":
        parts.append(f"partial run: {attributes['status']}")
    return "  ·  ".join(part for part in parts if part)


def caption(records: Sequence[xr.Dataset]) -> str:
    """The run that a figure shows, or what its runs have in common."""
    return run_caption(records[0]) if len(records) == 1 else str(records[0].attrs.get("title", ""))


def new_figure(width: float, height: float, title: str, caption: str) -> Figure:
    """An empty figure with its headline and the run it shows; sizes in inches."""
    figure = Figure(figsize=(width, height), dpi=DPI, layout="constrained")
    figure.suptitle(f"{title}\n", x=0.01, ha="left", fontsize=FONT + 4, fontweight="bold", linespacing=1.6)
    figure.text(0.01, 1.0 - 0.42 / height, caption, ha="left", va="top", fontsize=FONT, color="#444444")
    return figure


def dress(axes: Axes) -> None:
    """Quiet frame and grid."""
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(True, color="#DDDDDD", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.tick_params(labelsize=FONT - 1)
    axes.xaxis.label.set_fontsize(FONT)
    axes.yaxis.label.set_fontsize(FONT)
