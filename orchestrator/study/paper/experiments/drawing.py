"""How the figures of the experiments look and where they go."""

from __future__ import annotations

from pathlib import Path

from matplotlib.figure import Figure

COLOURS = {"v1": "#D55E00", "v2": "#0072B2", "v3": "#009E73"}
"""Okabe and Ito (2008), as in all figures of the project."""
PAPER = "#4D4D4D"


def figure(width: float = 9.0, height: float = 3.9) -> Figure:
    """An empty figure of a size [inch]."""
    return Figure(figsize=(width, height), layout="constrained", dpi=150)


def save(drawn: Figure, script: str) -> None:
    """Write the figure under its script's name into the present folder."""
    path = Path(script).with_suffix(".png").name
    drawn.savefig(path)
    print(f"written: {path}")
