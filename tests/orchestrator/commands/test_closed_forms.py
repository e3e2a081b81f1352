"""Linear commands on machines with closed forms: a disc on a massless shaft, a rigid rotor on pedestals."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr
from scipy.optimize import minimize_scalar
from typer.testing import CliRunner

from orchestrator.cli.main import app
from orchestrator.linear import case
from rotor_fmu.linear.analysis import REACH
from tests.published import published

HERTZ = 2.0 * math.pi
MASS, LENGTH, UNBALANCE = 100.0, 1.0, 0.01
STIFF, DAMPER = 5e6, 4e3  # of each bearing
PEDESTAL = {"mass": (30.0, 60.0), "stiffness": (2e7, 8e7), "damping": (2e3, 9e3)}  # of each, in x and y
TOP = 60.0

HEAD = """
speed = "1800 rev/min"
balance_grade = 0.0
gravity = 0
[materials.bare]
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = 0.0
"""
BEARING = """
[[bearing]]
name = "b{z}"
z = {z}
stiffness = {stiffness}
damping = {damping}
{more}
"""
WHEEL = f"""
[[wheel]]
name = "disc"
z = {LENGTH / 2.0}
mass = {MASS}
polar_inertia = 2.0
transverse_inertia = 1.0
"""


def machine(folder, diameter, more=""):
    """A disc in the middle of a massless shaft, bearings at its very ends, and a scenario with unbalance."""
    train = folder / "train"
    train.mkdir(parents=True)
    (train / "shaft.csv").write_text(
        f"length,outer diameter,material\n{LENGTH / 2},{diameter},bare\n{LENGTH / 2},{diameter},bare\n"
    )
    seats = "".join(BEARING.format(z=z, stiffness=STIFF, damping=DAMPER, more=more) for z in (0.0, LENGTH))
    (train / "train.toml").write_text(f'name = "{folder.name}"{HEAD}{seats}{WHEEL}')
    (folder / "s.toml").write_text(
        f'train = "train"\ndepth = "linear"\nend = 0.1\n[unbalance.at.disc]\nunbalance = {UNBALANCE}\n'
    )
    return folder


@pytest.fixture(scope="module")
def commands(tmp_path_factory):
    """Results of a command on the Jeffcott rotor or the rotor on pedestals, without the figures."""
    folder, done = tmp_path_factory.mktemp("closed"), {}
    words = ", ".join(f"{key} = {list(value)}" for key, value in PEDESTAL.items())
    machine(folder / "jeffcott", 0.06)
    machine(folder / "pedestals", 6.0, f"pedestal = {{ {words} }}")

    def found(name, command, *options, file=None):
        out = folder / f"{name}-{command}"
        if out not in done:
            arguments = [command, str(folder / name / "s.toml"), *options, "--out", str(out)]
            with pytest.MonkeyPatch.context() as patch:
                patch.setattr(case, "save", lambda *_: None)
                result = CliRunner().invoke(app, arguments, env={"COLUMNS": "150", "TERM": "dumb"})
            assert result.exit_code == 0, result.output
            done[out] = result.output
        with xr.open_dataset(out / f"{file or command}.nc", engine="h5netcdf") as data:
            return data.load()

    return found


def flexibility():
    """Of the shaft's middle against its ends, with shear (Cowper)."""
    area, second = math.pi / 4.0 * 0.06**2, math.pi / 64.0 * 0.06**4
    shear = 6.0 * 1.3 / (7.0 + 6.0 * 0.3) * 2.1e11 / 2.6 * area
    return LENGTH**3 / (48.0 * 2.1e11 * second) + LENGTH / (4.0 * shear)


def disc(speed):
    """Amplitude of the disc: r = U W^2 / (k - m W^2), 1/k = shaft + 1/(2 (K + i W C))."""
    support = 2.0 * (STIFF + 1j * speed * DAMPER)
    return abs(UNBALANCE * speed**2 / (1.0 / (flexibility() + 1.0 / support) - MASS * speed**2))


def journal(speed):
    """Amplitude of the journals, which carry half of the disc's force each."""
    support = 2.0 * (STIFF + 1j * speed * DAMPER)
    return disc(speed) / abs(1.0 + support * flexibility())


