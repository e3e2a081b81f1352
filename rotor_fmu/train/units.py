"""Values as people write them, ``450 mm``, in the SI unit of their key; by pint."""

from __future__ import annotations

import re
from decimal import Decimal
from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pint import Unit, UnitRegistry

_VALUE = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*")
_UNIT = re.compile(r"[A-Za-z0-9µμ°*/^·.()\- ]{1,40}")
_LARGEST_POWER = 9
_TURNING = re.compile(r"rad|deg|°|rev|turn|rpm|Hz")
"""What an angular velocity is said in; 1/s and 1/min would leave open whether radians or turns are meant."""


def in_si(text: str, unit: str) -> float:
    """Read a number with a unit.

    The conversion is exact in decimals, so that 35 mm and 0.035 are the same number.

    Parameters
    ----------
    text : str
        A number and its unit.
    unit : str
        The SI unit wanted, as the descriptions of `rotor_fmu.train.schema` write it: ``kg m2``, ``rad/s``.

    Returns
    -------
    float
        In that unit.

    Raises
    ------
    ValueError
        Saying what is allowed.
    """
    found = _VALUE.fullmatch(text)
    if "," in text:
        raise ValueError("a number with a decimal point, or in a table decimal commas in all numbers")
    if found is None:
        raise ValueError("a number")
    number, given = found.groups()
    if not given:
        raise ValueError(f'a number in {unit}, or in quotes with its unit, as "{number} {_example(unit)}"')
    if unit == "rad/s" and not _TURNING.search(given):
        raise ValueError("a number in rad/s, or with one of the units rad/s, deg/s, rev/min, Hz")
    if unit == "rad/s":
        given = given.replace("Hz", "turn/s")
    try:
        return float(_registry().Quantity(Decimal(number), _parsed(given)).to(_parsed(unit)).magnitude)
    except Exception:  # whatever pint and its tokenizer make of words that are no unit
        raise ValueError(f"a number in {unit} or in a unit of the same kind, as {_example(unit)}") from None


def _parsed(unit: str) -> Unit:
    if not _UNIT.fullmatch(unit):
        raise ValueError(unit)
    powers = re.sub(r"(?<=[A-Za-zµμ])\^?(-?\d+)", r"**\1", unit).replace("·", "*").replace("^", "**")
    if any(int(power) > _LARGEST_POWER for power in re.findall(r"\d+", powers)):
        raise ValueError(unit)
    return _registry().parse_units(re.sub(r"\brev\b", "turn", powers))


def _example(unit: str) -> str:
    """A unit in which people give what SI measures in this one."""
    examples = {"m": "mm", "Pa": "GPa", "rad": "deg", "rad/s": "rev/min", "Pa s": "mPa s", "kg/m3": "g/cm3"}
    return examples.get(unit, unit)


@cache
def _registry() -> UnitRegistry:
    import pint  # a second, which only those wait for who give units

    return pint.UnitRegistry(non_int_type=Decimal)


def converted(value: Any, unit: str) -> Any:
    """A value with the texts in it, also in lists of lists, as numbers in a unit."""
    if isinstance(value, list):
        return [converted(item, unit) for item in value]
    return in_si(value, unit) if isinstance(value, str) else value
