"""What contact stiffness, macro step and film resolution do to the figures of V1 after the fracture.

``python -m orchestrator.study.paper.experiments.robustness`` repeats the run of the bundled train with one of
them changed.  V1 runs at the bearings of LP1, V2 at all others; Craig-Bampton reduction.
"""

from __future__ import annotations

from dataclasses import replace

from orchestrator.study.depth_run import PhaseFigures, read_run
from orchestrator.study.paper.calibration.bench import Bench, bench, near
from orchestrator.study.paper.experiments.drawing import COLOURS, figure, save
from rotor_fmu.train.turbine_geometry import TurbineDesign, turbine_train

ANALYSED, END = "LP1-front", 0.9
BLADE = {"wheel": "LP1-2", "unbalance": 265.0, "time": 0.2}
CONTACT = (0.3e9, 1e9, 3e9, 10e9)
STEPS = (2e-4, 1e-4, 5e-5)
FINE = (96, 16)


def run(
    place: Bench, depth: str, *, contact: float = 1e9, step: float = 1e-4, film: tuple[int, int] = (48, 8)
) -> PhaseFigures:
    """Figures after the fracture of one case; prints them."""
    train = turbine_train(replace(TurbineDesign(), contact_modulus=contact))
    settings = {"film": {"columns": film[0], "rows": film[1]}, "reduction": "craig-bampton"}
    depths = near(train, "LP1", depth)
    record = place.run(train, "v2", BLADE, end=END, step=step, depth_at=depths, **settings)
    found = read_run(record, depth, ANALYSED).require("after")
    bearing, shaft = found.bearing, found.shaft
    print(
        f"{depth} {contact / 1e9:6.1f} {step * 1e6:8.0f} {film[0]:5d}x{film[1]:<3d}"
        f" {bearing.sommerfeld_mean:7.2f} {bearing.force_max / 1e6:7.3f} {bearing.moment_max / 1e6:7.3f}"
        f" {bearing.least_gap_min * 1e6:7.2f} {bearing.centre_line_gap_min * 1e6:7.2f}"
        f" {shaft.amplitude_max * 1e3:7.3f} {shaft.stress_max / 1e6:7.2f}",
        flush=True,
    )
    return found


def main() -> None:
    """Print all cases and draw force and gap over contact factor and step."""
    print("     K'E'     step   film        So       F       M     gap  centre     amp  stress")
    print("      GPa       us                       MN    MN m      um      um      mm   N/mm2")
    with bench() as place:
        reference = run(place, "v2").bearing
        contact = {value: run(place, "v1", contact=value).bearing for value in CONTACT}
        steps = {
            step: contact[1e9] if step == 1e-4 else run(place, "v1", step=step).bearing for step in STEPS
        }
        run(place, "v1", film=FINE)
        run(place, "v2", film=FINE)
    ratios = [bearing.force_max / reference.force_max for bearing in contact.values()]
    print(f"largest force V1 over V2 over the contact factor: {min(ratios):.3f} to {max(ratios):.3f}")
    drawn = figure()
    left, right = drawn.subplots(1, 2)
    for axes, cases, scale, label in (
        (left, contact, 1e-9, "contact factor K'E', GPa"),
        (right, steps, 1e6, "macro step, us"),
    ):
        at = [value * scale for value in cases]
        forces = [bearing.force_max / 1e6 for bearing in cases.values()]
        gaps = [bearing.least_gap_min * 1e6 for bearing in cases.values()]
        axes.semilogx(at, forces, "o-", color=COLOURS["v1"], label="largest force V1, MN")
        axes.semilogx(at, gaps, "s--", color="0.35", label="smallest gap V1, um")
        axes.axhline(reference.force_max / 1e6, color=COLOURS["v2"], lw=1, label="largest force V2, MN")
        axes.set_xticks(at, [f"{value:g}" for value in at])
        axes.minorticks_off()
        axes.set(xlabel=label, ylabel="force, MN; gap, um", ylim=(-10.0, 14.0))
        axes.legend(fontsize=8, loc="upper center")
    left.set_title("Stiffness of the solid contact")
    right.set_title("Convergence with the macro step")
    save(drawn, __file__)


if __name__ == "__main__":
    main()
