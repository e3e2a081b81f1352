"""The linear depth's curves are those of scipy."""

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from bearing_fmu.films.linear.monotone_cubic import MonotoneCubic


@pytest.mark.parametrize("count", [2, 3, 40])
def test_values_at_points_between_and_at_ends(count):
    random = np.random.default_rng(3)
    x, y = np.cumsum(random.uniform(0.1, 1.0, count)), random.normal(size=(count, 4))
    y[: count // 2, 0] = 1.0  # level, then a jump
    curve, own = MonotoneCubic(x, y), PchipInterpolator(x, y)
    for at in [*x, *np.linspace(x[0], x[-1], 200)]:
        assert curve(at) == pytest.approx(own(at), rel=1e-13, abs=1e-13)
