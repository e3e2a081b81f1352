"""The bundled turbine gives the paper's figures before the fracture (its section 5.1, figures 6 to 9)."""

import pytest

from orchestrator.study.paper.calibration.bench import bench
from orchestrator.study.paper.calibration.search import TARGETS, before_fracture, design_value, with_values
from rotor_fmu.train.turbine_geometry import TurbineDesign


@pytest.fixture(scope="module")
def depths():
    with bench() as place:
        return {depth: before_fracture(place, TurbineDesign(), depth) for depth in ("v1", "v2", "v3")}


@pytest.mark.parametrize("target", TARGETS, ids=lambda target: f"row-{target.row}")
def test_figure_before_the_fracture(depths, target):
    # A fifth of the tolerance: the data are calibrated, not merely inside.
    tolerance = target.published.tolerance / 5.0
    assert target.measure(depths["v1"], depths["v2"]) == pytest.approx(target.published.value, rel=tolerance)


@pytest.mark.parametrize("quantity", ["force", "amplitude", "stress"])
def test_depths_agree_before_the_fracture(depths, quantity):
    full = getattr(depths["v1"], quantity)
    for depth in ("v2", "v3"):
        assert getattr(depths[depth], quantity) == pytest.approx(full, rel=0.05)


def test_depths_differ_in_the_gap(depths):
    assert depths["v1"].gap < depths["v2"].gap < depths["v3"].gap


def test_values_of_a_design_go_in_and_out():
    design = with_values(TurbineDesign(), {"lp.residual_tilt": 1e-4, "viscosity": 0.03})
    assert design_value(design, "lp.residual_tilt") == 1e-4
    assert design_value(design, "viscosity") == 0.03
    assert design.lp.diameter == TurbineDesign().lp.diameter
