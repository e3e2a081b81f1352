"""Bearings that a depth cannot have are wrong input, said with the key before anything runs."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from orchestrator.errors import ScenarioError
from orchestrator.scenario.file import load_scenario

LEMON = Path("tests/examples/lemon")


@pytest.fixture
def lemon(tmp_path):
    shutil.copytree(LEMON, tmp_path / "lemon")
    return tmp_path / "lemon"


def test_a_depth_that_does_not_know_the_bore(lemon):
    with pytest.raises(ScenarioError) as error:
        load_scenario(lemon / "loss.toml", {"depth": "v3"})
    assert "depth = 'v3': not for bearing front, rear: bearing parameter bore" in str(error.value)
    assert str(error.value).count("\n") == 0


def test_the_depth_of_one_bearing(lemon):
    with pytest.raises(ScenarioError, match=r"depth_at\.rear = 'table': not for bearing rear: .* plain bore"):
        load_scenario(lemon / "loss.toml", {"depth_at": {"rear": "table"}})


def test_the_film_of_a_linear_bearing(lemon):
    with pytest.raises(ScenarioError, match=r"linear_from = 'v3': not for bearing front: .* plain bore"):
        load_scenario(lemon / "loss.toml", {"depth_at": {"front": "linear"}, "linear_from": "v3"})


def test_a_layer_in_a_bore_that_is_not_plain(lemon):
    text = (lemon / "train.toml").read_text()
    (lemon / "train.toml").write_text(text.replace("width = 0.11", 'width = 0.11\nlayer_thickness = "2 mm"'))
    with pytest.raises(ScenarioError, match=r"line 6: depth = 'v1': not for bearing front, rear: .*layer_th"):
        load_scenario(lemon / "loss.toml")
