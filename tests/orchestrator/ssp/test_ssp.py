"""SSP: round trip, contents, what another tool may have done to it, refusals."""

from zipfile import ZipFile

import numpy as np
import pytest

from fmus.build.archive import write_archive
from orchestrator.case.case import ssp_case
from orchestrator.case.simulate import Execution, execute, simulate
from orchestrator.errors import ScenarioError
from orchestrator.fmi.unit import Unit
from orchestrator.master.system import Wiring
from orchestrator.outcome import Outcome
from orchestrator.scenario.file import load_scenario
from orchestrator.ssp.export import export
from orchestrator.ssp.reader import read_ssp
from orchestrator.ssp.structure import SspError
from tests.marks import slow

SHORT = {"end": 0.012, "event": {"time": 0.00613}, "depth": "v3", "depth_at": {"rear": "v2"}}


def small(**overrides):
    return load_scenario("small", SHORT | overrides)


@pytest.fixture(scope="module")
def fmus(train_fmus):
    return train_fmus


@pytest.fixture(scope="module")
def exported(fmus, tmp_path_factory):
    law, force = export(small(), fmus, tmp_path_factory.mktemp("ssp") / "small.ssp", "small")
    return {Wiring.LAW: law, Wiring.FORCE: force}


def run(path, outcome=Outcome.FINISHED, **overrides):
    with ssp_case(path, overrides) as case:
        result = execute(case)
    assert result.outcome is outcome, result.message
    return result.record


def edited(source, target, changes):
    """Copy an SSP with texts replaced: ``{member: [(old, new), ...]}``."""
    with ZipFile(source) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    for member, pairs in changes.items():
        for old, new in pairs:
            assert old.encode() in files[member], old
            files[member] = files[member].replace(old.encode(), new.encode())
    write_archive(target, files)
    return target


@pytest.mark.parametrize(
    "settings",
    [
        {},
        slow({"reduction": "guyan", "film": {"columns": 32, "rows": 6}}),
        slow({"tolerance": 2e-3, "step": 4e-4}),
        slow({"coupling": "multirate", "tolerance": 1e-3}),
        {"event": None, "unbalance": {"grade": 1e-3, "at": {"wheel-1": {"unbalance": 0.02, "phase": 0.3}}}},
        {"depth": "linear", "depth_at": {}, "linear_from": "v3"},
        {
            "rotation": {"inertia": 40.0, "windage": 0.5},
            "event": None,
            "events": [
                {"wheel": "wheel-2", "unbalance": 0.3, "time": 0.00213},
                {"wheel": "wheel-1", "unbalance": 0.2, "phase": 1.0, "speed": 311.0},
                {"kind": "trip", "time": 0.003},
                {"kind": "change", "bearing": "rear", "parameter": "offset.y", "by": -3e-7, "time": 0.008},
            ],
        },
        {
            "rotation": {"course": [[0.0, 300.0], [0.01, 320.0]], "windage": 0.5},
            "coupling": "multirate",
            "tolerance": 1e-3,
            "events": [{"kind": "trip", "time": 0.005}],
            "event": None,
        },
    ],
    ids=[
        "as it comes",
        "reduction and film",
        "controlled steps",
        "many rates",
        "no fracture",
        "linear",
        "turning",
        "run-up",
    ],
)
def test_scenario_to_ssp_to_run_equals_the_run_of_the_scenario(settings, fmus, tmp_path):
    scenario = small(**settings)
    path, _ = export(scenario, fmus, tmp_path / "small.ssp", "small")
    direct, back = simulate(scenario, fmus).record, run(path)
    assert set(direct.variables) == set(back.variables)
    for name in direct.variables:
        np.testing.assert_array_equal(back[name].values, direct[name].values, err_msg=name)
    if scenario.turns:
        assert back["rotation_speed"].values[-1] != back["rotation_speed"].values[-5]
    assert back.attrs["ssp"].startswith("small.ssp sha256 ")


@pytest.mark.parametrize("coupling", ["gauss-seidel", "jacobi"])
def test_force_only_runs_as_the_explicit_coupling_of_the_scenario(coupling, fmus, exported):
    settings = {"coupling": coupling, "end": 1e-3, "event": None, "step": 1e-5}
    direct = simulate(small(**settings), fmus).record
    back = run(exported[Wiring.FORCE], Outcome.UNRESOLVED, coupling=coupling, end=1e-3, step=1e-5)
    np.testing.assert_array_equal(back["force"].values, direct["force"].values)


def test_threads_give_the_record_of_one(exported):
    with ssp_case(exported[Wiring.LAW]) as case:
        two = execute(case, None, Execution(threads=2)).record
    assert two.drop_attrs().identical(run(exported[Wiring.LAW]).drop_attrs())


def test_step_control_goes_where_its_step_is_replaced(fmus, tmp_path):
    path, force = export(small(tolerance=0.02), fmus, tmp_path / "small.ssp", "small")
    for overrides, left in (({}, 0.02), ({"step": 5e-5}, None), ({"step": 5e-5, "tolerance": 1e-3}, 1e-3)):
        with ssp_case(path, overrides) as case:
            assert case.scenario.tolerance == left
    with ssp_case(force) as case:
        assert case.scenario.tolerance is None


