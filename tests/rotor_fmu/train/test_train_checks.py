"""What a train may not be: each fault with line or row, key, value, what is allowed, and the usual slip."""

from __future__ import annotations

import re

import pytest

from rotor_fmu.shaft.statics import target_loads
from rotor_fmu.train.file import load_train
from tests.faults import fault
from tests.rotor_fmu.train.train_folder import edit, folder, problems

__all__ = ["folder"]


def case(old, new, line, words, name, outcome, *, guard):
    return pytest.param(old, new, line, words, id=name, marks=fault("input", name, outcome, guard=guard))


IN_TRAIN = [
    case(
        "speed = 314.1592653589793", "speed = 3000.0", 2,
        "speed = 3000.0: the journal of 'front' would run at 330 m/s; allowed is at most 200 m/s. It is in "
        'rad/s; did you give rev/min? Those are "3000 rpm"',
        "a speed in rev/min", "exit 2; line, value, the journal's surface speed and the greatest, the unit",
        guard="rotor_fmu.train.checks:speed_problems",
    ),
    case(
        "z = 0.35", "z = 7.5", 16, "bearing 'front': z = 7.5 is outside the shaft; allowed is 0 to 6",
        "a bearing outside the shaft", "exit 2; file, line, key, value and the length of the shaft",
        guard="rotor_fmu.train.checks:_position",
    ),
    case(
        "z = 3.0", "z = 6.5", 54, "wheel 'wheel-2': z = 6.5 is outside the shaft; allowed is 0 to 6",
        "a wheel outside the shaft", "exit 2; file, line, key, value and the length of the shaft",
        guard="rotor_fmu.train.file:_checked",
    ),
    case(
        "z = 3.0", "z = 3.1", 54, "z = 3.1; allowed are boundaries of shoulders, the nearest 2.35, 3, 3.65",
        "a wheel in the middle of a shoulder", "exit 2; line, value and the nearest boundaries",
        guard="rotor_fmu.train.checks:_position",
    ),
    case(
        "[[bearing]]", '[[coupling]]\nname = "c"\nz = 0.0\n[[bearing]]', 16,
        "coupling 'c': z = 0; allowed is between the shaft's ends, 0 and 6",
        "a coupling at the very end of the shaft", "exit 2; line, value, what is allowed",
        guard="rotor_fmu.train.checks:_inside",
    ),
    case(
        "diameter = 0.22", "diameter = 0.25", 17,
        "diameter = 0.25; allowed is the shaft's own diameter there, 0.22",
        "a bearing on a journal of another diameter", "exit 2; line, value and the shaft's diameter there",
        guard="rotor_fmu.train.checks:_seat",
    ),
    case(
        "width = 0.11", "width = 0.4", 18,
        "width = 0.4; allowed is at most 0.3: the journal of this diameter reaches from z = 0.2 to 0.5",
        "a bearing wider than its journal", "exit 2; line, value, the room there is and where it lies",
        guard="rotor_fmu.train.checks:_seat",
    ),
    case(
        "clearance = 0.00022", "clearance = 0.022", 19,
        "clearance = 0.022; allowed is the radial clearance in m, 1.1e-05 to 0.0011 (1e-4 to 1e-2 of the "
        "radius) for diameter 0.22; did you give mm or the diametral one?",
        "a clearance of the wrong order of magnitude", "exit 2; line, value, range; radial, in m",
        guard="rotor_fmu.train.checks:_film",
    ),
    case(
        "roughness = 1e-06", "roughness = 5e-05", 22,
        "roughness = 5e-05; allowed is at most a tenth of the clearance, 2.2e-05 m",
        "asperities as high as the film", "exit 2; line, value, a tenth of the clearance",
        guard="rotor_fmu.train.checks:_film",
    ),
    case(
        "roughness = 1e-06", "roughness = 1.0", 22,
        "roughness = 1.0; allowed is a number of at most 0.0001 m; did you give um?",
        "a roughness in um", "exit 2; line, value, range, the likely slip",
        guard="rotor_fmu.train.schema:BearingEntry.roughness",
    ),
    case(
        "contact_modulus = 1000000000.0", "contact_modulus = 1000.0", 23,
        "contact_modulus = 1000.0; allowed is 0, for no solid contact, or at least 1e+06 Pa; did you "
        "give MPa?",
        "a contact modulus in MPa", "exit 2; line, value, range, the likely slip",
        guard="rotor_fmu.train.checks:_film",
    ),
    case(
        "viscosity = 0.012", "viscosity = 12.0", 20,
        "viscosity = 12.0; allowed is a number of at most 1 Pa s; did you give mPa s?",
        "a viscosity in mPa s", "exit 2; line, value, range, the likely slip",
        guard="rotor_fmu.train.schema:BearingEntry.viscosity",
    ),
    case(
        "youngs_modulus = 210000000000.0", "youngs_modulus = 210000", 10,
        "youngs_modulus = 210000; allowed is a number greater than 1e+08 Pa; did you give MPa?",
        "a modulus in MPa", "exit 2; line, value, range, the likely slip",
        guard="rotor_fmu.train.schema:MaterialEntry.youngs_modulus",
    ),
    case(
        "density = 7850.0", "density = 7.85", 12,
        "density = 7.85; allowed is a number greater than 100 kg/m3, or 0; did you give t/m3?",
        "a density in t/m3", "exit 2; line, value, range, the likely slip",
        guard="rotor_fmu.train.schema:MaterialEntry._is_none_or_that_of_a_solid",
    ),
    case(
        "diameter = 0.22", "diameter = 220", 17,
        "diameter = 220; allowed is a number of at most 10 m; did you give mm?",
        "a diameter in mm", "exit 2; line, value, range, the likely slip",
        guard="rotor_fmu.train.schema:BearingEntry.diameter",
    ),
    case(
        "unbalance_phase = 0.0", "unbalance_phase = 90", 50,
        "unbalance_phase = 90; allowed is a number of at most 6.3 rad; did you give degrees?",
        "a phase in degrees", "exit 2; line, value, range, the likely slip",
        guard="rotor_fmu.train.entry:angle",
    ),
    case(
        "balance_grade = 0.0025", "balance_grade = 2.5", 3,
        "balance_grade = 2.5; allowed is a number of at most 0.1 m/s; G2.5 is 2.5e-3",
        "a balance grade in mm/s", "exit 2; line, value, range, what G2.5 is",
        guard="rotor_fmu.train.entry:grade",
    ),
    case(
        "polar_inertia = 303.75", "polar_inertia = 400.0", 46,
        "polar_inertia = 400.0; allowed is at most twice the transverse_inertia, 330, which a thin disc has",
        "moments of inertia that no body has", "exit 2; line, value, the limit of the thin disc",
        guard="rotor_fmu.train.checks:_body",
    ),
    case(
        "z = 5.65", "z = 0.35", 30,
        "bearing 'rear': z = 0.35; allowed is more than that of 'front' before it, 0.35",
        "bearings out of order", "exit 2; line, both names and positions",
        guard="rotor_fmu.train.checks:order_problems",
    ),
    case(
        "viscosity = 0.012", "viscosity = 2e-5", 14,
        "bearing 'front': static load 5.603e+04 N; its film carries at most ",
        "a load that no film carries", "exit 2; bearing, load, what the film carries, Sommerfeld number",
        guard="rotor_fmu.train.checks:load_problems",
    ),
    case(
        'name = "wheel-2"', 'name = "wheel-1"', 53,
        "wheel: name = 'wheel-1' occurs twice; allowed are unique names",
        "two wheels of one name", "exit 2; line of the second, the name",
        guard="rotor_fmu.train.checks:names_twice",
    ),
    case(
        "clearance =", "clearence =", 19,
        "clearence: unknown key; did you mean 'clearance'? allowed are name, z,",
        "a misspelt key of a train", "exit 2; line, the likely spelling, all keys",
        guard="rotor_fmu.train.wording:likely",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "line", "words"), IN_TRAIN)
