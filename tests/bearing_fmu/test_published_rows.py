"""Every row of the published bearings is met, but for the entries that are named with a reason."""

from __future__ import annotations

import math
import re

import pytest

from tests.bearing_fmu.published_rows import INDEFINITE, NAMED, PAGE, SOURCES, lund_bores, name_of
from tests.published import published as published_case

ROWS = [
    pytest.param(source, row, id=name_of(row), marks=pytest.mark.slow if source is SOURCES[-1] else ())
    for source in SOURCES
    for row in source.rows()
]


def section_of(source):
    """Lines of the page, a row each."""
    text = PAGE.read_text(encoding="utf-8").split(f"## {source.title}\n")[1].split("\n## ")[0]
    return [line for line in text.splitlines()[2:] if line]


def line_of(source, row):
    (line,) = (line for line in section_of(source) if line.startswith(f"| {name_of(row)} |"))
    return line


@pytest.mark.parametrize(("source", "row"), ROWS)
@published_case(
    "bores with grooves, lemon bores, tilting pads, full bearings: 47 rows",
    "Lund and Thomsen 1978, Someya 1989, Butenschoen 1976",
    "a quarter above what is found, by source, [row by row](bearing_fmu/reference/ROWS.md)",
)
def test_a_row_is_met_but_for_what_is_named(source, row):
    """And the page has its figures, to a unit of the third digit."""
    entries = source.solve(row)
    assert tuple(entry.name for entry in entries if entry.share > 1.0) == NAMED.get(name_of(row), ((), ""))[0]
    cells = re.findall(r"([-+\d.e]+) \(([-+\d.e]+)\)", line_of(source, row))
    for entry, (found, published) in zip(entries, cells, strict=True):
        digit = 10.0 ** (math.floor(math.log10(abs(entry.found))) - 2)
        assert float(published) == pytest.approx(entry.published, rel=1e-5)  # as written, %g
        if (name_of(row), entry.name) not in INDEFINITE:
            assert float(found) == pytest.approx(entry.found, abs=digit, rel=0.0), entry.name


def test_the_page_has_every_row():
    for source in SOURCES:
        assert [line.split(" | ")[0][2:] for line in section_of(source)] == list(map(name_of, source.rows()))
        for row in source.rows():
            missed = NAMED.get(name_of(row), ((), ""))[0]
            assert line_of(source, row).count("**") == 2 * len(missed)


@pytest.mark.parametrize("row", SOURCES[0].rows(), ids=name_of)
def test_the_default_grid_has_the_journals_of_lund_and_thomsen(row):
    for entry in lund_bores(row, columns=48)[:2]:
        assert abs(entry.found - entry.published) < {"eps": 0.0008, "phi_deg": 0.25}[entry.name]
