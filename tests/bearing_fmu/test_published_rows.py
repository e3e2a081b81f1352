"""Every row of the published bearings is met, but for the entries that are named with a reason."""

from __future__ import annotations

import pytest

from tests.bearing_fmu.published_rows import NAMED, PAGE, SOURCES, name_of
from tests.published import published as published_case

ROWS = [
    pytest.param(source, row, id=name_of(row), marks=pytest.mark.slow if source is SOURCES[-1] else ())
    for source in SOURCES
    for row in source.rows()
]


@pytest.mark.parametrize(("source", "row"), ROWS)
@published_case(
    "bores with grooves, lemon bores, tilting pads, full bearings: 47 rows",
    "Lund and Thomsen 1978, Someya 1989, Butenschoen 1976",
    "as the tables state, [row by row](bearing_fmu/reference/ROWS.md)",
)
def test_a_row_is_met_but_for_what_is_named(source, row):
    missed = tuple(entry.name for entry in source.solve(row) if entry.share > 1.0)
    assert missed == NAMED.get(name_of(row), ((), ""))[0]


def test_the_page_has_every_row():
    text = PAGE.read_text(encoding="utf-8")
    for source in SOURCES:
        section = text.split(f"## {source.title}\n")[1].split("\n## ")[0]
        assert [line.split(" | ")[0][2:] for line in section.splitlines()[2:] if line] == list(
            map(name_of, source.rows())
        )
        for row in source.rows():
            missed = NAMED.get(name_of(row), ((), ""))[0]
            (line,) = (line for line in section.splitlines() if line.startswith(f"| {name_of(row)} |"))
            assert line.count("**") == 2 * len(missed)
