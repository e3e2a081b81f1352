"""A bearing in a file of its own."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from fmus.port.bore import from_text
from rotor_fmu.train.file import TrainFileError
from rotor_fmu.train.lone import load_bearing

DAM = Path(__file__).parents[2] / "examples" / "bearing" / "dam.toml"


def test_a_bearing_with_a_pressure_dam():
    found = load_bearing(DAM)
    assert found.speed == pytest.approx(314.159, rel=1e-5) and found.load == 12e3
    assert found.seat.clearance == 2e-4 and found.seat.name == "dam" and found.film["columns"] == 72
    arcs = from_text(found.seat.bore)
    assert [arc.share for arc in arcs] == [0.75, 0.0, 0.0] and arcs[0].depth == pytest.approx(2.0)


def test_other_files_are_other_files(tmp_path):
    path = tmp_path / "scenario.toml"
    path.write_text('train = "small"\nend = 1.0\n')
    assert load_bearing(path) is None


def test_every_problem_is_told(tmp_path):
    path = tmp_path / "wrong.toml"
    path.write_text('speed = "50 Hz"\nlood = 1.0\n[bearing]\ndiameter = 200.0\nwidth = 0.1\n')
    with pytest.raises(TrainFileError) as error:
        load_bearing(path)
    text = str(error.value)
    for words in ("load: missing", "lood: unknown key", "diameter = 200.0; allowed is", "clearance: missing"):
        assert words in text
    path.write_text(DAM.read_text().replace('"0.2 mm"', "0.2"))
    with pytest.raises(TrainFileError, match=r"clearance = 0\.2; allowed"):
        load_bearing(path)
    path.write_text(re.sub("speed = .*", "speed = 9000.0", DAM.read_text()))
    with pytest.raises(TrainFileError, match=r"speed = 9000\.0: the journal of 'wrong' would run at .* m/s"):
        load_bearing(path)
