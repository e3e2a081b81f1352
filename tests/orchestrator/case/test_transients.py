"""Run-up, run-down and sudden unbalance of a Jeffcott rotor through the FMUs, on bearings of depth linear."""

import math

import numpy as np
import pytest
from scipy.linalg import eigvals, expm

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


PEDESTAL = {"mass": (60.0, 120.0), "stiffness": (6e5, 9e5), "damping": (2e3, 5e3)}  # in x and y
SOFT, DAMPER = 2e5, 1.5e3  # of each bearing


def two_masses(axis):
    """State matrix of half the rotor and a housing, displacements first."""
    mass, stiffness, damping = (values[axis] for values in PEDESTAL.values())
    inverse = np.array([[2.0 / MASS], [1.0 / mass]])
    springs = inverse * np.array([[SOFT, -SOFT], [-SOFT, SOFT + stiffness]])
    dampers = inverse * np.array([[DAMPER, -DAMPER], [-DAMPER, DAMPER + damping]])
    return np.block([[np.zeros((2, 2)), np.eye(2)], [-springs, -dampers]])


def test_transient_of_two_masses(tmp_path):
    """A blade is lost: motion, foundation force, frequencies and damping are those of two masses, to 1e-6."""
    given = "".join(f"{key} = {list(values)!r}\n" for key, values in PEDESTAL.items())
    train = TRAIN.replace("{K}", repr(SOFT)).replace("{C}", repr(DAMPER))
    train = train.replace("damping = 1500.0\n", f"damping = 1500.0\n[bearing.pedestal]\n{given}")
    (tmp_path / "train.toml").write_text(train.replace('beta = "1e-9 s"', "beta = 1e-12"))
    (tmp_path / "shaft.csv").write_text(SHAFT)
    (tmp_path / "s.toml").write_text(
        'train = "."\nend = 0.06\nstep = 2e-5\nreduction = "none"\ndepth = "linear"'
    )
    build(tmp_path / "fmus", [load_train(tmp_path)], ["linear"])
    lost, every = 2e-4, 2e-4
    event = {"wheel": "wheel", "unbalance": MASS * ECCENTRICITY, "time": lost}
    changes = {"events": [event], "unbalance": {"grade": 0.0}, "record": {"interval": every}}
    record = simulate(load_scenario(tmp_path / "s.toml", changes), tmp_path / "fmus").record
    time = record["time"].values
    names = ("displacement", "housing_displacement", "velocity", "housing_velocity")
    for axis in (0, 1):
        of, matrix = record.sel(bearing="front", axis="xy"[axis]), two_masses(axis)
        load = [0.0, 0.0, (-1j) ** axis * ECCENTRICITY * OMEGA**2, 0.0]
        steady = np.linalg.solve(1j * OMEGA * np.eye(4) - matrix, load)
        forced = np.real(steady[:, None] * np.exp(1j * OMEGA * time))
        first = np.real(steady * np.exp(1j * OMEGA * lost))
        free = np.array([expm(matrix * max(0.0, t - lost)) @ first for t in time]).T
        exact = np.where(time > lost, forced - free, 0.0)
        found = np.array([of[name].values - of[name].values[0] for name in names])
        size = np.abs(exact).max(axis=1, keepdims=True)
        assert (np.abs(found - exact) / size).max() < 1e-6
        _, spring, damper = (values[axis] for values in PEDESTAL.values())
        force = of["foundation_force"].values - of["foundation_force"].values[0]
        np.testing.assert_allclose(
            force, spring * found[1] + damper * found[3], atol=1e-6 * np.abs(force).max()
        )
        rest = (found - forced)[:, time > lost - 0.5 * every]
        step = np.linalg.lstsq(rest[:, :-1].T, rest[:, 1:].T, rcond=None)[0]
        rates = np.sort_complex(np.log(eigvals(step)) / every)
        np.testing.assert_allclose(rates, np.sort_complex(eigvals(matrix)), rtol=1e-6)


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
