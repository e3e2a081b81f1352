"""Whole runs on the toy train: the record, its extremes, the files, and the ways a run can end."""

import fmpy.util
import numpy as np
import pytest
import xarray as xr
from rich.console import Console
from threadpoolctl import threadpool_info, threadpool_limits

from orchestrator.case import case as case_module
from orchestrator.case.progress import Stage
from orchestrator.case.request import RunRequest
from orchestrator.case.simulate import simulate
from orchestrator.commands.run import run
from orchestrator.errors import FmuError
from orchestrator.master.stepping import DEEPEST
from orchestrator.outcome import Outcome
from orchestrator.results.record_files import read_record, write_record
from orchestrator.scenario import file as file_module
from orchestrator.scenario.file import load_scenario, scenario_toml, train_of
from rotor_fmu.recipe import rotor_recipe
from rotor_fmu.train.file import load_train
from tests.faults import fault
from tests.orchestrator.toy_train import (
    GRADE,
    SPEED,
    STIFFNESS,
    WHEEL_MASS,
    in_the_place_of,
    toy_fmu_folder,
    toy_scenario,
)

BLADE = {"wheel": "wheel", "unbalance": 0.1, "time": 0.0205}


@pytest.fixture(scope="module")
def fmus(toy_fmus, tmp_path_factory):
    return toy_fmu_folder(toy_fmus, tmp_path_factory.mktemp("named"))


@pytest.fixture(scope="module")
def finished(fmus, tmp_path_factory):
    return simulate(toy_scenario(tmp_path_factory.mktemp("scenario"), event=BLADE), fmus)


def test_a_run_finishes_with_a_labelled_record(finished):
    record = finished.record
    assert finished.outcome is Outcome.FINISHED
    assert finished.message == ""
    assert (finished.steps, finished.evaluations) == (50, 100)
    np.testing.assert_allclose(record["time"], 1e-3 * np.arange(51), rtol=1e-12)
    assert record["time"].values[-1] == 0.05
    assert record["force"].dims == ("time", "bearing", "axis")
    assert list(record["bearing"].values) == ["front", "rear"]
    assert list(record["depth"].values) == ["v1", "v1"]
    assert record["stress"].sizes == {"time": 51, "node": 4}
    for name, variable in record.data_vars.items():
        assert variable.dtype.kind == "U" or variable.attrs["units"], name
        assert variable.attrs["long_name"], name
    assert record.attrs["status"] == "finished"
    assert record.attrs["fracture_time"] == 0.0205


def test_forces_follow_from_the_recorded_motion(finished):
    record = finished.record
    q = record["displacement"] - record["offset"].values
    expected = -STIFFNESS * q - 2e4 * record["velocity"]
    scale = float(abs(record["force"]).max())
    np.testing.assert_allclose(record["force"], expected, rtol=0, atol=1e-9 * scale)


def test_the_nominal_unbalance_is_that_of_the_balance_grade(fmus, tmp_path):
    """Twice the grade, twice the orbit; an override by wheel replaces it."""
    amplitudes = []
    for change in ({}, {"grade": 2.0 * GRADE}, {"at": {"wheel": {"unbalance": GRADE / SPEED * WHEEL_MASS}}}):
        record = simulate(toy_scenario(tmp_path, unbalance=change), fmus).record
        amplitudes.append(float(np.ptp(record["displacement"].sel(bearing="front", axis="x").values)))
    assert amplitudes[1] == pytest.approx(2.0 * amplitudes[0], rel=1e-6)
    assert amplitudes[2] == pytest.approx(amplitudes[0], rel=1e-9)


def test_a_coarser_record_keeps_the_extremes_of_every_step(finished, fmus, tmp_path):
    fine = finished.record
    coarse = simulate(toy_scenario(tmp_path, event=BLADE, record={"interval": 7e-3}), fmus).record
    steps = [*range(0, 50, 7), 50]
    np.testing.assert_array_equal(coarse["time"], fine["time"][steps])
    np.testing.assert_array_equal(coarse["force"], fine["force"][steps])
    force, gap = fine["force_magnitude_max"].values, fine["least_gap"].values
    for k in range(1, len(steps)):
        between = slice(steps[k - 1] + 1, steps[k] + 1)
        np.testing.assert_array_equal(coarse["force_magnitude_max"][k], force[between].max(axis=0))
        np.testing.assert_array_equal(coarse["least_gap_min"][k], gap[between].min(axis=0))
    np.testing.assert_array_equal(coarse["force_magnitude_max_of_run"], force.max(axis=0))
    when = fine["time"].values[force.argmax(axis=0)]
    np.testing.assert_array_equal(coarse["force_magnitude_max_of_run_time"], when)
    np.testing.assert_array_equal(coarse["least_gap_min_of_run"], gap.min(axis=0))


