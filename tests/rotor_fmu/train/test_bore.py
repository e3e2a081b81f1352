"""Bores in train files: words and figures, grooves, arcs."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest

from fmus.port.bore import Arc, from_text
from rotor_fmu.train.file import DATA, TrainFileError, load_train
from rotor_fmu.train.film_capacity import most_load
from rotor_fmu.train.train import Train
from rotor_fmu.train.writer import write_train

SMALL = DATA / "small"


@pytest.fixture
def with_bore(tmp_path):
    """Load the small train with these lines in both of its bearings."""

    def load(lines):
        text = (SMALL / "train.toml").read_text().replace("width = 0.11", f"width = 0.11\n{lines}")
        (tmp_path / "train.toml").write_text(text)
        (tmp_path / "shaft.csv").write_text((SMALL / "shaft.csv").read_text())
        return load_train(tmp_path)

    return load


def degrees(bore):
    return [tuple(round(math.degrees(x), 9) for x in (arc.start, arc.end, arc.towards)) for arc in bore]


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ('bore = "lemon"\npreload = 0.5', [(10, 170, 90), (190, 350, 270)]),
        ('bore = "offset-halves"\npreload = 0.4', [(10, 170, 180), (190, 350, 360)]),
        ('grooves = [{at = "90 deg", width = "30 deg"}]', [(-255, 75, 180)]),
        (
            'bore = "three-lobe"\npreload = 0.6\nfirst = "30 deg"\n'
            'grooves = [{at = "30 deg", width = "10 deg"}]',
            [(35, 150, 90), (150, 270, 210), (270, 385, 330)],
        ),
        ('arcs = [{start = "200 deg", end = "340 deg"}]', [(200, 340, 270)]),
        ("arcs = [{start = 4.0, end = 5.5, preload = 0.2, towards = 4.5}]", None),
    ],
)
def test_words_and_figures(with_bore, lines, expected):
    seat = with_bore(lines).bearings[0]
    if expected is None:
        assert from_text(seat.bore) == (Arc(4.0, 5.5, 0.2, 4.5),)
    else:
        assert degrees(from_text(seat.bore)) == expected


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        ('bore = "lemons"\npreload = 0.5', "bore = 'lemons'; did you mean 'lemon'?"),
        ('bore = "lemon"', "preload = 0.0; allowed for bore = 'lemon' is more than 0, to 0.95"),
        ("preload = 0.5", "preload = 0.5; allowed for bore = 'plain' is 0"),
        ('grooves = [{at = "90 deg", wide = 0.1}]', "look at wide"),
        ('grooves = [{at = "90 m"}]', "for at"),
        ("arcs = [{start = 0, end = 2}, {start = 1, end = 3}]", "they overlap by 57.3 deg"),
        ('bore = "lemon"\npreload = 0.5\narcs = [{start = 0, end = 2}]', "beside arcs"),
        ("feed_pressure = -1.0", "feed_pressure = -1.0"),
    ],
)
def test_refused(with_bore, lines, words):
    with pytest.raises(TrainFileError) as refused:
        with_bore(lines)
    assert words in str(refused.value)


def test_a_bore_survives_files_and_json(with_bore, tmp_path):
    train = with_bore('bore = "four-lobe"\npreload = 0.3\nfeed_pressure = "1.2 bar"')
    assert train.bearings[1].feed_pressure == pytest.approx(1.2e5)
    assert Train.from_json(train.to_json()) == train
    write_train(train, tmp_path / "copy")
    assert load_train(tmp_path / "copy") == train


def test_capacity_counts_the_arcs_below(with_bore):
    seat = with_bore('bore = "lemon"\npreload = 0.5\nfirst = "45 deg"').bearings[0]
    circle = most_load(replace(seat, bore="plain"), 300.0)
    assert most_load(seat, 300.0) == pytest.approx(2.0 * circle)
    assert most_load(with_bore('arcs = [{start = "200 deg", end = "340 deg"}]').bearings[0], 300.0) == circle


def test_the_example_in_lemon_bores():
    folder = Path(__file__).parents[2] / "examples" / "lemon"
    for seat in load_train(folder).bearings:
        assert degrees(from_text(seat.bore)) == [(10, 170, 90), (190, 350, 270)]
        assert seat.feed_pressure == pytest.approx(1.2e5)