def test_a_fault_in_the_train(folder, old, new, line, words):
    edit(folder, "train.toml", (old, new))
    assert any(f"train.toml: line {line}: " in found and words in found for found in problems(folder)), (
        problems(folder)
    )


IN_TABLE = [
    case(
        "0.2,0.24,0.0,steel", "0.2,0.24,0.24,steel", 3,
        "inner_diameter = 0.24; allowed is less than outer_diameter, 0.24",
        "a shoulder whose bore is as wide as itself", "exit 2; file, row, both diameters",
        guard="rotor_fmu.train.schema:ShoulderRow._is_hollow_at_most",
    ),
    case(
        "0.25,0.28,0.0,steel", "0.0,0.28,0.0,steel", 7,
        "length = 0.0; allowed is a number greater than 0 m",
        "a shoulder without length", "exit 2; file, row, key, value, range",
        guard="rotor_fmu.train.entry:positive",
    ),
    case(
        "0.25,0.28,0.0,steel", "250,0.28,0.0,steel", 7,
        "length = 250.0; allowed is a number of at most 20 m; did you give mm?",
        "a shoulder in mm", "exit 2; file, row, value, range, the likely slip",
        guard="rotor_fmu.train.schema:ShoulderRow.length",
    ),
    case(
        "0.25,0.28,0.0,steel", "0.25,0.28,0.0,stel", 7,
        "material = 'stel'; did you mean 'steel'? allowed are steel",
        "an unknown material", "exit 2; file, row, the likely spelling, all materials",
        guard="rotor_fmu.train.shaft_table:unknown_materials",
    ),
    case(
        "0.25,0.28,0.0,steel", "0.25;0.28;0.0;steel", 7, "1 values; allowed are 4",
        "a table with another separator in a row", "exit 2; file, row, how many values it has",
        guard="rotor_fmu.train.table:_row",
    ),
    case(
        "0.25,0.28,0.0,steel", "1e-10,0.28,0.0,steel", 7,
        "length = 1e-10; allowed is at least 1e-05 m: leave the row out, or add it to the row before",
        "a shoulder that is left over from a sum of lengths", "exit 2; file, row, value, what to do",
        guard="rotor_fmu.train.shaft_table:shoulders_of",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "row", "words"), IN_TABLE)