def test_the_last_step_ends_on_the_end_time(fmus, tmp_path):
    result = simulate(toy_scenario(tmp_path, end=0.0125, record={"interval": 5e-3}), fmus)
    np.testing.assert_allclose(result.record["time"], [0.0, 0.005, 0.010, 0.0125])
    assert result.steps == 13


def test_coupling_and_depth_are_one_word(finished, fmus, tmp_path):
    reference = finished.record["displacement"]
    size = float(np.ptp(reference.values[:, 0, 0]))
    for change, bound in (({"coupling": "gauss-seidel", "step": 1e-4}, 0.1), ({"depth": "v2"}, 1e-12)):
        scenario = toy_scenario(tmp_path, event=BLADE, **change)
        other = simulate(scenario, fmus).record["displacement"]
        np.testing.assert_allclose(other, reference, rtol=0, atol=bound * size)


def test_depths_mix(fmus, tmp_path):
    record = simulate(toy_scenario(tmp_path, depth_at={"rear": "v3"}, end=2e-3), fmus).record
    assert list(record["depth"].values) == ["v1", "v3"]
    assert record.attrs["fmus"].count(".fmu") == 3


@fault(
    "film",
    "a film that fails for good at one bearing",
    "film-failed, exit 11; bearing, time, eccentricity ratio, tilts, least gap; record up to there",
    guard="orchestrator.fmi.unit_error:UnitError.__init__",
)
def test_a_failed_film_ends_the_run_with_its_reason_and_a_partial_record(fmus, tmp_path):
    result = simulate(toy_scenario(tmp_path, event={**BLADE, "unbalance": 1e3}), fmus)
    assert result.outcome is Outcome.FILM_FAILED
    assert not result.outcome.ok
    assert "front: fmi2DoStep returned discard: the journal has left its bore" in result.message
    last = result.record["eccentricity"].sel(bearing="front").values[-1]
    assert f"last state of front: eccentricity ratio {last:.4g}, tilts " in result.message
    assert f"least gap {1e6 * result.record['least_gap'].values[-1, 0]:.4g} um" in result.message
    times = result.record["time"].values
    assert 0.0205 <= times[-1] < 0.05
    assert f"at t = {times[-1]:.9g} s" in result.message
    assert result.counts.discarded >= DEEPEST
    assert result.counts.shortest == pytest.approx(1e-3 / 2**DEEPEST)
    assert times[-2] == pytest.approx(1e-3 * (len(times) - 2))
    attributes = result.record.attrs
    assert (attributes["status"], attributes["exit_status"]) == ("film-failed", 11)
    assert attributes["message"] == result.message
    assert attributes["advice"] == Outcome.FILM_FAILED.advice
    assert np.isfinite(result.record["force"]).all()


@fault(
    "film",
    "a bearing that does not carry its static load",
    "no-equilibrium, exit 3; bearing, load, what it carries; an empty record",
    guard="orchestrator.master.start.journal_position:aligned_positions",
)
def test_without_equilibrium_there_is_an_empty_record_and_a_reason(toy_fmus, tmp_path):
    scenario = toy_scenario(tmp_path)
    (tmp_path / "toy" / "train.toml").write_text(
        (tmp_path / "toy" / "train.toml").read_text().replace("clearance = 0.0008", "clearance = 0.0001")
    )
    own = toy_fmu_folder(toy_fmus, tmp_path / "own")
    in_the_place_of(rotor_recipe(train_of(scenario)), toy_fmus / "two_masses.fmu", own)
    result = simulate(scenario, own)
    assert result.outcome is Outcome.NO_EQUILIBRIUM
    assert "at the start: front: the film carries 2000 N of the load 4903 N" in result.message
    assert result.record.attrs["exit_status"] == 3
    assert result.record.sizes["time"] == 0


def test_an_interrupted_run_keeps_its_record(fmus, tmp_path):
    def stop(stage, time):
        if stage is Stage.RUN and time > 0.01:
            raise KeyboardInterrupt

    result = simulate(toy_scenario(tmp_path), fmus, stop)
    assert result.outcome is Outcome.INTERRUPTED
    assert result.record["time"].values[-1] == pytest.approx(0.011)


