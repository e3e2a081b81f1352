"""What the variables of a unit lack of the port."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from fmus import port
from orchestrator.errors import PortError
from orchestrator.fmi.unit import Unit
from rotor_fmu.train.wording import likely

_OFFSETS = tuple(v for v in port.BEARING_PARAMETERS if v.name.startswith("offset."))


def check_port(rotor: Unit, bearings: Sequence[Unit], *, turning: bool = False) -> None:
    """Compare the units with the port.

    Raises
    ------
    PortError
        One line for each variable that is missing or differs in causality or unit.
    """
    by_name = {v.name: v for v in port.rotor([b.name for b in bearings], (), 0)}
    needed = [port.SPEED]
    for index in range(1, len(bearings) + 1):
        needed += [port.at_bearing(index, name) for name in (*port.LAW, *port.JOURNAL)]
    needed += [*port.SWITCHES, port.LOST, port.ROTATION] if turning else []
    problems = list(differences(rotor, (by_name[name] for name in needed)))
    seen = set()
    for bearing in bearings:
        if bearing.file not in seen:
            seen.add(bearing.file)
            problems += differences(bearing, (*port.BEARING_INPUTS, *port.BEARING_OUTPUTS, *_OFFSETS))
    surplus = port.at_bearing(len(bearings) + 1, port.JOURNAL[0])
    if surplus in rotor.file.variables:
        problems.append(f"{rotor.file.path}: has more than the {len(bearings)} bearings of the train")
    if problems:
        raise PortError("\n".join(problems))


def differences(unit: Unit, variables: Iterable[port.Variable]) -> Iterator[str]:
    """Yield a line for each variable that a unit lacks or declares otherwise."""
    variables = tuple(variables)
    others = unit.file.variables.keys() - {variable.name for variable in variables}
    for wanted in variables:
        found = unit.file.variables.get(wanted.name)
        where = f"{unit.file.path}: {wanted.name}"
        if found is None:
            hint = likely(wanted.name, sorted(others)).strip()
            kind = f"{wanted.causality}, {wanted.unit or 'dimensionless'}"
            yield f"{where} is missing ({kind})" + (f"; {hint}" if hint else "")
        elif found.causality != wanted.causality or found.type != wanted.kind:
            yield f"{where} is {found.causality} {found.type}, not {wanted.causality} {wanted.kind}"
        elif (found.unit or "") not in ("", wanted.unit):
            yield f"{where} is in {found.unit}, not in {wanted.unit or 'no unit'}"
