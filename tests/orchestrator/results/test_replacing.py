"""Results replace those of an earlier run, and nothing else; a kill at any moment loses neither."""

import os
import signal
from pathlib import Path

import pytest

from orchestrator.errors import NotWrittenError
from orchestrator.results import manifest
from orchestrator.results.files import data_then_figures
from orchestrator.results.folder import PARTIAL, ResultFolderError, check_folder, named
from orchestrator.results.folder_lock import lock_folder
from orchestrator.results.replacing import result_folder
from tests.faults import fault
from tests.orchestrator.foreign import call

NAMES = ("record.nc", "scenario.toml", "summary.json", "figures/gap.png")


def write(folder, text, names=NAMES):
    for name in names:
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)


def results(folder, text, names=NAMES):
    with result_folder(folder) as fresh:
        write(fresh, text, names)


def content(folder):
    """Texts by name, without the list of files."""
    return {name: (folder / name).read_text() for name in manifest.files_in(folder)}


def killed_in(work):
    """Carry out work in a process that may be killed on its way; tell whether it was."""
    child = os.fork()
    if child == 0:
        try:
            work()
        finally:
            os._exit(0)
    _, status = os.waitpid(child, 0)
    return os.WIFSIGNALED(status)


def killing(count, *names):
    """Let the process be killed when these functions of `Path` are called for the time after `count`."""
    left = [count]
    for name in names:
        done = getattr(Path, name)

        def act(path, *rest, _done=done, **more):
            if not left[0]:
                os.kill(os.getpid(), signal.SIGKILL)
            left[0] -= 1
            return _done(path, *rest, **more)

        setattr(Path, name, act)


@fault(
    "process",
    "kill -9 at any change on disk while earlier results are replaced",
    "old results, or new ones, or a marked folder with all new ones inside it; the next run completes them",
    guard="orchestrator.results.replacing:finish_replacing",
)
def test_a_kill_at_every_change_on_disk(tmp_path):
    old, new = dict.fromkeys(NAMES, "old") | {"gone.txt": "old"}, dict.fromkeys(NAMES, "new")
    for count in range(40):
        out = tmp_path / f"out-{count}"
        results(out, "old", (*NAMES, "gone.txt"))
        (out / "notes.txt").write_text("mine")

        def work(out=out, count=count):
            killing(count, "rename", "replace", "unlink", "rmdir")
            results(out, "new")

        killed = killed_in(work)
        left = content(out)
        assert left.pop("notes.txt") == "mine"
        if PARTIAL not in left:
            inside = {name for name in left if name.startswith(".")}
            assert {n: t for n, t in left.items() if n not in inside} in (old, new)
        complete = [text for name, text in left.items() if Path(name).name == "record.nc"]
        assert "new" in complete or "old" in complete
        with lock_folder(out):
            pass
        left = content(out)
        assert left.pop("notes.txt") == "mine" and left in (old, new)
        check_folder(out)
        if not killed:
            assert left == new and count > 8
            return
    raise AssertionError("never came to an end")


@fault(
    "machine",
    "--out on earlier results in which a file was changed, or is the user's own, or a link",
    "exit 2 before the run; the file; nothing is changed",
    guard="orchestrator.results.folder:check_folder",
)
@pytest.mark.parametrize("how", ["changed", "mine", "a link", "a link for a folder"])
def test_what_this_program_did_not_write_is_left_as_it_is(how, tmp_path):
    out, elsewhere = tmp_path / "out", tmp_path / "elsewhere"
    results(out, "old", NAMES[1:3] if how == "mine" else NAMES)
    elsewhere.mkdir()
    (elsewhere / "gap.png").write_text("mine")
    if how == "a link for a folder":
        (out / "figures" / "gap.png").unlink()
        (out / "figures").rmdir()
        (out / "figures").symlink_to(elsewhere)
    elif how == "a link":
        (out / "record.nc").unlink()
        (out / "record.nc").symlink_to(elsewhere / "gap.png")
    else:
        (out / "record.nc").write_text("mine")
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    with pytest.raises(ResultFolderError, match=r"(record\.nc|figures) is not of an earlier run"):
        check_folder(out)
    with pytest.raises(NotWrittenError, match="they lie complete in") as info:
        results(out, "new")
    assert {path: path.read_bytes() for path in before} == before
    fresh = Path(str(info.value).rpartition(" ")[2])
    assert set(content(fresh).values()) == {"new"}


