"""Depth linear from a film: stiffness, damping, load and place are those of the film at the equilibrium."""

import numpy as np
import pytest

from bearing_fmu import depths
from orchestrator.errors import ScenarioError
from orchestrator.fmi.folder import build
from orchestrator.master.assembly import assemble
from orchestrator.master.start.equilibrium import find_start
from orchestrator.scenario.file import load_scenario, train_of


@pytest.fixture(scope="module")
def started(tmp_path_factory):
    """Tangents, forces and start of the small train at a depth."""
    fmus = tmp_path_factory.mktemp("fmus")
    train = train_of(load_scenario("small"))
    build(fmus, [train], ["v3", "linear"])

    def start(store, **overrides):
        scenario = load_scenario("small", overrides)
        system = assemble(scenario, train, fmus, store)
        try:
            found = find_start(system, train, train.speed)
            return system.tangents, system.forces.copy(), found
        finally:
            system.close()

    return start


def test_it_is_the_film_to_first_order(started, store):
    film, linear = started(store, depth="v3"), started(store, depth="linear", linear_from="v3")
    for expected, found in zip(film[:2], linear[:2], strict=True):
        assert found == pytest.approx(expected, rel=1e-7, abs=1e-7 * np.abs(expected).max())
    for name in ("offsets", "static", "cosine", "sine", "loads"):
        expected, found = getattr(film[2], name), getattr(linear[2], name)
        assert found == pytest.approx(expected, rel=1e-5, abs=1e-6 * np.abs(expected).max()), name


def test_one_bearing_may_be_linear_among_films(started, store):
    film, mixed = (
        started(store, depth="v3"),
        started(store, depth="v3", depth_at={"rear": "linear"}, linear_from="v3"),
    )
    assert mixed[0] == pytest.approx(film[0], rel=1e-6, abs=1e-7 * np.abs(film[0]).max())


def test_its_source_is_a_film():
    with pytest.raises(
        ScenarioError, match=f"linear_from = 'linear'; allowed are {', '.join(depths.films())}"
    ):
        load_scenario("small", {"linear_from": "linear"})
