"""Figures of the page VERIFICATION.md: what was published as marks, what the code finds as lines.

``python -m tests.published`` writes them with the page.
"""

from __future__ import annotations

from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from orchestrator.results.figures.style import dress
from rotor_fmu.linear.whirl import whirl_modes
from rotor_fmu.shaft.matrices import assemble
from tests.bearing_fmu.films.test_published_films import BUTENSCHOEN, sommerfeld_and_angle
from tests.rotor_fmu.linear.test_whirl import RPM, hertz
from tests.rotor_fmu.published_rotors import friswell, lalanne_ferraris, springs, uniform_shaft
from tests.rotor_fmu.shaft.test_beam import HUANG, STEEL, elastic_frequencies

MARKS = {"linestyle": "none", "marker": "o", "markerfacecolor": "none", "color": "#D55E00"}
SUPPORTS = springs(5e7, 7e7, 500.0, 700.0)
TWO = {
    0.0: [13.7921, 43.6582, 114.0801],
    4000.0: [13.5902, 13.9731, 40.0728, 46.9051, 95.5215, 131.6331],
}
THREE = {
    0.0: [60.615, 63.025, 169.496, 185.563, 329.605, 362.078, 529.333, 557.573],
    25000.0: [55.411, 67.197, 157.898, 193.639, 249.851, 407.463, 446.713],
}
"""Frequencies in Hz by the speed in rev/min."""
LINE = {"color": "#0072B2", "linewidth": 1.0}


def whirl() -> Figure:
    """Whirl of published rotors over their speed."""
    figure = Figure(figsize=(9.0, 3.4), layout="constrained")
    rotors = (
        ("two discs, isotropic supports (Friswell et al. 2010, 5.9.1)", friswell(), springs(1e6, 1e6), TWO),
        ("three discs, anisotropic supports (Lalanne, Ferraris 1998)", lalanne_ferraris(), SUPPORTS, THREE),
    )
    for axes, (title, train, bearings, told) in zip(figure.subplots(1, 2), rotors, strict=True):
        count = max(len(values) for values in told.values())
        speeds = np.linspace(0.0, max(told), 26)
        model = assemble(train)
        modes = [whirl_modes(model, rpm * RPM, count, bearings=bearings) for rpm in speeds]
        found = np.array([hertz(one)[:count] for one in modes])
        axes.plot(speeds, found, **LINE)
        for rpm, values in told.items():
            axes.plot([rpm] * len(values), values, **MARKS, clip_on=False)
        axes.set_title(title, loc="left", fontsize=8.5)
        axes.set_xlabel("speed [rev/min]")
        axes.set_ylabel("frequency [Hz]")
        dress(axes)
    return figure


def beam() -> Figure:
    """Error of the first free frequencies of a thick beam over the number of elements."""
    figure = Figure(figsize=(4.6, 3.4), layout="constrained")
    axes = figure.subplots()
    counts = np.array([10, 20, 40, 80, 160])
    errors = np.array(
        [
            elastic_frequencies(uniform_shaft(6.0, 1.2, int(n), STEEL), len(HUANG)) / HUANG - 1.0
            for n in counts
        ]
    )
    for k, column in enumerate(errors.T):
        axes.loglog(counts, column, **LINE, marker=".", label="modes 1 to 5" if k == 0 else None)
    axes.loglog(
        counts, errors[0, 0] * (counts / counts[0]) ** -2.0, color="#D55E00", linestyle="--", label="slope -2"
    )
    axes.set_title("thick beam: error against Huang (1961)", loc="left", fontsize=8.5)
    axes.set_xlabel("elements")
    axes.legend(fontsize=8)
    dress(axes)
    return figure


def bearing() -> Figure:
    """Load and attitude angle of plain bearings over their eccentricity."""
    figure = Figure(figsize=(9.0, 3.4), layout="constrained")
    load, angle = figure.subplots(1, 2)
    widths = sorted({float(row["B_over_D"]) for row in BUTENSCHOEN})
    for width in widths:
        rows = [row for row in BUTENSCHOEN if float(row["B_over_D"]) == width]
        told = np.array(
            [[float(row[k]) for k in ("eps", "So_own_gumbel", "beta_own_gumbel")] for row in rows]
        ).T
        places = np.linspace(told[0, 0], told[0, -1], 25)
        found = np.array(
            [sommerfeld_and_angle(width, float(eps), "v2", columns=96, rows=12)[:2] for eps in places]
        )
        for axes, line, marks in ((load, found[:, 0], told[1]), (angle, found[:, 1], told[2])):
            axes.plot(places, line, **LINE)
            axes.plot(told[0], marks, **MARKS)
        load.annotate(
            f"B/D {width:g}",
            (places[9], found[9, 0]),
            xytext=(4, -10),
            textcoords="offset points",
            fontsize=8,
        )
    load.set_yscale("log")
    load.set_title("Sommerfeld number, half film (V2)", loc="left", fontsize=8.5)
    angle.set_title("attitude angle [°]", loc="left", fontsize=8.5)
    for axes in (load, angle):
        axes.set_xlabel("relative eccentricity")
        dress(axes)
    return figure


FIGURES = {"whirl": whirl, "bearing": bearing, "beam": beam}
"""By their name in `tests.published.PICTURES`."""


def file_of(name: str) -> Path:
    """Where a figure lies."""
    return Path(__file__).with_name("verification") / f"{name}.png"


def write_all() -> None:
    """Draw and write every figure."""
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        for name, draw in FIGURES.items():
            path = file_of(name)
            path.parent.mkdir(exist_ok=True)
            draw().savefig(path, dpi=90, metadata={"Software": None})
