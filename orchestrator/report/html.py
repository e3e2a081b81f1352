"""Pieces of HTML; every text is escaped."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape


class Markup(str):
    """HTML that stays as it is."""

    __slots__ = ()


def tag(name: str, /, *children: str, **attributes: str | int | None) -> Markup:
    """An element; of attributes ``_`` stands for ``-``, ``klass`` for ``class``; None is left out."""
    given = "".join(
        f' {"class" if key == "klass" else key.replace("_", "-")}="{escape(str(value))}"'
        for key, value in attributes.items()
        if value is not None
    )
    inner = "".join(
        child if isinstance(child, Markup) else escape(str(child), quote=False) for child in children
    )
    return Markup(f"<{name}{given}>{inner}</{name}>")


def void(name: str, /, **attributes: str | int) -> Markup:
    """An element without content."""
    return Markup(tag(name, **attributes).removesuffix(f"</{name}>"))


def joined(parts: Iterable[str]) -> Markup:
    """Elements one behind the other."""
    return Markup("".join(part if isinstance(part, Markup) else escape(part, quote=False) for part in parts))


def dot(kind: str) -> Markup:
    """A mark whose colour and shape say how something stands."""
    return tag("span", klass=f"dot {kind}", title=kind)


def table(
    heads: Sequence[str], rows: Iterable[Markup], texts: Sequence[int] = (), kind: str | None = None
) -> Markup:
    """A table that scrolls sideways where the screen is narrow; columns in `texts` hold words.

    One of the kind ``cards`` has a block for each row there.
    """
    cells = [tag("th", head, klass="text" if k in texts else None) for k, head in enumerate(heads)]
    head = tag("thead", tag("tr", *cells))
    return tag("div", tag("table", head, tag("tbody", *rows), klass=kind), klass="wide")


def row(cells: Sequence[str], texts: Sequence[int] = (), **attributes: str | None) -> Markup:
    """A row of a table."""
    return tag(
        "tr",
        *(tag("td", cell, klass="text" if k in texts else None) for k, cell in enumerate(cells)),
        **attributes,
    )
