"""The pictures of the film: which instants, and in which colours."""

import pytest

from orchestrator.results import statistics
from orchestrator.results.figures.film import film_maps, steps
from tests.orchestrator.results.figures.axes import panel_axes

BEARING = "LP2-front"


DEPTHS = ("v1", "v2", "v3")


def test_film_maps_show_the_worst_instants_in_one_scale(records):
    figure = film_maps(records[:2], BEARING)
    titles = [axes.get_title(loc="left") for axes in panel_axes(figure)]
    gap = statistics.series(records[0], "least_gap", BEARING)
    assert f"V1:  least gap: {gap.min() * 1e6:.1f} µm" in titles[0]
    assert any("largest force" in title for title in titles)
    assert film_maps([records[0].drop_vars("bearing_parameters")], BEARING) is None
    foreign = records[0].assign(depth=("bearing", ["of-another-maker"] * 11))
    assert film_maps([foreign], BEARING) is None


@pytest.mark.parametrize("largest", [0.0, 3e5, 4.8e8])
def test_steps_of_colours_cover_the_values(largest):
    found = steps(largest, 0.004 * largest, 1e-6)
    assert found[0] == 0.0 and found[-1] >= largest * 1e-6 and found == sorted(set(found))
    assert len(found) <= 12
