"""Any number of runs and trains share a folder of FMUs: each loads what it means, or says that it cannot."""

import threading
from dataclasses import replace

import pytest

from bearing_fmu.recipe import bearing_recipe
from fmus.build import builder
from orchestrator.case.request import RunRequest
from orchestrator.errors import FmuError
from orchestrator.fmi.folder import fmu_folder
from orchestrator.master.assembly import parts_in_folder
from orchestrator.outcome import INPUT_ERROR
from orchestrator.results.record_files import read_record
from orchestrator.scenario.file import load_scenario, load_with_train
from rotor_fmu.recipe import rotor_recipe
from rotor_fmu.train.file import DATA, load_train
from tests.faults import fault
from tests.orchestrator.foreign import call
from tests.orchestrator.process import command
from tests.orchestrator.toy_train import in_the_place_of

PAIRS = 10


def test_the_default_folder_is_in_the_users_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert fmu_folder() == RunRequest("small").fmus == tmp_path / "bladeloss" / "fmus"


def variant(folder, mass):
    """A copy of the small train under its own name, with another wheel, and a short scenario."""
    folder.mkdir()
    text = (DATA / "small" / "train.toml").read_text()
    assert text.count("mass = 1500.0") >= 1
    (folder / "train.toml").write_text(text.replace("mass = 1500.0", f"mass = {mass}", 1))
    (folder / "shaft.csv").write_text((DATA / "small" / "shaft.csv").read_text())
    scenario = folder / "s.toml"
    scenario.write_text('train = "."\nend = 0.004\ndepth = "v3"\n[record]\ninterval = 1e-3\n')
    return scenario


@fault(
    "input",
    "two trains of one name, whose runs share a folder of FMUs",
    "each run has its own rotor; a rotor that is not the one meant is refused when it is loaded",
    guard="orchestrator.master.assembly:_built",
)
def test_a_rotor_that_is_not_the_one_meant_is_refused(tmp_path, store):
    light, heavy = (load_train(variant(tmp_path / str(m), m).parent) for m in (1000.0, 1500.0))
    assert light.name == heavy.name == "small" and light != heavy
    builder.refresh(tmp_path, [rotor_recipe(heavy)])
    path = builder.place(tmp_path, rotor_recipe(heavy))
    path.rename(tmp_path / rotor_recipe(light).stored_name)
    scenario = load_scenario("small", {"depth": "v3"})
    with pytest.raises(FmuError, match="is another unit than bladeloss_rotor_small as it is now"):
        next(iter(parts_in_folder(scenario, light, tmp_path, store)))


def test_threads_and_processes_may_build_at_once(tmp_path):
    """Every reader sees a whole file, whoever wrote it last."""
    recipe, problems = bearing_recipe("v3"), []

    def work():
        try:
            for _ in range(3):
                builder.refresh(tmp_path, [recipe], True)
                assert not builder.is_stale(builder.place(tmp_path, recipe), recipe)
        except Exception as error:
            problems.append(error)

    workers = [threading.Thread(target=work) for _ in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert not problems and [path.name for path in tmp_path.iterdir()] == [recipe.stored_name]


@fault(
    "input",
    "a train that is edited while the runs of a comparison start",
    "exit 2: `was edited meanwhile`; no run of another train is compared",
    guard="orchestrator.case.prepare:_scenario_case",
)
def test_a_train_that_is_edited_meanwhile(tmp_path, small_fmus):
    scenario = variant(tmp_path / "mine", 1000.0)
    meant = rotor_recipe(load_train(scenario.parent)).guid
    text = (scenario.parent / "train.toml").read_text()
    (scenario.parent / "train.toml").write_text(text.replace("mass = 1000.0", "mass = 1001.0"))
    result = call("run", scenario, "--rotor", meant, "--fmus", small_fmus, "--out", tmp_path / "o")
    assert result.exit_code == INPUT_ERROR and "was edited meanwhile" in result.stderr
    assert not (tmp_path / "o").exists()


def test_a_unit_that_passes_for_another_must_have_its_guid(tmp_path, toy_fmus, store):
    """The stand-ins of other tests do, which nobody can mistake for a proof of trust."""
    _, train = load_with_train("small")
    in_the_place_of(rotor_recipe(train), toy_fmus / "two_masses.fmu", tmp_path)
    scenario = load_scenario("small", {"depth": "v3"})
    part = next(iter(parts_in_folder(scenario, train, tmp_path, store)))
    assert part.file.description.guid == f"{{{rotor_recipe(train).guid}}}"
    other = replace(train, speed=1.01 * train.speed)
    with pytest.raises(FmuError, match="no such file"):
        next(iter(parts_in_folder(scenario, other, tmp_path, store)))


@pytest.mark.slow
def test_pairs_of_runs_at_once_each_have_their_own_rotor(tmp_path):
    """Ten times two variants of one name, started together in one folder, give the numbers of lonely runs."""
    scenarios = [variant(tmp_path / str(m), m) for m in (1000.0, 1500.0)]

    def run(scenario, out):
        options = ("--fmus", tmp_path / "fmus", "--out", out, "--no-figures")
        return command("run", scenario, *options, cwd=tmp_path)

    alone = []
    for number, scenario in enumerate(scenarios):
        out = tmp_path / f"alone-{number}"
        assert run(scenario, out).wait() == 0
        alone.append(read_record(out)["force"])
    assert not alone[0].identical(alone[1])
    for pair in range(PAIRS):
        for path in (tmp_path / "fmus").iterdir():
            path.unlink()
        outs = [tmp_path / f"{pair}-{number}" for number in (0, 1)]
        processes = [run(scenario, out) for scenario, out in zip(scenarios, outs, strict=True)]
        assert [process.wait() for process in processes] == [0, 0]
        assert all(read_record(out)["force"].identical(force) for out, force in zip(outs, alone, strict=True))
