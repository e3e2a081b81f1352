"""The search over the whole table: designs stand where rows 1, 2, 3, 5 ask; a table grows."""

from dataclasses import replace

import numpy as np
import pytest

from bearing_fmu.film import make_film
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.static.equilibrium import carried
from orchestrator.scenario.scenario import Scenario
from orchestrator.study.paper.calibration import explore
from orchestrator.study.paper.calibration.explore import RANGES, Range, sample
from orchestrator.study.paper.calibration.fracture import Blade, Means, figures, rows_met
from orchestrator.study.paper.calibration.search import design_value
from orchestrator.study.paper.calibration.statics import settled
from rotor_fmu.shaft.statics import target_loads
from rotor_fmu.train.turbine_designs import SUBHARMONIC
from rotor_fmu.train.turbine_geometry import JournalDesign, TurbineDesign, turbine_train
from tests.orchestrator.study.paper_runs import runs

WIDE = TurbineDesign(lp_core_diameter=1.136, lp=JournalDesign(0.832, 0.848, 1e-3, -1e-5))


@pytest.fixture(scope="module")
def stood():
    return settled(WIDE)


def test_a_settled_design_carries_the_papers_load(stood):
    train = turbine_train(stood)
    seat = next(seat for seat in train.bearings if seat.name == "LP1-front")
    load = target_loads(train)[train.bearings.index(seat)]
    assert load == pytest.approx(1.8e6, rel=1e-9)
    assert seat.sommerfeld(load, train.speed) == pytest.approx(4.3, rel=1e-5)


@pytest.mark.parametrize(("depth", "tilted", "gap"), [("v1", 1.0, 100e-6), ("v2", 0.0, 115e-6)])
def test_a_settled_journal_stands_where_the_papers_does(stood, depth, tilted, gap):
    train = turbine_train(stood)
    seat = next(seat for seat in train.bearings if seat.name == "LP1-front")
    film = make_film(
        depth,
        BearingParameters(seat.diameter, seat.width, seat.clearance, seat.viscosity, columns=48, rows=8),
    )
    tilts = (tilted * stood.lp.residual_tilt, 0.0)
    found = carried(film, (0.0, -1.8e6), train.speed, tilts=tilts)
    assert found.response.h_min == pytest.approx(gap, rel=2e-5)


def test_a_tilt_of_the_other_sign_moves_the_least_gap_to_the_other_end(stood):
    other = settled(replace(WIDE, lp=replace(WIDE.lp, residual_tilt=1e-5)))
    assert other.lp.residual_tilt == pytest.approx(-stood.lp.residual_tilt, rel=1e-9)
    assert other.viscosity == pytest.approx(stood.viscosity, rel=1e-9)


def test_no_journal_stands_so():
    with pytest.raises(ValueError, match="no clearance between"):
        settled(replace(WIDE, lp=JournalDesign(0.3, 0.5, 1e-3)))
    with pytest.raises(ValueError, match=r"lp: a journal 0.9568 m wide; there is room for 0.918 m"):
        settled(replace(WIDE, lp=JournalDesign(0.832, 1.15, 1e-3)))


def test_samples_fill_their_ranges_and_have_a_number_each():
    drawn = [sample(number) for number in range(32)]
    for r in RANGES:
        shares = np.array([r.share(values[r.name]) for values in drawn])
        assert np.all((shares >= 0.0) & (shares < 1.0))
        counts, _ = np.histogram(shares, 8, (0.0, 1.0))
        assert list(counts) == [4] * 8  # Sobol's points: the same number in each part
    assert sample(7) == drawn[7]


def test_a_look_around_keeps_near():
    middle = sample(3)
    for r in RANGES[:-2]:
        shares = [r.share(sample(number, middle)[r.name]) - r.share(middle[r.name]) for number in range(16)]
        assert max(map(abs, shares)) <= explore.NEAR and max(shares) > 0.5 * explore.NEAR
    assert sample(5, middle)["wheel"] == middle["wheel"]


def test_range_in_its_logarithm():
    assert Range("x", 1.0, 100.0, log=True).at(0.5) == pytest.approx(10.0)
    assert Range("x", 1.0, 100.0, log=True).share(10.0) == pytest.approx(0.5)


@pytest.mark.parametrize("depth", ["v1", "v2", "v3"])
def test_means_make_scenarios(depth):
    train = turbine_train()
    everywhere, keys = Means(elsewhere="table").settings(train, depth)
    scenario = Scenario.model_validate({"train": "turbine", "depth": everywhere, **keys})
    at = {seat.name: scenario.depth_at.get(seat.name, scenario.depth) for seat in train.bearings}
    assert at["LP1-front"] == at["LP1-rear"] == depth
    assert at["LP2-front"] == ("v3" if depth == "v3" else "table")


def test_table_of_designs_goes_on_where_it_ended(tmp_path, monkeypatch):
    looked = []

    def look(_place, design, blade, _means):
        looked.append((design.lp_core_diameter, blade))
        found = runs()
        return figures(found) | {"rows": " ".join(map(str, rows_met(found)))}

    monkeypatch.setattr(explore, "look", look)
    monkeypatch.setattr(explore, "settled", lambda design: design)
    table, said = tmp_path / "found.csv", []
    explore.explore(table, range(2), TurbineDesign(), Means(), report=said.append)
    explore.explore(table, range(4), TurbineDesign(), Means(), report=said.append)
    lines = explore.read(table)
    assert [line["number"] for line in lines] == ["0", "1", "2", "3"] and len(looked) == len(said) == 4
    assert lines[2]["rows"] == " ".join(map(str, range(1, 15))) and float(lines[2]["v1.force"]) == 12.0
    explore.explore(table, range(1), TurbineDesign(), Means(), near="2", report=said.append)
    core, blade = looked[-1]
    assert core == pytest.approx(float(lines[2]["lp_core_diameter"]), abs=0.15 * 0.06)
    assert isinstance(blade, Blade) and explore.read(table)[-1]["near"] == "2"


def test_a_design_that_cannot_stand_is_noted(tmp_path, monkeypatch):
    def settle(_design):
        raise ValueError("no tilt")

    monkeypatch.setattr(explore, "settled", settle)
    explore.explore(tmp_path / "found.csv", [0], TurbineDesign(), Means(), report=lambda _line: None)
    assert explore.read(tmp_path / "found.csv")[0]["note"] == "no tilt"


@pytest.mark.parametrize(
    ("so", "contact", "force", "worth"),
    [(7.7, 0.5, 7.7, True), (10.0, 0.5, 7.7, False), (7.7, 0.0, 7.7, False), (7.7, 0.5, 6.0, False)],
)
def test_which_designs_are_worth_all_depths(so, contact, force, worth):
    assert explore.promising({"v1.so": so, "v1.contact": contact, "v1.force": force}) is worth


def test_the_subharmonic_design_stands_as_solved_for():
    found = settled(SUBHARMONIC)
    for name in explore.SOLVED:
        assert design_value(SUBHARMONIC, name) == pytest.approx(design_value(found, name), rel=2e-3)
