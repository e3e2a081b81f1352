"""Train files with mistakes: a line a problem, with file, line or row, key, value and what is allowed."""

from __future__ import annotations

import re

import pytest

from rotor_fmu.train.file import TrainFileError, load_train
from tests.rotor_fmu.train.train_folder import edit, folder, problems

__all__ = ["folder"]


IN_TOML = [
    ("clearance = 0.00022", "clearance = -0.00022",
     ["bearing 'front': clearance = -0.00022; allowed is a number greater than 0 m"]),
    ("diameter = 0.22", "diameter = 0.25",
     ["bearing 'front': diameter = 0.25; allowed is the shaft's own diameter there, 0.22, or any "
      "with sleeve = true"]),
    ("viscosity = 0.012", "viscosity = nan",
     ["bearing 'front': viscosity = nan; allowed is a finite number"]),
    ("z = 0.35", "z = 0.36",
     ["bearing 'front': z = 0.36; allowed are boundaries of shoulders, the nearest 0.2, 0.35, 0.5"]),
    ("z = 0.35", "z = 0.0",
     ["bearing 'front': diameter = 0.22; allowed is the shaft's own diameter there, 0.24, or any "
      "with sleeve = true"]),
    ("z = 5.65", "z = 0.35",
     ["bearing 'rear': z = 0.35; allowed is more than that of 'front' before it, 0.35"]),
    ('name = "wheel-2"', 'name = "wheel-1"',
     ["wheel: name = 'wheel-1' occurs twice; allowed are unique names"]),
    ('name = "rear"', "", ["bearing number 2: name: missing; it must be given"]),
    ("mass = 1500.0", 'mass = "heavy"', ["wheel 'wheel-1': mass = 'heavy'; allowed is a number"]),
    ("[damping]", "[dampings]",
     ["dampings: unknown key; did you mean 'damping'? allowed are name, speed, balance_grade, "
      "gravity, shaft, foundation, damping, materials, wheel, bearing, coupling, mass"]),
    ('name = "small"', 'name = "small"\ngravity = -9.81',
     ["gravity = -9.81; allowed is [x, y] or [x, y, z], each a number of at most 100 m/s2, or one number, "
      'not below 0, for that much downwards (along -y), or 0 or "none"']),
    ("youngs_modulus = 210000000000.0", "youngs_modulus = 210.0",
     ["materials: steel: youngs_modulus = 210.0; allowed is a number greater than 1e+08 Pa; "
      "did you give MPa?"]),
    ("poisson_ratio = 0.3", "poisson_ratio = 0.5",
     ["materials: steel: poisson_ratio = 0.5; allowed is a number less than 0.5"]),
    ('name = "small"', 'name = "small/train"',
     ["name = 'small/train'; allowed is 1 to 40 letters a to z, digits, spaces, points, hyphens and "
      "underscores, a letter or digit first"]),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "expected"), IN_TOML)
def test_mistakes_in_the_toml(folder, old, new, expected):
    edit(folder, "train.toml", (old, new))
    found = problems(folder)
    # A name twice has the line of the second one, which is not the first that the change touched.
    text = (folder / "train.toml").read_text(encoding="utf-8").split("\n")
    for line in found:
        number = int(re.search(r"train.toml: line (\d+): ", line)[1])
        assert 1 <= number <= len(text) and text[number - 1].strip()
    plain = [re.sub(r"line \d+: ", "", line) for line in found]
    assert plain == [f"{folder / 'train.toml'}: {line}" for line in expected]


IN_CSV = [
    ("0.2,0.24,0.0,steel", "0.2,-0.24,x,steel",
     ["row 3: outer_diameter = -0.24; allowed is a number greater than 0 m",
      "row 3: inner_diameter = 'x'; allowed is a number"]),
    ("0.2,0.24,0.0,steel", "0.2,0.24,0.3,steel",
     ["row 3: inner_diameter = 0.3; allowed is less than outer_diameter, 0.24"]),
    ("0.2,0.24,0.0,steel", "0.2,0.24,0.0,gold", ["row 3: material = 'gold'; allowed are steel"]),
    ("0.2,0.24,0.0,steel", "0.2,0.24", ["row 3: 2 values; allowed are 4"]),
    ("length,outer", "len,outer",
     ["header: column 'len'; did you mean 'length'? allowed are length, outer_diameter, inner_diameter, "
      "material, rear_outer_diameter, rear_inner_diameter, stiffness_outer_diameter, "
      "stiffness_inner_diameter, counts, z, remark"]),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "expected"), IN_CSV)
def test_mistakes_in_the_table(folder, old, new, expected):
    edit(folder, "shaft.csv", (old, new))
    assert list(problems(folder)) == [f"{folder / 'shaft.csv'}: {line}" for line in expected]


def test_a_misspelt_key_offers_the_right_one(folder):
    edit(folder, "train.toml", ("clearance =", "clearence ="))
    missing, unknown = problems(folder)
    assert missing.endswith("bearing 'front': clearance: missing; it must be given")
    assert "'front': clearence: unknown key; did you mean 'clearance'? allowed are name, z," in unknown


def test_all_mistakes_of_both_files_at_once(folder):
    edit(folder, "train.toml", ("width = 0.11", "width = 0"), ("mass = 1500.0", "mass = -1"))
    edit(folder, "shaft.csv", ("0.2,0.24,", "0.2,0,"), ("0.15,0.22,", "0,0.22,"))
    found = problems(folder)
    assert len(found) == 4
    assert sum("train.toml: " in line for line in found) == 2
    assert sum("shaft.csv: row " in line for line in found) == 2


def test_a_rotor_without_bearing(folder):
    with (folder / "train.toml").open("a", encoding="utf-8") as file:
        file.write('\n[[coupling]]\nname = "c"\nz = 5.8\n')
    (line,) = problems(folder)
    assert line.endswith("bearing: none between 'c' and the rear end; allowed is at least one")


def test_not_toml(folder):
    edit(folder, "train.toml", ('name = "small"', "name = small"))
    (line,) = problems(folder)
    assert "train.toml: not TOML: Invalid value (at line 1" in line


def test_missing_table(folder):
    (folder / "shaft.csv").unlink()
    (line,) = problems(folder)
    assert "shaft.csv: not readable: " in line


def test_no_such_train():
    with pytest.raises(TrainFileError, match=r"^turbin: no such train; did you mean 'turbine'\? allowed are"):
        load_train("turbin")
