"""``bladeloss info TRAIN``: the train as it was read."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from rich.console import Console

from orchestrator.commands.info import show_train
from orchestrator.errors import OrchestratorError

EXAMPLE = Path(__file__).parents[2] / "examples" / "motor_compressor"


def shown(source):
    console = Console(width=160, record=True, file=io.StringIO())
    show_train(str(source), console)
    return console.export_text()


def test_the_example_as_it_was_read():
    text = shown(EXAMPLE)
    for words in (
        "motor-compressor  2.1 m, 468.4 kg, 50 Hz (3000 rev/min), gravity (0, -9.80665) m/s2",
        "130 x 0 steel; 300 x 130 sheets, mass only",
        "75.5 x 0 steel; 90 x 75.5 bronze",
        "90 x 0 to 120 x 0 steel",
        "elastic coupling, 4e+07 N/m, 60000 N m/rad, 2000 N s/m, 5 N m s/rad",
        "mass, 14 kg, polar 0.09, transverse 0.06 kg m2",
    ):
        assert words in text
    row, film = [line for line in text.splitlines() if "compressor-rear" in line]
    assert [cell.strip() for cell in film.strip("│ ").split("│")] == [
        "compressor-rear", "plain", "60", "65", "20 mPa s",
    ]  # fmt: skip
    assert [cell.strip() for cell in row.strip("│ ").split("│")] == [
        "compressor-rear",
        "1890",
        "90",
        "",
        "943.7",
    ]


def test_films_are_shown_as_they_were_understood():
    oil, pads, fan = (shown(EXAMPLE.parent / name) for name in ("oil", "tilting", "fan"))
    assert "46 mm2/s, 45 °C" in oil
    assert "4 pads" in pads and "130" in pads
    assert "60, 120" in fan


def test_a_train_that_holds_its_shaft_down(tmp_path):
    for name in ("shaft.csv", "train.toml"):
        text = (EXAMPLE / name).read_text(encoding="utf-8")
        (tmp_path / name).write_text(text.replace("30 kg", "300 kg"), encoding="utf-8")
    assert "held down" in shown(tmp_path)


def test_a_train_that_cannot_be_read(tmp_path):
    with pytest.raises(OrchestratorError, match="no such train; allowed are small, turbine"):
        shown(tmp_path / "none")


def test_loads_from_heights(tmp_path):
    """A bearing lowered by 0.2 mm under a shaft that is stiffer than any film is held down by kilonewtons."""
    for name in ("shaft.csv", "train.toml"):
        text = (EXAMPLE / name).read_text(encoding="utf-8")
        for height in ("0", "0", '"-0.2 mm"', "0"):
            text = text.replace("[[bearing]]\nname", f"[[bearing]]\nheight = {height}\nname", 1)
        (tmp_path / name).write_text(text, encoding="utf-8")
    text = shown(tmp_path)
    assert "As in short plain films" in text
    (row,) = [line for line in text.splitlines() if "held down" in line]
    assert float(row.split("│")[-2].split(",")[0]) < -1e3