def test_a_fault_in_the_table(folder, old, new, row, words):
    edit(folder, "shaft.csv", (old, new))
    assert any(f"shaft.csv: row {row}: {words}" in found for found in problems(folder)), problems(folder)


@fault(
    "input",
    "two bearings that overlap",
    "exit 2; line, both names, how far apart they must be",
    guard="rotor_fmu.train.checks:order_problems",
)
def test_bearings_that_overlap(folder):
    """Two bearings on one journal, each within its room, but in one another."""
    behind = "0.15,0.22,0.0,steel\n0.2,0.24"
    edit(folder, "shaft.csv", (behind, "0.05,0.22,0.0,steel\n" + behind.replace("0.15", "0.1")))
    text = (folder / "train.toml").read_text(encoding="utf-8")
    rear = re.search(r"\[\[bearing\]\]\nname = \"rear\".*?(?=\[\[wheel)", text, re.DOTALL)[0]
    third = rear.replace('"rear"', '"third"').replace("z = 5.65", "z = 5.7")
    edit(folder, "train.toml", (rear, rear + third))
    (found,) = problems(folder)
    assert "line 44: bearing 'third' overlaps 'rear': their middles are 0.05 m apart" in found
    assert "at least half their widths together, 0.11" in found


def test_a_shaft_that_would_lift_off_is_held_down(folder):
    """Both bearings at the front half of a shaft whose wheels hang at the rear: they carry it together."""
    edit(folder, "shaft.csv", ("0.25,0.28,0.0,steel", "0.25,0.22,0.0,steel"), ("0.4,0.4,0.0", "0.4,0.22,0.0"))
    edit(folder, "train.toml", ("z = 5.65", "z = 0.75"), ("viscosity = 0.012", "viscosity = 0.5"))
    edit(folder, "train.toml", ("viscosity = 0.012", "viscosity = 0.5"))
    train = load_train(folder)
    front, rear = target_loads(train)
    assert front < -1e5
    assert front + rear == pytest.approx(9.80665 * train.mass, rel=1e-12)


@fault(
    "input",
    "several faults in both files of a train",
    "exit 2; all of them at once, each with its line or row",
    guard="rotor_fmu.train.file:_sound",
)
def test_all_faults_of_both_files_at_once(folder):
    """What is wrong by itself does not hide what does not fit on the shaft."""
    edit(
        folder,
        "train.toml",
        ("speed = 314.1592653589793", "speed = -1"),
        ("viscosity = 0.012", "viscosity = 12"),
        ("z = 5.65", "z = 9.0"),
        ("z = 3.0", "z = 3.1"),
        ("mass = 1500.0", "mas = 1500.0"),
    )
    edit(folder, "shaft.csv", ("0.25,0.28,0.0,steel", "0.25,0.28,0.0,stel"))
    found = "\n".join(problems(folder))
    for words in (
        "train.toml: line 2: speed = -1; allowed",
        "train.toml: line 20: bearing 'front': viscosity = 12; allowed",
        "train.toml: line 30: bearing 'rear': z = 9.0 is outside the shaft; allowed is 0 to 6",
        "train.toml: line 42: wheel 'wheel-1': mass: missing",
        "train.toml: line 45: wheel 'wheel-1': mas: unknown key; did you mean 'mass'?",
        "train.toml: line 54: wheel 'wheel-2': z = 3.1; allowed are boundaries",
        "shaft.csv: row 7: material = 'stel'; did you mean 'steel'?",
    ):
        assert words in found
    assert len(found.splitlines()) == 7
