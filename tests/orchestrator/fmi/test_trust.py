"""Native code of others runs only when the user agrees; what this installation builds runs as it is."""

import shutil
import sys
from zipfile import ZipFile

import pytest
from pythonfmu.builder import FmuBuilder

from bearing_fmu.recipe import bearing_recipe
from fmus.build.archive import write_archive
from fmus.build.builder import write
from orchestrator.case.checkpoint_folder import checkpoint_folder
from orchestrator.fmi import trust
from orchestrator.fmi.own import is_own
from orchestrator.fmi.trust import UntrustedError, require_trust
from orchestrator.fmi.voucher import vouch, vouched
from orchestrator.observers import checkpoint
from orchestrator.outcome import INPUT_ERROR
from orchestrator.results.record_files import read_record
from orchestrator.scenario.file import load_scenario
from orchestrator.ssp.export import export
from rotor_fmu.recipe import rotor_recipe
from rotor_fmu.train.file import load_train
from tests.faults import fault
from tests.orchestrator.fmi.test_own_bearing import EXAMPLE
from tests.orchestrator.foreign import call, with_entry, with_text


@pytest.fixture(scope="module")
def spring(tmp_path_factory):
    """A bearing of somebody else."""
    folder = tmp_path_factory.mktemp("own")
    return folder / FmuBuilder.build_FMU(EXAMPLE, folder).name


@pytest.fixture
def short(tmp_path):
    (tmp_path / "short.toml").write_text('train = "small"\nend = 0.003\ndepth = "v3"\n')
    return tmp_path / "short.toml"


def untrusted(result, name):
    """The message for a file that may not run."""
    assert result.exit_code == INPUT_ERROR, result.output
    (text,) = result.stderr.strip().splitlines()
    assert name in text and "native code" in text and "--trust" in text
    return text


def never(*_, **__):
    raise AssertionError("an FMU was instantiated")


@pytest.fixture
def nothing_runs(monkeypatch):
    monkeypatch.setattr("orchestrator.fmi.unit.Unit.__init__", never)


@fault(
    "archive",
    "an FMU of somebody else, without terminal and without `--trust`",
    "exit 2; file, `native code`, `--trust`; nothing of it runs",
    guard="orchestrator.case.prepare:prepare",
)
def test_a_bearing_of_somebody_else_needs_trust(spring, short, small_fmus, tmp_path, nothing_runs):
    arguments = ("run", short, "--depth-at", f"rear={spring}", "--fmus", small_fmus, "--out", tmp_path / "o")
    untrusted(call(*arguments), str(spring))
    assert not (tmp_path / "o").exists()


@fault(
    "archive",
    "an FMU of somebody else in an investigation of the linearised train",
    "exit 2; file, `native code`, `--trust`; nothing of it runs",
    guard="orchestrator.linear.case:LinearCase._ensure",
)
def test_linear_commands_ask_as_well(spring, short, small_fmus, tmp_path, nothing_runs):
    short.write_text(short.read_text() + f'[depth_at]\nrear = "{spring}"\n')
    untrusted(call("modes", short, "--fmus", small_fmus, "--out", tmp_path / "o"), str(spring))


@fault(
    "archive",
    "an export that would run an FMU of somebody else to find the start",
    "exit 2; file, `native code`, `--trust`; nothing of it runs",
    guard="orchestrator.commands.export_ssp:export_scenario",
)
def test_an_export_asks_as_well(spring, short, small_fmus, tmp_path, nothing_runs):
    short.write_text(short.read_text() + f'[depth_at]\nrear = "{spring}"\n')
    untrusted(call("export-ssp", short, "--fmus", small_fmus, "--out", tmp_path / "o.ssp"), str(spring))
    assert not (tmp_path / "o.ssp").exists()


def foreign_ssp(ssp, bearing, target):
    with ZipFile(ssp) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    files["resources/bearing_v3.fmu"] = bearing.read_bytes()
    write_archive(target, files)
    return target


