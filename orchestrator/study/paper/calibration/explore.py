"""The whole table over many designs: rows 1, 2, 3 and 5 solved for, rows 9 to 14 by coupled runs.

``python -m orchestrator.study.paper.calibration.explore FOUND.csv`` appends a line a design and goes on where
an earlier call has ended; ``--around LINE`` looks near a line of the table instead of everywhere. Designs are
the points of Sobol's sequence, so the same number is the same design. V1 is run first: a design that leaves
row 9 or 10 far behind, or whose force does not rise, is not worth the other two depths.
"""

from __future__ import annotations

import argparse
import csv
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from scipy.stats import qmc

from orchestrator.errors import OrchestratorError
from orchestrator.study.paper.calibration.bench import Bench, bench
from orchestrator.study.paper.calibration.fracture import Blade, Means, figures, fractured, rows_met
from orchestrator.study.paper.calibration.search import design_value, with_values
from orchestrator.study.paper.calibration.statics import settled
from orchestrator.study.paper.published import DEPTHS, SOMMERFELD_AFTER
from rotor_fmu.train.turbine_geometry import TurbineDesign

Values = dict[str, float]

SEED, NEAR = 12, 0.15
"""Of the sequence; half the width of a look around a design, as a share of each range."""
LEAST_FORCE = 6.5
"""Of V1 [MN], below which nothing but inertia acts and V2 has it as well."""
WHEELS = tuple(f"LP1-{number}" for number in (4, 6))
"""Wheels beside the middle one."""


@dataclass(frozen=True)
class Range:
    """Where a figure of design or blade is looked for; evenly, or in its logarithm."""

    name: str
    low: float
    high: float
    log: bool = False

    def at(self, share: float) -> float:
        """The figure at a share of the range."""
        if self.log:
            return float(self.low * (self.high / self.low) ** share)
        return self.low + share * (self.high - self.low)

    def share(self, value: float) -> float:
        """The inverse of `at`."""
        if self.log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)


RANGES = (
    Range("lp_core_diameter", 1.10, 1.16),
    Range("lp.width_ratio", 0.75, 1.15),
    Range("lp.diameter", 0.75, 0.88),
    Range("contact_modulus", 1e9, 1e10, log=True),
    Range("rayleigh_alpha", 1.0, 3.0),
    Range("unbalance", 110.0, 180.0),
    Range("phase", 0.0, 2.0 * math.pi),
    Range("wheel", 0.0, float(len(WHEELS))),
    Range("tilted", -1.0, 1.0),
)


def sample(number: int, near: Values | None = None) -> Values:
    """Figures of design and blade of a number, everywhere or near some."""
    shares = qmc.Sobol(len(RANGES), rng=SEED).random(1 << number.bit_length())[number]
    if near is None:
        return {r.name: r.at(float(share)) for r, share in zip(RANGES, shares, strict=True)}
    found = dict(near)
    for r, share in zip(RANGES[:-2], shares, strict=False):
        middle = r.share(near[r.name])
        found[r.name] = r.at(middle + NEAR * (2.0 * float(share) - 1.0))
    return found


def design_of(values: Values, base: TurbineDesign) -> tuple[TurbineDesign, Blade]:
    """Design that meets rows 1, 2, 3 and 5, and blade."""
    own = {r.name: values[r.name] for r in RANGES[:5]}
    sign = math.copysign(1.0, values["tilted"])
    design = with_values(base, {**own, "lp.residual_tilt": sign * abs(base.lp.residual_tilt)})
    wheel = WHEELS[min(int(values["wheel"]), len(WHEELS) - 1)]
    return settled(design), Blade(wheel, values["unbalance"], values["phase"])


def look(place: Bench, design: TurbineDesign, blade: Blade, means: Means) -> dict[str, float | str]:
    """Figures and rows of a design; of V1 alone when it is not promising."""
    v1 = fractured(place, design, blade, means, ("v1",))
    found: dict[str, float | str] = dict(figures(v1))
    if not promising(found):
        return found
    rest = fractured(place, design, blade, means, ("v2", "v3"))
    both = replace(rest, runs={**v1.runs, **rest.runs}, ended={**v1.ended, **rest.ended})
    found |= figures(both)
    found |= {f"v1/{d}": float(found["v1.force"]) / float(found[f"{d}.force"]) for d in ("v2", "v3")}
    return found | {"rows": " ".join(map(str, rows_met(both)))}


