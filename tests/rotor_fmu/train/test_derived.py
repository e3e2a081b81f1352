"""Trains derived from others, and bores of tilting pads and pockets in train files."""

from __future__ import annotations

import math
import shutil
from pathlib import Path

import pytest

from fmus.port.bore import from_text
from rotor_fmu.train.file import TrainFileError, bundled_file, load_train

LEMON = Path(__file__).parents[2] / "examples" / "lemon"


def derived(tmp_path, text, name="own.toml"):
    shutil.copytree(LEMON, tmp_path, dirs_exist_ok=True)
    (tmp_path / name).write_text('base = "train.toml"\n' + text)
    return tmp_path / name


def test_bundled_train_on_other_bores():
    plain, lemon, pads = (load_train(name) for name in ("turbine", "turbine/lemon", "turbine/tilting"))
    assert plain.shoulders == lemon.shoulders == pads.shoulders and pads.name == "turbine-tilting"
    assert {seat.feed_pressure for seat in lemon.bearings} == {1.5e5}
    for seat in pads.bearings:
        arcs = from_text(seat.bore)
        assert len(arcs) == 4 and all(arc.compliance == 0.0 and arc.preload == 0.0 for arc in arcs)
        assert (arcs[2].towards - arcs[2].start) / arcs[2].length == pytest.approx(0.5)
    assert bundled_file("turbine/../small") is None and bundled_file("none") is None


def test_keys_take_the_place_of_the_base(tmp_path):
    path = derived(
        tmp_path,
        'speed = 300.0\n[every_bearing]\nclearance = "0.2 mm"\n[[bearing]]\nname = "rear"\n'
        'bore = "tilting-pads"\npads = 5\npivot_stiffness = 2e9\nfirst = "-18 deg"\n',
    )
    train = load_train(path)
    front, rear = train.bearings
    assert train.speed == 300.0 and front.clearance == rear.clearance == 2e-4
    assert len(from_text(front.bore)) == 2
    pads = from_text(rear.bore)
    assert [arc.compliance for arc in pads] == [5e-10] * 5
    assert math.degrees(pads[0].length) == pytest.approx(62.0)
    assert math.degrees(pads[0].towards) == pytest.approx(18.0)


def test_pockets_are_cut_into_arcs(tmp_path):
    path = derived(
        tmp_path,
        '[every_bearing]\nbore = "plain"\ngrooves = [{at = "0 deg"}, {at = "180 deg"}]\npockets = '
        '[{at = "70 deg", width = "100 deg", share = 0.75, depth = "0.44 mm"}, '
        '{at = "270 deg", width = "12 deg", share = 0.3, fed = true}]\n',
    )
    arcs = from_text(load_train(path).bearings[0].bore)
    assert [round(math.degrees(a.start)) for a in arcs] == [10, 20, 120, 190, 264, 276]
    assert [a.share for a in arcs] == [0.0, 0.75, 0.0, 0.0, 0.3, 0.0]
    assert arcs[1].depth == pytest.approx(2.0) and arcs[4].fed and not arcs[1].fed


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('[every_bearing]\nbore = "tilting-pads"\ngrooves = [{at = 0.0}]\n', "grooves: allowed beside bore"),
        ("[every_bearing]\npads = 4\n", "pads: allowed beside bore = 'tilting-pads' only"),
        ('[every_bearing]\nbore = "tilting-pads"\npads = 9\n', "pads = 9; allowed is a number of at most 8"),
        ('[[bearing]]\nname = "middle"\n', "bearing 'middle'; allowed are those of the base, front, rear"),
        (
            '[every_bearing]\nbore = "plain"\npockets = [{at = "0 deg", width = "30 deg", share = 0.5}]\n'
            'grooves = [{at = "10 deg"}]\n',
            "pocket of 30 deg at 0 deg; allowed is a place on one arc",
        ),
    ],
)
def test_no_such_bore(tmp_path, text, words):
    with pytest.raises(TrainFileError) as error:
        load_train(derived(tmp_path, text))
    assert words in str(error.value)


def test_a_base_has_no_base(tmp_path):
    derived(tmp_path, "speed = 300.0\n")
    (tmp_path / "second.toml").write_text('base = "own.toml"\n')
    with pytest.raises(TrainFileError, match="a train without base"):
        load_train(tmp_path / "second.toml")
    (tmp_path / "third.toml").write_text('[every_bearing]\nbore = "lemon"\n')
    with pytest.raises(TrainFileError, match="every_bearing: allowed is it beside base"):
        load_train(tmp_path / "third.toml")
