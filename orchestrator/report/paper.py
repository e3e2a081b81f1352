"""Figures on sheets of paper: as many below one another as find room, so that little stays white."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from io import BytesIO

from matplotlib.figure import Figure
from pypdf import PageObject, PdfReader, PdfWriter, Transformation

PAPER = (8.27, 11.69)
"""A4, in inches."""
MARGIN = 0.4
_POINT, _SPACE = 72.0, 0.12  # points of an inch; inches between figures
_LARGEST = 0.75
"""Scale of figures that would not need a smaller one, so that their letters are alike."""


def on_paper(words: Sequence[Figure], figures: Iterable[Figure], information: dict[str, str]) -> bytes:
    """A PDF of pages of words, each a sheet, and of figures behind them.

    Parameters
    ----------
    words : sequence of Figure
        Of the size of the paper.
    figures : iterable of Figure
        Of any size; each is put where there is room, those behind it may come before it on the sheet.
    information : dict
        Of the document, such as its title.
    """
    writer = PdfWriter()
    for figure in words:
        writer.add_page(_page(figure))
    for sheet in _sheets([_page(figure) for figure in figures]):
        page = writer.add_blank_page(*(inches * _POINT for inches in PAPER))
        top = PAPER[1] - MARGIN
        for found, scale in sheet:
            top -= scale * _size(found)[1]
            place = Transformation().scale(scale).translate(MARGIN * _POINT, top * _POINT)
            page.merge_transformed_page(found, place)
            top -= _SPACE
    writer.add_metadata({f"/{key}": value for key, value in information.items()})
    writer.compress_identical_objects()
    content = BytesIO()
    writer.write(content)
    return content.getvalue()


def _page(figure: Figure) -> PageObject:
    """The figure as a page of its own."""
    content = BytesIO()
    figure.savefig(content, format="pdf", metadata={"CreationDate": None})
    return PdfReader(content).pages[0]


def _size(page: PageObject) -> tuple[float, float]:
    """Width and height in inches."""
    return float(page.mediabox.width) / _POINT, float(page.mediabox.height) / _POINT


def _sheets(pages: Sequence[PageObject]) -> list[list[tuple[PageObject, float]]]:
    """Pages and their scales, sheet by sheet; each goes to the first sheet that has room for it."""
    wide, high = (side - 2.0 * MARGIN for side in PAPER)
    sheets: list[list[tuple[PageObject, float]]] = []
    room: list[float] = []
    for page in pages:
        width, height = _size(page)
        scale = min(_LARGEST, wide / width, high / height)
        needed = scale * height + _SPACE
        at = next((k for k, left in enumerate(room) if needed <= left + _SPACE), len(sheets))
        if at == len(sheets):
            sheets.append([])
            room.append(high)
        sheets[at].append((page, scale))
        room[at] -= needed
    return sheets
