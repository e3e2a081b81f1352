"""Where runs are carried out: a process that does one after another, and what they share there."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

from orchestrator.study.ensemble.running.row import REFUSED, Row, Value


@dataclass
class Bench:
    """A process of runs.

    Attributes
    ----------
    give_up : callable
        Gets the row of a run whose unit hangs, and does not return.
    shared : dict
        What the runs share, by name.
    """

    give_up: Callable[[Row], None]
    shared: dict[str, Any] = field(default_factory=dict)


class Work(Protocol):
    """Something to be done on a bench."""

    def carry_out(self, bench: Bench) -> Row:
        """Do it."""
        ...


@dataclass(frozen=True)
class FunctionWork:
    """A value of a function of the parameters: numbers by name, or one."""

    function: Callable[..., Mapping[str, float] | float]
    arguments: Mapping[str, Any]

    def carry_out(self, bench: Bench) -> Row:
        """Call it."""
        begin = time.perf_counter()
        try:
            found = self.function(**self.arguments)
        except Exception as error:
            return Row(REFUSED, " ".join(f"{type(error).__name__}: {error}".split()))
        named = found if isinstance(found, Mapping) else {"value": found}
        values = {name: Value((), float(value)) for name, value in named.items()}
        spent = time.perf_counter() - begin
        return Row("finished", "", values, timing={"loop": spent, "run": spent})
