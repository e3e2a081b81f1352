"""Calibration of the bundled turbine train: finds its free figures again and prints what they give.

``python -m orchestrator.study.paper.calibration.calibrate`` takes some minutes.  Static and linear
quantities fix the design (rows 1 to 5, 7 and 8 of the table), a scan of the blade's unbalance with short
coupled runs shows rows 9 to 14.  CALIBRATION.md beside the train explains the choices; the result, rounded,
stands in `rotor_fmu.train.turbine_geometry.TurbineDesign` and, drawn, in train.toml and shaft.csv.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence

from orchestrator.study.comparison import Comparison
from orchestrator.study.paper.calibration.bench import Bench, bench
from orchestrator.study.paper.calibration.fracture import Blade, Means, fractured
from orchestrator.study.paper.calibration.search import (
    ANALYSED,
    FREEDOMS,
    TARGETS,
    before_fracture,
    design_value,
    search,
    with_values,
)
from orchestrator.study.paper.published import GAP_V3_OVER_V1
from orchestrator.study.paper.requirement import Verdict
from orchestrator.study.paper.rows import rows
from rotor_fmu.train.turbine_geometry import TurbineDesign

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


def show_search(place: Bench) -> None:
    """Search from a round first guess, far from the bundled design, and print both."""
    print("Search on static and linear quantities, misses of rows 1 2 3 4 5 7 8:")
    bundled = TurbineDesign()
    found = search(place, with_values(bundled, FIRST_GUESS))
    print(f"\n{'figure':24s}{'row':>4s}{'from':>10s}{'to':>10s}{'found':>13s}{'bundled':>13s}")
    for f in FREEDOMS:
        values = (design_value(design, f.name) for design in (found, bundled))
        numbers = "".join(f"{value:13.5g}" for value in values)
        print(f"{f.name:24s}{f.fixed_by:4d}{f.low:10.4g}{f.high:10.4g}{numbers}")


def show_before(place: Bench) -> None:
    """Rows 1 to 8 of the bundled design."""
    v1, v2, v3 = (before_fracture(place, TurbineDesign(), depth) for depth in ("v1", "v2", "v3"))
    print(f"\nBefore the fracture, {ANALYSED}:")
    print(f"{'row':>4s}  {'quantity':30s}{'paper':>12s}{'here':>12s}  verdict")
    for target in TARGETS:
        value, aim = target.measure(v1, v2), target.published.value
        met = "met" if abs(target.miss(v1, v2)) <= 1.0 else "missed"
        print(f"{target.row:4d}  {target.text:30s}{aim:12.4g}{value:12.4g}  {met}")
    gap, aim = v3.gap - v1.gap, GAP_V3_OVER_V1.value
    print(f"{6:4d}  {'mean least gap V3 - V1 [m]':30s}{aim:12.4g}{gap:12.4g}  see experiments")


def scan(place: Bench, unbalances: Sequence[float]) -> Iterator[tuple[float, Comparison]]:
    """The depths side by side for unbalances of a blade [kg m]."""
    for unbalance in unbalances:
        yield unbalance, fractured(place, TurbineDesign(), Blade(WHEEL, unbalance), Means(behind=0.7))


def show_scan(place: Bench) -> None:
    """Rows 9 to 14 over the unbalance of the blade."""
    print(f"\nBlade of {WHEEL}; rows 9 to 14, + met, - missed")
    heads = ("So", "F MN", "gap um", "centre um", "rear %", "amp mm", "N/mm2")
    print(f"{'kg m':>5s}{'':>4s}" + "".join(f"{head:>10s}" for head in heads))
    for unbalance, found in scan(place, UNBALANCES):
        for depth, run in found.runs.items():
            after = run.require("after")
            film, shaft = after.bearing, after.shaft
            gaps = (film.least_gap_min * 1e6, film.centre_line_gap_min * 1e6, after.ends[1] * 1e2)
            largest = (shaft.amplitude_max * 1e3, shaft.stress_max / 1e6)
            values = (film.sommerfeld_mean, film.force_max / 1e6, *gaps, *largest)
            print(f"{unbalance:5.0f}{depth:>4s}" + "".join(f"{v:10.2f}" for v in values), flush=True)
        verdicts = (f"{row.number}{'+' if row.verdict is Verdict.MET else '-'}" for row in rows(found)[8:])
        print("  rows   " + " ".join(verdicts), flush=True)


def main() -> None:
    """Print search, rows 1 to 8 and the scan."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--part", choices=("search", "before", "scan"), help="only this part")
    part = parser.parse_args().part
    with bench() as place:
        for name, show in (("search", show_search), ("before", show_before), ("scan", show_scan)):
            if part in (None, name):
                show(place)


if __name__ == "__main__":
    main()
