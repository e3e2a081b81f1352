"""What contact stiffness, macro step and film resolution do to the figures of V1 after the fracture.

``python orchestrator/study/paper/experiments/robustness.py`` repeats the run of the bundled train with one of
them changed.  V1 runs at the bearings of LP1, V2 at all others; Craig-Bampton reduction.
"""

from __future__ import annotations

from dataclasses import replace

from orchestrator.study.paper.calibration.coupled import Blade, CoupledTrain
from orchestrator.study.paper.calibration.measures import Fractured, bearing_index, fractured
from orchestrator.study.paper.experiments.drawing import COLOURS, figure, save
from rotor_fmu.train.turbine_geometry import TurbineDesign, turbine_train

ANALYSED, BLADE, END = "LP1-front", Blade("LP1-2", 265.0), 0.9
CONTACT = (0.3e9, 1e9, 3e9, 10e9)
STEPS = (2e-4, 1e-4, 5e-5)
FINE = (96, 16)


def run(
    depth: str, *, contact: float = 1e9, step: float = 1e-4, film: tuple[int, int] = (48, 8)
) -> Fractured:
    """Measures of one case; prints them."""
    train = turbine_train(replace(TurbineDesign(), contact_modulus=contact))
    near = {seat.name: depth for seat in train.bearings if seat.name.startswith("LP1-")}
    coupled = CoupledTrain(
        train, "v2", depth_at=near, reduction="craig-bampton", columns=film[0], rows=film[1]
    )
    history = coupled.run(BLADE, END, step, interval=step)
    m = fractured(train, history, bearing_index(train, ANALYSED), BLADE.time)
    print(
        f"{depth} {contact / 1e9:6.1f} {step * 1e6:8.0f} {film[0]:5d}x{film[1]:<3d} {m.sommerfeld:7.2f}"
        f" {m.force / 1e6:7.3f} {m.moment / 1e6:7.3f} {m.gap * 1e6:7.2f} {m.centre_gap * 1e6:7.2f}"
        f" {m.amplitude * 1e3:7.3f} {m.stress / 1e6:7.2f}",
        flush=True,
    )
    return m


def main() -> None:
    """Print all cases and draw force and gap over contact factor and step."""
    print("     K'E'     step   film        So       F       M     gap  centre     amp  stress")
    print("      GPa       us                       MN    MN m      um      um      mm   N/mm2")
    reference = run("v2")
    contact = {value: run("v1", contact=value) for value in CONTACT}
    steps = {step: contact[1e9] if step == 1e-4 else run("v1", step=step) for step in STEPS}
    run("v1", film=FINE)
    run("v2", film=FINE)
    ratios = [m.force / reference.force for m in contact.values()]
    print(f"largest force V1 over V2 over the contact factor: {min(ratios):.3f} to {max(ratios):.3f}")
    drawn = figure()
    left, right = drawn.subplots(1, 2)
    for axes, cases, scale, label in (
        (left, contact, 1e-9, "contact factor K'E', GPa"),
        (right, steps, 1e6, "macro step, us"),
    ):
        at = [value * scale for value in cases]
        forces, gaps = [m.force / 1e6 for m in cases.values()], [m.gap * 1e6 for m in cases.values()]
        axes.semilogx(at, forces, "o-", color=COLOURS["v1"], label="largest force V1, MN")
        axes.semilogx(at, gaps, "s--", color="0.35", label="smallest gap V1, um")
        axes.axhline(reference.force / 1e6, color=COLOURS["v2"], lw=1, label="largest force V2, MN")
        axes.set_xticks(at, [f"{value:g}" for value in at])
        axes.minorticks_off()
        axes.set(xlabel=label, ylabel="force, MN; gap, um", ylim=(-10.0, 14.0))
        axes.legend(fontsize=8, loc="upper center")
    left.set_title("Stiffness of the solid contact")
    right.set_title("Convergence with the macro step")
    save(drawn, __file__)


if __name__ == "__main__":
    main()