def promising(v1: dict[str, float | str]) -> bool:
    """Whether V1 touches with a Sommerfeld number near row 9 and more force than inertia alone imposes."""
    so, contact, force = (float(v1[f"v1.{name}"]) for name in ("so", "contact", "force"))
    off = abs(so / SOMMERFELD_AFTER.value - 1.0)
    return off < 1.3 * SOMMERFELD_AFTER.tolerance and contact > 0.0 and force > LEAST_FORCE


FIGURES = ("so", "force", "gap", "centre", "contact", "front", "amplitude", "stress")
BEFORE = ("gap_before", "harmonic_before", "amplitude_before", "stress_before")
SOLVED = ("lp_wheel_mass", "viscosity", "lp.relative_clearance", "lp.residual_tilt")
COLUMNS = (
    *("number", "near", *(r.name for r in RANGES), *SOLVED, "v1/v2", "v1/v3", "rows"),
    *(f"{depth}.{name}" for depth in DEPTHS for name in (*FIGURES, *BEFORE)),
    "note",
)


def read(path: Path) -> list[dict[str, str]]:
    """Lines of a table that are there."""
    if not path.is_file():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def append(path: Path, line: dict[str, float | str]) -> None:
    """Add a line to a table, which is made if missing."""
    new = not path.is_file()
    with path.open("a", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        if new:
            writer.writeheader()
        writer.writerow({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in line.items()})


def values_of(line: dict[str, str]) -> Values:
    """What `sample` gave for a line."""
    return {r.name: float(line[r.name]) for r in RANGES}


def explore(
    path: Path,
    numbers: Sequence[int],
    base: TurbineDesign,
    means: Means,
    near: str = "",
    report: Callable[[str], None] = print,
) -> None:
    """Look at designs by number and append what is found; numbers that the table has are left out."""
    lines = read(path)
    whole = {line["number"]: line for line in lines if not line["near"]}
    if near and near not in whole:
        raise OrchestratorError(f"{path}: no design {near!r}; --around takes a number of the table")
    centre = values_of(whole[near]) if near else None
    done = {(line["number"], line["near"]) for line in lines}
    with bench() as place:
        for number in numbers:
            if (str(number), near) in done:
                continue
            append(path, line := one(place, number, near, sample(number, centre), base, means))
            shown = (f"{key} {line[key]:.4}" for key in ("v1.so", "v1/v2", "v1/v3") if key in line)
            report(f"{number:5d}  {'  '.join(shown)}  rows {line.get('rows', '-')} {line.get('note', '')}")


def one(
    place: Bench, number: int, near: str, values: Values, base: TurbineDesign, means: Means
) -> dict[str, float | str]:
    """A line of the table."""
    line: dict[str, float | str] = {"number": number, "near": near, **values}
    try:
        design, blade = design_of(values, base)
        line |= {name: design_value(design, name) for name in SOLVED}
        return line | look(place, design, blade, means)
    except (OrchestratorError, ValueError) as error:
        return line | {"note": str(error).splitlines()[0]}


def main() -> None:
    """Look at designs; print a line each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV that lines are appended to")
    parser.add_argument("--first", type=int, default=0, help="number of the first design")
    parser.add_argument("--count", type=int, default=64, help="how many designs")
    parser.add_argument("--around", default="", metavar="NUMBER", help="look near this design of the table")
    parser.add_argument("--behind", type=float, default=0.9, help="time behind the fracture in s")
    given = parser.parse_args()
    numbers = range(given.first, given.first + given.count)
    try:
        explore(given.table, numbers, TurbineDesign(), Means(given.behind, elsewhere="table"), given.around)
    except OrchestratorError as error:
        parser.error(str(error))


if __name__ == "__main__":
    main()
