"""Depth linear: the affine law itself, constant or through the points of a table."""

import numpy as np
import pytest

from bearing_fmu import depths
from fmus import port

RANDOM = np.random.default_rng(3)
STARTS = {v.name: v.start for v in depths.LINEAR.parameters}
STATIC = {"static.Fx": 1e3, "static.Fy": 5e4, "static.My": 20.0, "position.x": 2e-5, "position.tilt_x": 1e-4}


def matrices():
    return RANDOM.normal(size=(4, 4)) * 1e8, RANDOM.normal(size=(4, 4)) * 1e5


def row(speed, stiffness, damping):
    return (speed, *stiffness.ravel(), *damping.ravel())


def bearing(text, **values):
    return depths.LINEAR.make({**STARTS, **STATIC, **port.coefficient_values(text), **values})


def test_the_wrench_is_affine_about_the_static_load_and_the_law_is_exact():
    stiffness, damping = matrices()
    film = bearing(port.coefficient_text([row(0.0, stiffness, damping)]), **{"offset.y": -3e-4})
    inputs = np.append(RANDOM.normal(size=16) * 1e-4, 300.0)
    out, _ = film.evaluate(film.rest(), inputs, 0.0)
    q, v = inputs[:4] - inputs[8:12], inputs[4:8] - inputs[12:16]
    at = np.array([2e-5, -3e-4, 1e-4, 0.0])
    expected = np.array([1e3, 5e4, 0.0, 20.0]) - stiffness @ (q - at) - damping @ v
    assert out[:4] == pytest.approx(expected, rel=1e-12)
    law = out[4:8] - out[8:24].reshape(4, 4) @ q - out[24:40].reshape(4, 4) @ v
    assert law == pytest.approx(out[:4], rel=1e-14)
    assert np.array_equal(out[8:24].reshape(4, 4), stiffness)
    assert np.array_equal(out[24:40].reshape(4, 4), damping)


def test_a_table_goes_smoothly_through_its_points_and_not_beyond():
    """Between points of a straight line it is that line; its slope has no jump; outside it is refused."""
    points = [matrices() for _ in range(4)]
    speeds = (100.0, 150.0, 250.0, 300.0)
    text = port.coefficient_text(row(s, *p) for s, p in zip(speeds, points, strict=True))
    film = bearing(text)
    for speed, (stiffness, damping) in zip(speeds, points, strict=True):
        found = film.coefficients(speed)
        assert found[0] == pytest.approx(stiffness) and found[1] == pytest.approx(damping)
    step = 1e-4
    for speed in speeds[1:3]:
        before, at, after = (film.coefficients(speed + k * step)[0] for k in (-1, 0, 1))
        assert after - at == pytest.approx(at - before, rel=1e-2, abs=2e-3 * step * 1e8)
    first, second = points[0], points[1]
    line = bearing(port.coefficient_text([row(0.0, *first), row(10.0, *second)]))
    assert line.coefficients(2.5)[1] == pytest.approx(0.75 * first[1] + 0.25 * second[1])
    with pytest.raises(ArithmeticError, match="from 100 to 300 rad/s, not at 99"):
        film.coefficients(99.0)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("1 2 3", "row 1 has 3 numbers; allowed are 33"),
        ("1 x", "row 1: could not convert"),
        (port.coefficient_text([(2.0, *[0.0] * 32), (1.0, *[0.0] * 32)]), "speeds must ascend"),
    ],
)
def test_a_table_that_is_none_is_refused(text, reason):
    with pytest.raises(ValueError, match=reason):
        bearing("", coefficients=text)


def test_only_films_are_offered_to_be_linearised():
    assert depths.LINEAR.name in depths.names() and depths.LINEAR.name not in depths.films()
