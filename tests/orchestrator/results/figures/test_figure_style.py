"""Colours, dashes and names of depths; which bearing is shown; all figures in files."""

import numpy as np
from matplotlib import rc_context

from orchestrator.results import quantities
from orchestrator.results.figures import style
from orchestrator.results.figures.write import write_figures
from orchestrator.results.verdicts.judge import worst_bearing
from tests.faults import fault

BEARING = "LP2-front"


DEPTHS = ("v1", "v2", "v3")


def test_mixed_depths_are_named(record):
    mixed = record.copy()
    mixed["depth"] = record["depth"].copy(data=np.where(record["bearing"] == "HP-front", "v3", "v1"))
    assert style.run_name(mixed, "HP-front") == f"mixed depths, here {style.depth_name('v3')}"
    assert style.colour_of(style.depth_at(mixed)) == style.OTHER_COLOUR


def test_depths_differ_in_grey_print():
    assert len({style.dash_of(depth) for depth in DEPTHS}) == 3


def test_the_worst_bearing_is_shown_unless_one_is_named(record):
    assert worst_bearing([record]) == "LP2-front"
    assert worst_bearing([record.assign_attrs(analysed_bearing="HP-front")]) == "HP-front"


@fault(
    "machine",
    "a matplotlibrc that sets TeX, and a font that there is not",
    "the figures are drawn as ever",
    guard="orchestrator.results.figures.write:own_settings",
)
def test_writing_gives_every_figure_in_every_format(record, train, tmp_path):
    short = record.isel(time=slice(900, 1100))
    with rc_context({"text.usetex": True, "font.family": "nonsense"}):
        files = write_figures([short], tmp_path / "figures", train=train, formats=("png",))
    assert len(files) == 10
    assert all(path.stat().st_size > 1000 for path in files)
    assert quantities.FORCE.unit == "MN"
