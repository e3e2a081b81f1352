"""The temperature of the oil: the search in closed form, the balance of one film and of a machine."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.special import lambertw

from bearing_fmu.film import make_film
from fmus.port import Oil
from orchestrator.case.simulate import simulate
from orchestrator.errors import EquilibriumError, ScenarioError
from orchestrator.fmi.file import FmuStore
from orchestrator.fmi.folder import build
from orchestrator.master.assembly import assemble
from orchestrator.master.start.equilibrium import find_start
from orchestrator.master.start.heat import as_it_runs, settle
from orchestrator.master.system import RESPONSE
from orchestrator.scenario.file import load_with_train
from tests.bearing_fmu.bearings import plain, respond

EXAMPLE = Path(__file__).parents[2] / "examples" / "oil"


def test_rises_in_closed_form():
    """Solve rise = A exp(-rise / b): b times Lambert's W of A / b."""
    scale, decay = np.array([5.0, 40.0, 150.0]), np.array([30.0, 20.0, 25.0])
    found = settle(lambda rise: scale * np.exp(-rise / decay), np.full(3, 10.0))
    np.testing.assert_allclose(found, decay * lambertw(scale / decay).real, rtol=1e-7)


def test_an_oil_without_temperature_is_said():
    with pytest.raises(EquilibriumError, match="the oil finds no temperature: after 40 equilibria"):
        settle(lambda rise: rise + 1.0, np.array([10.0]))


def test_film_in_balance_with_its_oil():
    """A journal at a place: friction power is what flow and heat capacity carry away, to 1e-6."""
    oil, supply = Oil.of_grade(46), 318.15

    def at(rise):
        p = plain(
            0.5, diameter=0.2, width=0.1, clearance=2e-4, supply_temperature=supply,
            viscosity=oil.dynamic(supply + float(rise[0]), 870.0),
        )  # fmt: skip
        return p, respond(make_film("v2", p), [0.4, -0.5, 0, 0], speed=314.0)

    rise = settle(lambda rise: np.array([at(rise)[1].oil_temperature - supply]), np.array([10.0]))
    p, found = at(rise)
    carried = p.density * p.heat_capacity * found.oil_flow * 2.0 * rise[0]
    assert carried == pytest.approx(found.friction_power, rel=1e-6)
    assert 1.0 < rise[0] < 40.0


def test_machine_on_oil_of_a_grade(tmp_path):
    """The example: every bearing has the viscosity of the temperature that its unit tells."""
    scenario, train = load_with_train(str(EXAMPLE / "loss.toml"))
    build(tmp_path, [train], ["v3"])
    with FmuStore() as store:
        system = assemble(scenario, train, tmp_path, store)
        try:
            find_start(system, train, train.speed)
            temperatures = system.responses[:, RESPONSE["oil_temperature"]]
            power, flow = (system.responses[:, RESPONSE[name]] for name in ("friction_power", "oil_flow"))
            running = as_it_runs(train, system)
            for seat, warm, cold, carried in zip(
                running.bearings, temperatures, train.bearings, flow, strict=True
            ):
                assert seat.viscosity == pytest.approx(seat.oil.dynamic(float(warm), seat.density), rel=1e-6)
                assert seat.viscosity != cold.viscosity
                assert carried > 0.0
            rise = temperatures - 318.15
            np.testing.assert_allclose(2.0 * 870.0 * 2e3 * flow * rise, power, rtol=1e-6)
        finally:
            system.close()


def test_machine_on_oil_that_warms(tmp_path):
    """The example without a loss: from the equilibrium on nothing changes, also where steps go back."""
    changes = {
        "events": (),
        "end": 0.01,
        "step": 1e-3,
        "coupling": "newton",
        "film": {"temperature": "followed"},
        "unbalance": {"grade": 0.0},
    }
    scenario, train = load_with_train(str(EXAMPLE / "loss.toml"), changes)
    build(tmp_path, [train], ["v3"])
    record = simulate(scenario, tmp_path).record
    temperature = record["oil_temperature"].values
    assert temperature.min() > 318.16
    np.testing.assert_allclose(temperature, np.broadcast_to(temperature[0], temperature.shape), rtol=1e-6)


def test_what_does_not_warm_is_said():
    with pytest.raises(ScenarioError, match=r"temperature = 'followed'; allowed with an oil at each bearing"):
        load_with_train("small", {"film": {"temperature": "followed"}})
