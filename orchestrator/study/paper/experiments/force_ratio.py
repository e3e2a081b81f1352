"""Row 12: what raises the largest force of V1 over that of V2, and what it costs.

``python -m orchestrator.study.paper.experiments.force_ratio`` breaks a blade off the middle wheel of LP2
for several core diameters of the LP rotors and several unbalances.  The diameter detunes the first
bending mode: near half the speed at the bundled 1.11 m, higher above.  V1 runs at the bearings of LP2, V2
at all others; the shaft is reduced after Craig and Bampton, which is quick to prepare.
"""

from __future__ import annotations

import math
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace

import numpy as np

from orchestrator.study.depth_run import read_run
from orchestrator.study.paper.calibration.bench import bearing_index, bench, late_force, near
from orchestrator.study.paper.experiments.drawing import figure, save
from rotor_fmu.shaft.statics import target_loads
from rotor_fmu.train.train import Train
from rotor_fmu.train.turbine_geometry import TurbineDesign, turbine_train

WHEEL, ANALYSED, LOAD = "LP2-5", "LP2-front", 1.8e6
CORES, UNBALANCES = (1.11, 1.20, 1.30, 1.45), (120.0, 160.0, 200.0)
FRACTURE, END = 0.2, 1.0


@dataclass(frozen=True)
class Cell:
    """Mean Sommerfeld number, largest and late force [N], least gap [m] after the fracture."""

    sommerfeld: float
    force: float
    late_force: float
    gap: float


def detuned(core: float) -> Train:
    """The bundled train with another core diameter and wheels so heavy that the load stays."""
    design = replace(TurbineDesign(), lp_core_diameter=core)
    for _ in range(3):
        train = turbine_train(design)
        missing = LOAD - target_loads(train)[bearing_index(train, ANALYSED)]
        design = replace(design, lp_wheel_mass=design.lp_wheel_mass + 2.0 * missing / 9.0 / 9.80665)
    return turbine_train(design)


def column(core: float) -> list[dict[str, Cell]]:
    """V1 and V2 for all unbalances at one core diameter."""
    train = detuned(core)
    cells = []
    for unbalance in UNBALANCES:
        event = {"wheel": WHEEL, "unbalance": unbalance, "phase": math.pi, "time": FRACTURE}
        found = {}
        with bench() as place:
            for depth in ("v1", "v2"):
                settings = {"end": END, "reduction": "craig-bampton", "depth_at": near(train, "LP2", depth)}
                record = place.run(train, "v2", event, **settings)
                after = read_run(record, depth, ANALYSED).require("after").bearing
                late = late_force(record, ANALYSED)
                found[depth] = Cell(after.sommerfeld_mean, after.force_max, late, after.least_gap_min)
        cells.append(found)
        v1, v2 = cells[-1]["v1"], cells[-1]["v2"]
        print(
            f"{core:6.2f} {unbalance:6.0f}   {v1.sommerfeld:7.2f} {v2.sommerfeld:7.2f}"
            f"   {v1.force / 1e6:7.2f} {v2.force / 1e6:7.2f}"
            f"   {v1.force / v2.force:6.2f} {v1.late_force / v2.late_force:6.2f}   {v1.gap * 1e6:7.1f}",
            flush=True,
        )
    return cells


def main() -> None:
    """Print the map and draw it."""
    print("  core  blade    So V1   So V2     F V1    F V2    ratio   late     gap V1")
    print("     m   kg m                        MN      MN                       um", flush=True)
    with ProcessPoolExecutor(2) as pool:
        grid = list(pool.map(column, CORES))
    drawn = figure()
    left, right = drawn.subplots(1, 2)
    for shade, core, cells in zip(np.linspace(0.15, 0.85, len(CORES)), CORES, grid, strict=True):
        colour = (shade, 0.25, 1.0 - shade)
        ratios = [max(c["v1"].force / c["v2"].force, c["v1"].late_force / c["v2"].late_force) for c in cells]
        numbers = [c["v1"].sommerfeld for c in cells]
        left.plot(UNBALANCES, ratios, "o-", ms=4, color=colour, label=f"core {core:.2f} m")
        right.plot(numbers, ratios, "o", ms=6, color=colour, label=f"core {core:.2f} m")
    force = "largest force V1 over V2, whole or late"
    left.set(xlabel="lost blade, kg m", ylabel=force, title=f"Blade of {WHEEL}, bearing {ANALYSED}")
    left.axhspan(2.1, 3.9, color="0.85", zorder=0)
    left.set_ylim(0.5, 3.2)
    left.text(165.0, 2.15, "row 12 met: 3 ± 30 %", fontsize=8)
    left.legend(fontsize=8, loc="upper left")
    right.axhspan(2.1, 3.9, color="0.85", zorder=0)
    right.axvspan(7.7 * 0.85, 7.7 * 1.15, color="0.85", zorder=0)
    right.set_ylim(0.5, 3.2)
    right.text(6.6, 0.55, "row 9 met", fontsize=8)
    right.set(xlabel="So after, V1", ylabel=force, title="Rows 9 and 12: no case meets both")
    save(drawn, __file__)


if __name__ == "__main__":
    main()
