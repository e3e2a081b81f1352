"""How a table is built from V2, and how far it is from it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.evaluate import RESULT
from bearing_fmu.film import Film
from bearing_fmu.films.aligned.depth import RUPTURING
from bearing_fmu.films.aligned.depth import SOLVER as ALIGNED
from bearing_fmu.films.table.spline import coefficients
from bearing_fmu.films.table.table import FORCE, PARTS, RUB, RUN, SUMMIT, TURN, Table, narrowing, solve_table
from bearing_fmu.kernels.compiled import kernel
from bearing_fmu.outputs import INPUTS, OUTPUTS
from bearing_fmu.parameters import BearingParameters
from bearing_fmu.result import FLOW, PEAK, RESULTS, SHEAR
from fmus import port

Floats = NDArray[np.float64]

SIZES = {"guembel": (6, 144, 240), "reynolds": (3, 96, 160)}
"""Of a table: how many times the columns of V2 it is built with, radii and angles.  The numbers of
`bearing_fmu/FILMS.md` belong to them.  With Reynolds' condition V2 takes milliseconds, and its active set
goes node by node on any grid."""

_LEAST = 1e-4  # gap over the clearance up to which tables of smooth surfaces are built
_PRESSED = 3.0  # roughnesses by which surfaces overlap at a table's end
_TRIALS = 1000
_WEAK = 1e-3
_MOST_COLUMNS = int(port.bearing_parameter("columns").maximum or 0)


@dataclass(frozen=True)
class Built:
    """A table.

    Attributes
    ----------
    coefficients : ndarray
        See `bearing_fmu.films.table.spline.coefficients`.
    last : float
        Largest value of its radial coordinate.
    typical, largest : float
        Deviation of its force from that of V2 on a finer grid (with Reynolds' condition on its own) as a
        share of the force, over random states with gaps down to 1e-3 of the clearance: met by 99 of 100 of
        them, and the largest.
    columns : int
        Of that grid.
    """

    coefficients: Floats
    last: float
    typical: float
    largest: float
    columns: int

    def table(self) -> Table:
        """For the kernel, with a work space of its own."""
        return Table(
            self.coefficients, self.last / (self.coefficients.shape[0] - 3), self.last, np.zeros((7, PARTS))
        )


def unit_bearing(parameters: BearingParameters) -> BearingParameters:
    """The bearing of radius, clearance and scale of pressure 1 that has the same table; on a finer grid."""
    return BearingParameters(
        diameter=2.0,
        width=2.0 * parameters.width / parameters.diameter,
        clearance=1.0,
        viscosity=1.0 / 6.0,
        roughness=parameters.roughness / parameters.clearance,
        contact_modulus=1e-30,  # without effect, but bears a closed gap
        columns=min(SIZES[parameters.boundary][0] * parameters.columns, _MOST_COLUMNS),
        rows=parameters.rows,
        boundary=parameters.boundary,
    )


class _Solved:
    """V2 as a function of position and velocity, dimensionless as in `bearing_fmu.result`."""

    def __init__(self, parameters: BearingParameters) -> None:
        self._film = Film(ALIGNED if parameters.boundary == "guembel" else RUPTURING, parameters)
        self._space, self._data = self._film.take()
        self._inputs, self._out = np.zeros(INPUTS), np.zeros(OUTPUTS)
        self._result = self._data[-1][RESULT : RESULT + RESULTS]

    def __call__(self, q: Floats, v: Floats, speed: float) -> Floats:
        self._inputs[:2], self._inputs[4:6], self._inputs[16] = q, v, speed
        status = self._film.solver.kernel(self._inputs, self._film.offset, self._out, *self._data)
        if status:
            raise self._film.failure(status, self._inputs, self._film.offset)
        return self._result


def build(unit: BearingParameters, radii: int = 0, angles: int = 0) -> Built:
    """Build the table of a `unit_bearing`, by default of its `SIZES`; half a turn, the rest is its image.

    Raises
    ------
    ValueError
        For an odd number of angles: each needs its image, and the angle across, to which lines through the
        middle of the disc go on.
    """
    _, *size = SIZES[unit.boundary]
    radii, angles = radii or size[0], angles or size[1]
    if angles % 2:
        raise ValueError(f"{angles} angles; allowed is an even number")
    sigma, ratio = unit.roughness, (unit.width / unit.diameter) ** 2
    most = 1.0 + _PRESSED * sigma if sigma > 0.0 else 1.0 - _LEAST
    last = narrowing(most, sigma)[1]
    solved = _Solved(unit)
    values = np.empty((radii, angles, PARTS))
    for i, a in enumerate(np.linspace(0.0, last, radii)):
        e = most if i == radii - 1 else _eccentricity(float(a), most, sigma)
        r = float(narrowing(e, sigma)[0])
        for j, psi in enumerate(2.0 * np.pi / angles * np.arange(angles // 2 + 1)):
            q = e * np.array([np.cos(psi), np.sin(psi)])
            # the drive whose D' is 1 along x
            along, across = np.cos(psi), -np.sin(psi) / r
            drive = np.array([along * np.cos(psi) - across * np.sin(psi),
                              along * np.sin(psi) + across * np.cos(psi)])  # fmt: skip
            values[i, j] = _parts(solved(q, 0.5 * drive, 0.0), r, ratio)
            values[i, -j] = values[i, j]
            values[i, -j, TURN] *= -1.0 if 0 < j < angles // 2 else 1.0
    values[..., TURN] = np.unwrap(values[..., TURN], axis=1)
    finer = unit if unit.boundary == "reynolds" else replace(unit, columns=_MOST_COLUMNS)
    built = Built(coefficients(values, flat=sigma > 0.0), last, 0.0, 0.0, finer.columns)
    typical, largest = _deviation(built, _Solved(finer), sigma, ratio)
    return replace(built, typical=typical, largest=largest)


def _eccentricity(a: float, most: float, sigma: float) -> float:
    """The eccentricity at which the radial coordinate is `a`, by bisection: it grows with it."""
    low, high = 0.0, most
    for _ in range(60):
        middle = 0.5 * (low + high)
        if narrowing(middle, sigma)[1] < a:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def _parts(result: Floats, r: float, ratio: float) -> Floats:
    parts, wall = np.empty(PARTS), ratio + r * r
    parts[FORCE] = np.log(np.hypot(result[0], result[1]) * r**3 * wall)
    parts[TURN] = np.arctan2(-result[1], -result[0])
    parts[SUMMIT] = np.log(max(float(result[PEAK]), np.finfo(float).tiny) * r**4 * wall)
    parts[RUB] = result[SHEAR] * r
    parts[RUN] = result[FLOW]
    return parts


@kernel
def looked_up(
    table: Table, q: Floats, v: Floats, speed: float, sigma: float, ratio: float, result: Floats
) -> None:
    """`solve_table` on its own."""
    solve_table(table, q, v, speed, sigma, ratio, result)


def _deviation(built: Built, solved: _Solved, sigma: float, ratio: float) -> tuple[float, float]:
    """How far the force is from V2's: rotating journals that move by up to their speed, in any direction."""
    random, table, result = np.random.default_rng(1), built.table(), np.zeros(RESULTS)
    found = np.empty(_TRIALS)
    for k in range(_TRIALS):
        angle, other = random.uniform(0.0, 2.0 * np.pi, 2)
        e, size = 1.0 - 10.0 ** random.uniform(-3.0, 0.0), random.uniform(0.0, 0.5)
        q, v = e * np.array([np.cos(angle), np.sin(angle)]), size * np.array([np.cos(other), np.sin(other)])
        force = solved(q, v, 1.0)[:2]
        looked_up(table, q, v, 1.0, sigma, ratio, result)
        found[k] = np.hypot(*(result[:2] - force)) / max(np.hypot(*force), _WEAK)
    return float(np.quantile(found, 0.99)), float(found.max())
