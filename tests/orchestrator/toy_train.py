"""A train of two bearings whose FMUs are the oscillator's, to run the master as a whole."""

import math
import shutil

from orchestrator.scenario.file import load_scenario

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
    """FMUs under the names that the master looks for."""
    folder.mkdir(exist_ok=True)
    shutil.copy(toy_fmus / "two_masses.fmu", folder / "rotor_toy.fmu")
    for depth in ("v1", "v2", "v3"):
        shutil.copy(toy_fmus / "spring_damper.fmu", folder / f"bearing_{depth}.fmu")
    return folder


def toy_scenario(folder, **overrides):
    """Scenario of the toy train, written to `folder`."""
    (folder / "toy").mkdir(exist_ok=True)
    (folder / "toy" / "train.toml").write_text(TRAIN)
    (folder / "toy" / "shaft.csv").write_text(SHAFT)
    (folder / "toy.toml").write_text(SCENARIO)
    return load_scenario(folder / "toy.toml", overrides)
