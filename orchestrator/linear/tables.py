"""How the tables of the linear investigations look: modes, shafts, errors."""

from __future__ import annotations

from rich import box
from rich.table import Table

from orchestrator.results.figures.style import PLANAR
from orchestrator.results.quantities import HERTZ
from rotor_fmu.linear.analysis import LeastDamped

_COLUMNS = {"irs": "IRS", "irs-plain": "IRS\nplain", "guyan": "Guyan", "craig-bampton": "CMS"}
COLUMNS_EXPLAINED = "IRS: complemented, the default of runs; IRS plain: as published; CMS: Craig-Bampton."


def table_of(title: str, *, narrow: bool = False) -> Table:
    """A table without columns yet, title and caption at its left; `narrow` spares room between columns."""
    table = Table(
        title=title,
        box=box.SIMPLE_HEAD,
        title_justify="left",
        collapse_padding=narrow,
        pad_edge=not narrow,
    )
    table.caption_justify = "left"
    return table


def whirl_name(direction: float) -> str:
    """Whirl direction, from -1 to 1, in a word and a number."""
    if abs(direction) < PLANAR:
        return f"planar   {direction:+.2f}"
    return f"{'forward' if direction > 0.0 else 'backward':8s} {direction:+.2f}"


def warning(mode: LeastDamped, speed: float) -> str:
    """The line for a train that is unstable at a speed [rad/s], nothing for a stable one."""
    if mode.stable:
        return ""
    return (
        f"UNSTABLE at {speed / HERTZ:.4g} Hz of rotation: the mode of {mode} grows. "
        "What is linear here is no motion that lasts."
    )


def shaft_column(name: str) -> str:
    """A shaft as the head of a table's column names it."""
    kind, comma, variant = name.partition(", ")
    return _COLUMNS.get(kind, kind.replace(" ", "\n")) + (
        f"\n{variant.replace('iterations', 'it.')}" if comma else ""
    )


def error_text(error: float, good: float) -> str:
    """A relative error; green up to what is good."""
    return f"[green]{error:.0e}[/green]" if error <= good else f"{error:.0e}"
