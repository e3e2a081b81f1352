"""Stiffness and damping in train files: numbers, matrices, tables; what is wrong is told at its line."""

import math

import numpy as np
import pytest

from fmus import port
from rotor_fmu.train.file import TrainFileError, load_train
from rotor_fmu.train.train import Train
from rotor_fmu.train.writer import write_train
from tests.rotor_fmu.published import FRISWELL

TABLE = """\
speed [rpm], Kxx [kN/mm], Kxy, Kyy [N/m], Cxx [N s/mm], C34
# a tilting-pad bearing
3000, 100, 1e6, 2e8, 50, 7
6000, 120, 1.5e6, 2.5e8, 40, 8
"""


def train(tmp_path, first, *, table=None):
    """The Friswell rotor with other words at its first bearing."""
    folder = FRISWELL.write(tmp_path / "rotor", 4000)
    text = (folder / "train.toml").read_text()
    (folder / "train.toml").write_text(text.replace("stiffness = 1e6\ndamping = 0", first, 1))
    if table is not None:
        (folder / "tilting.csv").write_text(table)
    return folder


def rows(loaded, bearing=0):
    return np.array(port.coefficient_rows(loaded.bearings[bearing].coefficients))


def test_numbers_and_matrices_fill_a_full_one(tmp_path):
    loaded = load_train(train(tmp_path, "stiffness = [[1.0, 2.0], [-3.0, 4.0]]\ndamping = [5, 6.0]"))
    ((speed, *numbers),) = rows(loaded)
    stiffness, damping = np.array(numbers).reshape(2, 4, 4)
    assert stiffness[:2, :2].tolist() == [[1.0, 2.0], [-3.0, 4.0]] and not stiffness[2:].any()
    assert np.diag(damping).tolist() == [5.0, 6.0, 0.0, 0.0] and speed == 0.0
    assert not loaded.bearings[0].has_film
    full = np.arange(16.0).reshape(4, 4)
    other = load_train(train(tmp_path / "4x4", f"stiffness = {full.tolist()}"))
    assert np.array_equal(rows(other)[0, 1:17].reshape(4, 4), full)


def test_a_table_of_another_program_is_read_with_its_units(tmp_path):
    found = rows(load_train(train(tmp_path, 'table = "tilting.csv"', table=TABLE)))
    assert found[:, 0] == pytest.approx([100.0 * math.pi, 200.0 * math.pi])
    assert found[:, 1] == pytest.approx([1e8, 1.2e8]) and found[:, 2] == pytest.approx([1e6, 1.5e6])
    assert found[:, 6] == pytest.approx([2e8, 2.5e8]) and found[:, 17] == pytest.approx([5e4, 4e4])
    assert found[:, 17 + 11] == pytest.approx([7.0, 8.0])
    assert np.count_nonzero(found) == 12


def test_a_table_as_a_spreadsheet_writes_it(tmp_path):
    text = "\ufeffSpeed [rpm];Kxx [kN/mm];K13 [kN/rad]\r\n3000;100,5;2,5\r\n;;\r\n6000;120;3\r\n"
    found = rows(load_train(train(tmp_path, 'table = "tilting.csv"', table=text)))
    assert found[:, [1, 3]].tolist() == [[1.005e8, 2.5e3], [1.2e8, 3e3]]


def test_written_trains_read_again(tmp_path):
    loaded = load_train(train(tmp_path, 'table = "tilting.csv"', table=TABLE))
    write_train(loaded, tmp_path / "again")
    assert load_train(tmp_path / "again") == loaded == Train.from_json(loaded.to_json())


@pytest.mark.parametrize(
    ("first", "table", "reasons"),
    [
        (
            "stiffness = [1, 2, 3]",
            None,
            ["line 11", "stiffness = [1, 2, 3]; allowed is a number for x and y"],
        ),
        ("stiffness = true", None, ["stiffness = True", "2x2 or 4x4"]),
        ("damping = [[1, nan], [0, 1]]", None, ["damping", "2x2 or 4x4"]),
        ('stiffness = 1e6\ntable = "tilting.csv"', TABLE, ["table: given beside stiffness"]),
        ('table = "no.csv"', None, ["line 11", "no.csv: not readable"]),
        (
            'table = "tilting.csv"',
            "speed,Kxz\n1,2\n",
            ["tilting.csv: header: column 'Kxz'", "allowed are speed, k11"],
        ),
        ('table = "tilting.csv"', "speed,Kxx [lb/in]\n1,2\n", ["header: column 'Kxx [lb/in]'", "in N/m"]),
        ('table = "tilting.csv"', "Kxx\n1\n", ["missing speed"]),
        ('table = "tilting.csv"', "speed,Kxx\n1,x\n", ["row 2: kxx = 'x'; allowed is a number in N/m"]),
        ('table = "tilting.csv"', "speed;Kxx\n1;2\n3;\n", ["row 3: kxx = ''; allowed is a number"]),
        ('table = "tilting.csv"', "speed,Kxx,K11\n1,2,3\n", ["'k11' and 'kxx' are the same"]),
        ('table = "tilting.csv"', "speed,Kxx\n1,2\n1,3\n", ["speeds must ascend"]),
        ("stiffness = 1e6\ndiameter = 0.05", None, ["width: missing", "clearance: missing"]),
        ("", None, ["diameter: missing", "viscosity: missing"]),
    ],
)
def test_what_is_wrong_is_told_with_what_is_allowed(tmp_path, first, table, reasons):
    with pytest.raises(TrainFileError) as error:
        load_train(train(tmp_path, first, table=table))
    assert all(reason in str(error.value) for reason in reasons), str(error.value)