@fault(
    "archive",
    "an SSP in which an FMU has our name and GUID, but other code",
    "exit 2; archive, FMU in it, `native code`, `--trust`; nothing of it runs",
    guard="orchestrator.case.prepare:prepare",
)
def test_an_ssp_with_doctored_code(small_ssp, small_fmus, tmp_path, nothing_runs):
    script = next(
        n for n in ZipFile(small_fmus / "bearing_v3.fmu").namelist() if "bladeloss_bearing_v3_" in n
    )
    doctored = tmp_path / "doctored.fmu"
    with_text(small_fmus / "bearing_v3.fmu", doctored, script, "keep(globals())", "keep(dict(()))")
    path = foreign_ssp(small_ssp, doctored, tmp_path / "x.ssp")
    text = untrusted(call("run", path, "--out", tmp_path / "o"), "x.ssp: resources/bearing_v3.fmu")
    assert "rotor" not in text


def test_our_own_ssp_runs_without_a_question(small_fmus, tmp_path):
    """Also where start values that no parameter set holds are inside its FMUs."""
    settings = {
        "depth": "v3",
        "end": 0.003,
        "event": None,
        "reduction": "guyan",
        "film": {"columns": 32, "rows": 6},
    }
    path, _ = export(load_scenario("small", settings), small_fmus, tmp_path / "small.ssp", "small")
    result = call("run", path, "--out", tmp_path / "o", "--no-figures")
    assert result.exit_code == 0, result.output


@fault(
    "archive",
    "an FMU of ours with a file added, such as another library",
    "it counts as foreign: `--trust`",
    guard="fmus.build.archive:holds",
)
def test_added_code_is_foreign(small_fmus, tmp_path):
    bearing = small_fmus / "bearing_v3.fmu"
    assert is_own(bearing)
    assert not is_own(with_entry(bearing, tmp_path / "x.fmu", "binaries/linux64/evil.so"))


@fault(
    "archive",
    "an FMU of ours with one byte of its code changed",
    "it counts as foreign: `--trust`",
    guard="fmus.build.archive:holds",
)
def test_changed_code_is_foreign(small_fmus, tmp_path):
    names = ZipFile(small_fmus / "rotor_small.fmu").namelist()
    member = next(name for name in names if name.endswith("facade.py"))
    path = with_text(small_fmus / "rotor_small.fmu", tmp_path / "x.fmu", member, "import", "IMPORT")
    assert is_own(small_fmus / "rotor_small.fmu") and not is_own(path)


def test_trains_and_start_values_are_data(tmp_path):
    own = [
        rotor_recipe(load_train("small"), {"start.orbit": False, "reduction": "guyan"}),
        bearing_recipe("v1", {"film.rows": 6, "film.columns": 32}),
    ]
    assert all(is_own(write(recipe, tmp_path)) for recipe in own)
    (tmp_path / "text.fmu").write_text("text")
    assert not is_own(tmp_path / "text.fmu")


@fault(
    "archive",
    "a cloned folder of FMUs with a doctored bearing of our name and GUID",
    "exit 2; the file, which is left as it is; nothing of it runs",
    guard="fmus.build.builder:refresh",
)
def test_a_doctored_bearing_in_the_folder_of_fmus(short, small_fmus, tmp_path, nothing_runs):
    recipe = bearing_recipe("v3")
    script = next(
        n for n in ZipFile(small_fmus / "bearing_v3.fmu").namelist() if "bladeloss_bearing_v3_" in n
    )
    folder = tmp_path / "cloned"
    folder.mkdir()
    target = folder / recipe.stored_name
    with_text(small_fmus / "bearing_v3.fmu", target, script, "keep(globals())", "keep(dict(()))")
    doctored = target.read_bytes()
    result = call("run", short, "--fmus", folder, "--out", tmp_path / "o")
    assert result.exit_code == INPUT_ERROR, result.output
    (text,) = result.stderr.strip().splitlines()
    assert text.startswith(f"error: {target}: is not what bladeloss builds under this name")
    assert target.read_bytes() == doctored and not (tmp_path / "o").exists()


