"""Wrong use of the command in one line on stderr, as every other error; the status is that of wrong input."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from enum import StrEnum
from typing import Any, TypeVar

import typer
from typer.core import TyperGroup

from orchestrator.outcome import INPUT_ERROR
from rotor_fmu.train.wording import choice

_WRONG_USE: type[Exception] = typer.BadParameter.__mro__[1]  # UsageError, which typer does not export
_Choice = TypeVar("_Choice", bound=StrEnum)


class Commands(TyperGroup):
    """The commands; what click says about wrong options comes without box and usage."""

    def main(
        self, args: Sequence[str] | None = None, *others: Any, standalone_mode: bool = True, **more: Any
    ) -> Any:
        """Run a command and end the process, as click does."""
        more["standalone_mode"] = False
        if not standalone_mode:
            return super().main(args, *others, **more)
        try:
            status = super().main(args, *others, **more)
        except typer.Abort:
            typer.secho("error: aborted", err=True, fg="red")
            status = 1
        except _WRONG_USE as error:
            status = INPUT_ERROR
            text = " ".join(error.format_message().split())  # type: ignore[attr-defined]
            context = getattr(error, "ctx", None)
            if type(error).__name__ == "NoArgsIsHelpError":  # nothing given, and its help is shown by now
                typer.echo(text)
            else:
                hint = f" (see {context.command_path} --help)" if context else ""
                typer.secho(f"error: {text}{hint}", err=True, fg="red")
        sys.exit(status)


class WrongChoice(typer.BadParameter):
    """A value of an option that is none of its choices."""

    def format_message(self) -> str:
        """Return the message alone, which names the option."""
        return self.message


def one_of(kind: type[_Choice], option: str) -> Callable[[str], _Choice]:
    """Return the parser of an option with choices.

    Parameters
    ----------
    kind : type of StrEnum
        The choices.
    option : str
        Name of the option, such as ``--depth``.
    """

    def parse(given: str) -> _Choice:
        try:
            return kind(given)
        except ValueError:
            raise WrongChoice(f"{option} {given}: {choice(given, kind)}") from None

    return parse
