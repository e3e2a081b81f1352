"""Where FMUs are extracted: a path that hosts of Python FMUs bear, if there is one."""

import tempfile
from pathlib import Path

import pytest

from orchestrator.fmi import file
from orchestrator.fmi.file import FmuStore


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
