"""Bearings on threads: the same numbers to the bit, and the same errors."""

import numpy as np
import pytest

from orchestrator.case.simulate import Execution, simulate
from orchestrator.case.threads import default_threads
from orchestrator.fmi.unit import Status, UnitError
from orchestrator.master.threads import StepThreads
from orchestrator.outcome import Outcome
from rotor_fmu.train.file import load_train
from tests.faults import fault
from tests.orchestrator.toy_train import toy_fmu_folder, toy_scenario

BLADE = {"wheel": "wheel", "unbalance": 0.1, "time": 0.0205}


class Counter:
    """Stands for a unit; refuses its steps if `fails`."""

    def __init__(self, name, fails=False):
        self.name, self.fails, self.steps = name, fails, []

    def do_step(self, time, step):
        self.steps.append((time, step))
        if self.fails:
            raise UnitError(self.name, "fmi2DoStep", Status.DISCARD, "")


@pytest.mark.parametrize("threads", [1, 2, 3, 8])
def test_every_unit_steps_once(threads):
    units = [Counter(str(k)) for k in range(7)]
    crew = StepThreads(units, threads)
    crew.step(0.5, 1e-3)
    crew.close()
    assert [unit.steps for unit in units] == [[(0.5, 1e-3)]] * 7


@fault(
    "unit",
    "units that fail at the same time on several threads",
    "the error of the first in their order, as on one thread",
    guard="orchestrator.master.threads:StepThreads.step",
)
@pytest.mark.parametrize("threads", [1, 2, 3])
def test_the_first_error_in_the_order_of_units_counts_and_all_step(threads):
    units = [Counter(str(k), fails=k in (2, 3, 5)) for k in range(7)]
    crew = StepThreads(units, threads)
    with pytest.raises(UnitError, match=r"^2: "):
        crew.step(0.0, 1e-3)
    crew.close()
    assert all(unit.steps for unit in units)


def test_two_threads_give_the_record_of_one(toy_fmus, tmp_path):
    fmus = toy_fmu_folder(toy_fmus, tmp_path / "fmus")
    scenario = toy_scenario(tmp_path, event=BLADE, coupling="newton")
    one, two = (simulate(scenario, fmus, None, Execution(threads=n)) for n in (1, 2))
    assert one.outcome is Outcome.FINISHED
    assert one.record.identical(two.record)
    assert np.ptp(one.record["force"].values) > 0.0


def test_refused_steps_count_alike_on_threads(toy_fmus, tmp_path):
    fmus = toy_fmu_folder(toy_fmus, tmp_path / "fmus")
    scenario = toy_scenario(tmp_path, event={**BLADE, "unbalance": 1e3})
    one, two = (simulate(scenario, fmus, None, Execution(threads=n)) for n in (1, 2))
    assert one.outcome is Outcome.FILM_FAILED
    assert one.record.identical(two.record)
    assert (one.message, one.counts, one.evaluations) == (two.message, two.counts, two.evaluations)


def test_quick_films_stay_on_one_thread(tmp_path, monkeypatch):
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    turbine = load_train("turbine")
    scenario = toy_scenario(tmp_path)
    assert default_threads(scenario, turbine) == 2
    assert default_threads(scenario.model_copy(update={"depth": "v2"}), turbine) == 1
    monkeypatch.setattr("os.cpu_count", lambda: 1)
    assert default_threads(scenario, turbine) == 1
