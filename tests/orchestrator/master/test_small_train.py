"""The small train on its real FMUs: start, order of the coupling, what explicit coupling costs, state."""

import re
from zipfile import ZipFile

import numpy as np
import pytest

from bearing_fmu import depths
from fmus.build.archive import write_archive
from fmus.build.promises import ISOTROPIC
from orchestrator.case.simulate import simulate
from orchestrator.master.assembly import assemble
from orchestrator.master.coupling import LinearImplicit
from orchestrator.master.start.equilibrium import apply_start, find_start
from orchestrator.outcome import Outcome
from orchestrator.scenario.file import load_scenario, train_of
from tests.faults import fault
from tests.marks import slow

DEPTHS = depths.names()
CALM = {"event": None, "unbalance": {"grade": 0.0}, "end": 0.01}


@pytest.fixture(scope="module")
def fmus(train_fmus):
    return train_fmus


def small(**overrides):
    return load_scenario("small", overrides)


def begin(scenario, fmus, store):
    """System at its start, out of Initialization Mode."""
    train = train_of(scenario)
    system = assemble(scenario, train, fmus, store)
    start = find_start(system, train, train.speed)
    return system, start, train


def finish_initialization(system, start):
    apply_start(system, start)
    for unit in system.units:
        unit.exit_initialization()
    for group in system.groups:
        group.fetch()


def march(system, steps, first=0, step=1e-4):
    path = []
    for k in range(first, first + steps):
        LinearImplicit().advance(system, k * step, step)
        path.append(np.concatenate([system.journals.ravel(), system.responses.ravel()]))
    return np.array(path)


@pytest.mark.parametrize("depth", DEPTHS)
def test_bearings_carry_their_target_loads_at_their_residual_tilts(depth, fmus, store):
    system, start, train = begin(small(depth=depth), fmus, store)
    half_weight = 0.5 * train.mass * 9.80665
    np.testing.assert_allclose(start.loads[:, 1], half_weight, rtol=2e-4)
    np.testing.assert_allclose(start.loads[:, 1].sum(), 2.0 * half_weight, rtol=1e-9)
    np.testing.assert_allclose(start.loads[:, 0].sum(), 0.0, atol=1e-9 * half_weight)
    relative = start.static - start.offsets
    residual = [[seat.residual_tilt_x, seat.residual_tilt_y] for seat in train.bearings]
    np.testing.assert_allclose(relative[:, 2:], -np.array(residual), atol=1e-12)
    assert np.all(relative[:, 0] > 0.0)  # counter-clockwise rotation carries the journal to +x
    assert np.all(relative[:, 1] < 0.0)
    system.close()


@pytest.mark.parametrize("depth", DEPTHS)
def test_without_unbalance_the_train_stays_at_rest(depth, fmus):
    record = simulate(small(depth=depth, **CALM), fmus).record
    motion = record["displacement"] - record["displacement"].isel(time=0)
    assert float(abs(motion).max()) < 1e-7 * 2.2e-4  # of the clearance
    assert float(record["vibration_amplitude_max"].max()) < 1e-10


def test_the_start_lies_on_the_orbit(fmus):
    """With the nominal unbalance the first revolution repeats, up to the films' nonlinearity."""
    period = 2.0 * np.pi / train_of(small()).speed
    step = period / 200
    scenario = small(event=None, end=2.0 * period, step=step, record={"interval": step})
    y = simulate(scenario, fmus).record["displacement"].sel(bearing="front", axis="y").values
    assert np.max(np.abs(y[200:] - y[:-200])) < 0.02 * np.ptp(y)


def forces(fmus, **change):
    """Bearing forces every 4e-4 s through the fracture at 4.13 ms, (records, bearings, 2)."""
    event = {"time": 4.13e-3}
    result = simulate(small(end=16e-3, event=event, record={"interval": 4e-4}, **change), fmus)
    assert result.outcome is Outcome.FINISHED, result.message
    return result.record["force"].values


def rms(values):
    return float(np.sqrt(np.mean(values**2)))


@pytest.mark.parametrize("depth", [depth if depth == "v1" else slow(depth) for depth in DEPTHS])
def test_linear_implicit_is_of_second_order_through_the_fracture(depth, fmus):
    reference = forces(fmus, depth=depth, step=6.25e-6)
    dynamic = rms(reference - reference[0])
    steps = (1e-4, 5e-5, 2.5e-5)
    errors = np.array([rms(forces(fmus, depth=depth, step=step) - reference) for step in steps])
    order = np.log2(errors[:-1] / errors[1:])
    assert order[-1] == pytest.approx(2.0, abs=0.1)
    assert errors[0] < 1e-3 * dynamic


