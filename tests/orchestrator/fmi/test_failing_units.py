"""Units that answer with nonsense, or with an error: the run ends by name, and the record stays."""

import json
from zipfile import ZipFile

import pytest

from fmus.build.archive import write_archive
from orchestrator.fmi.unit import Status, Unit, UnitError
from orchestrator.outcome import INPUT_ERROR, Outcome
from orchestrator.results.record_files import read_record
from tests.faults import fault
from tests.orchestrator.foreign import call, with_text


@pytest.fixture
def run(small_fmus, tmp_path, monkeypatch):
    """Run the small train with a bearing of somebody else, which fails as it is told."""
    (tmp_path / "short.toml").write_text(
        'train = "small"\nend = 0.01\nstep = 1e-4\n[record]\ninterval = 1e-4\n'
    )

    def start(bearing, how, *options):
        monkeypatch.setenv("FAULT", how)
        return call(
            *("run", tmp_path / "short.toml", "--depth", "v3", "--depth-at", f"rear={bearing}", "--trust"),
            *("--fmus", small_fmus, "--out", tmp_path / "out", "--no-figures", *options),
        )

    return start


@fault(
    "unit",
    "an FMU that returns NaN",
    "exit 6, `not-finite`; bearing, time; no NaN in the motion that is recorded",
    guard="orchestrator.master.stepping:Stepper._problem",
)
@pytest.mark.parametrize(("coupling", "time"), [("linear-implicit", 0.0015), ("multirate", 0.0019)])
def test_nan_from_a_unit_goes_no_further(coupling, time, faulty, run, tmp_path):
    """The unit cannot be taken back, so that no step is repeated."""
    result = run(faulty, "nan", "--coupling", coupling)
    assert result.exit_code == Outcome.NOT_FINITE.status, result.output
    assert f"not-finite (exit status 6): at t = {time} s: rear: " in result.stderr
    record = read_record(tmp_path / "out-partial")
    assert record["displacement"].notnull().all() and record.attrs["status"] == "not-finite"


def test_a_bearing_without_a_gap(faulty, run, tmp_path):
    """Its gap is no number: there is none in table and summary, and the rest counts."""
    result = run(faulty, "gap")
    assert result.exit_code == 0, result.output
    found = json.loads((tmp_path / "out" / "summary.json").read_text())["bearings"]
    (rear,) = [one for one in found if one["bearing"] == "rear"]
    assert rear["least_gap_min"] is None and rear["force_max"] > 5e4


@fault(
    "unit",
    "an own bearing whose gap is no number at some instants",
    "left out of the statistics; bearing, quantity, how often and since when in the summary",
    guard="orchestrator.results.missing_values:missing_values",
)
def test_a_gap_that_is_missing_now_and_then_is_told(faulty, run, tmp_path):
    result = run(faulty, "one gap")
    assert result.exit_code == 0, result.output
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    (missing,) = [one for one in summary["missing"] if one["quantity"] == "least_gap"]
    assert missing["bearing"] == "rear" and 1 <= missing["count"] < missing["samples"]
    text = " ".join((tmp_path / "out" / "summary.txt").read_text().split())
    assert f"least_gap of rear in {missing['count']} of {missing['samples']} samples, first at " in text


@fault(
    "unit",
    "an FMU that returns a status that FMI does not know",
    "it counts as fatal: UnitError with outcome unit-failed",
    guard="orchestrator.fmi.unit:Unit._fail",
)
def test_an_unknown_status(store, toy_fmus):
    unit = Unit(store.open(toy_fmus / "spring_damper.fmu"), "front")
    with pytest.raises(UnitError, match="front: fmi2DoStep returned fatal") as info:
        unit._fail("fmi2DoStep", 17)
    assert info.value.outcome is Outcome.UNIT_FAILED and info.value.status is Status.FATAL
    assert unit.failed


@fault(
    "unit",
    "an FMU without a library for this platform",
    "exit 2; file and what is missing",
    guard="orchestrator.fmi.unit:Unit.__init__",
)
def test_a_unit_of_another_platform(faulty, run, tmp_path):
    with ZipFile(faulty) as archive:
        names = [name for name in archive.namelist() if not name.startswith("binaries/")]
        write_archive(tmp_path / "bare.fmu", {name: archive.read(name) for name in names})
    result = run(tmp_path / "bare.fmu", "")
    assert result.exit_code == INPUT_ERROR, result.output
    assert "bare.fmu: cannot be instantiated as rear: " in result.stderr


@fault(
    "unit",
    "an FMU for model exchange, or of another version of FMI",
    "exit 2; file, `not an FMI 2.0 co-simulation unit` or the schema's complaint",
    guard="orchestrator.fmi.file:FmuFile.__init__",
)
def test_a_unit_of_another_kind(small_fmus, run, tmp_path):
    source = small_fmus / "bearing_v3.fmu"
    with ZipFile(source) as archive:
        text = archive.read("modelDescription.xml").decode()
    begin = text.index("<CoSimulation")
    element = text[begin : text.index("/>", begin) + 2]
    exchange = '<ModelExchange modelIdentifier="bladeloss_bearing_v3"/>'
    path = with_text(source, tmp_path / "exchange.fmu", "modelDescription.xml", element, exchange)
    result = run(path, "")
    assert result.exit_code == INPUT_ERROR, result.output
    assert "exchange.fmu: not an FMI 2.0 co-simulation unit" in result.stderr
