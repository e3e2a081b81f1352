"""A bearing of somebody else in the place of one of the train's."""

from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest
from pythonfmu.builder import FmuBuilder

from orchestrator.case.case import ssp_case
from orchestrator.case.simulate import execute, simulate
from orchestrator.errors import PortError, ScenarioError
from orchestrator.outcome import Outcome
from orchestrator.scenario.file import load_scenario, train_of
from orchestrator.ssp.export import export
from tests.faults import fault

EXAMPLE = Path(__file__).parents[2] / "examples" / "spring_bearing.py"


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    folder = tmp_path_factory.mktemp("own")
    return folder / FmuBuilder.build_FMU(EXAMPLE, folder).name


@pytest.fixture(scope="module")
def fmus(train_fmus):
    return train_fmus


def scenario(own, **overrides):
    settings = {"depth": "v3", "depth_at": {"rear": str(own)}, "end": 0.01, "event": {"time": 0.005}}
    return load_scenario("small", settings | overrides)


def test_it_carries_its_load_and_follows_its_law(own, fmus):
    result = simulate(scenario(own), fmus)
    assert result.outcome is Outcome.FINISHED, result.message
    record = result.record.sel(bearing="rear")
    assert str(record["depth"].values) == own.stem
    train = train_of(scenario(own))
    np.testing.assert_allclose(record["static_force"].values[1], 0.5 * train.mass * 9.80665, rtol=1e-3)
    centre = record["offset"].values
    expected = -5e8 * (record["displacement"].values - centre) - 5e5 * record["velocity"].values
    np.testing.assert_allclose(record["force"].values, expected, rtol=1e-9, atol=1e-3)


def test_it_travels_in_the_ssp(own, fmus, tmp_path):
    path, _ = export(scenario(own), fmus, tmp_path / "own.ssp", "own")
    with ssp_case(path) as case:
        back = execute(case).record
    np.testing.assert_array_equal(back["force"].values, simulate(scenario(own), fmus).record["force"].values)


@fault(
    "unit",
    "a bearing of one's own without the port's variables, or with others",
    "exit 2; every variable that is missing or differs, the likely spelling",
    guard="orchestrator.master.system:System.__init__",
)
def test_all_that_is_missing_or_different_is_listed(own, fmus, tmp_path):
    bad = tmp_path / "bad.fmu"
    with ZipFile(own) as archive, ZipFile(bad, "w") as out:
        for name in archive.namelist():
            content = archive.read(name)
            if name == "modelDescription.xml":
                content = content.replace(b'name="K[2,3]"', b'name="stiff[2,3]"')
                content = content.replace(b'name="offset.x"', b'name="offsetx"')
                before, _, after = content.partition(b'name="h_min"')
                content = (
                    before + b'name="h_min"' + after.replace(b'causality="output"', b'causality="local"', 1)
                )
                before, _, after = content.partition(b'name="journal.x"')
                content = before + b'name="journal.x"' + after.replace(b"<Real ", b'<Real unit="mm" ', 1)
                units = b'<UnitDefinitions><Unit name="mm"><BaseUnit m="1"/></Unit></UnitDefinitions>'
                content = content.replace(b"<LogCategories>", units + b"<LogCategories>")
            out.writestr(name, content)
    with pytest.raises(PortError) as info:
        simulate(scenario(bad), fmus)
    text = str(info.value)
    assert "K[2,3] is missing (output, N/rad)" in text
    assert "offset.x is missing (parameter, m); did you mean 'offsetx'?" in text
    assert "h_min is local Real, not output Real" in text
    assert "journal.x is in mm, not in m" in text
    assert len(text.splitlines()) == 4


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(ScenarioError, match=r"depth_at.rear = '.*none.fmu': no such file"):
        scenario(tmp_path / "none.fmu")


def test_paths_count_from_the_scenario(own, tmp_path):
    (tmp_path / own.name).write_bytes(own.read_bytes())
    text = f'train = "small"\nend = 0.01\n[depth_at]\nrear = "{own.name}"\n'
    (tmp_path / "mine.toml").write_text(text)
    assert load_scenario(tmp_path / "mine.toml").depth_name_of("rear") == own.stem
