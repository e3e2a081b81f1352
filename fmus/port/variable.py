"""A scalar variable of a unit and the units of measurement, as FMI 2.0 knows them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import inf, isfinite
from typing import Literal

Causality = Literal["input", "output", "parameter", "calculatedParameter", "local"]
Kind = Literal["Real", "Integer", "Boolean", "String"]
Variability = Literal["continuous", "discrete", "fixed", "tunable"]
Value = float | int | bool | str


@dataclass(frozen=True)
class Variable:
    """One scalar variable of a unit as other tools see it.

    Attributes
    ----------
    name : str
        Structured name (FMI 2.0, section 2.2.9).
    causality : str
        FMI causality.
    unit : str
        Name of the unit, a key of `UNITS`; empty for dimensionless.
    description : str
        One line, with sign convention where it matters.
    start : float, int, bool, str or None
        Start value of inputs and parameters.
    minimum, maximum, nominal : float or None
        Where physics gives them.
    above : bool
        Whether the minimum itself is excluded.
    choices : tuple of str
        Words that a String may be; empty: any.
    tunable : bool
        Whether a parameter may change between two steps.
    depends_on : tuple of str
        Names of the inputs an output depends on directly.
    starts_on : tuple of str or None
        Names of the inputs and parameters on which the initial value of an output
        or a calculated parameter depends; None: on all of them.
    kind : str
        FMI type.
    lazy : str
        Group of outputs that are computed together, only when one of them is asked for;
        empty for outputs of every step.
    """

    name: str
    causality: Causality
    unit: str = ""
    description: str = ""
    start: Value | None = None
    minimum: float | None = None
    nominal: float | None = None
    depends_on: tuple[str, ...] = ()
    starts_on: tuple[str, ...] | None = None
    kind: Kind = "Real"
    lazy: str = ""
    maximum: float | None = None
    above: bool = False
    choices: tuple[str, ...] = ()
    tunable: bool = False

    @property
    def variability(self) -> Variability:
        """FMI variability that follows from causality and type."""
        if self.causality in ("parameter", "calculatedParameter"):
            return "tunable" if self.tunable else "fixed"
        return "continuous" if self.kind == "Real" else "discrete"

    @property
    def range(self) -> str:
        """The range of a number in words, with its unit, or the choices."""
        if self.choices:
            return " or ".join(map(repr, self.choices))
        unit = f" ({self.unit})" if self.unit else ""
        low, high = self.minimum, self.maximum
        if low is None and high is None:
            return f"a finite number{unit}"
        if low is not None and high is not None:
            return f"{'an integer ' if self.kind == 'Integer' else ''}from {low:g} to {high:g}{unit}"
        return f"<= {high:g}{unit}" if low is None else f"{'>' if self.above else '>='} {low:g}{unit}"

    def admits(self, value: Value) -> bool:
        """Tell whether a number is finite and in the range, or a word one of the choices."""
        if isinstance(value, str):
            return not self.choices or value in self.choices
        low = -inf if self.minimum is None else self.minimum
        high = inf if self.maximum is None else self.maximum
        whole = self.kind != "Integer" or (isfinite(value) and value == int(value))
        return isfinite(value) and whole and low <= value <= high and not (self.above and value == low)


def with_starts(variables: Iterable[Variable], starts: Mapping[str, Value]) -> tuple[Variable, ...]:
    """Replace the start values named in `starts`.

    Raises
    ------
    ValueError
        If a name is unknown, or its variable takes no start value.
    """
    ports = {v.name: v for v in variables}
    for name in starts:
        if name not in ports or ports[name].start is None:
            raise ValueError(f"start value for {name!r}: not an input or a parameter of this unit")
    return tuple(replace(v, start=starts.get(v.name, v.start)) for v in ports.values())


@dataclass(frozen=True)
class Unit:
    """A unit as exponents of the SI base units (kg, m, s, K, rad)."""

    kg: int = 0
    m: int = 0
    s: int = 0
    K: int = 0
    rad: int = 0


UNITS: dict[str, Unit] = {
    "m": Unit(m=1),
    "m/s": Unit(m=1, s=-1),
    "m/s2": Unit(m=1, s=-2),
    "rad": Unit(rad=1),
    "rad/s": Unit(s=-1, rad=1),
    "s": Unit(s=1),
    "N": Unit(kg=1, m=1, s=-2),
    "N.m": Unit(kg=1, m=2, s=-2),
    "N/m": Unit(kg=1, s=-2),
    "N/rad": Unit(kg=1, m=1, s=-2, rad=-1),
    "N.m/rad": Unit(kg=1, m=2, s=-2, rad=-1),
    "N.s/m": Unit(kg=1, s=-1),
    "N.s/rad": Unit(kg=1, m=1, s=-1, rad=-1),
    "N.s": Unit(kg=1, m=1, s=-1),
    "N.m.s/rad": Unit(kg=1, m=2, s=-1, rad=-1),
    "Pa": Unit(kg=1, m=-1, s=-2),
    "Pa.s": Unit(kg=1, m=-1, s=-1),
    "W": Unit(kg=1, m=2, s=-3),
    "J": Unit(kg=1, m=2, s=-2),
    "kg": Unit(kg=1),
    "kg/m3": Unit(kg=1, m=-3),
    "kg.m": Unit(kg=1, m=1),
    "K": Unit(K=1),
    "m2/s": Unit(m=2, s=-1),
    "m3/s": Unit(m=3, s=-1),
    "J/K": Unit(kg=1, m=2, s=-2, K=-1),
    "J/(kg.K)": Unit(m=2, s=-2, K=-1),
    "kg.m2": Unit(kg=1, m=2),
    "N.m.s2": Unit(kg=1, m=2, rad=-2),
}
