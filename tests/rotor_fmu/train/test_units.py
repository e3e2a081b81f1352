"""Values with units: the number that the same value has in SI, to the last bit, and what is no unit."""

from __future__ import annotations

import math
import re

import pytest

from rotor_fmu.train.file import load_train
from rotor_fmu.train.units import in_si
from tests.rotor_fmu.train.train_folder import edit, folder, problems

__all__ = ["folder"]


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("450 mm", "m", 0.45), ("35mm", "m", 0.035), ("0.5 um", "m", 5e-7), ("60 µm", "m", 6e-5),
        ("1 in", "m", 0.0254),
        ("210 GPa", "Pa", 2.1e11), ("210e3 N/mm2", "Pa", 2.1e11), ("7.85 g/cm3", "kg/m3", 7850.0),
        ("7.85 kg/dm^3", "kg/m3", 7850.0), ("20 mPa s", "Pa s", 0.02), ("20 cP", "Pa s", 0.02),
        ("3.2 t", "kg", 3200.0),
        ("40 N/um", "N/m", 4e7), ("60 kN m/rad", "N m/rad", 6e4), ("1e4 kg cm2", "kg m2", 1.0),
        ("90 deg", "rad", math.pi / 2.0), ("90°", "rad", math.pi / 2.0), ("2.5 mm/s", "m/s", 2.5e-3),
        ("3000 rev/min", "rad/s", 100.0 * math.pi), ("3000 rpm", "rad/s", 100.0 * math.pi),
        ("50 Hz", "rad/s", 100.0 * math.pi), ("0.3 krad/s", "rad/s", 300.0), ("12 kN", "N", 12e3),
    ],
)  # fmt: skip
def test_the_number_is_that_of_the_si_unit(text, unit, value):
    assert in_si(text, unit) == value


@pytest.mark.parametrize(
    ("text", "unit", "words"),
    [
        ("450", "m", 'a number in m, or in quotes with its unit, as "450 mm"'),
        ("heavy", "kg", "a number"),
        ("1,5 mm", "m", "a number with a decimal point"),
        ("450 kg", "m", "a number in m or in a unit of the same kind, as mm"),
        ("450 mn", "m", "in a unit of the same kind"),
        ("1 m**99999999", "m", "in a unit of the same kind"),
        ("1 __import__('os')", "m", "in a unit of the same kind"),
        ("50 1/s", "rad/s", "one of the units rad/s, deg/s, rev/min, Hz"),
    ],
)
def test_what_is_no_unit(text, unit, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        in_si(text, unit)


def test_units_in_a_train_give_the_train_in_si(folder):
    edit(
        folder, "train.toml",
        ("speed = 314.1592653589793", 'speed = "50 Hz"'), ("z = 0.35", 'z = "350 mm"'),
        ("diameter = 0.22", 'diameter = "22 cm"'), ("clearance = 0.00022", 'clearance = "0.22 mm"'),
        ("viscosity = 0.012", 'viscosity = "12 mPa s"'), ("density = 7850.0", 'density = "7.85 g/cm3"'),
        ("youngs_modulus = 210000000000.0", 'youngs_modulus = "210 GPa"'),
    )  # fmt: skip
    assert load_train(folder) == load_train("small")


def test_a_wrong_unit_is_named_with_its_line(folder):
    edit(folder, "train.toml", ("mass = 1500.0", 'mass = "1500 mm"'))
    (line,) = problems(folder)
    assert line.endswith(
        "line 45: wheel 'wheel-1': mass = '1500 mm'; allowed is a number in kg or in a unit of the same "
        "kind, as kg"
    )


@pytest.mark.parametrize("text", ['"50 kN/mm"', '["50 N/um", 5e7]', '[["50 MN/m", 0], [0.0, "5e4 N/mm"]]'])
def test_units_of_coefficients(folder, text):
    edit(folder, "train.toml", ("clearance = 0.00022", f"stiffness = {text}\nclearance = 0.00022"))
    given = load_train(folder).bearings[0]
    edit(folder, "train.toml", (f"stiffness = {text}", "stiffness = 5e7"))
    assert given.coefficients and given == load_train(folder).bearings[0]