@pytest.mark.parametrize("name", ["scenario.toml", "figures/mine.png", "record.nc"])
def test_a_folder_of_the_users_own_is_refused(name, tmp_path):
    """A scenario beside the user's other files is no sign of an earlier run."""
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text("mine")
    with pytest.raises(ResultFolderError, match="no earlier result"):
        check_folder(tmp_path)


def test_files_beside_the_results_stay(tmp_path):
    out = tmp_path / "out"
    results(out, "old", (*NAMES, "figures/old.png"))
    (out / "figures" / "mine.png").write_text("mine")
    results(out, "new")
    assert content(out) == dict.fromkeys(NAMES, "new") | {"figures/mine.png": "mine"}


@fault(
    "machine",
    "a figure that cannot be drawn, for want of memory or whatever it stumbles over",
    "exit 13; record and summary are there, PARTIAL.txt says that the figures are not",
    guard="orchestrator.results.files:data_then_figures",
)
@pytest.mark.parametrize("error", [MemoryError(), ValueError("no such colour"), KeyError("x")])
def test_a_figure_that_fails_costs_the_figures_alone(error, tmp_path):
    def draw(_):
        raise error

    with pytest.raises(NotWrittenError, match="the data are complete, the figures not drawn"):
        data_then_figures(tmp_path / "out", lambda fresh: write(fresh, "new", NAMES[:3]), draw)
    assert (tmp_path / "out" / "record.nc").read_text() == "new"
    assert "figures are not written" in (tmp_path / "out" / PARTIAL).read_text()


@fault(
    "process",
    "Ctrl-C while the results are written",
    "the data get into their place first; exit 130",
    guard="orchestrator.master.interrupt:held_back",
)
def test_a_signal_while_the_results_are_written(tmp_path, monkeypatch):
    monkeypatch.setattr("orchestrator.master.interrupt.TOGETHER", 0.0)

    def fill(fresh):
        signal.raise_signal(signal.SIGINT)
        write(fresh, "new")

    with pytest.raises(KeyboardInterrupt):
        data_then_figures(tmp_path / "out", fill, lambda _: pytest.fail("drawn"))
    assert (tmp_path / "out" / "record.nc").read_text() == "new"


@fault(
    "input",
    "--out that is too long for its -partial, or a link that leads nowhere",
    "exit 2 before the run; the folder",
    guard="orchestrator.results.folder:check_writable",
)
@pytest.mark.parametrize("how", ["long", "too long", "dangling"])
def test_a_folder_that_could_never_be_made(how, tmp_path):
    out = tmp_path / ("x" * {"long": 240, "too long": 400}.get(how, 5))
    if how == "dangling":
        out.symlink_to(tmp_path / "nowhere" / "else")
    with pytest.raises(ResultFolderError):
        check_folder(out)
    result = call("run", "small", "--out", out)
    assert result.exit_code == 2 and "loading" not in result.output, result.output


def test_the_working_folder_has_a_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert named(Path()) == tmp_path and named(Path("out")) == Path("out")


def test_a_partial_result_keeps_its_reason_when_figures_are_added(tmp_path):
    out = tmp_path / "out"
    with result_folder(out) as fresh:
        (fresh / PARTIAL).write_text("the gap closed")
    with result_folder(out, adding=True) as fresh:
        (fresh / "figure.png").write_text("x")
    assert (out / PARTIAL).read_text() == "the gap closed" and (out / "figure.png").exists()
