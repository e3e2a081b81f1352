"""A train of two bearings whose FMUs are the oscillator's, to run the master as a whole."""

import math
import re
from zipfile import ZipFile

from bearing_fmu.recipe import bearing_recipe
from orchestrator.scenario.file import load_scenario
from rotor_fmu.recipe import rotor_recipe
from rotor_fmu.train.file import load_train
from tests.orchestrator.foreign import with_text

JOURNAL_MASS, INNER_MASS, GRAVITY = 100.0, 400.0, 9.80665
SHAFT_STIFFNESS, SHAFT_DAMPING = 4e6, 1e3
STIFFNESS, DAMPING, CLEARANCE = 2e7, 2e4, 8e-4
SPEED, WHEEL_MASS, GRADE = 100.0, 400.0, 2.5e-3
SHAFT_MASS = 7850.0 * math.pi / 4.0 * 0.8**2 * 3.0
WEIGHT = (JOURNAL_MASS + INNER_MASS) * GRAVITY

BEARINGS = "".join(
    f"""
[[bearing]]
name = "{name}"
z = {z}
diameter = 0.8
width = 0.4
clearance = {CLEARANCE}
viscosity = 0.02
residual_tilt_x = {tilt}
"""
    for name, z, tilt in (("front", 1.0, 1e-5), ("rear", 2.0, -2e-5))
)
TRAIN = f"""
name = "toy"
speed = {SPEED}
balance_grade = {GRADE}
[damping]
alpha = 0.0
beta = 0.0
[materials.steel]
youngs_modulus = 2.1e11
poisson_ratio = 0.3
density = 7850.0
{BEARINGS}[[wheel]]
name = "wheel"
z = 1.0
mass = {WHEEL_MASS}
polar_inertia = 1.0
transverse_inertia = 1.0
mean_diameter = 10.0
balance_factor = {WHEEL_MASS / (WHEEL_MASS + SHAFT_MASS)}
"""
SHAFT = "length,outer_diameter,inner_diameter,material\n" + 3 * "1.0,0.8,0.0,steel\n"
SCENARIO = """
title = "toy"
train = "toy"
end = 0.05
step = 1e-3
[record]
interval = 1e-3
"""


def toy_fmu_folder(toy_fmus, folder):
    """FMUs under the names and with the GUIDs that the master looks for."""
    folder.mkdir(exist_ok=True)
    train = load_train(_toy_folder(folder))
    in_the_place_of(rotor_recipe(train), toy_fmus / "two_masses.fmu", folder)
    for depth in ("v1", "v2", "v3"):
        in_the_place_of(bearing_recipe(depth), toy_fmus / "spring_damper.fmu", folder)
    return folder


def in_the_place_of(recipe, fmu, folder):
    """Copy an FMU so that it passes for that of a recipe in all but its code."""
    with ZipFile(fmu) as archive:
        text = archive.read("modelDescription.xml").decode()
    guid = re.search(r'guid="[^"]*"', text)[0]
    target = folder / recipe.file_name
    return with_text(fmu, target, "modelDescription.xml", guid, f'guid="{{{recipe.guid}}}"')


def _toy_folder(folder):
    """Write the files of the toy train."""
    (folder / "toy").mkdir(exist_ok=True)
    (folder / "toy" / "train.toml").write_text(TRAIN)
    (folder / "toy" / "shaft.csv").write_text(SHAFT)
    return folder / "toy"


def toy_scenario(folder, **overrides):
    """Scenario of the toy train, written to `folder`."""
    _toy_folder(folder)
    (folder / "toy.toml").write_text(SCENARIO)
    return load_scenario(folder / "toy.toml", overrides)