def peak(amplitude, low, high):
    """Speed and height of the largest amplitude on a fine grid, refined."""
    grid = np.linspace(low, high, 4001)[1:]
    at = grid[int(np.argmax([amplitude(speed) for speed in grid]))]
    step = grid[1] - grid[0]
    best = minimize_scalar(
        lambda speed: -amplitude(speed),
        bounds=(at - step, at + step),
        method="bounded",
        options={"xatol": 1e-9},
    )
    return best.x, amplitude(best.x)


@published("peaks of the unbalance response of a Jeffcott rotor", "closed form", "1e-5")
@pytest.mark.parametrize(("place", "closed"), [("disc", disc), ("b0.0", journal)])
def test_harmonic_finds_the_peaks_of_a_jeffcott_rotor(commands, place, closed):
    """A sharp one, 0.5 % of its speed wide, between speeds of a grid of 0.5 Hz."""
    found = commands("jeffcott", "harmonic", "--to", str(TOP), file="amplitudes")
    found = found["amplitude"].sel(shaft="unreduced", place=place)
    speed, height = peak(closed, 0.0, HERTZ * TOP)
    k = int(np.argmax(found.values))
    assert found.values[k] == pytest.approx(height, rel=1e-5)
    assert float(found["rotation"][k]) * HERTZ == pytest.approx(speed, rel=1e-5)
    every = [closed(HERTZ * float(hertz)) for hertz in found["rotation"]]
    assert found.values == pytest.approx(every, rel=2e-3, abs=1e-9)


def two_masses(axis):
    """Eigenvalues [1/s] of half the rotor on its bearing on its pedestal, and their state matrix."""
    mass, stiffness, damping = (PEDESTAL[key][axis] for key in ("mass", "stiffness", "damping"))
    inverse = np.array([[2.0 / MASS], [1.0 / mass]])
    springs = inverse * np.array([[STIFF, -STIFF], [-STIFF, STIFF + stiffness]])
    dampers = inverse * np.array([[DAMPER, -DAMPER], [-DAMPER, DAMPER + damping]])
    return np.block([[np.zeros((2, 2)), np.eye(2)], [-springs, -dampers]])


def bounces():
    """Eigenvalues of the motion of both ends together, in both directions, by frequency."""
    found = np.concatenate([np.linalg.eigvals(two_masses(axis)) for axis in (0, 1)])
    found = found[found.imag > 0.0]
    return found[np.argsort(found.imag)]


@published("modes of a rigid rotor on bearings on pedestals", "closed form of two masses", "1e-5")
def test_modes_of_a_rigid_rotor_on_pedestals(commands):
    """Both ends together they are those of two masses; the others tilt."""
    data = commands("pedestals", "modes")
    ratio, turn = data["damping_ratio"].values, data["frequency"].values * HERTZ
    found = turn / np.sqrt(1.0 - ratio**2) * (-ratio + 1j * np.sqrt(1.0 - ratio**2))
    for exact in bounces():
        nearest = found[np.nanargmin(np.abs(found - exact))]
        assert abs(nearest - exact) < 2e-5 * abs(exact)


def test_stability_sees_the_pedestals(commands):
    """Critical speeds and least damped modes are those of two masses."""

    def along(axis, speed):
        load = [0.0, 0.0, (-1j) ** axis * UNBALANCE * speed**2 / MASS, 0.0]
        return np.linalg.solve(1j * speed * np.eye(4) - two_masses(axis), load)[0]

    def major(speed):
        x, y = (along(axis, speed) for axis in (0, 1))
        return (abs(x + 1j * y) + abs(x - 1j * y)) / 2.0

    speed, height = peak(major, 0.0, HERTZ * TOP)
    peaks = commands("pedestals", "stability", "--to", str(TOP), file="critical-speeds")
    k = int(np.argmax(peaks["amplitude"].values))
    assert float(peaks["speed"][k]) * HERTZ == pytest.approx(speed, rel=2e-5)
    assert float(peaks["amplitude"][k]) == pytest.approx(height, rel=2e-5)
    found = commands("pedestals", "stability", "--to", str(TOP)).sel(rotation=30.0, method="nearest")
    exact = bounces()
    exact = exact[exact.imag <= REACH * HERTZ * TOP]  # others are not among those that count at any speed
    assert exact.size == 2
    for expected in np.sort(-exact.real / np.abs(exact))[:2]:
        assert np.abs(found["damping_ratio"].values / expected - 1.0).min() < 2e-5
