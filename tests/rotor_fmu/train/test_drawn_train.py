"""What sits on the shaft of a train as it is drawn: the example of the page, heights, gravity, sides."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import scipy.optimize

from rotor_fmu.shaft.statics import target_loads
from rotor_fmu.train.file import load_train
from rotor_fmu.train.train import Joint, Material, Train
from rotor_fmu.train.writer import write_train
from tests.faults import fault
from tests.rotor_fmu.published_rotors import uniform_shaft, with_bearings
from tests.rotor_fmu.train.train_folder import edit, folder, problems

__all__ = ["folder"]

EXAMPLE = Path(__file__).parents[2] / "examples" / "motor_compressor"
PAGE = Path(__file__).parents[3] / "rotor_fmu" / "train" / "README.md"


@pytest.fixture(scope="module")
def example():
    return load_train(EXAMPLE)


def cylinder(length, outer, inner=0.0, density=7850.0):
    return density * math.pi / 4.0 * (outer**2 - inner**2) * length


def cone(length, a, b):
    return 7850.0 * math.pi / 12.0 * length * (a * a + a * b + b * b)


def test_the_example_weighs_what_its_drawing_says(example):
    motor = 2 * cylinder(0.12, 0.08) + 2 * cylinder(0.15, 0.11) + cylinder(0.5, 0.13) + cylinder(0.11, 0.07)
    motor += cylinder(0.5, 0.3, 0.13, 7600.0) + 14.0
    compressor = cylinder(0.11, 0.07) + cylinder(0.1, 0.0755) + cylinder(0.1, 0.09, 0.0755, 8800.0)
    compressor += cone(0.12, 0.09, 0.12) + cylinder(0.36, 0.12, 0.04) + cylinder(0.24, 0.15, 0.12)
    compressor += cylinder(0.1, 0.09) + cone(0.16, 0.08, 0.06) + 14.0 + 38.0 + 30.0
    assert example.section_masses == pytest.approx((motor, compressor), rel=1e-12)
    assert example.length == pytest.approx(2.1, rel=1e-14)


def test_the_page_says_what_the_example_gives(example):
    text = PAGE.read_text(encoding="utf-8")
    loads = [float(x) for x in re.search(r"loads of (\d+), (\d+), (\d+) and (\d+) N", text).groups()]
    assert target_loads(example) == pytest.approx(loads, abs=0.5)
    assert f"{example.mass:.1f} kg" in text
    blocks = [block for block in text.split("```")[1::2] if "outer diameter" in block or "[[" in block]
    blocks = [block for block in blocks if "base =" not in block]  # of a train derived from another
    table, toml = ((EXAMPLE / name).read_text(encoding="utf-8") for name in ("shaft.csv", "train.toml"))
    for line in "".join(blocks).splitlines():
        kept = line.partition("  #")[0].strip()
        assert kept in ("", "...", "toml") or kept in table + toml, line


def test_the_motor_alone_bears_its_core_and_half_the_coupling(example):
    """No shear is needed in the coupling: each rotor stands on its own two bearings."""
    parts = [
        (s.mass, z + s.centroid) for z, s in zip(example.z, example.shoulders, strict=False) if z < 1.1499
    ] + [(14.0, 1.15)]
    mass, place = np.array(parts).T
    rear = 9.80665 * (mass @ (place - 0.06)) / 0.92
    assert target_loads(example)[:2] == pytest.approx((9.80665 * mass.sum() - rear, rear), rel=1e-12)


def test_the_example_is_the_same_after_writing(example, tmp_path):
    write_train(example, tmp_path)
    assert load_train(tmp_path) == example
    assert Train.from_json(example.to_json()) == example
    assert example.joint_of(example.couplings[0]) == Joint(4e7, 6e4, 2e3, 5.0)


UPRIGHT = [
    ("[0.0, 0.0, -9.81]", (0.0, 0.0)),
    ('["9.81 m/s2", 0]', (9.81, 0.0)),
    ("[0.0, 0.0]", (0.0, 0.0)),
    ("0.0", (0.0, 0.0)),
    ('"none"', (0.0, 0.0)),
    ("1.62", (0.0, -1.62)),
    ('"9.81 m/s2"', (0.0, -9.81)),
]


@pytest.mark.parametrize(("text", "gravity"), UPRIGHT)
def test_gravity(folder, tmp_path, text, gravity):
    edit(folder, "train.toml", ("balance_grade", f"gravity = {text}\nbalance_grade"))
    train = load_train(folder)
    assert train.gravity == gravity
    assert target_loads(train).sum() == pytest.approx(math.hypot(*gravity) * train.mass, rel=1e-12, abs=1e-9)
    write_train(train, tmp_path / "again")
    assert load_train(tmp_path / "again") == train


def test_loads_from_heights():
    """Three bearings, the middle one lowered: load over compliance goes from it to the outer ones."""
    length, diameter, lowered = 8.0, 0.2, 1e-3
    train = with_bearings(uniform_shaft(length, diameter, 8, Material("steel", 2.1e11, 0.3, 7850.0)), 0, 4, 8)

    def loads(height):
        heights = 0.0, height, 0.0
        # A clearance next to nothing: journals that hardly sink.
        seats = [replace(b, height=h, clearance=1e-12) for b, h in zip(train.bearings, heights, strict=True)]
        return target_loads(replace(train, bearings=tuple(seats)))

    section = train.shoulders[0]
    kappa = 6.0 * 1.3 / (7.0 + 6.0 * 0.3)
    compliance = length**3 / (48.0 * 2.1e11 * section.second_moment)
    compliance += length / (4.0 * kappa * section.material.shear_modulus * section.area)
    change = loads(-lowered) - loads(0.0)
    assert change == pytest.approx(lowered / compliance * np.array([0.5, -1.0, 0.5]), rel=1e-6)
    # On two supports the middle would sink under the shaft's own weight, which the third one prevents.
    weight = 9.80665 * train.mass
    sag = 5.0 * weight * length**3 / (384.0 * 2.1e11 * section.second_moment)
    sag += weight * length / (8.0 * kappa * section.material.shear_modulus * section.area)
    middle = sag / compliance
    assert loads(0.0) == pytest.approx([(weight - middle) / 2.0, middle, (weight - middle) / 2.0], rel=1e-6)

    angle, weights = np.polynomial.legendre.leggauss(60)
    angle, weights = 0.5 * np.pi * (angle + 1.0), 0.5 * np.pi * weights

    def sinks(load):
        """In the pressure of the short bearing, integrated over its half: where it bears this load."""
        b = train.bearings[0]
        size = b.viscosity * train.speed * b.diameter / 4.0 * b.width**3 / b.clearance**2

        def force(e):
            pressure = np.sin(angle) / (1.0 + e * np.cos(angle)) ** 3
            return size * e * np.array([[np.cos(angle)], [np.sin(angle)]] * pressure @ weights).ravel()

        e = scipy.optimize.brentq(lambda e: np.hypot(*force(e)) - abs(load), 1e-9, 0.9, xtol=1e-13)
        return math.copysign(b.clearance * e * abs(force(e)[0]) / np.hypot(*force(e)), load)

    for height in (0.0, 2e-4, -3e-3):
        seats = [replace(b, height=h) for b, h in zip(train.bearings, (0.0, height, 0.0), strict=True)]
        found = target_loads(replace(train, bearings=tuple(seats)))
        stands = np.array([0.0, height, 0.0]) - [sinks(load) for load in found]
        assert stands[1] - stands[0] == pytest.approx(compliance * found[1] - sag, abs=1e-9)
        assert found.sum() == pytest.approx(weight, rel=1e-9)


ELASTIC = """
[[coupling]]
name = "c"
z = 4.9
translational_stiffness = 1e8
angular_stiffness = 1e6
"""


def appended(folder, text):
    with (folder / "train.toml").open("a", encoding="utf-8") as file:
        file.write(text)


BEARING = """
[[bearing]]
name = "third"
z = {z}
diameter = 0.28
width = 0.1
clearance = 2e-4
viscosity = 0.012
sleeve = true
"""


@fault(
    "input",
    "a body at an elastic coupling that does not say on which side",
    "exit 2; line, both names, what is allowed",
    guard="rotor_fmu.train.checks:side_problems",
)
@pytest.mark.parametrize(
    ("text", "words"),
    [
        (ELASTIC.replace("z = 4.9", "z = 3.65") + '[[mass]]\nname = "m"\nz = 3.65\nmass = 1.0\n',
         "mass 'm': z = 3.65: the elastic coupling 'c' is there, too; allowed is side = front or rear"),
        ('[[mass]]\nname = "m"\nz = 3.65\nmass = 1.0\nside = "rear"\n',
         "mass 'm': side = 'rear'; allowed is it at the z of an elastic coupling"),
        (ELASTIC.replace("z = 4.9", "z = 5.65"),
         "bearing 'rear': z = 5.65: the elastic coupling 'c' is there; allowed is beside it"),
        (ELASTIC.replace("angular_stiffness = 1e6", ""),
         "coupling 'c': translational_stiffness without angular_stiffness; allowed are both"),
        ('[[coupling]]\nname = "c"\nz = 3.65\nangular_damping = 1.0\n',
         "coupling 'c': damping of a rigid coupling; allowed is it beside both stiffnesses"),
        (BEARING.format(z=5.8) + "height = 1e-4\n",
         "bearing 'front': height: missing; it must be given for all bearings or for none"),
        (BEARING.format(z=5.8) + "height = 1e-4\nload = 1e4\n",
         "bearing 'third': height = 0.0001 beside a load; allowed is one of them"),
    ],
)  # fmt: skip
def test_what_sits_on_the_shaft_does_not_fit(folder, text, words):
    edit(folder, "train.toml", ("[[wheel]]", text + "[[wheel]]"))
    assert any(words in line and re.search(r"train.toml: line \d+: ", line) for line in problems(folder)), (
        problems(folder)
    )


def test_a_sleeve_and_a_bearing_at_the_very_end(folder):
    edit(folder, "train.toml", ("z = 0.35", "z = 0.0"), ("diameter = 0.22", "diameter = 0.3\nsleeve = true"))
    train = load_train(folder)
    assert (train.bearings[0].node, train.bearings[0].diameter, train.bearings[0].sleeve) == (0, 0.3, True)
