"""Run-up, run-down and sudden unbalance of a Jeffcott rotor through the FMUs, on bearings of depth linear."""

import math

import numpy as np
import pytest

from orchestrator.case.simulate import simulate
from orchestrator.fmi.folder import build
from orchestrator.scenario.file import load_scenario
from rotor_fmu.train.file import load_train

MASS, OMEGA, ECCENTRICITY = 400.0, 100.0, 1e-6
TRAIN = """
name = "jeffcott"
speed = 100.0
balance_grade = 0.0
gravity = [0.0, 0.0]

[damping]
beta = "1e-9 s"

[materials.stiff]
youngs_modulus = 9e12
poisson_ratio = 0.3
density = 0.0

[[wheel]]
name = "wheel"
z = 0.5
mass = 400.0
polar_inertia = 20.0
transverse_inertia = 5000.0
mean_diameter = 1.0

[[bearing]]
name = "front"
z = 0.25
diameter = 0.4
width = 0.1
clearance = 1e-3
viscosity = 0.02
stiffness = {K}
damping = {C}

[[bearing]]
name = "rear"
z = 0.75
diameter = 0.4
width = 0.1
clearance = 1e-3
viscosity = 0.02
stiffness = {K}
damping = {C}
"""
SHAFT = "length,outer_diameter,material\n0.25,0.4,stiff\n0.25,0.4,stiff\n0.25,0.4,stiff\n0.25,0.4,stiff\n"


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """Return a function that runs a scenario on the Jeffcott rotor of a damping ratio."""

    def run(zeta, **settings):
        folder = tmp_path_factory.mktemp("jeffcott")
        K, C = 0.5 * MASS * OMEGA**2, zeta * MASS * OMEGA
        (folder / "train.toml").write_text(TRAIN.replace("{K}", repr(K)).replace("{C}", repr(C)))
        (folder / "shaft.csv").write_text(SHAFT)
        (folder / "scenario.toml").write_text('train = "."\nend = 1.0\nreduction = "none"\ndepth = "linear"')
        build(folder / "fmus", [load_train(folder)], ["linear"])
        scenario = load_scenario(folder / "scenario.toml", settings)
        record = simulate(scenario, folder / "fmus").record
        assert record.attrs["status"] in ("finished", "beyond-model"), record.attrs["message"]
        size = np.hypot(*record["displacement"].sel(bearing="front").transpose("axis", "time").values)
        return record, size / ECCENTRICITY

    return run


STEP = 2.0 * math.pi / OMEGA / 40
UNBALANCE = {"grade": 0.0, "at": {"wheel": {"unbalance": MASS * ECCENTRICITY}}}


def passage(run, zeta, rate, start, end):
    """Largest amplitude over the eccentricity, and the speed ratio there, at constant acceleration."""
    total = abs(end - start) / rate / OMEGA
    course = [[0.0, start * OMEGA], [total, end * OMEGA]]
    changes = {"end": total, "step": STEP, "record": {"interval": STEP}, "unbalance": UNBALANCE}
    record, size = run(zeta, rotation={"course": course}, **changes)
    worst = int(np.argmax(size))
    return size[worst], record["rotation_speed"].values[worst] / OMEGA


def test_passage_through_the_critical_speed(place):
    """As integrated to 1e-10, tangential force included; a course begins above 0."""
    assert passage(place, 0.02, 0.01, 0.05, 1.4) == pytest.approx((11.3084, 1.1949), rel=5e-3)
    assert passage(place, 0.02, 0.01, 3.0, 0.6) == pytest.approx((9.9574, 0.8192), rel=5e-3)


@pytest.mark.parametrize(("ratio", "steady", "peak"), [(0.5, 0.3326, 0.5754), (2.0, 1.3304, 3.2366)])
def test_sudden_unbalance(place, ratio, steady, peak):
    step = 2.0 * math.pi / OMEGA / 100
    lost = {"wheel": "wheel", "unbalance": MASS * ECCENTRICITY, "time": 0.5 * step}
    rotation = {"course": [[0.0, ratio * OMEGA]]}
    changes = {"unbalance": {"grade": 0.0}, "events": [lost], "record": {"interval": step}, "step": step}
    _, size = place(0.05, rotation=rotation, end=2600 * step, **changes)
    assert max(size) == pytest.approx(peak, rel=2e-3)
    assert size[-1] == pytest.approx(steady, rel=2e-3)
