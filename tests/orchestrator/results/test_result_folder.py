"""Results appear whole or not at all, and never in place of something else."""

import pytest

from orchestrator.results.folder import (
    PARTIAL,
    ResultFolderError,
    check_folder,
    partial_folder,
)
from orchestrator.results.manifest import MANIFEST
from orchestrator.results.replacing import result_folder
from tests.faults import fault


def write(folder, text):
    (folder / "scenario.toml").write_text(text)
    (folder / "figures").mkdir()
    (folder / "figures" / f"{text}.png").write_text(text)


def test_a_new_folder_appears_with_its_parents(tmp_path):
    target = tmp_path / "results" / "run"
    with result_folder(target) as fresh:
        write(fresh, "one")
        assert not target.exists()
    assert (target / "figures" / "one.png").read_text() == "one"
    assert [path.name for path in target.parent.iterdir()] == ["run"]
    assert target.stat().st_mode & 0o700 == 0o700


@fault(
    "machine",
    "an error while results are written",
    "no folder, and no parent that was made for it",
    guard="orchestrator.results.replacing:result_folder",
)
def test_nothing_is_left_when_writing_fails(tmp_path):
    target = tmp_path / "results" / "run"
    with pytest.raises(RuntimeError), result_folder(target) as fresh:
        write(fresh, "one")
        raise RuntimeError
    assert list(tmp_path.iterdir()) == []


def test_an_earlier_result_is_replaced_and_other_files_stay(tmp_path):
    target = tmp_path / "run"
    with result_folder(target) as fresh:
        write(fresh, "one")
        (fresh / PARTIAL).write_text("reason")
    (target / "notes.txt").write_text("mine")
    check_folder(target)
    with result_folder(target) as fresh:
        write(fresh, "two")
    names = sorted(path.relative_to(target).as_posix() for path in target.rglob("*"))
    assert names == [MANIFEST, "figures", "figures/two.png", "notes.txt", "scenario.toml"]


def test_an_earlier_result_survives_a_failure(tmp_path):
    target = tmp_path / "run"
    with result_folder(target) as fresh:
        write(fresh, "one")
    with pytest.raises(RuntimeError), result_folder(target):
        raise RuntimeError
    assert (target / "scenario.toml").read_text() == "one"


@fault(
    "machine",
    "`--out` names a folder with other files",
    "exit 2; `no earlier result`; nothing is overwritten",
    guard="orchestrator.results.folder:check_folder",
)
def test_a_folder_with_alien_files_is_refused(tmp_path):
    (tmp_path / "thesis.tex").write_text("")
    with pytest.raises(ResultFolderError, match="no earlier result"):
        check_folder(tmp_path)


def test_a_file_is_refused(tmp_path):
    (tmp_path / "x").write_text("")
    with pytest.raises(ResultFolderError, match="is a file"):
        check_folder(tmp_path / "x")


def test_an_unfinished_run_goes_beside(tmp_path):
    assert partial_folder(tmp_path / "paper-v1") == tmp_path / "paper-v1-partial"
