"""Where FMUs are extracted: a path that hosts of Python FMUs bear, if there is one."""

import os
import signal
import tempfile
from pathlib import Path

import pytest

from orchestrator.fmi import file
from orchestrator.fmi.file import FmuStore
from tests.faults import fault


@pytest.fixture
def odd(tmp_path, monkeypatch):
    """A temporary folder with characters that hosts trip over."""
    folder = tmp_path / "a (b)"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


def test_an_odd_folder_is_avoided(odd, tmp_path, monkeypatch):
    plain = tmp_path / "plain"
    plain.mkdir()
    monkeypatch.setattr(file, "_FALLBACKS", ("/no/such/folder", str(plain)))
    monkeypatch.setattr(file, "_SAFE_PATH", file.re.compile(r"[^( ]+"))
    with FmuStore() as store:
        assert store.folder.parent == plain


def test_where_there_is_no_other_it_is_taken(odd, monkeypatch):
    """As on Windows, which has no /tmp."""
    monkeypatch.setattr(file, "_FALLBACKS", ("/no/such/folder",))
    with FmuStore() as store:
        assert store.folder.parent == Path(odd)


@fault(
    "process",
    "what a killed run had extracted to the temporary folder",
    "the next run removes it; what a run still uses stays",
    guard="orchestrator.fmi.file:_remove_rests",
)
def test_rests_of_killed_runs_are_removed(room):
    (room / "bladeloss_mine1234").mkdir()
    killed = os.fork()
    if killed == 0:
        FmuStore()
        os.kill(os.getpid(), signal.SIGKILL)
    os.waitpid(killed, 0)
    (rest,) = (path for path in room.iterdir() if path.name != "bladeloss_mine1234")
    with FmuStore() as one, FmuStore() as other:
        assert not rest.exists() and one.folder.exists() and other.folder.exists()
    assert [path.name for path in room.iterdir()] == ["bladeloss_mine1234"]
