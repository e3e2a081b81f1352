"""Modes keep their number through a crossing, and shapes decide."""

import numpy as np
import pytest

from rotor_fmu.linear.tracking import follow, modal_assurance
from rotor_fmu.linear.whirl import WhirlModes


def modes(*pairs):
    """Modes of (eigenvalue, shape of x and y at two nodes), ascending in frequency as `whirl_modes` gives."""
    ordered = sorted(pairs, key=lambda pair: pair[0].imag)
    shapes = np.zeros((8, len(ordered)), complex)
    for k, (_, (first, second)) in enumerate(ordered):
        shapes[0:2, k], shapes[4:6, k] = first, second
    return WhirlModes(np.array([value for value, _ in ordered]), shapes)


FORWARD = ((1.0, -1j), (1.0, -1j))
BACKWARD = ((1.0, 1j), (1.0, 1j))
CONICAL = ((1.0, -1j), (-1.0, 1j))


def crossing(speed):
    """A forward mode that rises through a backward one that falls, at the speed 5."""
    return modes((-1.0 + 1j * (100.0 + speed), FORWARD), (-1.0 + 1j * (110.0 - speed), BACKWARD))


def test_forward_and_backward_whirl_of_one_line_are_orthogonal():
    found = modal_assurance(modes((1j, FORWARD), (2j, BACKWARD)), modes((1j, CONICAL), (3j, BACKWARD)))
    assert found == pytest.approx(np.array([[0.0, 0.0], [0.0, 1.0]]), abs=1e-15)


@pytest.mark.parametrize("reference", [0, 2, 4])
def test_a_mode_keeps_its_number_through_a_crossing(reference):
    speeds = [0.0, 3.0, 4.9, 6.0, 10.0]
    found = follow(crossing, speeds, reference, 2)
    frequency = found.of(lambda m: m.frequency)
    rising = int(np.argmax(frequency[-1] - frequency[0]))
    assert frequency[:, rising] == pytest.approx(100.0 + np.array(speeds))
    assert frequency[:, 1 - rising] == pytest.approx(110.0 - np.array(speeds))
    assert np.all(found.of(lambda m: m.direction)[:, rising] == pytest.approx(1.0))


def test_a_mode_that_comes_or_goes_has_no_number_elsewhere():
    def at(speed):
        pairs = [(100j, FORWARD)] + ([(-0.1 + 40j, CONICAL)] if speed > 2.0 else [])
        return modes(*pairs)

    found = follow(at, [0.0, 1.0, 3.0], 0, 4).of(lambda m: m.frequency)
    assert found[:, 0] == pytest.approx([100.0] * 3)
    assert np.isnan(found[:2, 1]).all() and found[2, 1] == 40.0


def test_a_shape_that_turns_slowly_is_followed_by_looking_in_between():
    """From one end to the other each shape comes nearer to where the other was; on the way it does not."""

    def at(speed):
        turn = np.array([[np.cos(speed), -np.sin(speed)], [np.sin(speed), np.cos(speed)]])
        first, second = (turn @ (1.0, 0.0)).astype(complex), (turn @ (0.0, 1.0)).astype(complex)
        return modes((10j, ((first[0], 0), (first[1], 0))), (12j, ((second[0], 0), (second[1], 0))))

    found = follow(at, [0.0, np.pi / 3.0], 0, 2)
    assert found.of(lambda m: m.frequency)[1].tolist() == [10.0, 12.0]
