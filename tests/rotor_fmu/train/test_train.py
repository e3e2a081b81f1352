"""The train as data: round trips, derived quantities, the bundled trains."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from rotor_fmu.train import turbine_designs
from rotor_fmu.train.file import DATA, bundled_trains, load_train
from rotor_fmu.train.train import Train
from rotor_fmu.train.turbine_designs import DESIGNS
from rotor_fmu.train.turbine_geometry import TurbineDesign, turbine_train
from rotor_fmu.train.writer import shaft_csv, train_toml, write_train


@pytest.fixture(scope="module")
def turbine():
    return load_train("turbine")


@pytest.mark.parametrize("name", bundled_trains())
class TestRoundTrips:
    def test_json(self, name):
        train = load_train(name)
        # Floats that have no short decimal representation survive as well.
        odd = replace(train, speed=math.pi / 3.0, rayleigh_beta=5e-324 + 1.1e-5)
        odd = replace(odd, bearings=tuple(replace(b, load=1.0e6 / 3.0) for b in odd.bearings))
        assert Train.from_json(odd.to_json()) == odd
        assert Train.from_json(train.to_json()).to_json() == train.to_json()

    def test_files(self, name, tmp_path):
        train = load_train(name)
        write_train(train, tmp_path)
        assert load_train(tmp_path) == train
        assert load_train(tmp_path / "train.toml") == train


def test_bundled_trains():
    assert bundled_trains() == ("small", "turbine")


def test_committed_turbine_is_what_its_geometry_draws(turbine):
    drawn = turbine_train()
    assert drawn == turbine
    folder = DATA / "turbine"
    assert (folder / "shaft.csv").read_text(encoding="utf-8") == shaft_csv(drawn)
    assert (folder / "train.toml").read_text(encoding="utf-8") == train_toml(drawn)


@pytest.mark.parametrize("name", DESIGNS)
def test_committed_designs_are_what_their_geometry_draws(name):
    assert load_train(f"turbine/{name}") == turbine_designs.drawn(name)
    for file, text in turbine_designs.files(name).items():
        assert (DATA / "turbine" / file).read_text(encoding="utf-8") == text


class TestTheTurbine:
    def test_figures_of_the_paper(self, turbine):
        assert len(turbine.shoulders) == 278
        assert turbine.length == 68.0
        diameters = [s.outer_diameter for s in turbine.shoulders]
        assert (min(diameters), max(diameters)) == (0.45, 1.6)
        assert len(turbine.bearings) == 11
        assert turbine.speed == 2.0 * math.pi * 25.0

    def test_rotors(self, turbine):
        assert [b.name for b in turbine.bearings] == [
            *("HP-front", "HP-rear", "LP1-front", "LP1-rear", "LP2-front", "LP2-rear"),
            *("LP3-front", "LP3-rear", "GEN-front", "GEN-rear", "EXC"),
        ]
        assert [c.name for c in turbine.couplings] == ["HP-LP1", "LP1-LP2", "LP2-LP3", "LP3-GEN", "GEN-EXC"]
        per_rotor = [sum(first < b.node < last for b in turbine.bearings) for first, last in turbine.sections]
        assert per_rotor == [2, 2, 2, 2, 2, 1]
        for lp in ("LP1", "LP2", "LP3"):
            assert sum(w.name.startswith(f"{lp}-") for w in turbine.wheels) == 9
        assert 0.9e6 < turbine.mass < 1.45e6

    def test_bearings_are_plausible(self, turbine):
        from rotor_fmu.shaft.statics import target_loads

        loads = target_loads(turbine)
        numbers = [b.sommerfeld(f, turbine.speed) for b, f in zip(turbine.bearings, loads, strict=True)]
        assert all(1.0 < so < 5.0 for so in numbers)
        assert loads[2:8] == pytest.approx([1.8e6] * 6, rel=0.03)
        assert numbers[2:8] == pytest.approx([4.3] * 6, rel=0.03)

    def test_rigid_wheels_have_possible_inertias(self, turbine):
        for wheel in turbine.wheels:
            # Polar inertia at most twice the transverse one, the limit of a thin disc.
            assert 0.0 < wheel.polar_inertia <= 2.0 * wheel.transverse_inertia

    def test_nominal_unbalance_follows_the_balance_grade(self, turbine):
        eccentricity = 2.5e-3 / turbine.speed
        assert eccentricity == pytest.approx(15.9e-6, rel=1e-3)
        by_name = dict(zip((w.name for w in turbine.wheels), turbine.nominal_unbalance, strict=True))
        _, lp, _, _, generator, _ = turbine.section_masses
        assert sum(turbine.section_masses) == pytest.approx(turbine.mass, rel=1e-12)
        assert by_name["LP1-9"] == pytest.approx(0.95 * eccentricity * lp / 9.0)
        assert by_name["LP1-5"] == 0.0
        assert by_name["GEN-3"] == pytest.approx(10.2 * eccentricity * generator / 5.0)

    @pytest.mark.parametrize("core", [1.05, 1.16, 1.30])
    def test_other_designs_keep_the_size(self, core):
        train = turbine_train(TurbineDesign(lp_core_diameter=core, lp_wheel_mass=29e3))
        assert len(train.shoulders) == 278
        assert train.length == 68.0
