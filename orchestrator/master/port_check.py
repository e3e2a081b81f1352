"""What the variables of a unit lack of the port."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from fmus import port
from orchestrator.fmi.unit import Unit
from rotor_fmu.train.wording import likely


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
