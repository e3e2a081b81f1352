"""Tables on the terminal, and time that is comparable on a machine others use too."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import process_time


def show(title: str, columns: Sequence[str], rows: Sequence[Sequence[object]], note: str = "") -> None:
    """Print a table, its first column to the left, the others to the right."""
    cells = [[str(value) for value in row] for row in (columns, *rows)]
    widths = [max(len(row[k]) for row in cells) for k in range(len(columns))]
    print(f"\n{title}")
    for row in cells:
        first = row[0].ljust(widths[0])
        print("  ".join([first, *(cell.rjust(w) for cell, w in zip(row[1:], widths[1:], strict=True))]))
    if note:
        print(note)


def least_time(call: Callable[[], object], *, repeats: int, rounds: int = 7) -> float:
    """Least mean processor time of `repeats` calls over some rounds [s]; the first call is not counted."""
    call()
    best = float("inf")
    for _ in range(rounds):
        begin = process_time()
        for _ in range(repeats):
            call()
        best = min(best, (process_time() - begin) / repeats)
    return best


def percent(share: float) -> str:
    """A share in per cent with three digits; "failed" if not finite, "> 1000 %" beyond that."""
    if share == float("inf") or share != share:
        return "failed"
    return "> 1000 %" if share > 10.0 else f"{100.0 * share:.3g} %"
