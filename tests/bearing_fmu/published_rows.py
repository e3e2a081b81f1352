"""Each row of the published bearings and what the film says: ``python -m tests.bearing_fmu.published_rows``.

Writes ROWS.md beside the tables.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from bearing_fmu.film import Film, make_film
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.static.equilibrium import Carried, carried
from bearing_fmu.tilting.film import TiltingFilm
from fmus.port.bore import Bore, grooved, lobes, tilting, to_text
from tests.bearing_fmu.bearings import plain, respond, table

PAGE = Path(__file__).with_name("reference") / "ROWS.md"
DEG = math.radians(1.0)
KEYS = ("Kxx", "Kxy", "Kyx", "Kyy", "Bxx", "Bxy", "Byx", "Byy")
Row = dict[str, str]


@dataclass(frozen=True)
class Entry:
    """One figure of a row: as published, as found, and how far apart they may be."""

    name: str
    published: float
    found: float
    bound: float

    @property
    def share(self) -> float:
        """Of the bound."""
        return float(abs(self.found - self.published) / self.bound)


def cut(bore: Bore, degrees: float) -> str:
    """A bore with grooves at the split."""
    return to_text(grooved(bore, [(middle, degrees * DEG) for middle in (0.0, math.pi)]))


def load_of(p: BearingParameters, inverse: float) -> float:
    """Load whose Sommerfeld number, eta N b d (R/C)^2 / W, is `inverse` at 1 rad/s."""
    return p.viscosity / (2.0 * math.pi) * p.width * p.diameter * (p.radius / p.clearance) ** 2 / inverse


def told(found: Carried, p: BearingParameters) -> dict[str, float]:
    """Eccentricity over the clearance, angle and coefficients as in tables, and the inverse number S."""
    k, b = (p.clearance * matrix for matrix in found.matrices())
    here = dict(zip(KEYS, (*k.ravel(), *b.ravel()), strict=True))
    here["phi_deg"] = float(np.degrees(found.attitude))
    here["eps"] = float(np.hypot(*found.position)) / p.clearance
    here["S"] = load_of(p, 1.0) / float(np.hypot(*found.load))
    return here


def at_eccentricity(film: Film, eps: float, guess: float) -> Carried:
    """The load downwards that the film carries at an eccentricity; `guess` of its S."""
    p = film.parameters

    def missed(log_s: float) -> float:
        position = carried(film, (0.0, -load_of(p, math.exp(log_s))), 1.0).position
        return float(np.hypot(*position)) / p.clearance - eps

    low, high = math.log(guess) - 0.1, math.log(guess) + 0.1
    log_s = brentq(missed, low, high, xtol=1e-5)
    return carried(film, (0.0, -load_of(p, math.exp(log_s))), 1.0)


def compared(row: Row, here: dict[str, float], bounds: dict[str, Callable[[float], float]]) -> list[Entry]:
    """Entries of a row that it has."""
    return [
        Entry(name, float(row[name]), here[name], bound(float(row[name])))
        for name, bound in bounds.items()
        if row.get(name)
    ]


def _fixed(bound: float) -> Callable[[float], float]:
    return lambda _value: bound


def _share(bound: float) -> Callable[[float], float]:
    return lambda value: bound * abs(value)


def _coefficient(value: float) -> float:
    return 0.06 * abs(value) + 0.06


def _below(most: float) -> Callable[[float], float]:
    return lambda value: min(most, _coefficient(value))


def _of_the_largest(row: Row, stiffness: float, damping: float) -> dict[str, Callable[[float], float]]:
    """Bounds as shares of the largest entry of K and of B, at most `_coefficient`."""
    bounds: dict[str, Callable[[float], float]] = {}
    for keys, share in ((KEYS[:4], stiffness), (KEYS[4:], damping)):
        largest = max(abs(float(row[key])) for key in keys if row.get(key))
        bounds |= dict.fromkeys(keys, _below(share * largest))
    return bounds


def lund_bores(row: Row, **grid: int) -> list[Entry]:
    """Two grooves of 20 deg, and a lemon bore with them."""
    lemon, fine = row["bearing"] == "lemon", row["S"] == "0.12"
    bore = cut(lobes(2, 0.5) if lemon else lobes(1, 0.0), 20.0)
    grid = grid or {"columns": 192 if fine else 96, "rows": 16 if fine else 8}
    p = plain(float(row["B_over_D"]), bore=bore, boundary="reynolds", **grid)
    here = told(carried(make_film("v1", p), (0.0, -load_of(p, float(row["S"]))), 1.0), p)
    bounds = {"eps": _fixed(0.0011), "phi_deg": _fixed(0.085)}
    return compared(row, here, bounds | _of_the_largest(row, 0.0075, 0.01))


def lund_axial(row: Row) -> list[Entry]:
    """Two grooves of 20 deg at the tabulated eccentricity."""
    fine = float(row["eps"]) > 0.8
    p = plain(0.5, bore=cut(lobes(1, 0.0), 20.0), boundary="reynolds", columns=192 if fine else 96, rows=12)
    here = told(at_eccentricity(make_film("v1", p), float(row["eps"]), float(row["S"])), p)
    bounds = {"S": _share(0.006), "phi_deg": _fixed(0.045)}
    return compared(row, here, bounds | _of_the_largest(row, 0.0055, 0.0065))


def someya_fixed(row: Row) -> list[Entry]:
    """Two grooves of 10 deg, in a circle or between two lobes; eps over the least clearance."""
    preload, inverse = float(row["preload"]), float(row["S"])
    grid = {"columns": 192, "rows": 12} if inverse < 0.1 else {"columns": 96}
    bore = cut(lobes(2, preload) if preload else lobes(1, 0.0), 10.0)
    p = plain(float(row["B_over_D"]), bore=bore, boundary="reynolds", **grid)
    here = told(carried(make_film("v1", p), (0.0, -load_of(p, inverse)), 1.0), p)
    here["eps"] /= 1.0 - preload
    eps, angle = (0.02, 0.15) if preload else (0.0014, 0.5)
    bounds = {"eps": _fixed(eps), "phi_deg": _fixed(angle)} | dict.fromkeys(KEYS, _coefficient)
    return compared(row, here, bounds)


def someya_pads(row: Row) -> list[Entry]:
    """Four tilting pads of 80 deg at the tabulated eccentricity, synchronous coefficients."""
    on = row["bearing"] == "tilting4-on"
    p = plain(
        0.5, bore=to_text(tilting(4, 80.0 * DEG, 0.0, first=(45.0 if on else 0.0) * DEG)), columns=96, rows=12
    )
    film = make_film("v2", p)
    assert isinstance(film, TiltingFilm)
    film.whirl = 1.0
    found = respond(film, [0.0, -float(row["eps"]), 0.0, 0.0])
    load = float(found.wrench[1])
    here = told(
        Carried(np.array([0.0, -load]), 1.0, np.array([0.0, -float(row["eps"])]) * p.clearance, found), p
    )
    bounds = {"S": _share(0.047), "Kxx": _share(0.05), "Kyy": _share(0.05)}
    return compared(row, here, bounds | dict.fromkeys(("Bxx", "Byy"), _share(0.036)))


def butenschoen(row: Row) -> list[Entry]:
    """A full bearing that is fed at its widest gap."""
    p = plain(float(row["B_over_D"]), boundary="reynolds", columns=192, rows=12)
    film = make_film("v1", p)
    space, (_, _, _, work, _) = film.take()
    work.usual.held[:, work.usual.held.shape[1] // 2] = 2.0
    film.bring_back(space)
    found = respond(film, [float(row["eps"]), 0.0, 0.0, 0.0])
    work.usual.held[:] = 0.0
    fx, fy = found.wrench[:2]
    here = {
        "So_ref": found.sommerfeld,
        "beta_ref": float(np.degrees(np.arctan2(fy, -fx))),
        "Q_ref": found.oil_flow / (p.radius**2 * p.clearance),
    }
    return compared(row, here, dict.fromkeys(here, _share(0.01)))


@dataclass(frozen=True)
class Source:
    """Rows of a table that are one kind of bearing."""

    title: str
    file: str
    solve: Callable[[Row], list[Entry]]
    bearings: tuple[str, ...] = ()

    def rows(self) -> list[Row]:
        """Those of its bearings."""
        found = table(self.file)
        return [row for row in found if not self.bearings or row["bearing"] in self.bearings]


SOURCES = (
    Source(
        "Lund and Thomsen 1978, two grooves of 20 deg and lemon bore",
        "bores_lund_thomsen_1978.csv",
        lund_bores,
    ),
    Source(
        "Lund and Thomsen 1978, two grooves of 20 deg, B/D 0.5",
        "lund_thomsen_1978_two_axial_groove.csv",
        lund_axial,
    ),
    Source(
        "Someya 1989, two grooves of 10 deg in a circle or between two lobes",
        "bores_someya_1989.csv",
        someya_fixed,
        ("two-groove", "two-lobe"),
    ),
    Source(
        "Someya 1989, four tilting pads of 80 deg",
        "bores_someya_1989.csv",
        someya_pads,
        ("tilting4-between", "tilting4-on"),
    ),
    Source("Butenschoen 1976, full bearings", "butenschoen_1976_rotation.csv", butenschoen),
)


def name_of(row: Row) -> str:
    """Of a row: its bearing and what it is tabulated over."""
    parts = row.get("bearing", ""), row.get("B_over_D") or row.get("L_over_D", ""), row.get("S") or row["eps"]
    return " ".join(part for part in parts if part)


_GROOVES = (
    "the two books contradict each other here: with grooves twice as wide Lund and Thomsen have the film's"
)
_LOBES = "finite differences give the film's, `test_two_lobes_of_another_solution`"
_PADS = "finite differences give the film's load, `test_loads_on_pads_are_those_of_another_solution`"
_ON = _PADS + "; Kyy is next to nothing at this very place and 2 to 6 a ten-thousandth of C beside it"
_ALL = ("S", "Kxx", "Kyy", "Bxx", "Byy")
_GROOVED, _LOBED = "two-groove 0.5 ", "two-lobe 0.5 "
#: Entries of rows beyond the agreement, and why.
NAMED: dict[str, tuple[tuple[str, ...], str]] = {
    _GROOVED + "5.96": (("phi_deg", "Kxx", "Kyx", "Kyy"), _GROOVES),
    _GROOVED + "2.07": (("phi_deg", "Kxx", "Kyx", "Kyy"), _GROOVES),
    _GROOVED + "0.798": (("Kyx", "Kyy", "Byy"), _GROOVES),
    _GROOVED + "0.323": (("Kyx", "Kyy", "Bxy", "Byx", "Byy"), _GROOVES),
    _GROOVED + "0.0926": (("Bxy", "Byx", "Byy"), _GROOVES),
    _LOBED + "0.993": (("eps", "phi_deg", "Kxy", "Kyy", "Bxx"), _LOBES),
    _LOBED + "0.105": (("phi_deg", "Kxx", "Byy"), _LOBES),
    "tilting4-between 0.5 5.76": (_ALL, _PADS),
    "tilting4-on 0.5 1.42": (_ALL, _ON),
    "tilting4-on 0.5 0.507": (_ALL, _ON),
}
#: Entries that rounding decides: next to nothing at the place, hundreds of times as much beside it.
INDEFINITE = {("tilting4-on 0.5 1.42", "Kyy"), ("tilting4-on 0.5 0.507", "Kyy")}
_HEAD = """\
# Published bearings, row by row

