"""A train on disk to spoil: fixture and helpers of the tests of train files."""

from __future__ import annotations

import shutil

import pytest

from rotor_fmu.train.file import DATA, TrainFileError, load_train


@pytest.fixture
def folder(tmp_path):
    """A copy of the small train."""
    return shutil.copytree(DATA / "small", tmp_path / "train")


def edit(folder, file, *changes):
    """Replace texts in a file, each once."""
    path = folder / file
    text = path.read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    path.write_text(text, encoding="utf-8")


def problems(folder):
    """All problems of the train in a folder."""
    with pytest.raises(TrainFileError) as caught:
        load_train(folder)
    assert str(caught.value) == "\n".join(caught.value.problems)
    return caught.value.problems
