"""The oil of a bearing in a train file: grade, viscosities, values with units, what is refused."""

from __future__ import annotations

import pytest

from fmus import port
from rotor_fmu.train.file import DATA, TrainFileError, load_train
from rotor_fmu.train.writer import write_train
from tests.faults import fault

SMALL = DATA / "small"


@pytest.fixture
def with_oil(tmp_path):
    """Load the small train with these lines in place of the viscosity."""

    def load(lines):
        text = (SMALL / "train.toml").read_text().replace("viscosity = 0.012", lines)
        (tmp_path / "train.toml").write_text(text)
        (tmp_path / "shaft.csv").write_text((SMALL / "shaft.csv").read_text())
        return load_train(tmp_path)

    return load


def test_a_grade(with_oil):
    seat = with_oil('oil = "ISO VG 46"\nsupply_temperature = "45 degC"').bearings[0]
    assert seat.oil == port.Oil.of_grade(46)
    assert seat.supply_temperature == pytest.approx(318.15)
    assert seat.viscosity == pytest.approx(seat.oil.dynamic(328.15, seat.density))


def test_two_viscosities_and_back_through_a_file(with_oil, tmp_path):
    train = with_oil('viscosity_40 = "46 mm2/s"\nviscosity_100 = "6.9 mm2/s"\nheat_capacity = "2.1 kJ/kg/K"')
    assert train.bearings[0].oil == port.Oil(46e-6, 6.9e-6)
    assert train.bearings[0].heat_capacity == pytest.approx(2100.0)
    write_train(train, tmp_path / "again")
    assert load_train(tmp_path / "again") == train


def test_without_oil_the_viscosity_is_what_is_given():
    assert load_train(SMALL).bearings[0].oil is None


@fault(
    "input",
    "an oil that is none, or given twice",
    "exit 2; line, value, what is allowed",
    guard="rotor_fmu.train.oil:OilKeys._is_one_oil",
)
@pytest.mark.parametrize(
    ("lines", "words"),
    [
        ('oil = "VG 46"\nviscosity = 0.012', "viscosity: given beside an oil; allowed is one of them"),
        ('oil = "VG 47"', "oil = 'VG 47'; allowed is a grade of ISO 3448"),
        ("viscosity_40 = 46e-6", "viscosity_40 and viscosity_100; allowed are both or none"),
        ("viscosity_40 = 46e-6\nviscosity_100 = 5e-5", "allowed is from 1e-6 m2/s to less than viscosity_40"),
        ('oil = "VG 46"\nviscosity_40 = 46e-6', "oil: given beside viscosity_40"),
        ("viscosity = 0.02\nviscosity_index = 95", "allowed is one of them"),
        ('oil = "VG 46"\nsupply_temperature = 45.0', "did you give degrees Celsius"),
    ],
)
def test_what_is_refused(with_oil, lines, words):
    with pytest.raises(TrainFileError, match=r"train.toml: line \d+") as error:
        with_oil(lines)
    assert words in str(error.value), str(error.value)
