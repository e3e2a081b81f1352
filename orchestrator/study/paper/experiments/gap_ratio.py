"""Row 6: why the gaps of V3 and V2 lie further apart than the paper's 130 and 115 um.

``python -m orchestrator.study.paper.experiments.gap_ratio`` floats one aligned journal on V2 and on V3
films under the same load: over b/d and So; over readings of the paper's So = 4.3, which it prints
with and without psi^2; and over an effective width in V3.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from scipy.optimize import brentq

from bearing_fmu.film import Film, make_film
from bearing_fmu.parameters import BearingParameters
from orchestrator.study.paper.experiments.drawing import COLOURS, PAPER, figure, save

SPEED, DIAMETER, PSI = 2.0 * math.pi * 25.0, 0.8, 2.155e-3
CLEARANCE = PSI * DIAMETER / 2.0
PAPER_RATIO, WIDTH_RATIO, PAPER_SO = 130.0 / 115.0, 0.8, 4.3


@cache
def film(depth: str, width_ratio: float) -> Film:
    """A plain bearing without solid contact; its viscosity does not act on the gap at given So."""
    width = width_ratio * DIAMETER
    return make_film(depth, BearingParameters(DIAMETER, width, CLEARANCE, 0.024, 0.0, 3e-6, 1.0, 0.0))


def gap_at(so: float, bearing: Film, load_width_ratio: float | None = None) -> float:
    """Least gap over clearance at a Sommerfeld number.

    Parameters
    ----------
    so : float
        F psi^2 / (b d eta omega) with the width of `load_width_ratio`.
    bearing : Film
        The film.
    load_width_ratio : float, optional
        b/d of the bearing that carries the load, where the film has another, effective width.
    """
    b_over_d = bearing.parameters.width / DIAMETER
    aim = so * (load_width_ratio or b_over_d) / b_over_d

    def miss(gap: float) -> float:
        position = (0.0, -(1.0 - gap) * CLEARANCE, 0.0, 0.0)
        return bearing.respond(np.array(position), np.zeros(4), SPEED).sommerfeld - aim

    return float(brentq(miss, 0.004, 1.0 - 1e-9, xtol=1e-10))


def ratio_at(so: float, width_ratio: float) -> float:
    """Gap of V3 over gap of V2."""
    return gap_at(so, film("v3", width_ratio)) / gap_at(so, film("v2", width_ratio))


def effective_width(so: float, width_ratio: float) -> float:
    """Width of V3 over the true width that gives the paper's ratio of gaps."""
    aim = PAPER_RATIO * gap_at(so, film("v2", width_ratio))

    def miss(share: float) -> float:
        return gap_at(so, film("v3", share * width_ratio), width_ratio) - aim

    return float(brentq(miss, 0.2, 1.0, xtol=1e-4))


def readings() -> dict[str, float]:
    """Sommerfeld number F psi^2 / (b d eta omega) that the paper's 4.3 would be under each reading."""
    return {
        "F ψ²/(b d η ω), as printed for the fracture": PAPER_SO,
        "ω in turns a second: So/2π": PAPER_SO / (2.0 * math.pi),
        "ψ = C/d: 4 So": 4.0 * PAPER_SO,
        "F ψ²/(b r η ω): So/2": PAPER_SO / 2.0,
        "F/(b d η ω), as printed for the steady state": PAPER_SO * PSI**2,
    }


def main() -> None:
    """Print the numbers and draw the figure."""
    widths, loads = np.array([0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]), (0.5, 1.0, 2.0, 4.3, 8.0)
    print("gap V3 / gap V2; the paper's is", f"{PAPER_RATIO:.2f}")
    print("   So  b/d " + "".join(f"{w:7.2f}" for w in widths))
    curves = {so: [ratio_at(so, w) for w in widths] for so in loads}
    for so, curve in curves.items():
        print(f"{so:5.1f}      " + "".join(f"{r:7.3f}" for r in curve))
    print(
        f"\nreadings of the paper's So, b/d {WIDTH_RATIO}, gaps 100 um in V1 and 115 um in V2; paper: 30 um"
    )
    for text, so in readings().items():
        gap = gap_at(so, film("v2", WIDTH_RATIO))
        ratio = ratio_at(so, WIDTH_RATIO)
        more, clearance = 115.0 * ratio - 100.0, 0.115 / gap
        print(f"  {text:46s} So {so:9.3g}  ratio {ratio:5.3f}  V3 - V1 {more:6.1f} um", end="")
        print(f"  clearance {clearance:6.3f} mm")
    shares = np.linspace(0.4, 1.0, 7)
    v2 = gap_at(PAPER_SO, film("v2", WIDTH_RATIO))
    v3 = [gap_at(PAPER_SO, film("v3", s * WIDTH_RATIO), WIDTH_RATIO) / v2 for s in shares]
    needed = effective_width(PAPER_SO, WIDTH_RATIO)
    print(f"\neffective width of V3 that gives the paper's ratio: {needed:.2f} of the width")

    drawn = figure()
    left, right = drawn.subplots(1, 2)
    for shade, (so, curve) in zip(np.linspace(0.0, 1.0, len(loads)), curves.items(), strict=True):
        colour = (0.75 * (1.0 - shade), 0.3 + 0.5 * (1.0 - shade), 0.7 + 0.2 * (1.0 - shade))
        left.plot(widths, curve, "o-", ms=3, color=colour, label=f"So {so:g}")
    here = ratio_at(PAPER_SO, WIDTH_RATIO)
    left.plot(WIDTH_RATIO, here, "s", ms=8, mfc="none", mew=1.6, color=COLOURS["v1"])
    left.text(WIDTH_RATIO + 0.01, here - 0.12, "bundled train", color=COLOURS["v1"], fontsize=9)
    left.axhline(PAPER_RATIO, color=PAPER, ls="--", lw=1)
    left.text(0.75, PAPER_RATIO - 0.09, "paper: 130/115", color=PAPER, fontsize=9)
    left.set(xlabel="width over diameter b/d", ylabel="least gap V3 over V2", title="Same load on both films")
    left.legend(fontsize=8, loc="upper left")
    right.plot(shares, v3, "o-", ms=3, color=COLOURS["v3"])
    right.axhline(PAPER_RATIO, color=PAPER, ls="--", lw=1)
    right.axvline(needed, color=PAPER, lw=0.8, ls=":")
    right.text(needed + 0.01, 1.7, f"{needed:.2f} b gives\nthe paper's ratio", color=PAPER, fontsize=9)
    right.set(
        xlabel="effective width of V3 over width b",
        ylabel="least gap V3 over V2",
        title=f"So {PAPER_SO}, b/d {WIDTH_RATIO}: V3 with an effective width",
    )
    save(drawn, __file__)


if __name__ == "__main__":
    main()