Made by `python -m tests.bearing_fmu.published_rows`; `test_published_rows.py` holds what it says. Each cell
is the film's figure and, in brackets, the published one; bold is what is further apart than a bound of its
source, about a quarter above what is found in the other rows:

| source | eps, phi, S | coefficients |
|---|---|---|
| Lund and Thomsen, bores | eps 0.0011, phi 0.085 deg | 0.75 % of the largest of K, 1 % of B |
| Lund and Thomsen, B/D 0.5 | S 0.6 %, phi 0.045 deg | 0.55 % of the largest of K, 0.65 % of B |
| Someya, two grooves; lobes | eps 0.0014, phi 0.5 deg; 0.02, 0.15 deg | 6 % + 0.06 |
| Someya, pads | S 4.7 % | K 5 %, B 3.6 % |
| Butenschoen | 1 % | |

No coefficient of Lund and Thomsen may be further off than 6 % + 0.06, the agreement that they state of a
converged solver; Someya states none. S is eta N B D (R/C)^2/W, x along the load; eps of lemon bores is over
the clearance of a lobe, of Someya's lobes over the least one.
"""


def _cell(entry: Entry) -> str:
    mark = "**" if entry.share > 1.0 else ""
    return f"{mark}{entry.found:.4g} ({entry.published:g}){mark}"


def page() -> Iterator[str]:
    """The text of the page, as it is found."""
    yield _HEAD
    for source in SOURCES:
        yield f"\n## {source.title}\n"
        for number, row in enumerate(source.rows()):
            entries = source.solve(row)
            if number == 0:
                yield f"| row | {' | '.join(entry.name for entry in entries)} | why |\n"
                yield f"|---|{'---|' * (len(entries) + 1)}\n"
            cells = (_cell(entry) for entry in entries)
            yield f"| {name_of(row)} | {' | '.join(cells)} | {NAMED.get(name_of(row), ((), ''))[1]} |\n"


if __name__ == "__main__":
    PAGE.write_text("".join(page()), encoding="utf-8")
