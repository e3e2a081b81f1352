"""Units of measurement of an SSP: definitions, conversion by them, and values that wait for it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any
from xml.etree.ElementTree import Element

from fmus.port.variable import Value

_BASES = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")


@dataclass(frozen=True)
class UnitDefinition:
    """A unit by its SI base units: value in SI = factor * value + offset (SSP 1.0, as in FMI 2.0).

    Attributes
    ----------
    name : str
        As written.
    exponents : tuple of int, or None
        Of kg, m, s, A, K, mol, cd, rad; None where the SSP defines no such unit.
    factor, offset : float
        To SI.
    """

    name: str
    exponents: tuple[int, ...] | None = None
    factor: float = 1.0
    offset: float = 0.0


def definition(name: str, base: Any) -> UnitDefinition:
    """Return a unit from the attributes of its BaseUnit, or from fmpy's; None: nothing is known of it."""
    if base is None:
        return UnitDefinition(name, (0,) * len(_BASES) if name in ("", "1", "-") else None)
    get = (
        base.get if isinstance(base, Element | dict) else lambda key, usual: getattr(base, key, None) or usual
    )
    exponents = tuple(int(get(key, 0)) for key in _BASES)
    return UnitDefinition(name, exponents, float(get("factor", 1.0)), float(get("offset", 0.0)))


def conversion(source: UnitDefinition, target: UnitDefinition) -> tuple[float, float]:
    """Return factor and offset from values in one unit to values in another.

    Raises
    ------
    ValueError
        When a unit is not defined, or they measure different things.
    """
    if source == target or (source.name == target.name and None in (source.exponents, target.exponents)):
        return 1.0, 0.0
    if source.exponents is None or target.exponents is None:
        missing = source.name if source.exponents is None else target.name
        raise ValueError(f"unit {missing!r} is defined nowhere")
    # without rad, which tools count or leave out
    factor, offset = source.factor / target.factor, (source.offset - target.offset) / target.factor
    if source.exponents[:-1] != target.exponents[:-1] or not (
        math.isfinite(factor) and factor and math.isfinite(offset)
    ):
        raise ValueError(f"{source.name!r} is no unit of {target.name or 'a plain number'!r}")
    return factor, offset


@dataclass(frozen=True)
class Given:
    """A parameter's value on its way to a variable: factor * (value in the variable's unit) + offset.

    Attributes
    ----------
    value : float, int, bool or str
        As written.
    unit : UnitDefinition or None
        None: the variable's own.
    factor, offset : float
        The linear transformations on the way.
    """

    value: Value
    unit: UnitDefinition | None = None
    factor: float = 1.0
    offset: float = 0.0

    def through(self, factor: float, offset: float, keep_unit: bool = True) -> Given:
        """The same after one more linear transformation."""
        unit = self.unit if keep_unit else None
        return replace(self, unit=unit, factor=factor * self.factor, offset=factor * self.offset + offset)

    def in_unit(self, unit: UnitDefinition | None) -> Value:
        """The value for a variable of a unit; ValueError where there is no conversion."""
        plain = self.unit is None and (self.factor, self.offset) == (1.0, 0.0)
        if plain or isinstance(self.value, str | bool):
            return self.value
        factor, offset = (1.0, 0.0) if self.unit is None or unit is None else conversion(self.unit, unit)
        if (factor, offset, self.factor, self.offset) == (1.0, 0.0, 1.0, 0.0):
            return self.value
        return self.factor * (factor * float(self.value) + offset) + self.offset