def test_progress_announces_stages_and_simulated_time(fmus, tmp_path):
    calls = []
    scenario = toy_scenario(tmp_path, end=3e-3)
    simulate(scenario, fmus, lambda stage, time: calls.append((stage, round(time, 9))))
    assert calls[:4] == [(stage, 0.0) for stage in Stage]
    assert calls[4:] == [(Stage.RUN, 1e-3), (Stage.RUN, 2e-3), (Stage.RUN, 3e-3)]


def test_a_missing_fmu_is_named_and_nothing_is_left_behind(fmus, tmp_path, monkeypatch):
    folders = []
    store = case_module.FmuStore

    def watched():
        made = store()
        folders.append(made.folder)
        return made

    monkeypatch.setattr(case_module, "FmuStore", watched)
    with pytest.raises(FmuError, match=r"bearing_v2-[0-9a-f]{16}\.fmu: no such file"):
        (fmus / "bearing_v2.fmu").rename(fmus / "hidden")
        try:
            simulate(toy_scenario(tmp_path, depth_at={"rear": "v2"}), fmus)
        finally:
            (fmus / "hidden").rename(fmus / "bearing_v2.fmu")
    assert not folders[0].exists()


def test_timing_adds_up(finished):
    timing = finished.timing
    loop = (timing.film, timing.rotor, timing.fmi, timing.record, timing.master)
    assert all(part >= 0.0 for part in (timing.load, timing.equilibrium, *loop))
    assert timing.loop == sum(loop)


def test_the_record_survives_the_file(finished, tmp_path):
    path, _ = write_record(finished.record, tmp_path / "out")
    again = read_record(tmp_path / "out")
    xr.testing.assert_identical(again, finished.record)
    xr.testing.assert_identical(read_record(path), finished.record)
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == ["record.csv", "record.nc"]


def test_the_scenario_in_the_record_is_the_scenario_that_ran(finished, tmp_path):
    (tmp_path / "again.toml").write_text(finished.record.attrs["scenario"])
    toy_scenario(tmp_path)
    again = load_scenario(tmp_path / "again.toml")
    assert again.events[0].unbalance == 0.1
    assert again.step == 1e-3


def test_fmi_tools_read_the_table(finished, tmp_path):
    _, path = write_record(finished.record, tmp_path)
    table = fmpy.util.read_csv(path)
    assert table.dtype.names[0] == "time"
    np.testing.assert_allclose(table["time"], finished.record["time"], rtol=1e-9)
    force = finished.record["force"].sel(bearing="rear", axis="y")
    np.testing.assert_allclose(table["rear.force_y [N]"], force, rtol=1e-9)
    assert "vibration_amplitude_max [m]" in table.dtype.names
    assert all(name.endswith("]") and " [" in name for name in table.dtype.names[1:])
    lines = path.read_text().splitlines()  # FMI tools refuse a second row that is no numbers
    path.write_text("\n".join([lines[0], ",".join("N" for _ in table.dtype.names), *lines[1:]]))
    with pytest.raises(ValueError, match="could not convert"):
        fmpy.util.read_csv(path)


def test_a_failed_write_leaves_nothing(finished, tmp_path, monkeypatch):
    def fail(*_args, **_kwargs):
        raise OSError("disk full")

    monkeypatch.setattr("orchestrator.results.record_files._write_netcdf", fail)
    with pytest.raises(OSError, match="disk full"):
        write_record(finished.record, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_linear_algebra_has_one_thread_in_a_run_and_what_it_had_behind_it(fmus, tmp_path):
    """Also of a run from Python, where no command has set the environment."""

    def threads(*_):
        found.append({pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"})

    found = []
    with threadpool_limits(3, user_api="blas"):
        simulate(toy_scenario(tmp_path, end=2e-3), fmus, threads)
        inside = list(found)
        threads()
    assert inside and all(pools == {1} for pools in inside)
    assert found[-1] == {3}


def test_a_run_reads_its_train_once(fmus, tmp_path, monkeypatch):
    read = []

    def counted(source):
        read.append(source)
        return load_train(source)

    (tmp_path / "toy.toml").write_text(scenario_toml(toy_scenario(tmp_path, end=2e-3)))
    monkeypatch.setattr(file_module, "load_train", counted)
    monkeypatch.setattr("orchestrator.case.prepare.ensure_fmus", lambda *_: None)
    request = RunRequest(str(tmp_path / "toy.toml"), out=tmp_path / "out", fmus=fmus, formats=())
    assert run(request, Console(quiet=True), Console()) == 0
    assert len(read) == 1