def test_two_exports_have_the_same_bytes(fmus, exported, tmp_path):
    again = export(small(), fmus, tmp_path / "small.ssp", "small")
    for one, other in zip(again, exported.values(), strict=True):
        assert one.read_bytes() == other.read_bytes()


def test_bearings_of_one_depth_share_a_file_and_values_are_real(fmus, tmp_path):
    path, _ = export(small(depth_at={"rear": "v3"}), fmus, tmp_path / "a.ssp", "a")
    structure = read_ssp(path, tmp_path / "x")
    assert [c.name for c in structure.components] == ["rotor", "front", "rear"]
    assert len({c.source for c in structure.components}) == 2
    assert all(isinstance(x, float) for c in structure.components for x in c.parameters.values())
    assert len(structure.connections) == 2 * (8 + 36)
    assert (structure.end, structure.step, structure.coupling) == (0.012, 1e-4, "linear-implicit")


def test_an_edited_parameter_counts(exported, tmp_path):
    path = edited(
        exported[Wiring.LAW],
        tmp_path / "edited.ssp",
        {"resources/rotor.ssv": [('<ssv:Real value="0.00613" />', '<ssv:Real value="0.004" />')]},
    )
    changed, before = run(path), run(exported[Wiring.LAW])
    assert changed.attrs["fracture_time"] == 0.004
    early = before["time"].values < 0.004
    np.testing.assert_array_equal(changed["force"].values[early], before["force"].values[early])
    assert abs(changed["force"] - before["force"]).max() > 1e3


def test_other_prefixes_order_and_inline_values_are_read(exported, tmp_path):
    """As another tool may write it."""
    law = exported[Wiring.LAW]
    with ZipFile(law) as archive:
        values = archive.read("resources/front.ssv").decode().partition("?>")[2]
    binding = '<ssd:ParameterBinding type="application/x-ssp-parameter-set" source="resources/front.ssv" />'
    inline = (
        f"<ssd:ParameterBinding><ssd:ParameterValues>{values}</ssd:ParameterValues></ssd:ParameterBinding>"
    )
    turned = (
        'startElement="front" startConnector="F0.Fx" endElement="rotor" endConnector="bearing[1].F0.Fx"',
        'startElement="rotor" startConnector="bearing[1].F0.Fx" endElement="front" endConnector="F0.Fx"',
    )
    changes = [
        (binding, inline),
        turned,
        ("ssd:", "a:"),
        ("xmlns:ssd", "xmlns:a"),
        ("ssc:", "b:"),
        ("xmlns:ssc", "xmlns:b"),
    ]
    path = edited(law, tmp_path / "other.ssp", {"SystemStructure.ssd": changes})
    np.testing.assert_array_equal(run(path)["force"].values, run(law)["force"].values)


def refusal(path, **overrides):
    with pytest.raises((SspError, ScenarioError)) as info, ssp_case(path, overrides):
        pass
    return str(info.value)


def test_refusals_name_what_is_wrong(exported, tmp_path):
    law = exported[Wiring.LAW]
    assert "no such file" in refusal(tmp_path / "missing.ssp")
    (tmp_path / "text.ssp").write_text("text")
    assert "not a readable SSP" in refusal(tmp_path / "text.ssp")
    assert "allowed is linear-implicit" in refusal(law, coupling="jacobi")
    assert "step" in refusal(law, step=0.5)
    cut = edited(
        law,
        tmp_path / "cut.ssp",
        {"SystemStructure.ssd": [('startConnector="K[1,1]"', 'startConnector="K[1,2]"')]},
    )
    text = refusal(cut)
    assert (
        "missing: front.K[1,1] -> rotor.bearing[1].K[1,1]" in text and "not of the port: front.K[1,2]" in text
    )
    speed = [('name="speed">\n      <ssv:Real value="', 'name="speed">\n      <ssv:Real value="1')]
    assert "speed" in refusal(edited(law, tmp_path / "speed.ssp", {"resources/rear.ssv": speed}))
    name = [('name="viscosity"', 'name="thickness"')]
    path = edited(law, tmp_path / "name.ssp", {"resources/rear.ssv": name})
    with ssp_case(path) as case, pytest.raises(SspError, match=r"rear: thickness is no variable"):
        execute(case)


def test_a_failed_run_closes_its_units(exported, tmp_path, monkeypatch):
    closed = []
    close = Unit.close
    monkeypatch.setattr(Unit, "close", lambda unit: (closed.append(unit.name), close(unit)))
    name = [('name="viscosity"', 'name="thickness"')]
    path = edited(exported[Wiring.LAW], tmp_path / "name.ssp", {"resources/rear.ssv": name})
    with ssp_case(path) as case, pytest.raises(SspError):
        execute(case)
    assert closed == ["rotor", "front"]  # the rear one was not made
