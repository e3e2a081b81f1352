"""Where a unit's variables lie: value references, start values, blocks."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from fmus.port.failure import FAILURE
from fmus.port.variable import Kind, Variable


def _block(variables: Sequence[Variable], chosen: Iterable[int], what: str) -> slice:
    """Return the slice that holds exactly the references `chosen`."""
    references = sorted(chosen)
    if not references:
        return slice(len(variables), len(variables))
    block = slice(references[0], references[-1] + 1)
    if block.stop - block.start != len(references):
        raise ValueError(f"port: the {what} must stand in one block")
    return block


@dataclass(frozen=True)
class Layout:
    """The variables of a unit; the value reference is the place in the port.

    Parameters
    ----------
    variables : tuple of Variable
        Inputs first, all Real; parameters and calculated parameters in one block;
        Real outputs in one block, lazy ones aside; `failure` among the variables.

    Raises
    ------
    ValueError
        If the variables are not in this order.
    """

    variables: tuple[Variable, ...]
    references: list[int] = field(init=False, repr=False)
    index: dict[str, int] = field(init=False, repr=False)
    starts: list[float] = field(init=False, repr=False)
    strings: dict[int, str] = field(init=False, repr=False)
    settable: dict[Kind, frozenset[int]] = field(init=False, repr=False)
    tunable: frozenset[int] = field(init=False, repr=False)
    computed: frozenset[int] = field(init=False, repr=False)
    lazy: dict[str, frozenset[int]] = field(init=False, repr=False)
    lazy_span: dict[str, tuple[int, int]] = field(init=False, repr=False)
    first_lazy: int = field(init=False, repr=False)
    inputs: slice = field(init=False)
    outputs: slice = field(init=False)
    parameters: slice = field(init=False)

    def __post_init__(self) -> None:
        numbered = list(enumerate(self.variables))
        causality = [v.causality for v in self.variables]
        index = {v.name: i for i, v in numbered}
        if len(index) != len(self.variables):
            raise ValueError("port: a variable's name stands twice")
        inputs = _block(self.variables, (i for i, c in enumerate(causality) if c == "input"), "inputs")
        if inputs.start != 0 or any(v.kind != "Real" for v in self.variables[inputs]):
            raise ValueError("port: inputs must come first and be Real")
        set_field = object.__setattr__  # the dataclass is frozen
        set_field(self, "references", list(range(len(self.variables))))
        set_field(self, "index", index)
        set_field(self, "starts", [_number(v) for v in self.variables])
        set_field(self, "strings", {i: str(v.start or "") for i, v in numbered if v.kind == "String"})
        kinds: tuple[Kind, ...] = ("Real", "Integer", "Boolean", "String")
        free = ("input", "parameter")
        set_field(
            self,
            "settable",
            {k: frozenset(i for i, v in numbered if v.kind == k and v.causality in free) for k in kinds},
        )
        set_field(self, "tunable", frozenset(i for i, v in numbered if v.tunable))
        set_field(self, "computed", frozenset(i for i, c in enumerate(causality) if c not in free))
        groups = sorted({v.lazy for v in self.variables if v.lazy})
        set_field(self, "lazy", {g: frozenset(i for i, v in numbered if v.lazy == g) for g in groups})
        set_field(self, "lazy_span", {group: (min(vrs), max(vrs)) for group, vrs in self.lazy.items()})
        set_field(
            self, "first_lazy", min((first for first, _ in self.lazy_span.values()), default=len(index))
        )
        set_field(self, "inputs", inputs)
        if FAILURE.name not in index:
            raise ValueError(f"port: the output {FAILURE.name} is missing")
        eager = (i for i, v in numbered if v.causality == "output" and v.kind == "Real" and not v.lazy)
        set_field(self, "outputs", _block(self.variables, eager, "outputs"))
        fixed = (i for i, v in numbered if v.variability in ("fixed", "tunable"))
        set_field(self, "parameters", _block(self.variables, fixed, "parameters"))

    def __getitem__(self, name: str) -> int:
        """Return the value reference of the variable `name`."""
        return self.index[name]

    def block(self, first: str, last: str) -> slice:
        """Return the references from the variable `first` to `last`, both included."""
        return slice(self.index[first], self.index[last] + 1)


def _number(variable: Variable) -> float:
    """Return the start value as a number; outputs and strings have none."""
    if variable.start is None or variable.kind == "String":
        return 0.0
    return float(variable.start)