def test_a_doctored_bearing_of_the_plain_name_is_passed_over(short, small_fmus, tmp_path):
    """It is neither run nor changed."""
    folder = tmp_path / "cloned"
    folder.mkdir()
    path = with_entry(small_fmus / "bearing_v3.fmu", folder / "bearing_v3.fmu", "resources/evil.py")
    mine = path.read_bytes()
    result = call("run", short, "--fmus", folder, "--out", tmp_path / "o", "--no-figures")
    assert result.exit_code == 0, result.output
    assert path.read_bytes() == mine
    assert bearing_recipe("v3").stored_name in read_record(tmp_path / "o").attrs["fmus"]


@fault(
    "archive",
    "a scenario with an FMU of somebody else in the folder of FMUs",
    "exit 2; file, `native code`, `--trust`; nothing of it runs",
    guard="orchestrator.fmi.trust:require_trust",
)
def test_the_folder_of_fmus_vouches_for_nothing(spring, short, small_fmus, tmp_path, nothing_runs):
    folder = tmp_path / "fmus"
    folder.mkdir()
    shutil.copy(spring, folder / "mine.fmu")
    short.write_text(short.read_text() + '[depth_at]\nrear = "fmus/mine.fmu"\n')
    untrusted(call("run", short, "--fmus", folder, "--out", tmp_path / "o"), "mine.fmu")


@fault(
    "archive",
    "an FMU of somebody else, on a terminal where the user says no",
    "exit 2 after the question; file, `native code`",
    guard="orchestrator.fmi.trust:_agrees",
)
def test_the_question_on_a_terminal(spring, monkeypatch):
    asked = []
    monkeypatch.setattr(sys.stdin, "isatty", lambda: True, raising=False)
    monkeypatch.setattr(trust.typer, "confirm", lambda text, **_: asked.append(text))
    with pytest.raises(UntrustedError, match=r"mine: holds native code .* say --trust"):
        require_trust({"mine": spring})
    assert "mine holds native code" in asked[0] and asked[0].endswith("Run it?")
    monkeypatch.setattr(trust.typer, "confirm", lambda *_, **__: True)
    assert len(require_trust({"mine": spring})) == 1


@fault(
    "archive",
    "a checkpoint of somebody else that says which FMUs are trusted",
    "it does not vouch for itself: exit 2, file, `native code`, `--trust`",
    guard="orchestrator.fmi.voucher:vouched",
)
def test_a_voucher_is_worth_something_to_its_user_only(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "mine"))
    vouchers = vouch(["a", "b"])
    assert vouched(vouchers | {"c": vouchers["a"]}) == {"a", "b"}
    assert (tmp_path / "mine" / "bladeloss" / "voucher-key").stat().st_mode & 0o777 == 0o600
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "other"))
    assert vouched(vouchers) == set()
    vouch(["a"])
    assert vouched(vouchers) == set()
    monkeypatch.setenv("XDG_STATE_HOME", "/proc/none")
    assert vouch(["a"]) == {} and vouched(vouchers) == set()


@fault(
    "archive",
    "an FMU that is exchanged between a trusted run and its resumption",
    "exit 2; file, `native code`, `--trust`; unchanged, it runs without a question",
    guard="orchestrator.fmi.trust:require_trust",
)
def test_a_resumed_run_knows_what_was_trusted(spring, short, small_fmus, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    mine, out = tmp_path / "mine.fmu", tmp_path / "o"
    shutil.copy(spring, mine)
    options = ("--no-figures", "--fmus", small_fmus, "--out", out, "--checkpoint", 0.001, "--trust")
    monkeypatch.setattr("orchestrator.commands.run.discard", lambda _: None)  # as if it had been killed
    assert call("run", short, "--depth-at", f"rear={mine}", *options).exit_code == 0
    assert len(checkpoint.read(checkpoint_folder(out)).about["trusted"]) == 1
    assert call("resume", out).exit_code == 0
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "somebody-else"))
    untrusted(call("resume", out), str(mine))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    assert call("resume", out).exit_code == 0
    shutil.copy(with_entry(spring, tmp_path / "other.fmu", "resources/x"), mine)
    untrusted(call("resume", out), str(mine))
    assert call("resume", out, "--trust").exit_code == 0
