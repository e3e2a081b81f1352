"""Calibration of the bundled turbine train: finds its free figures again and prints what they give.

``python -m orchestrator.study.paper.calibration.calibrate`` takes some minutes.  Static and linear
quantities fix the design (rows 1 to 5, 7 and 8 of the table), a scan of the blade's unbalance with short
coupled runs shows rows 9 to 14.  CALIBRATION.md beside the train explains the choices; the result, rounded,
stands in `turbine_geometry.TurbineDesign` and, drawn, in train.toml and shaft.csv.
"""

from __future__ import annotations

import argparse
from dataclasses import astuple

from orchestrator.study.paper.calibration.blade import coupled_depths, judge, scan
from orchestrator.study.paper.calibration.measures import bearing_index, steady
from orchestrator.study.paper.calibration.search import (
    ANALYSED,
    FREEDOMS,
    TARGETS,
    before_fracture,
    design_value,
    search,
    with_values,
)
from rotor_fmu.train.turbine_geometry import TurbineDesign, turbine_train

FIRST_GUESS = {
    "lp_wheel_mass": 30e3,
    "viscosity": 0.020,
    "lp.relative_clearance": 2.0e-3,
    "lp_balance": 1.0,
    "lp.residual_tilt": 5e-5,
    "generator_balance": 8.0,
    "lp_core_diameter": 1.20,
}
WHEEL, UNBALANCES = "LP1-2", (225.0, 245.0, 265.0, 285.0)


def show_search() -> None:
    """Search from a round first guess, far from the bundled design, and print both."""
    print("Search on static and linear quantities, misses of rows 1 2 3 4 5 7 8:")
    bundled = TurbineDesign()
    found = search(with_values(bundled, FIRST_GUESS))
    print(f"\n{'figure':24s}{'row':>4s}{'from':>10s}{'to':>10s}{'found':>13s}{'bundled':>13s}")
    for f in FREEDOMS:
        values = (design_value(design, f.name) for design in (found, bundled))
        numbers = "".join(f"{value:13.5g}" for value in values)
        print(f"{f.name:24s}{f.fixed_by:4d}{f.low:10.4g}{f.high:10.4g}{numbers}")


def show_before() -> None:
    """Rows 1 to 8 of the bundled design."""
    v1, v2, v3 = (before_fracture(TurbineDesign(), depth) for depth in ("v1", "v2", "v3"))
    print(f"\nBefore the fracture, {ANALYSED}:")
    print(f"{'row':>4s}  {'quantity':30s}{'paper':>12s}{'here':>12s}  verdict")
    for target in TARGETS:
        value = target.measure(v1, v2)
        met = "met" if abs(value / target.value - 1.0) <= target.tolerance else "missed"
        print(f"{target.row:4d}  {target.text:30s}{target.value:12.4g}{value:12.4g}  {met}")
    print(f"{6:4d}  {'mean least gap V3 - V1 [m]':30s}{30e-6:12.4g}{v3.gap - v1.gap:12.4g}  see experiments")


def show_scan() -> None:
    """Rows 9 to 14 over the unbalance of the blade."""
    trains = coupled_depths(turbine_train(), ANALYSED.partition("-")[0])
    index = bearing_index(trains["v1"].train, ANALYSED)
    histories = {depth: coupled.revolution() for depth, coupled in trains.items()}
    gap = steady(trains["v2"].train, histories["v2"], index).gap
    moment = float(histories["v1"].moment(index).mean())
    print(f"\nBlade of {WHEEL}; rows 9 10 11 12 13 14, + met, - missed")
    heads = ("So", "F MN", "gap um", "centre um", "rear %", "amp mm", "N/mm2")
    print(f"{'kg m':>5s}{'':>4s}" + "".join(f"{head:>10s}" for head in heads))
    for unbalance, found in scan(trains, WHEEL, UNBALANCES, ANALYSED):
        for depth, m in found.items():
            gaps = (m.gap * 1e6, m.centre_gap * 1e6, m.rear_share * 1e2)
            values = (m.sommerfeld, m.force / 1e6, *gaps, m.amplitude * 1e3, m.stress / 1e6)
            print(f"{unbalance:5.0f}{depth:>4s}" + "".join(f"{v:10.2f}" for v in values), flush=True)
        rows = astuple(judge(found["v1"], found["v2"], found["v3"], gap, moment))
        print("  rows   " + " ".join(f"{9 + k}{'+' if met else '-'}" for k, met in enumerate(rows)))


def main() -> None:
    """Print search, rows 1 to 8 and the scan."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--part", choices=("search", "before", "scan"), help="only this part")
    part = parser.parse_args().part
    for name, show in (("search", show_search), ("before", show_before), ("scan", show_scan)):
        if part in (None, name):
            show()


if __name__ == "__main__":
    main()
