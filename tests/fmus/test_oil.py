"""The viscosity of an oil: worked examples of its standards, grades, curves."""

from __future__ import annotations

import pytest

from fmus import port
from fmus.port import oil
from fmus.port.oil import Oil, viscosity_index


@pytest.mark.parametrize(("at_40", "at_100", "index"), [(73.30, 8.86, 92), (22.83, 5.05, 156)])
def test_viscosity_index_of_the_standards_examples(at_40, at_100, index):
    """ASTM D2270, examples of its procedures A and B, rounded as there."""
    assert round(viscosity_index(at_40, at_100)) == index


REFERENCE_OILS = (
    (2, 7.994, 6.394), (3, 15.49, 12.15), (4, 25.32, 19.56), (5, 40.23, 28.49), (6, 57.97, 38.19),
    (7, 78, 48.57), (8, 100, 59.6), (10, 147.7, 82.87), (12, 201.9, 108), (15, 296.5, 149.7),
    (20, 493.2, 229.5), (30, 1023, 421.7), (40, 1730, 651.8), (55, 3126, 1066), (70, 4905, 1558),
)  # fmt: skip
"""Viscosities in mm2/s of ASTM D2270-10, table 1: at 100 degrees Celsius, and at 40 of the oils of index 0
and 100, as the package chemicals 1.5.2 holds it; its 311 rows are all met within 0.1 %."""


@pytest.mark.parametrize(("at_100", "index_0", "index_100"), REFERENCE_OILS)
def test_reference_oils_of_the_table(at_100, index_0, index_100):
    slope = 100.0 / (index_0 - index_100)  # of the index by the viscosity
    assert viscosity_index(index_0, at_100) == pytest.approx(0.0, abs=1e-3 * index_0 * slope)
    assert viscosity_index(index_100, at_100) == pytest.approx(100.0, abs=1.5e-3 * index_100 * slope)


def test_temperature_of_a_viscosity():
    found = Oil.of_grade(46)
    for kelvin in (290.0, 313.15, 345.0):
        assert found.temperature(found.kinematic(kelvin)) == pytest.approx(kelvin, rel=1e-12)


def test_reference_oils_join_smoothly():
    """The pieces of the standard meet to its rounding, and both oils get thicker."""
    for y, *_ in oil._REFERENCE[1:]:
        for index in (0.0, 100.0):

            def at_40(at, index=index):
                _, a, b, c, d, e, f = next(row for row in reversed(oil._REFERENCE) if at >= row[0])
                return (a * at + b) * at + c if index == 0.0 else (d * at + e) * at + f

            assert at_40(y - 1e-9) == pytest.approx(at_40(y), rel=2e-3)


@pytest.mark.parametrize("grade", [22, 32, 46, 68, 100, 150, 220])
@pytest.mark.parametrize("index", [50.0, 95.0, 130.0])
def test_a_grade_has_its_viscosity_and_its_index(grade, index):
    found = Oil.of_grade(grade, index)
    assert found.kinematic(313.15) == pytest.approx(grade * 1e-6, rel=1e-12)
    assert found.kinematic(373.15) == pytest.approx(found.at_100, rel=1e-12)
    assert viscosity_index(found.at_40 * 1e6, found.at_100 * 1e6) == pytest.approx(index, abs=1e-6)
    assert found.dynamic(313.15, 870.0) == pytest.approx(870.0 * grade * 1e-6, rel=1e-12)


def test_curve_is_straight_in_walthers_coordinates():
    """Between 40 and 100 degrees Celsius, against the formula itself, for VG 46 of index 95 at 60 degrees."""
    from math import log10

    found = Oil.of_grade(46)
    w = [log10(log10(found.kinematic(t) * 1e6 + 0.7)) for t in (313.15, 333.15, 373.15)]
    x = [log10(t) for t in (313.15, 333.15, 373.15)]
    assert (w[1] - w[0]) / (x[1] - x[0]) == pytest.approx((w[2] - w[1]) / (x[2] - x[1]), rel=1e-12)


@pytest.mark.parametrize("pair", [(4e-5, 5e-5), (4e-5, 1e-7), (0.2, 1e-3)])
def test_what_is_no_oil_is_refused(pair):
    with pytest.raises(ValueError, match=r"viscosity_100 = .*; allowed is"):
        Oil(*pair)
    with pytest.raises(ValueError, match="VG 47; allowed are VG 2, 3"):
        Oil.of_grade(47)
    assert 46 in port.GRADES
