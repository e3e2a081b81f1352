"""Pedestals and foundations in a train file."""

from pathlib import Path

import numpy as np
import pytest

from rotor_fmu.foundation.foundation import foundation_of
from rotor_fmu.train.file import TrainFileError, load_train
from rotor_fmu.train.train import Train
from rotor_fmu.train.writer import write_train

FAN = Path(__file__).parents[2] / "examples" / "fan"
TABLE = """frequency [Hz], damping, mass [kg], motor-side.x, Fan-Side.y
10, 0.02, 400, 1.0, 0.5
25, 0.05, 100, -0.2, 1.0
"""


def changed(tmp_path, old, new):
    text = (FAN / "train.toml").read_text()
    assert old in text
    (tmp_path / "shaft.csv").write_text((FAN / "shaft.csv").read_text())
    (tmp_path / "train.toml").write_text(text.replace(old, new))
    return tmp_path


def on_table(tmp_path, table=TABLE):
    folder = changed(tmp_path, "pedestal", "# pedestal")
    text = (folder / "train.toml").read_text()
    (folder / "train.toml").write_text(
        text.replace('name = "fan"', 'name = "fan"\nfoundation = "modes.csv"', 1)
    )
    (folder / "modes.csv").write_text(table)
    return folder


def test_pedestals_survive_files_and_json(tmp_path):
    train = load_train(FAN)
    assert train.bearings[0].pedestal.stiffness == (6e7, 1.2e8)
    write_train(train, tmp_path)
    assert load_train(tmp_path).bearings == train.bearings
    assert Train.from_json(train.to_json()) == train
    assert foundation_of(train).size == 4


def test_a_foundation_of_modes(tmp_path):
    train = load_train(on_table(tmp_path))
    foundation = foundation_of(train)
    np.testing.assert_allclose(foundation.omega, 2.0 * np.pi * np.array([10.0, 25.0]))
    np.testing.assert_allclose(foundation.damping, 2.0 * np.array([0.02, 0.05]) * foundation.omega)
    np.testing.assert_allclose(foundation.shapes[[0, 5]], [[0.05, -0.02], [0.025, 0.1]])
    assert not np.delete(foundation.shapes, [0, 5], axis=0).any()
    assert Train.from_json(train.to_json()) == train
    write_train(train, tmp_path / "again")
    assert load_train(tmp_path / "again") == train


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("mass = 180.0", "mass = 0.0", "pedestal: mass = 0.0; allowed is a number from 0.001"),
        ("stiffness = [6e7, 1.2e8]", 'stiffness = "hard"', "pedestal: stiffness = 'hard'; allowed is"),
        ("mass = 180.0", "mass = 180.0, inertia = 3.0", "allowed are both, or none"),
        ('name = "fan"', 'name = "fan"\nfoundation = "modes.csv"', "given beside pedestals"),
    ],
)
def test_wrong_pedestals_are_said(tmp_path, old, new, message):
    with pytest.raises(TrainFileError) as info:
        load_train(changed(tmp_path, old, new))
    assert message in str(info.value)
    assert "\n" not in str(info.value)


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("frequency, damping\n", "no row"),
        ("frequency, damping, nowhere.x\n1, 0, 0\n", "nowhere.x"),
        ("frequency, damping\n-1, 0\n", "frequency = -1.0; allowed is 0.001 to 1e+07"),
        ("frequency, damping\n1,\n", "damping is missing"),
    ],
)
def test_wrong_foundations_are_said(tmp_path, table, message):
    with pytest.raises(TrainFileError) as info:
        load_train(on_table(tmp_path, table))
    assert message in str(info.value)