def test_explicit_coupling_fails_where_linear_implicit_is_accurate(fmus):
    event, defects = {"time": 4.13e-3}, {}
    for coupling in ("linear-implicit", "gauss-seidel", "jacobi"):
        result = simulate(small(coupling=coupling, end=16e-3, event=event), fmus)
        assert result.outcome.ok == (coupling == "linear-implicit"), result.message
        record = result.record
        static = float(record["force_magnitude_max"].isel(time=0).max())
        defects[coupling] = float(record["defect_max"].max()) / static
    assert defects.pop("linear-implicit") < 1e-3
    assert min(defects.values()) > 0.05


def test_depths_differ_by_one_word_and_mix(fmus):
    gaps = {}
    for depth in DEPTHS:
        result = simulate(small(depth=depth, end=2e-3, event=None), fmus)
        gaps[depth] = result.record["least_gap"].isel(time=0).values
        assert list(result.record["depth"].values) == [depth, depth]
    assert np.all(gaps["v1"] < gaps["v2"]) and np.all(gaps["v2"] < gaps["v3"])
    mixed = simulate(small(depth_at={"rear": "v3"}, end=2e-3, event=None), fmus).record
    np.testing.assert_allclose(mixed["least_gap"].isel(time=0), [gaps["v1"][0], gaps["v3"][1]], rtol=1e-3)
    assert not mixed["moment"].sel(bearing="rear").any()


def test_parameters_alone_define_the_run(fmus, store):
    """Fresh units with the same start parameters and offsets repeat it bit by bit."""
    scenario = small()
    searched, start, train = begin(scenario, fmus, store)
    finish_initialization(searched, start)
    fresh = assemble(scenario, train, fmus, store)
    finish_initialization(fresh, start)
    np.testing.assert_array_equal(march(fresh, 30), march(searched, 30))
    searched.close()
    fresh.close()


def test_a_system_taken_back_repeats_its_steps_bit_by_bit(fmus, store):
    system, start, _ = begin(small(), fmus, store)
    finish_initialization(system, start)
    march(system, 20)
    states = [unit.get_state() for unit in system.units]
    inputs, outputs = system.graph.inputs.copy(), system.graph.outputs.copy()
    first = march(system, 20, first=20)
    for unit, state in zip(system.units, states, strict=True):
        unit.set_state(state)
        unit.free_state(state)
    system.graph.inputs[:], system.graph.outputs[:] = inputs, outputs
    np.testing.assert_array_equal(march(system, 20, first=20), first)
    system.close()


def test_a_run_repeats_bit_by_bit(fmus):
    scenario = small(end=8e-3, event={"time": 4e-3})
    first, second = (simulate(scenario, fmus).record for _ in range(2))
    assert first.identical(second)


@pytest.mark.parametrize(
    ("coupling", "step", "end"),
    [("linear-implicit", 1e-3, 0.04), ("newton", 1e-3, 0.04), ("iqn-ils", 1e-4, 0.021)],
)
def test_steps_are_taken_back_alike_with_and_without_a_mark_of_the_films(
    coupling, step, end, fmus, monkeypatch
):
    """Films say that they have no memory; a mark of theirs must then change nothing, to the bit."""
    changes = {"coupling": coupling, "tolerance": 1e-3, "step": step, "end": end, "event": {"time": 0.0203}}
    without = simulate(small(**changes), fmus)
    assert without.outcome is Outcome.FINISHED
    assert without.counts.rejected > 0 or without.counts.iterations > without.counts.accepted
    monkeypatch.setattr("orchestrator.fmi.file.promises_of", lambda _root: frozenset({ISOTROPIC}))
    marked = simulate(small(**changes), fmus)
    assert marked.counts == without.counts
    assert marked.record.identical(without.record)


@fault(
    "unit",
    "an FMU built from other sources than those of the process",
    "no-equilibrium, exit 3; the bearing, `FMU refused`, the package, and to rebuild",
    guard="fmus.unit.loader:_refusing",
)
def test_an_fmu_of_other_sources_is_refused_with_its_reason(fmus, tmp_path):
    assert simulate(small(depth="v3", **CALM), fmus).outcome is Outcome.FINISHED  # its sources are loaded now
    for path in fmus.iterdir():
        with ZipFile(path) as archive:
            files = {name: archive.read(name) for name in archive.namelist()}
        if path.name == "bearing_v3.fmu":
            script = files.pop(f"resources/{files['resources/slavemodule.txt'].decode()}.py")
            files["resources/slavemodule.txt"] = b"bearing_of_others"  # modules go by name
            files["resources/bearing_of_others.py"] = re.sub(
                rb"'bearing_fmu': '\w+'", b"'bearing_fmu': 'other'", script
            )
        write_archive(tmp_path / path.name, files)
    result = simulate(small(depth="v3", **CALM), tmp_path)
    assert result.outcome is Outcome.NO_EQUILIBRIUM
    assert "front: no film at any position: front: FMU refused: the package bearing_fmu" in result.message
    assert "rebuild the FMU" in result.message
